"""`manoeuvre` with those of the standards: for the simulator's vehicle, in lockstep as offline."""

import pytest

from vehicle_roll_sim.command_line.main import main as offline

VEHICLE = {"cg_height": 0.55, "steering_ratio": 20.0}
LOCKSTEP = ("-p", "mode:=lockstep", "-p", "lockstep_topics:=[steering_cmd, wheel_torque_cmd]")


def simulator_words(*more: str) -> list[str]:
    values = [("-p", f"vehicle.{name}:={value}") for name, value in VEHICLE.items()]
    return ["--ros-args", *more, *(word for pair in values for word in pair)]


def values_of(summary: str) -> dict[str, str]:
    pairs = (text.partition(":") for text in summary.splitlines())
    return {label: value.strip() for label, _, value in pairs}


@pytest.mark.parametrize("name", ["nhtsa_fishhook", "sine_with_dwell"])
def test_in_lockstep_a_manoeuvre_is_that_of_the_offline_run(start, capsys, name):
    start("simulator", *simulator_words(*LOCKSTEP))
    status, out, err = start("manoeuvre", name).finish()
    assert (status, err) == (0, "")
    words = [word for key, value in VEHICLE.items() for word in ("--set", f"{key}={value}")]
    offline(["run", name, "--command-period", "0.01", *words])
    expected, found = values_of(capsys.readouterr().out), values_of(out)
    by_steps = {label for label in expected if label.startswith(("peak", "lift-off"))}
    for label in expected.keys() - by_steps:  # the node knows what comes between sets by samples
        assert found[label] == expected[label], label
    assert found.keys() == expected.keys()


def test_in_real_time_the_fishhook_reverses_at_the_roll_rate_too(start):
    start("simulator", *simulator_words())
    status, out, _ = start("manoeuvre", "nhtsa_fishhook", "--duration", "3").finish()
    assert status == 0
    found = values_of(out)
    assert float(found["steering reversal"].split()[3]) <= 1.5
    assert float(found["handwheel amplitude"].split()[0]) == pytest.approx(
        6.5 * float(found["handwheel angle at 0.3 g"].split()[0]), abs=0.01
    )


def test_a_vehicle_that_the_manoeuvre_is_not_for_ends_with_one_line_and_status_2(start):
    start("simulator", *simulator_words())
    status, _, err = start("manoeuvre", "nhtsa_j_turn", "--scalar", "90").finish()
    assert status == 2
    assert len(err.splitlines()) == 1
    assert "handwheel angle" in err
