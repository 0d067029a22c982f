"""The standard `simulation_interfaces` as services and an action of the simulator.

Only where that package is installed. Here messages are read and filled; what they ask for is done
in `live.standard_simulator`.
"""

import importlib
import importlib.util
from collections.abc import Callable

from rclpy.action import ActionServer, CancelResponse

from vehicle_roll_sim.live.entity_state import EntityState
from vehicle_roll_sim.live.simulation_interfaces import Code
from vehicle_roll_sim.live.standard_simulator import FEATURES, StandardSimulator, Verdict

PACKAGE = "simulation_interfaces"
SERVICES = (
    "GetSimulatorFeatures",
    "GetSimulationState",
    "SetSimulationState",
    "ResetSimulation",
    "StepSimulation",
    "GetEntities",
    "GetEntityState",
    "SetEntityState",
    "SpawnEntity",
)
ACTION = "SimulateSteps"


def is_installed() -> bool:
    """Whether the package of the standard is installed."""
    return importlib.util.find_spec(PACKAGE) is not None


def name_of(kind: str) -> str:
    """The name of a service below the node, such as get_entity_state."""
    return "".join(f"_{char.lower()}" if char.isupper() else char for char in kind).lstrip("_")


class Yielding:
    """Awaited in a callback, it lets the executor do something else first."""

    def __await__(self):
        yield


class StandardServices:
    """Offers the services and the action on a node, and answers them.

    stamp: returns the present stamp. frame: the frame of poses.
    """

    def __init__(self, node, fulfilled: StandardSimulator, stamp: Callable, frame: str):
        self._node, self._fulfilled, self._stamp, self._frame = node, fulfilled, stamp, frame
        self._is_stepping = False

    def serve(self) -> None:
        """Create the services and the action server."""
        services = importlib.import_module(f"{PACKAGE}.srv")
        for kind in SERVICES:
            answer = getattr(self, name_of(kind))
            self._node.create_service(getattr(services, kind), f"~/{name_of(kind)}", answer)
        self._kind = getattr(importlib.import_module(f"{PACKAGE}.action"), ACTION)
        self._action = ActionServer(
            self._node,
            self._kind,
            f"~/{name_of(ACTION)}",
            self.simulate_steps,  # rclpy awaits only what is itself a coroutine function
            cancel_callback=lambda _: CancelResponse.ACCEPT,
        )

    def get_simulator_features(self, _, response):
        """What is supported."""
        response.features.features = [int(feature) for feature in FEATURES]
        response.features.custom_info = self._fulfilled.about
        return response

    def get_simulation_state(self, _, response):
        """Stopped, playing or paused."""
        response.state.state = int(self._fulfilled.state())
        return _said(response, Verdict(Code.OK))

    def set_simulation_state(self, request, response):
        """Play, pause or stop."""
        return _said(response, self._fulfilled.set_state(request.state.state))

    def reset_simulation(self, request, response):
        """Reset, with a scope."""
        return _said(response, self._fulfilled.reset(request.scope))

    def step_simulation(self, request, response):
        """Steps while paused, one after the other; no other callback runs meanwhile."""
        if not request.steps:
            return _said(response, _NO_STEPS)
        verdict, number = Verdict(Code.OK), 0
        while number < request.steps and verdict.code == Code.OK and self._node.context.ok():
            verdict, number = self._fulfilled.step(), number + 1
        return _said(response, verdict)

    def get_entities(self, request, response):
        """The vehicle, if its name matches."""
        filters = request.filters
        others = (filters.categories, filters.tags.tags, filters.bounds.points)
        verdict, response.entities = self._fulfilled.entities(filters.filter, any(map(len, others)))
        return _said(response, verdict)

    def get_entity_state(self, request, response):
        """Where the vehicle is, and how it moves."""
        verdict, state = self._fulfilled.entity_state(request.entity)
        if state:
            self._fill(response.state, state)
        return _said(response, verdict)

    def set_entity_state(self, request, response):
        """Move the vehicle; without flags, as in version 2.0.0, pose and twist are set."""
        state, frame = request.state, request.state.header.frame_id
        if frame not in ("", self._frame):
            only = f"frame_id {frame!a}: empty or {self._frame}"
            return _said(response, Verdict(Code.OPERATION_FAILED, only))
        pose, twist = state.pose, state.twist
        verdict = self._fulfilled.set_entity_state(
            request.entity,
            (_numbers(pose.position), (*_numbers(pose.orientation), pose.orientation.w))
            if getattr(request, "set_pose", True)
            else None,
            (_numbers(twist.linear), _numbers(twist.angular))
            if getattr(request, "set_twist", True)
            else None,
            getattr(request, "set_acceleration", False),
        )
        return _said(response, verdict)

    def spawn_entity(self, _, response):
        """Refused, as the list of features says."""
        return _said(response, self._fulfilled.spawn())

    async def simulate_steps(self, goal):
        """Steps while paused, with feedback after each, until they are done or cancelled.

        Other callbacks run between the steps.
        """
        result = self._kind.Result()
        if self._is_stepping:
            goal.abort()
            return _said(result, _OTHER_GOAL)
        self._is_stepping = True
        try:
            return _said(result, await self._stepped(goal, self._kind.Feedback()))
        finally:
            self._is_stepping = False

    async def _stepped(self, goal, feedback) -> Verdict:
        """The verdict on a goal, which is brought to its end."""
        steps, verdict = goal.request.steps, _NO_STEPS
        for number in range(1, steps + 1):
            if goal.is_cancel_requested:
                goal.canceled()
                return _CANCELLED
            verdict = self._fulfilled.step()
            if verdict.code != Code.OK:
                break
            feedback.completed_steps, feedback.remaining_steps = number, steps - number
            goal.publish_feedback(feedback)
            self._node.executor.wake()  # it does not wait for a message before the next step
            await Yielding()
        if verdict.code == Code.OK:
            goal.succeed()
        else:
            goal.abort()
        return verdict

    def _fill(self, message, state: EntityState) -> None:
        """Write the state of the vehicle into an EntityState message."""
        message.header.stamp, message.header.frame_id = self._stamp(), self._frame
        _set(message.pose.position, state.position)
        _set(message.pose.orientation, state.orientation)
        _set(message.twist.linear, state.velocity)
        _set(message.twist.angular, state.turning)
        _set(message.acceleration.linear, state.acceleration)
        _set(message.acceleration.angular, (float("nan"),) * 3)


_NO_STEPS = Verdict(Code.OPERATION_FAILED, "steps: 0 is not allowed: at least 1")
_OTHER_GOAL = Verdict(Code.OPERATION_FAILED, "another goal is being executed")
_CANCELLED = Verdict(Code.OPERATION_FAILED, "cancelled")


def _said(response, verdict: Verdict):
    """The response with its result."""
    response.result.result, response.result.error_message = int(verdict.code), verdict.message
    return response


def _numbers(vector) -> tuple[float, float, float]:
    return vector.x, vector.y, vector.z


def _set(message, values) -> None:
    for name, value in zip("xyzw", values, strict=False):
        setattr(message, name, value)
