"""Malformed or foreign messages are refused or ignored, and the simulator keeps running."""

import pytest
from rcl_interfaces.msg import Parameter, ParameterValue
from rcl_interfaces.srv import SetParameters, SetParametersAtomically
from std_msgs.msg import Float64MultiArray, MultiArrayDimension

NO_TYPE = 77
MALFORMED = {
    f"type {NO_TYPE}": Parameter(name="command_timeout", value=ParameterValue(type=NO_TYPE)),
    "name: ''": Parameter(value=ParameterValue(type=2, integer_value=1)),
}


@pytest.mark.parametrize("node", ["simulator", "recorder"])
def test_a_malformed_parameter_is_refused_and_the_node_goes_on(start, peer, tmp_path, node):
    words = ("--output", str(tmp_path / "bag")) if node == "recorder" else ()
    process = start(node, *words).process
    good = Parameter(name="use_sim_time", value=ParameterValue(type=1, bool_value=False))
    for problem, parameter in MALFORMED.items():
        request = SetParameters.Request(parameters=[good, parameter])
        answer = peer.call(SetParameters, f"{node}/set_parameters", request)
        at_once = SetParametersAtomically.Request(parameters=[good, parameter])
        name = f"{node}/set_parameters_atomically"
        results = [*answer.results, peer.call(SetParametersAtomically, name, at_once).result]
        assert not any(result.successful for result in results)
        assert all(problem in result.reason for result in results)
    assert peer.call(
        SetParameters, f"{node}/set_parameters", SetParameters.Request(parameters=[good])
    )
    assert process.poll() is None


def test_what_is_no_state_or_command_of_a_simulator_does_not_end_a_manoeuvre(start, peer):
    start("simulator")
    manoeuvre = start("manoeuvre", "step_steer", "--duration", "4")
    peer.listen("state", "applied_command")
    peer.wait(lambda: peer.newest("applied_command").data[1] != 0.0, "the manoeuvre to steer")
    strange = Float64MultiArray(data=[float("nan")])
    strange.layout.dim = [MultiArrayDimension(label="time")]
    names = ("state", "applied_command", "tire_normal_forces")
    publishers = [peer.node.create_publisher(Float64MultiArray, name, 10) for name in names]

    def disturbed_and_over():
        for publisher in publishers:
            publisher.publish(strange)
            publisher.publish(Float64MultiArray())
        return manoeuvre.process.poll() is not None

    peer.wait(disturbed_and_over, "the end of the manoeuvre")
    status, out, err = manoeuvre.finish()
    assert (status, err) == (0, "")
    assert "complete" in out
