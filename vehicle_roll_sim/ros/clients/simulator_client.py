"""A running simulator as another node sees it: its parameters and services, asked for patiently."""

import time
from collections.abc import Callable, Sequence

from rcl_interfaces.srv import GetParameters, SetParameters
from rclpy.executors import Executor
from rclpy.node import Node
from rclpy.parameter import Parameter, parameter_value_to_python
from std_srvs.srv import Trigger

from vehicle_roll_sim.ros.process import LOOK
from vehicle_roll_sim.ros.simulator.compiling import Compilations

PATIENCE = 10.0
"""Wall seconds that a simulator may take to answer."""
ASK_AGAIN = 2.0
"""Wall seconds after which a question is repeated."""


class NoAnswerError(Exception):
    """No simulator answered as it should; the text says what was waited for."""


class SimulatorClient:
    """Asks the simulator of a name on behalf of `node`, which is spun while it waits.

    All methods raise NoAnswerError if the simulator does not answer in time. One that says that it
    is compiling its model is waited for until it has.
    """

    def __init__(self, node: Node, executor: Executor, name: str):
        self._node, self._executor, self.name = node, executor, name
        self._compilations = Compilations(node, name)

    def get(self, names: Sequence[str]) -> list:
        """Values of parameters; none at all where one of them is not there."""
        client = self._node.create_client(GetParameters, f"{self.name}/get_parameters")
        answer = self._call(client, GetParameters.Request(names=names), f"its {names[0]}")
        return [parameter_value_to_python(value) for value in answer.values]

    def set(self, name: str, value: float) -> None:
        """Change a parameter."""
        client = self._node.create_client(SetParameters, f"{self.name}/set_parameters")
        parameter = Parameter(name, value=value).to_parameter_msg()
        request = SetParameters.Request(parameters=[parameter])
        result = self._call(client, request, f"its {name}").results[0]
        if not result.successful:
            raise NoAnswerError(f"`{self.name}` refused {name} {value:g}: {result.reason}")

    def reset(self, before: Callable[[], None]) -> None:
        """Reset it; it may be asked more than once, and `before` is called before each time.

        What the simulator publishes in a reset reaches the subscriptions that `node` had at its
        first question: endpoints are made known in order, and that of an answer after theirs.
        """
        client = self._node.create_client(Trigger, f"{self.name}/reset")
        answer = self._call(client, Trigger.Request(), "a reset", before)
        if not answer.success:
            raise NoAnswerError(f"`{self.name}` refused a reset: {answer.message}")

    def _call(self, client, request, what: str, before: Callable[[], None] = lambda: None):
        """Ask a service until it answers, which must not mind being asked twice.

        A server that has not found its new client yet drops the answer. `before` each request.
        """
        self.wait(client.service_is_ready, f"its service for {what}")
        until = time.monotonic() + PATIENCE
        while True:
            before()
            future = client.call_async(request)
            try:
                self.wait(future.done, what, min(ASK_AGAIN, until - time.monotonic()))
            except NoAnswerError:
                client.remove_pending_request(future)
                if time.monotonic() >= until:
                    raise
            else:
                return future.result()

    def wait(self, done: Callable[[], bool], what: str, patience: float = PATIENCE) -> None:
        """Spin until `done()`; what: the thing that is waited for, for an error message."""
        until = time.monotonic() + patience
        while not done():
            if self._compilations.is_running():
                until = time.monotonic() + patience
            if time.monotonic() > until:
                raise NoAnswerError(f"no answer from `{self.name}` in {PATIENCE:g} s: {what}")
            self._executor.spin_once(timeout_sec=LOOK)

    def linger(self, seconds: float) -> None:
        """Spin for so many wall seconds."""
        until = time.monotonic() + seconds
        while time.monotonic() < until:
            self._executor.spin_once(timeout_sec=LOOK)
