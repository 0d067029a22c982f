"""A simulator's vehicle and road from its parameters: roll centres and implausible values."""

import pytest
import rclpy
from rclpy.context import Context

from vehicle_roll_sim import InputError
from vehicle_roll_sim.ros.clients.simulated_vehicle import simulated_vehicle
from vehicle_roll_sim.ros.simulator.node import Simulator
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.vehicle.vehicle_file import PRESETS

HEIGHT, DEPTH = "vehicle.front_roll_centre_height", "vehicle.front_roll_centre_depth"


@pytest.fixture
def simulator(domain):
    """simulator(*assignments): a simulator with these parameters."""
    context, nodes = Context(), []
    rclpy.init(context=context, domain_id=domain)

    def make(*assignments: str) -> Simulator:
        words = [word for each in assignments for word in ("-p", each)]
        nodes.append(Simulator(context=context, cli_args=["--ros-args", *words]))
        return nodes[-1]

    yield make
    for node in nodes:
        node.destroy_node()
    rclpy.shutdown(context=context)


def answers_of(node: Simulator):
    """The values of parameters by name, as the service answers: nothing if one is not there."""

    def ask(names) -> list:
        there = all(node.has_parameter(name) for name in names)
        return [parameter.value for parameter in node.get_parameters(names)] if there else []

    return ask


def test_a_roll_centre_is_the_parameter_that_was_given_alone(simulator):
    """So that a dump of the parameters can be loaded."""
    node = simulator(f"{HEIGHT}:=0.2")
    assert node.get_parameter(HEIGHT).value == 0.2
    assert not node.has_parameter(DEPTH)
    assert node.get_parameter("vehicle.rear_roll_centre_depth").value == 0.6
    assert node.session.simulation.vehicle.roll_centre_depth[0] == 0.75 - 0.2
    with pytest.raises(
        InputError, match=f"^{DEPTH}: 0.65 together with front_roll_centre_height 0.1"
    ):
        simulator(f"{HEIGHT}:=0.1", f"{DEPTH}:=0.65")


def test_another_node_reads_the_same_vehicle(simulator):
    node = simulator(f"{HEIGHT}:=0.2", "vehicle.cg_height:=0.7")

    vehicle, _ = simulated_vehicle(answers_of(node))
    assert vehicle.given == node.session.simulation.vehicle.given
    assert vehicle.record().tobytes() == node.session.simulation.vehicle.record().tobytes()


def test_another_node_knows_of_the_payload(simulator, tmp_path):
    (tmp_path / "reference.tir").write_text((PRESETS / "reference.tir").read_text())
    load = "payload:\n  - {mass: 200, behind_front_axle: 1.5, height: 1.2}\n"
    (tmp_path / "loaded.yaml").write_text((PRESETS / "reference.yaml").read_text() + load)
    node = simulator(f"vehicle_file:={tmp_path / 'loaded.yaml'}", "vehicle.front_track:=1.45")

    vehicle, _ = simulated_vehicle(answers_of(node))
    assert vehicle.sprung_mass == 1440.0 + 200.0
    assert vehicle.record().tobytes() == node.session.simulation.vehicle.record().tobytes()


def test_tables_over_wheel_travel_are_numbers_in_a_row(simulator):
    camber, bar = "vehicle.front_camber_change", "vehicle.rear_anti_roll_bar_stiffness"
    row = [-0.1, 0.02, 0.0, 0.0, 0.1, -0.03]
    words = (f"{camber}:={row}", f"{bar}:=20000", "vehicle.rear_toe_change:=0.1")
    node = simulator(*words, "model:='2'")
    assert list(node.get_parameter(camber).value) == row
    vehicle = node.session.simulation.vehicle
    assert vehicle.front_camber_change == ((-0.1, 0.02), (0.0, 0.0), (0.1, -0.03))
    assert (vehicle.rear_toe_change, vehicle.rear_anti_roll_bar_stiffness) == (0.1, 2e4)

    assert simulated_vehicle(answers_of(node))[0].given == vehicle.given
    with pytest.raises(InputError, match=rf"^{camber}: \[0.0, 1.0, 0.0\].*pairs"):
        simulator(f"{camber}:=[0.0, 1.0, 0.0]")


@pytest.fixture
def other(tmp_path) -> str:
    """A tire file that differs from the reference tire."""
    text = (PRESETS / "reference.tir").read_text()
    (tmp_path / "other.tir").write_text(text.replace("= 1.685", "= 1.5"))
    return str(tmp_path / "other.tir")


def test_each_axle_may_have_its_tire_and_another_node_reads_the_same(simulator, other):
    node = simulator(f"vehicle.rear_tire:={other}", "vehicle.front_camber:=-0.01")
    assert not node.has_parameter("vehicle.tire")
    assert node.get_parameter("vehicle.rear_tire").value == other
    assert node.get_parameter("vehicle.front_tire").value.endswith("reference.tir")
    vehicle = node.session.simulation.vehicle
    assert vehicle.tires()["PCX1"].tolist() == [1.685, 1.5]

    same, options = simulated_vehicle(answers_of(node))
    assert same.tires().tobytes() == vehicle.tires().tobytes()
    assert same.record().tobytes() == vehicle.record().tobytes()
    assert options == node.session.simulation.options


@pytest.mark.parametrize(
    ("assignments", "told"),
    [
        (("vehicle.tire:={0}", "vehicle.front_tire:={0}"), "vehicle.tire: .* together with front_"),
        (("vehicle.front_tire:=none.tir",), ".*none.tir.*No such file"),
        (("vehicle.longitudinal:=lateral", "vehicle.tire:={0}"), "vehicle.longitudinal: 'lateral'"),
        (("vehicle.tire_pressure:=200000.0",), "vehicle.tire_pressure: 200000.0 .* version 5.2"),
        (("vehicle.front_tire_radius:=0.3", "vehicle.tire_radius:=0.3"), "vehicle.front_tire_r"),
    ],
)
def test_tires_that_do_not_go_together_are_refused(simulator, other, assignments, told):
    with pytest.raises(InputError, match=f"^{told}"):
        simulator(*(each.format(other) for each in assignments))


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ("vehicle.payload:=75.0", "vehicle.payload is a key of vehicle files only: .*vehicle_file"),
        ("vehicle.model:='2'", "vehicle.model is no number: give model instead"),
        ("rear_tire:=mine.tir", "rear_tire is no number: give vehicle.rear_tire instead"),
    ],
)
def test_a_key_of_vehicle_files_is_refused_with_the_place_where_it_belongs(simulator, given, told):
    with pytest.raises(InputError, match=f"^parameter: {told}"):
        simulator(given)


@pytest.mark.parametrize(("given", "shown"), [("on", "on"), ("off", "off"), ("auto", "off")])
def test_moments_and_shift_are_shown_as_they_are(simulator, given, shown):
    """YAML reads on and off as true and false."""
    node = simulator(f"tire_moments:={given}", f"contact_patch_shift:={given}")
    for name in ("tire_moments", "contact_patch_shift"):
        assert node.get_parameter(name).value == shown
        assert getattr(node.session.simulation.options, name) == shown
    with pytest.raises(InputError, match=r"^tire_moments: 'maybe'"):
        simulator("tire_moments:=maybe")


def test_strict_refuses_what_is_not_plausible(simulator):
    told = "strict: the vehicle is not plausible: vehicle.rear_damping: 0 N s/m gives a damping"
    with pytest.raises(InputError, match=f"^{told}"):
        simulator("vehicle.rear_damping:=0.0", "strict:=true")
    simulator("strict:=true")


def test_else_the_log_has_it_once_and_stderr_nothing_more(start, peer):
    node = start("simulator", "--ros-args", "-p", "vehicle.cg_height:=0.6")
    peer.listen("state")
    peer.newest("state")
    _, _, err = node.finish(2)
    told = "vehicle.front_roll_centre_depth: 0.65 m below a c.g. at 0.6 m puts the roll centre"
    assert err.count(told) == err.count("0.05 m below the road") == 1
    assert "[WARN]" in next(line for line in err.splitlines() if told in line)


def test_the_road_is_that_of_its_file_with_the_slopes_given_as_parameters(simulator, tmp_path):
    file = tmp_path / "road.yaml"
    file.write_text("grade: 0.05\nbank: 0.02\nfeatures: [{kind: curb, start: 20, offset: 2}]\n")
    node = simulator(f"road_file:={file}", "bank:=-0.03")
    road = node.session.simulation.road
    assert (road.grade, road.bank) == (0.05, -0.03)
    assert road.features == Road.from_file(file).features
    assert node.get_parameter("grade").value == 0.05
    with pytest.raises(InputError, match=r"^road: features on the road of model 8dof"):
        simulator(f"road_file:={file}", "model:=8dof")
