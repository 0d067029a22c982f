"""The node `live_view`: shows a running simulator in a browser on this machine."""

import argparse
import sys
import webbrowser

import rclpy
from rclpy.clock import Clock as RosClock
from rclpy.clock import ClockType
from rclpy.node import Node

from vehicle_roll_sim.arguments import OneLineParser
from vehicle_roll_sim.input_errors import InputError, number_in
from vehicle_roll_sim.messages.run_messages import (
    COLLECTED,
    NOT_OF_EVERY_MODEL,
    STATE,
    TIRE_FORCES,
    RunMessages,
    by_name,
    is_ours,
)
from vehicle_roll_sim.messages.set_synchronizer import SetSynchronizer
from vehicle_roll_sim.messages.topic import Topic
from vehicle_roll_sim.messages.topics import SIMULATION_DESCRIPTION, set_of
from vehicle_roll_sim.ros.node_main import LOOK, lifetime, node_main, refuse_unknown_parameters
from vehicle_roll_sim.ros.qos_overrides import make_subscription, refuse_wrong_overrides
from vehicle_roll_sim.ros.topics import message_class, recording_qos
from vehicle_roll_sim.simulation.description import described
from vehicle_roll_sim.viewer.live_run import EVERY, LiveRun
from vehicle_roll_sim.viewer.live_server import DEFAULT_PORT, PORTS, LiveServer
from vehicle_roll_sim.viewer.scene import scene_of

SHOWN = (*COLLECTED, *TIRE_FORCES)


class LiveView(Node):
    """Collects the sets of a simulator, and gives them to the server's run every EVERY seconds.

    What the vehicle is comes from `simulation_description`; sets that come before it are not shown.
    """

    def __init__(self, server: LiveServer):
        super().__init__("live_view")
        refuse_unknown_parameters(self)
        topics = (SIMULATION_DESCRIPTION, *SHOWN, *NOT_OF_EVERY_MODEL)
        refuse_wrong_overrides(self, subscriptions=[topic.name for topic in topics])
        self._server, self._sets, self._description = server, None, ""
        self._subscriptions_of = [self._listen_to(topic) for topic in topics]
        steady = RosClock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(EVERY, self._pass_on, clock=steady)
        self._has_warned = False

    def _listen_to(self, topic: Topic):
        def listen(message, info: dict) -> None:
            if topic is SIMULATION_DESCRIPTION:
                self._describe(message.data)
            elif self._sets and topic.name in self._sets.names and is_ours(topic.name, message):
                whole = self._sets.add(topic.name, info["source_timestamp"], message)
                if whole:
                    self._keep(whole)

        kind = message_class(topic.type)
        return make_subscription(self, kind, topic.name, listen, recording_qos(topic))

    def _describe(self, text: str) -> None:
        """Begin anew with the vehicle described, unless it is the one that is shown."""
        if text == self._description:
            return
        try:
            simulation = described(text).simulation
        except InputError as error:
            self.get_logger().error(f"{self._subscriptions_of[0].topic_name}: {error}")
            return
        self._description, self._road = text, simulation.road
        in_set = set_of(simulation.options, stamped=False, devices=simulation.sensors.devices)
        further = (topic for topic in NOT_OF_EVERY_MODEL if topic in in_set)
        self._sets = SetSynchronizer(topic.name for topic in (*SHOWN, *further))
        self._kept = RunMessages()
        if self._server.run:
            self._server.run.close()
        label = self.get_namespace().strip("/") or "simulator"
        scene = scene_of(simulation.vehicle, simulation.options)
        self._server.run = LiveRun(label, scene, simulation.rollover_angle, simulation.road)

    def _keep(self, whole: tuple) -> None:
        """Keep a complete set; the place in the order stands for the time at which it was sent."""
        messages = dict(zip(self._sets.names, whole, strict=True))
        state = by_name(messages.pop(STATE))
        if self._kept.states and state["time"] < self._kept.states[-1][1]["time"]:
            self._pass_on()  # a reset
        place = len(self._kept.states)
        self._kept.states.append((place, state))
        for name, message in messages.items():
            self._kept.keep(name, place, message)

    def _pass_on(self) -> None:
        """Add what has been kept to the run."""
        self._warn_of_others()
        if self._sets is None or not self._kept.states:
            return
        kept, self._kept = self._kept, RunMessages()
        history = kept.history(self._road)
        if len(history.rows):
            self._server.run.add(history)

    def _warn_of_others(self) -> None:
        count = self.count_publishers(STATE)
        if count > 1 and not self._has_warned:
            where = "start one in each namespace, and this node in one of them"
            self.get_logger().warning(
                f"{count} nodes publish {STATE}, and are shown mixed: {where}"
            )
        self._has_warned = count > 1


def serve(port: int, opens: bool) -> int:
    """Serve until a signal; return the exit status."""
    server = LiveServer(port)
    server.start()
    try:
        with lifetime(LiveView(server)) as executor:
            print(f"live_view: {server.address}", flush=True)
            if opens:
                webbrowser.open(server.address)
            while rclpy.ok():
                executor.spin_once(timeout_sec=LOOK)
    finally:
        server.close()
    return 0


def main() -> int:
    """Entry point of the executable."""
    parser = OneLineParser(
        prog="live_view",
        description="Show a running simulator in a browser: vehicle in 3D, plots and events.",
    )
    parser.add_argument(
        "--port",
        default=str(DEFAULT_PORT),
        metavar="N",
        help="port on 127.0.0.1, 0 for any that is free (default: %(default)s)",
    )
    parser.add_argument("--open", action="store_true", help="also open the page in the browser")

    def body(arguments: argparse.Namespace) -> int:
        return serve(port_of(arguments.port), arguments.open)

    return node_main(parser, body, sys.argv)


def port_of(text: str) -> int:
    """The number of a port; raises InputError."""
    allowed = f"0 or a whole number from {PORTS[0]} to {PORTS[1]}"
    try:
        port = number_in(text)
    except ValueError:
        raise InputError("--port", text, allowed) from None
    if port != 0 and not (PORTS[0] <= port <= PORTS[1] and port == int(port)):
        raise InputError("--port", text, allowed)
    return int(port)


if __name__ == "__main__":
    sys.exit(main())
