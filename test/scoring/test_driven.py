"""Runs are repeated from their commands, to the bit."""

import numpy as np
import pytest
from scored import brake, drive, make_setup

from vehicle_roll_sim import Simulation
from vehicle_roll_sim.model.records import STATE_NAMES
from vehicle_roll_sim.runs.run import run
from vehicle_roll_sim.scoring.driven import Driven, drive_again, drive_alone
from vehicle_roll_sim.scoring.plan import Ladder

LEVEL = 30.0
"""mph: without a controller the nominal vehicle stays on its wheels."""


def fishhook(variant: str) -> Ladder:
    return Ladder("fishhook", variant, "left", (LEVEL,))


def test_a_run_alone_is_the_offline_run_whose_commands_are_held():
    setup, ladder = make_setup(), fishhook("nominal")
    found = drive_alone(ladder, LEVEL, setup)
    manoeuvre = ladder.manoeuvre(setup, LEVEL)
    simulation = Simulation(setup.vehicle)
    simulation.reset(manoeuvre.speed)
    expected = run(simulation, manoeuvre.driver(), manoeuvre.duration, command_period=0.01)
    assert found.history.rows.tobytes() == expected.rows.tobytes()
    assert found.events.tobytes() == simulation.events.tobytes()
    assert not found.has_failed


@pytest.mark.parametrize("variant", ["nominal", "grip_less", "slow_actuators", "noisy_imu"])
def test_a_run_with_a_controller_is_repeated_from_its_commands(variant):
    """Also on other tires, through actuators and with sensors; and from the bytes of its file."""
    setup, ladder = make_setup(), fishhook(variant)
    driven, simulation = drive(ladder, LEVEL, setup, brake(800.0))
    again = Driven.from_bytes(driven.to_bytes())
    assert again == driven
    found = drive_again(ladder, LEVEL, setup, again)
    assert len(found.history.rows) == len(driven.warned) == len(driven.commands) + 1
    last = simulation.state_vector[: len(STATE_NAMES)]
    assert found.history["roll"][-1] == last[STATE_NAMES.index("roll")]
    assert found.events.tobytes() == simulation.events.tobytes()
    assert found.history.command("brake_torque")[-1].tolist() == [0.0, 800.0, 0.0, 0.0]


def test_the_same_run_is_the_same_bytes_and_another_is_not():
    commands = np.zeros(
        2, drive(fishhook("nominal"), LEVEL, make_setup(), brake(0.0))[0].commands.dtype
    )
    one = Driven(commands, np.zeros(3, bool), ("a note",))
    assert one.to_bytes() == Driven(commands.copy(), np.zeros(3, bool), ("a note",)).to_bytes()
    assert one != Driven(commands, np.ones(3, bool), ("a note",))
    assert Driven.from_bytes(one.to_bytes()).notes == ("a note",)
