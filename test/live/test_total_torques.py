"""Total torques of drive and brakes: how they are distributed, and what they give way to."""

import numpy as np
import pytest

from vehicle_roll_sim import InputError, Options, Simulation, preset
from vehicle_roll_sim.live.command_inbox import CommandInbox
from vehicle_roll_sim.live.session import Session
from vehicle_roll_sim.live.status import command_troubles
from vehicle_roll_sim.manoeuvres.command_file import command_table

PERIOD_NS = 10_000_000
LAYOUTS = {0.0: (0, 0, 200, 200), 1.0: (200, 200, 0, 0), 0.4: (80, 80, 120, 120)}
"""Wheel torques for 400 N m by the share of the front axle."""


def session_of(**values) -> Session:
    return Session(Simulation(preset().with_values(values)), CommandInbox(), PERIOD_NS, 20.0)


@pytest.mark.parametrize(("share", "torques"), LAYOUTS.items())
def test_a_drive_torque_is_distributed_by_the_layout(share, torques):
    session = session_of(front_drive_share=share)
    session.inbox.receive("drive_torque_cmd", [400.0], 0)
    session.run_period()
    assert session.applied.wheel_torque == pytest.approx(torques)
    assert session.applied.brake_torque == (0.0,) * 4


def test_by_default_the_rear_wheels_drive_and_the_front_wheels_brake_more():
    session = session_of()
    session.inbox.receive("drive_torque_cmd", [-400.0], 0)
    session.inbox.receive("brake_cmd", [1000.0], 0)
    session.run_period()
    assert session.applied.wheel_torque == pytest.approx((0, 0, -200, -200))
    assert session.applied.brake_torque == pytest.approx((300, 300, 200, 200))


def test_brake_balance():
    session = session_of(front_brake_share=0.75)
    session.inbox.receive("brake_cmd", [800.0], 0)
    session.run_period()
    assert session.applied.brake_torque == pytest.approx((300, 300, 100, 100))


@pytest.mark.parametrize(
    ("loser", "winner"),
    [
        ("drive_torque_cmd", "wheel_torque_cmd"),
        ("speed_cmd", "drive_torque_cmd"),
        ("brake_cmd", "brake_torque_cmd"),
    ],
)
def test_a_command_of_wheels_has_priority_and_the_other_is_told_to_be_ignored(loser, winner):
    session = session_of()
    session.inbox.receive(loser, [7.0], 0)
    assert command_troubles(session, {}) == []
    session.inbox.receive(winner, [10.0] * session.inbox.channels[winner].size, 0)
    assert command_troubles(session, {}) == [f"{loser}: ignored while {winner} is commanded"]
    assert session.inbox.total(loser, 0) is None
    later = 2 * round(session.inbox.timeout * 1e9)
    session.inbox.receive(loser, [7.0], later)  # by now the other is silent
    assert session.inbox.total(loser, later) == 7.0


def test_a_silent_drive_torque_is_none():
    session = session_of()
    session.inbox.receive("drive_torque_cmd", [400.0], 0)
    for _ in range(52):
        session.run_period()
    assert session.applied.wheel_torque == (0.0,) * 4


@pytest.mark.parametrize(("share", "torques"), LAYOUTS.items())
def test_the_speed_controller_distributes_its_torque_by_the_layout(share, torques):
    plain, session = session_of(), session_of(front_drive_share=share)
    for each in (plain, session):
        each.inbox.receive("speed_cmd", [20.2], 0)
        each.run_period()
    total = sum(plain.applied.wheel_torque)
    assert plain.applied.wheel_torque == (total / 4,) * 4
    assert total > 0.0
    assert session.applied.wheel_torque == pytest.approx(np.multiply(total / 400, torques))


def test_columns_of_a_command_file_are_distributed_alike():
    table = command_table({"time": [0.0, 1.0], "drive_torque": [0.0, 400.0], "brake": [100.0, 0.0]})
    vehicle = preset().with_values({"front_drive_share": 0.4})
    assert table.needs_vehicle
    records = table.for_vehicle(vehicle, Options())(np.array([0.5, 1.0]))
    assert records["wheel_torque"][1] == pytest.approx(LAYOUTS[0.4])
    assert records["brake_torque"][0] == pytest.approx((15, 15, 10, 10))
    assert table.commanded == ("steering", "wheel_torque", "brake_torque")


@pytest.mark.parametrize(
    ("columns", "words"),
    [
        ({"drive_torque": [1.0], "wheel_torque_lf": [1.0]}, ("drive_torque", "wheel_torque_lf")),
        ({"brake": [1.0], "brake_torque_rr": [1.0]}, ("brake", "brake_torque_rr")),
        ({"brake": [-1.0]}, ("brake", "at least 0")),
    ],
)
def test_totals_with_values_of_wheels_and_negative_brakes_are_refused(columns, words):
    with pytest.raises(InputError) as refusal:
        command_table({"time": [0.0], **columns})
    assert all(word in str(refusal.value) for word in words)
