"""A client for the parameters and services of a running simulator, which retries requests."""

import functools
import time
from collections.abc import Callable, Sequence

from rcl_interfaces.srv import GetParameters, SetParameters
from rclpy.executors import Executor
from rclpy.node import Node
from rclpy.parameter import Parameter, parameter_value_to_python

from vehicle_roll_sim.ros.node_main import LOOK
from vehicle_roll_sim.ros.services import RESET
from vehicle_roll_sim.ros.simulator.compile_status import Compilations

PATIENCE = 10.0
"""Time that a simulator may take to answer (wall s)."""
ASK_AGAIN = 2.0
"""Time after which a request is repeated (wall s)."""


class NoAnswerError(Exception):
    """No simulator answered as expected; the text says what was awaited."""


class SimulatorClient:
    """Calls the simulator node `name` on behalf of `node`, which is spun while waiting.

    All methods raise NoAnswerError if the simulator does not answer in time. Time during which it
    announces that it is compiling its model does not count.
    """

    def __init__(self, node: Node, executor: Executor, name: str):
        self._node, self._executor, self.name = node, executor, name
        self._compilations = Compilations(node, name)

    @functools.cached_property
    def _getting(self):
        return self._node.create_client(GetParameters, f"{self.name}/get_parameters")

    def get(self, names: Sequence[str]) -> list:
        """The values of parameters, in order; an empty list if one of them does not exist."""
        request = GetParameters.Request(names=names)
        answer = self._call(self._getting, request, f"its parameter {names[0]}")
        return [parameter_value_to_python(value) for value in answer.values]

    def set(self, name: str, value: float) -> None:
        """Set a parameter; raises NoAnswerError also if the simulator refuses the value."""
        client = self._node.create_client(SetParameters, f"{self.name}/set_parameters")
        parameter = Parameter(name, value=value).to_parameter_msg()
        request = SetParameters.Request(parameters=[parameter])
        result = self._call(client, request, f"its parameter {name}").results[0]
        if not result.successful:
            raise NoAnswerError(f"`{self.name}` refused {name} {value:g}: {result.reason}")

    def reset(self, before: Callable[[], None]) -> None:
        """Reset the simulator. The request may be repeated; `before` is called before each.

        What the simulator publishes on a reset reaches every subscription that `node` had at the
        first request: endpoints are announced in order, that of the service client last.
        """
        client = self._node.create_client(RESET.kind, f"{self.name}/{RESET.name}")
        answer = self._call(client, RESET.kind.Request(), "a reset", before)
        if not answer.success:
            raise NoAnswerError(f"`{self.name}` refused a reset: {answer.message}")

    def _call(self, client, request, what: str, before: Callable[[], None] = lambda: None):
        """Call a service until it answers; the request must be idempotent.

        A server that has not discovered its new client yet drops the answer, so that the request
        is repeated. On a busy machine the answer to an earlier one may come first: all later ones
        are then on their way, in order, and the last counts. `before` is called before each.
        """
        self.wait(client.service_is_ready, f"its service for {what}")
        until, asked = time.monotonic() + PATIENCE, []
        try:
            while not any(future.done() for future in asked):
                before()
                asked.append(client.call_async(request))
                self._await_any(asked, what, until)
            first = next(k for k, future in enumerate(asked) if future.done())
            for future in asked[first:]:
                self.wait(future.done, what)
            return asked[-1].result()
        finally:
            for future in asked:
                client.remove_pending_request(future)

    def _await_any(self, asked: Sequence, what: str, until: float) -> None:
        """Wait for an answer until it is time to ask again; raises NoAnswerError after `until`."""
        patience = min(ASK_AGAIN, until - time.monotonic())
        try:
            self.wait(lambda: any(future.done() for future in asked), what, patience)
        except NoAnswerError:
            if time.monotonic() >= until:
                raise

    def wait(self, done: Callable[[], bool], what: str, patience: float = PATIENCE) -> None:
        """Spin until `done()`. what: what is awaited, for the error message."""
        until = time.monotonic() + patience
        while not done():
            if self._compilations.is_running():
                until = time.monotonic() + patience
            if time.monotonic() > until:
                waited = f"no answer from `{self.name}` within {PATIENCE:g} s"
                raise NoAnswerError(f"{waited}; waiting for {what}")
            self._executor.spin_once(timeout_sec=LOOK)

    def linger(self, seconds: float) -> None:
        """Spin for a wall time (s)."""
        until = time.monotonic() + seconds
        while time.monotonic() < until:
            self._executor.spin_once(timeout_sec=LOOK)
