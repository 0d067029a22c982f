"""Parameters of the simulator: one line for an invalid one, ranges, read-only structure."""

import math
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest
from rcl_interfaces.srv import DescribeParameters, GetParameters, ListParameters, SetParameters
from rclpy.parameter import Parameter
from std_srvs.srv import Trigger

from vehicle_roll_sim import InputError, Vehicle, preset
from vehicle_roll_sim.declaration import Curve, parameters_of
from vehicle_roll_sim.ros.simulator.node import Simulator
from vehicle_roll_sim.ros.simulator.parameters import PARAMETERS

EXAMPLES = Path(__file__).parents[3] / "msg_examples"
PLAUSIBLE_RUN = 1000
"""s: far more than a test lasts, far less than the time since 1970."""
WRONG = {
    "vehicle.sprung_mass:=-3": ("vehicle.sprung_mass", "0.01"),
    "vehicle.sprung_mas:=1500": ("vehicle.sprung_mas", "vehicle.sprung_mass"),
    "vehicle.roll_inertia:=5000": ("vehicle.roll_inertia", "4000"),
    "vehicle.tire:=none.tir": ("none.tir", "No such file"),
    "vehicle_file:=none.yaml": ("none.yaml", "No such file"),
    "road_file:=none.yaml": ("none.yaml", "No such file"),
    "steering_limt:=1.0": ("steering_limt", "did you mean steering_limit?"),
    "normal_force_limit:=-1.0": ("normal_force_limit", "from 0 to 1e+06 N"),
    "steering_rate_limit:=.inf": ("steering_rate_limit", "from 0 to 1000 rad/s"),
    "catch_up_limit:=60": ("catch_up_limit", "from 0 to 10 s"),
    "publish_rate:=.nan": ("publish_rate", "number"),
    "step:=0.0003": ("publish_rate", "multiple of the step"),
    "step:=0.005 initial_speed:=4.0 steady_state_slip:=true": ("step", "at most 0.0015 s at 4 m/s"),
    "step:=1e-6 publish_rate:=5": ("publish_rate", "at least 10 Hz with steps of 1e-06 s"),
    "initial_speed:=-0.1": ("initial_speed", "from 0 to 100 m/s"),
    "initial_speed:=3.4 steady_state_slip:=true": ("initial_speed", "3.5 m/s"),
    "grade:=1.5": ("grade", "from -1 to 1 m/m"),
    "bank:=steep": ("bank", "number"),
    "rollover_angle:=4.0": ("rollover_angle", "1.57"),
    "euler_terms:=3": ("euler_terms", "true or false"),
    "steering_timeout_policy:=let_go": ("steering_timeout_policy", "hold, centre"),
    "model:=1d": ("model", "1c-iii"),
    "imu.orientation_covariance_diagonal:=[0.1,0.1]": ("imu.orientation", "a list of 3 numbers"),
    "imu.angular_velocity_covariance_diagonal:=[1.0,1.0,-0.1]": ("imu.angular", "from 0 to 1e+12"),
    "odom.pose_covariance_diagonal:=0.1": ("odom.pose_cov", "a list of 6 numbers from 0"),
    "odom.pos_covariance_diagonal:=[1.0]": ("odom.pos", "did you mean odom.pose_covariance_diag"),
    "mode:=walk": ("mode", "real_time, lockstep"),
    "real_time_factor:=0.01": ("real_time_factor", "0, or from 0.1 to 100"),
    "lockstep_topics:=[steering]": ("lockstep_topics", "steering_cmd, rear"),
    "lockstep_wait:=[state_stamped]": ("lockstep_wait", "only with publish_stamped"),
    "lockstep_wait:=odom": ("lockstep_wait", "a list of one or more of state"),
}


@pytest.mark.parametrize("assignment", WRONG)
def test_a_wrong_parameter_is_refused_by_name_with_what_is_allowed(context, assignment):
    words = [word for each in assignment.split() for word in ("-p", each)]
    with pytest.raises(InputError) as refusal:
        Simulator(context=context, cli_args=["--ros-args", *words])
    for word in WRONG[assignment]:
        assert word in str(refusal.value)


def beyond(declared) -> list:
    """Wrong values of a parameter."""
    if declared.size:
        fewer = [1.0] * (declared.size - 1)
        with_wrong_end = [[*fewer, end] for end in ("1", -1e-9, math.nan, math.inf, True, None)]
        return [1.0, "1", None, [], fewer, [*fewer, 1.0, 1.0], *with_wrong_end]
    if declared.kind is Curve:
        return [math.nan, "no_such", None, True, [], 99.0, [0.0, 0.0], [0.1, 0.0, 0.0, 0.0]]
    if declared.kind is not float:
        return [] if declared.kind is str and not declared.choices else [math.nan, "no_such", [], 7]
    low, high = declared.minimum, declared.maximum
    beside = math.nextafter(low, -math.inf), math.nextafter(high, math.inf)
    return [math.nan, math.inf, -math.inf, "1", None, True, *beside]


def assert_refused(name: str, value) -> None:
    """In one line that says what is allowed."""
    declared = PARAMETERS[name]
    with pytest.raises(InputError) as refusal:
        declared.validate(value, name)
    text = str(refusal.value)
    assert len(text.splitlines()) == 1
    said = "missing" if value is None else f"{value!r} is not allowed"
    assert text.startswith(f"{name}: {said}: ")
    if declared.kind is float:
        assert f"{declared.minimum:g}" in text
        assert f"{declared.maximum:g}" in text
        assert declared.unit in text


def test_every_parameter_refuses_what_is_out_of_its_range_and_says_what_is_allowed():
    for name, declared in PARAMETERS.items():
        for value in beyond(declared):
            assert_refused(name, value)


def test_a_misspelt_parameter_in_a_file_is_refused_with_the_nearest_name(context, tmp_path):
    file = tmp_path / "parameters.yaml"
    file.write_text("simulator: {ros__parameters: {wheel_torqe_limit: 100.0}}")
    with pytest.raises(InputError, match=r"wheel_torqe_limit.*did you mean wheel_torque_limit\?"):
        Simulator(context=context, cli_args=["--ros-args", "--params-file", str(file)])


@pytest.mark.parametrize(
    ("words", "allowed"),
    [
        (("manoeuvre", "j_turn"), "one of use_sim_time"),
        (("recorder", "--output", "{}/bag"), "one of use_sim_time"),
        (("active_roll_bar",), "did you mean share?"),
    ],
)
def test_a_misspelt_parameter_of_any_node_is_refused(start, tmp_path, words, allowed):
    name, *words = (word.format(tmp_path) for word in words)
    program = EXAMPLES / f"{name}.py"
    given = {"program": str(program)} if program.exists() else {}
    node = start(name, *words, "--ros-args", "-p", "use_sim_time:=true", "-p", "shar:=0.5", **given)
    status, out, err = node.finish()
    assert (status, out, list(tmp_path.glob("bag"))) == (2, "", [])
    assert f"error: parameter: 'shar' is unknown: {allowed}" in err
    assert len(err.splitlines()) == 1


@pytest.mark.parametrize("node", [("simulator",), ("recorder", "--output", "{}/bag")])
@pytest.mark.parametrize(
    ("given", "said"),
    [("use_sim_times:=true", "did you mean use_sim_time?"), ("use_sim_time:=maybe", "'BOOL'")],
)
def test_so_is_a_wrong_one_of_every_node(start, tmp_path, node, given, said):
    name, *words = (word.format(tmp_path) for word in node)
    status, _, err = start(name, *words, "--ros-args", "-p", given).finish()
    assert (status, list(tmp_path.glob("bag"))) == (2, [])
    assert said in err
    assert "Traceback" not in err


def test_integers_serve_for_all_numbers_of_a_file(context, tmp_path):
    file = tmp_path / "parameters.yaml"
    values = "{steering_limit: 1, command_timeout: 2, publish_rate: 50, vehicle.cg_height: 1}"
    file.write_text(f"simulator: {{ros__parameters: {values}}}")
    node = Simulator(context=context, cli_args=["--ros-args", "--params-file", str(file)])
    try:
        assert node.get_parameter("steering_limit").value == 1.0
        assert type(node.get_parameter("vehicle.cg_height").value) is float
    finally:
        node.destroy_node()


def test_a_wrong_parameter_ends_the_process_with_one_line_and_status_2(start):
    status, out, err = start("simulator", "--ros-args", "-p", "vehicle.cg_height:=-1").finish()
    assert (status, out) == (2, "")
    assert err.startswith("simulator: error: vehicle.cg_height: -1 is not allowed")
    assert len(err.splitlines()) == 1


def set_parameter(peer, name, value):
    request = SetParameters.Request(parameters=[Parameter(name, value=value).to_parameter_msg()])
    return peer.call(SetParameters, "simulator/set_parameters", request).results[0]


def test_structure_is_read_only_and_tunable_ones_keep_their_range(start, peer):
    start("simulator")
    structure = {"step": 0.002, "vehicle.sprung_mass": 1500.0, "euler_terms": True, "grade": 0.1}
    for name, value in structure.items():
        assert "read-only" in set_parameter(peer, name, value).reason
    assert set_parameter(peer, "command_timeout", 1).successful  # an integer serves
    refused = set_parameter(peer, "command_timeout", -1.0)
    assert not refused.successful
    assert "command_timeout" in refused.reason
    assert set_parameter(peer, "steering_timeout_policy", "centre").successful
    assert not set_parameter(peer, "steering_timeout_policy", "let_go").successful


def test_timeout_and_policy_that_are_set_while_it_runs_count(start, peer):
    start("simulator", "--ros-args", "-p", "command_timeout:=0.0")
    peer.listen("applied_command")

    def applied():
        data = peer.newest("applied_command").data
        return data[1], data[3]

    commands = {"steering_cmd": 0.02, "wheel_torque_cmd": [5.0, 0.0, 0.0, 0.0]}
    peer.command(commands, lambda: applied() == (0.02, 5.0), "both commands")
    assert set_parameter(peer, "command_timeout", 0.1).successful
    peer.wait(lambda: applied() == (0.02, 0.0), "the torque to end, the steering to be held")
    assert set_parameter(peer, "steering_timeout_policy", "centre").successful
    peer.wait(lambda: applied() == (0.0, 0.0), "the steering to be centred")


def test_with_transient_slip_it_may_stand_and_start_from_standstill(start, peer):
    start("simulator", "--ros-args", "-p", "initial_speed:=0.0")
    peer.listen("odom")
    assert abs(peer.newest("odom").twist.twist.linear.x) < 1e-9  # m/s
    for speed, allowed in {20.0: True, 0.0: True, -0.1: False}.items():
        assert set_parameter(peer, "initial_speed", speed).successful is allowed


def test_with_steady_state_slip_no_lower_speed_than_its_lowest_is_taken(start, peer):
    start("simulator", "--ros-args", "-p", "steady_state_slip:=true")
    refused = set_parameter(peer, "initial_speed", 3.4)
    assert not refused.successful
    assert "3.5 m/s with steady_state_slip" in refused.reason
    assert set_parameter(peer, "initial_speed", 3.5).successful


def test_every_parameter_is_described_with_its_range(start, peer):
    start("simulator")
    absent = {*parameters_of(Vehicle)} - {*preset().given} | {"front_tire", "rear_tire"}
    absent = {f"vehicle.{name}" for name in absent}  # the reference vehicle does not have them
    there = {name: p for name, p in PARAMETERS.items() if name not in absent}
    assert there.keys() <= {*peer.call(ListParameters, "simulator/list_parameters").result.names}
    request = DescribeParameters.Request(names=list(there))
    answer = peer.call(DescribeParameters, "simulator/describe_parameters", request)
    for descriptor, (name, declared) in zip(answer.descriptors, there.items(), strict=True):
        assert descriptor.name == name
        assert descriptor.description
        assert descriptor.read_only is not declared.tunable
        spans = [(span.from_value, span.to_value) for span in descriptor.floating_point_range]
        assert spans == [(declared.minimum, declared.maximum)] * (declared.kind is float), name


def test_covariances_are_told_as_they_are_given_integers_for_numbers(start, peer):
    given = {
        "imu.angular_velocity_covariance_diagonal": "[0.1, 0.2, 0.3]",
        "odom.twist_covariance_diagonal": "[1, 2, 3, 4, 5, 6]",
    }
    words = [word for name, value in given.items() for word in ("-p", f"{name}:={value}")]
    start("simulator", "--ros-args", *words)
    peer.listen("imu", "odom")
    assert peer.newest("imu").angular_velocity_covariance[::4].tolist() == [0.1, 0.2, 0.3]
    assert not peer.newest("imu").orientation_covariance.any()
    assert peer.newest("odom").twist.covariance[::7].tolist() == [1, 2, 3, 4, 5, 6]
    request = GetParameters.Request(names=list(given))
    values = peer.call(GetParameters, "simulator/get_parameters", request).values
    assert [list(value.double_array_value) for value in values] == [[0.1, 0.2, 0.3], [*range(1, 7)]]


def test_parameters_reach_the_model_and_its_description(start, peer):
    """A late listener gets the latched description; the load is the weight of the heavier car."""
    start(
        "simulator", "--ros-args", "-p", "vehicle.sprung_mass:=2000", "-p", "vehicle.cg_height:=1.0"
    )
    peer.listen("tire_normal_forces", "robot_description")
    loads = peer.newest("tire_normal_forces").data
    assert sum(loads) == pytest.approx((2000 + 4 * 80) * 9.81, rel=1e-9)
    peer.wait(lambda: peer.received["robot_description"], "the description")
    robot = ElementTree.fromstring(peer.received["robot_description"][0][1].data)
    joints = {joint.get("name"): joint for joint in robot.iter("joint")}
    assert len(joints) == 12
    height = float(joints["lf_suspension_joint"].find("origin").get("xyz").split()[2])
    # the wheel centre is the loaded radius above ground, the c.g. 1 m
    assert 1.0 + height == pytest.approx(0.285 - loads[0] / 200_000)
    links = {link.get("name") for link in robot.iter("link")}
    for joint in joints.values():
        assert joint.find("parent").get("link") in links
        assert joint.find("child").get("link") in links


def test_an_own_clock_begins_at_0_and_jumps_back_on_a_reset(start, peer):
    start("simulator", "--ros-args", "-p", "publish_clock:=true")
    peer.listen("/clock", "imu")

    def seconds():
        clock = peer.newest("/clock").clock
        return clock.sec + clock.nanosec * 1e-9

    peer.wait(lambda: seconds() > 1.0, "a second")
    assert peer.newest("imu").header.stamp.sec < PLAUSIBLE_RUN
    peer.call(Trigger, "simulator/reset")
    peer.wait(lambda: seconds() < 1.0, "the jump back")
