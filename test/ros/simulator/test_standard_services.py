"""The services of the standard for simulators, with a stand-in for its messages.

The package simulation_interfaces is not among the wheels, so that no service of it can be called
here. The stand-in has the same fields and constants; the services are answered as rclpy would do.
"""

import dataclasses
import math
import sys

import pytest
import rclpy
import simulation_interfaces_stand_in
from patience import PATIENCE
from rclpy.task import Future

from vehicle_roll_sim.live import simulation_interfaces as codes
from vehicle_roll_sim.live.standard_simulator import StandardSimulator
from vehicle_roll_sim.ros.simulator import standard_services
from vehicle_roll_sim.ros.simulator.node import Simulator
from vehicle_roll_sim.ros.simulator.standard_services import SERVICES, StandardServices, name_of

STAND_IN = simulation_interfaces_stand_in.modules()
MSG, SRV, ACTION = (STAND_IN[f"simulation_interfaces.{part}"] for part in ("msg", "srv", "action"))


@dataclasses.dataclass
class Goal:
    """The handle of a goal, as rclpy gives it to an action."""

    steps: int
    ended: str = ""
    is_cancel_requested: bool = False

    def __post_init__(self):
        self.request = ACTION.SimulateSteps.Goal()
        self.request.steps = self.steps
        self.feedback = []

    def publish_feedback(self, feedback):
        self.feedback.append((feedback.completed_steps, feedback.remaining_steps))

    def succeed(self):
        self.ended = "succeeded"

    def abort(self):
        self.ended = "aborted"

    def canceled(self):
        self.ended = "cancelled"


@pytest.fixture
def simulator(domain):
    """A simulator that nothing spins, after its first set."""
    context = rclpy.Context()
    rclpy.init(context=context, domain_id=domain)
    node = Simulator(context=context)
    executor = rclpy.executors.SingleThreadedExecutor(context=context)
    executor.add_node(node)
    node.begin()
    yield node
    executor.shutdown()
    node.destroy_node()
    rclpy.shutdown(context=context)


@pytest.fixture
def offered(simulator, monkeypatch):
    """The services that would be offered: their classes and callbacks by name."""
    for name, module in STAND_IN.items():
        monkeypatch.setitem(sys.modules, name, module)
    found = {}

    def create(kind, name, callback):
        found[name] = kind, callback

    def create_action(_, kind, name, execute, **__):
        found[name] = kind, execute

    monkeypatch.setattr(simulator, "create_service", create)
    monkeypatch.setattr(standard_services, "ActionServer", create_action)
    simulator._serve_standard()
    return found


@pytest.fixture
def call(offered):
    """call(SERVICE, FIELD=VALUE...): the response of a service."""

    def call_one(service: str, /, **fields):
        kind, callback = offered[f"~/{name_of(service)}"]
        request, response = kind.Request(), kind.Response()
        for field, value in fields.items():
            setattr(request, field, value)
        assert callback(request, response) is response
        return response

    return call_one


def state_of(number: int):
    message = MSG.SimulationState()
    message.state = number
    return message


def test_the_codes_are_those_of_the_definitions():
    for feature in codes.Feature:
        assert getattr(MSG.SimulatorFeatures, feature.name) == feature
    for state in codes.State:
        assert getattr(MSG.SimulationState, f"STATE_{state.name}") == state
    for scope in (*codes.Scope, codes.Scope.ALL):
        assert getattr(SRV.ResetSimulation.Request, f"SCOPE_{scope.name}") == scope
    of_states = SRV.SetSimulationState.Response
    for code in codes.Code:
        assert getattr(MSG.Result if code < 100 else of_states, code.name) == code
    assert SRV.SetEntityState.Response.INVALID_POSE == codes.INVALID_POSE


def test_without_the_package_nothing_of_it_is_offered(simulator):
    if standard_services.is_installed():
        pytest.skip("the package simulation_interfaces is installed")
    names = {each.srv_name for each in simulator.services}
    assert not any(f"/{name_of(kind)}" in name for kind in SERVICES for name in names)


def test_every_service_and_the_action_are_offered_below_the_node(offered):
    names = {f"~/{name_of(kind)}" for kind in (*SERVICES, "SimulateSteps")}
    assert offered.keys() == names
    assert "~/get_simulator_features" in names
    assert "~/simulate_steps" in names


def test_features_are_those_that_have_a_service(call):
    features = call("GetSimulatorFeatures").features
    assert set(features.features) == {int(each) for each in codes.Feature}
    assert MSG.SimulatorFeatures.SPAWNING not in features.features
    assert list(features.spawn_formats) == []
    assert "0.01 s" in features.custom_info


def test_it_is_paused_stepped_and_reset(call, simulator):
    """The default of `steps` is 1."""
    assert call("GetSimulationState").state.state == codes.State.PLAYING
    assert call("StepSimulation").result.result == codes.Code.OPERATION_FAILED
    assert call("SetSimulationState", state=state_of(codes.State.PAUSED)).result.result == 1
    assert call("StepSimulation").result.result == codes.Code.OK
    assert call("StepSimulation", steps=4).result.result == codes.Code.OK
    assert simulator.session.simulation.time == 0.05
    assert call("StepSimulation", steps=0).result.error_message
    assert call("ResetSimulation", scope=1).result.result == codes.Code.FEATURE_UNSUPPORTED
    assert call("ResetSimulation").result.result == codes.Code.OK
    assert simulator.session.simulation.time == 0.0
    assert call("SetSimulationState", state=state_of(codes.State.STOPPED)).result.result == 1
    assert call("GetSimulationState").state.state == codes.State.STOPPED


def test_entities_are_found_by_name_alone(call):
    assert call("GetEntities").entities == ["vehicle"]
    filters = MSG.EntityFilters()
    filters.filter = "nothing"
    assert call("GetEntities", filters=filters).entities == []
    for field, value in (("categories", [MSG.EntityCategory()]), ("filter", "(")):
        filters = MSG.EntityFilters()
        setattr(filters, field, value)
        response = call("GetEntities", filters=filters)
        assert response.result.result != codes.Code.OK
        assert response.result.error_message


def test_the_state_of_the_vehicle_is_read_and_set(call, simulator):
    response = call("GetEntityState", entity="vehicle")
    assert response.result.result == codes.Code.OK
    state = response.state
    assert state.header.frame_id == "odom"
    assert state.twist.linear.x == pytest.approx(simulator.settings.initial_speed)
    assert math.isnan(state.acceleration.angular.x)
    state.pose.position.x, state.pose.position.y = 3.0, 4.0
    state.twist.linear.x = 10.0
    given = {"entity": "vehicle", "state": state}
    assert call("SetEntityState", **given).result.result == codes.Code.OK  # nothing is to be set
    assert simulator.session.simulation.state["x"] == 0.0
    given |= {"set_pose": True, "set_twist": True}
    assert call("SetEntityState", **given).result.result == codes.Code.OK
    found = simulator.session.simulation.state
    assert (found["x"], found["y"], found["u"]) == pytest.approx((3.0, 4.0, 10.0))
    state.header.frame_id = "map"
    assert "map" in call("SetEntityState", **given).result.error_message
    assert call("GetEntityState", entity="nobody").result.result == codes.Code.NOT_FOUND


def test_without_flags_as_in_version_2_0_0_pose_and_twist_are_set(call, simulator, monkeypatch):
    state = call("GetEntityState", entity="vehicle").state
    state.pose.position.x, state.twist.linear.x = 9.0, 11.0
    standard = StandardSimulator(simulator.session, simulator._control, simulator.lock)
    services = StandardServices(simulator, standard, None, "odom")

    class Request:
        entity = "vehicle"

    Request.state = state
    response = services.set_entity_state(Request, SRV.SetEntityState.Response())
    assert response.result.result == codes.Code.OK
    found = simulator.session.simulation.state
    assert (found["x"], found["u"]) == pytest.approx((9.0, 11.0))


def test_a_spawn_is_refused(call):
    response = call("SpawnEntity", name="second")
    assert response.result.result == codes.Code.FEATURE_UNSUPPORTED
    assert "namespace" in response.result.error_message


@pytest.fixture
def stepping(offered, simulator):
    """stepping(goal): a task of the executor that executes a goal."""
    _, execute = offered["~/simulate_steps"]
    return lambda goal: simulator.executor.create_task(execute, goal)


def finished(simulator, task: Future):
    while not task.done():
        simulator.executor.spin_once(timeout_sec=PATIENCE)
    return task.result().result


def test_steps_are_simulated_with_feedback_after_each(simulator, stepping):
    simulator.session.paused = True
    goal = Goal(3)
    assert finished(simulator, stepping(goal)).result == codes.Code.OK
    assert (goal.ended, goal.feedback) == ("succeeded", [(1, 2), (2, 1), (3, 0)])
    assert simulator.session.simulation.time == 0.03


@pytest.mark.parametrize(("steps", "paused"), [(0, True), (2, False)])
def test_no_steps_and_steps_while_it_runs_are_refused(simulator, stepping, steps, paused):
    simulator.session.paused = paused
    goal = Goal(steps)
    result = finished(simulator, stepping(goal))
    assert (result.result, goal.ended) == (codes.Code.OPERATION_FAILED, "aborted")
    assert result.error_message


def test_between_steps_the_executor_does_other_things_such_as_a_cancellation(simulator, stepping):
    simulator.session.paused = True
    goal, other = Goal(2**60), Goal(1)
    task = stepping(goal)
    while len(goal.feedback) < 3:
        assert not task.done()
        simulator.executor.spin_once(timeout_sec=PATIENCE)
    refused = finished(simulator, stepping(other))
    assert (refused.error_message, other.ended) == ("another goal is being executed", "aborted")

    def cancel():
        goal.is_cancel_requested = True
        timer.cancel()

    timer = simulator.create_timer(0.0, cancel)
    assert finished(simulator, task).error_message == "cancelled"
    assert goal.ended == "cancelled"
    assert simulator.session.simulation.time == pytest.approx(0.01 * len(goal.feedback))
    assert finished(simulator, stepping(Goal(1))).result == codes.Code.OK
