"""Deliberate faults, each of which a test must catch."""

import dataclasses

RATES = "test/model/test_properties_of_rates.py::"
WHEEL = "test/model/test_wheel.py::"
INBOX = "test/live/test_command_inbox.py::"
SESSION = "test/live/test_session.py::"
SNAPSHOTS = "test/live/test_session_snapshot.py::"
WAYS = "test/live/test_ways_in.py::"
OF_MESSAGES = "test/messages/test_messages.py::"
STAMPS = "test/ros/simulator/test_stamps.py::"


@dataclasses.dataclass(frozen=True)
class Fault:
    """A fault: in `file` of the package, `faulty` replaces `original`, which occurs exactly once.

    test: the test that must fail, as a file or as FILE::TEST.
    """

    what: str
    file: str
    original: str
    faulty: str
    test: str


FAULTS = (
    Fault(
        "a tire pulls on the road",
        "model/contact.py",
        "return support if support > 0.0 else 0.0",
        "return support",
        RATES + "test_loads_are_never_negative_and_zero_exactly_off_the_ground",
    ),
    Fault(
        "wrong sign: the longitudinal force of a steered tire acts to the other side",
        "model/contact.py",
        "= fy * c + fx * s  # (4)",
        "= fy * c - fx * s  # (4)",
        "test/model/test_momentum.py::test_each_wheel_spins_up_by_its_torque_less_the_tires",
    ),
    Fault(
        "dampers add energy",
        "model/suspension/struts.py",
        "passive += vehicle.damping[i]",
        "passive -= vehicle.damping[i]",
        RATES + "test_energy_changes_by_named_powers_and_nothing_else",
    ),
    Fault(
        "wrong wheels: link load transfer across the diagonal",
        "model/suspension/links.py",
        "for left, right in ((LF, RF), (LR, RR)):",
        "for left, right in ((LF, RR), (LR, RF)):",
        RATES + "test_tires_weights_and_drag_are_all_that_changes_the_momenta",
    ),
    Fault(
        "left and right exchanged at the rear",
        "vehicle/derived_values.py",
        "SIDES = np.array([1.0, -1.0, 1.0, -1.0])",
        "SIDES = np.array([1.0, -1.0, -1.0, 1.0])",
        RATES + "test_tires_weights_and_drag_are_all_that_changes_the_momenta",
    ),
    Fault(
        "wrong factor: twice the aerodynamic drag",
        "model/air.py",
        "return vehicle.air_density / 2 * vehicle.drag_area * u * abs(u)",
        "return vehicle.air_density * vehicle.drag_area * u * abs(u)",
        RATES + "test_energy_changes_by_named_powers_and_nothing_else",
    ),
    Fault(
        "missing clamp: friction reverses at large loads",
        "model/tire/pure_slip.py",
        "return value if value * coefficient > 0 else 0.0",
        "return value",
        "test/model/tire/test_tire.py::test_friction_never_turns_round_however_large_the_load",
    ),
    Fault(
        "a weighting function of combined slip is left out",
        "model/tire/magic_formula.py",
        "fx = gx * (fx + terms.longitudinal_shift[i])",
        "fx = fx + terms.longitudinal_shift[i]",
        "test/model/tire/test_tire.py::test_slip_in_one_direction_takes_force_from_the_other",
    ),
    Fault(
        "slip does not decay off the ground",
        "model/tire/transient_slip.py",
        "along_rate = along_rate if loaded else -along / RELEASE_TIME",
        "along_rate = along_rate if loaded else 0.0",
        "test/model/tire/test_transient_slip.py::test_slips_decay_without_load",
    ),
    Fault(
        "the third stage of the integration takes only half a step",
        "model/integration/integrator.py",
        "along(state, stages[K3], step, trial)",
        "along(state, stages[K3], step / 2, trial)",
        "test/model/integration/test_accuracy.py::test_halving_the_step_divides_the_error_by_sixteen",
    ),
    Fault(
        "a brake reverses a wheel",
        "model/wheel.py",
        "            spin[i] = 0.0",
        "            pass",
        WHEEL + "test_a_brake_stops_a_free_wheel_in_the_time_of_the_closed_form_and_not_beyond",
    ),
    Fault(
        "wrong sign: the 8 DOF model transfers load to the inner wheels",
        "model/eight_dof.py",
        "load -= overturning * ay / y",
        "load += overturning * ay / y",
        "test/model/test_eight_dof.py::test_its_rates_solve_the_equations_written_out",
    ),
    Fault(
        "off by one: events are a step late",
        "model/integration/events.py",
        "return time + step * before / (before - after)",
        "return time + step + step * before / (before - after)",
        "test/model/integration/test_conditions.py::test_the_rollover_angle_says_where_a_run_stops",
    ),
    Fault(
        "event times are not reset",
        "simulation/simulation.py",
        "self._state[:], self._events[:] = state, no_events()",
        "self._state[:] = state",
        "test/model/integration/test_stepping.py::test_reset_gives_the_first_state_back_bit_by_bit",
    ),
    Fault(
        "missing timeout: commands never expire",
        "live/command_inbox.py",
        "return now_ns - channel.arrival_ns > round(self.timeout * NANOSECONDS)",
        "return False",
        INBOX + "test_a_topic_is_silent_once_more_than_the_timeout_has_passed",
    ),
    Fault(
        "off by one: commands expire exactly at the timeout",
        "live/command_inbox.py",
        "return now_ns - channel.arrival_ns > round(",
        "return now_ns - channel.arrival_ns >= round(",
        SESSION + "test_torques_end_half_a_simulated_second_after_the_last_message",
    ),
    Fault(
        "missing check: values that are not finite",
        "live/channels.py",
        "if not all(map(math.isfinite, values)):",
        "if not values:",
        INBOX + "test_a_message_with_a_value_that_is_not_finite_is_dropped",
    ),
    Fault(
        "missing bound: a negative brake torque",
        "live/channels.py",
        "if min(values) < self.smallest:",
        "if max(values) < self.smallest:",
        INBOX + "test_a_brake_that_would_drive_is_dropped",
    ),
    Fault(
        "commands outlive a reset",
        "live/session.py",
        "        self.inbox.clear()\n",
        "",
        SESSION + "test_a_reset_recovers_from_a_rollover_and_forgets_all_commands",
    ),
    Fault(
        "the speed controller outlives a reset",
        "live/session.py",
        "        self.controller.reset()\n        self.applied = Command()",
        "        self.applied = Command()",
        SESSION + "test_a_reset_forgets_what_the_speed_controller_has_learnt",
    ),
    Fault(
        "a snapshot lacks the command that the rate limit starts from",
        "live/session.py",
        '        self.applied = Command(**kept["applied"])\n',
        "",
        SNAPSHOTS + "test_a_thousand_random_branches_equal_their_straight_runs",
    ),
    Fault(
        "two ways in at once: both command the same quantity",
        "live/command_inbox.py",
        "flaw = channel.flaw(values) or self._conflict(channel, topic, now_ns)",
        "flaw = channel.flaw(values)",
        WAYS + "test_of_two_ways_in_the_second_is_refused_by_name_until_the_first_has_expired",
    ),
    Fault(
        "deadlines drift: each period adds a period of delay",
        "live/pacing.py",
        "self._next = (origin_ns, count + 1 + given_up)",
        "self._next = (origin_ns, count + 2 + given_up)",
        "test/live/test_pacing.py::test_on_time_every_period_is_run_once",
    ),
    Fault(
        "wrong stamp: nanoseconds left out",
        "messages/sets.py",
        "self.stamp = divmod(nanoseconds, NANOSECONDS)",
        "self.stamp = (nanoseconds // NANOSECONDS, 0)",
        OF_MESSAGES + "test_stamps_are_simulated_time",
    ),
    Fault(
        "lift-off is flagged while a wheel still carries a small load",
        "messages/sets.py",
        'self._lift_off.numbers[:] = self.simulation.outputs["normal_force"] == 0.0',
        'self._lift_off.numbers[:] = self.simulation.outputs["normal_force"] < 300.0',
        "test/package/test_soak.py",
    ),
    Fault(
        "stamps stay behind the clock after skipped periods",
        "ros/simulator/real_time.py",
        "simulator.run_period(self.pacer.due_ns if is_behind else None)",
        "simulator.run_period(None)",
        STAMPS + "test_stamps_are_at_the_clock_after_start_pause_reset_and_standstill",
    ),
    Fault(
        "missing lock: a message arrives during a period",
        "ros/simulator/node.py",
        "        with self.lock:\n            now_ns = self.session.simulation.time_ns",
        "        if self.lock:\n            now_ns = self.session.simulation.time_ns",
        "test/ros/simulator/test_lock.py",
    ),
    Fault(
        "missing lock: a reset during a period",
        "ros/simulator/control.py",
        "        with simulator.lock:\n            try:\n                simulator.session.reset(",
        "        if simulator.lock:\n            try:\n                simulator.session.reset(",
        "test/ros/simulator/test_lock.py",
    ),
    Fault(
        "a nan stays in the state and is published on every topic",
        "model/integration/advance.py",
        "        copy(stages[KEPT], state)\n",
        "",
        "test/model/integration/test_divergence.py",
    ),
    Fault(
        "the recorder falls behind: one message per topic and poll",
        "ros/clients/recorder.py",
        "MOST_AT_ONCE = 1000\n",
        "MOST_AT_ONCE = 1\n",
        "test/ros/clients/test_recorder_fairness.py",
    ),
    Fault(
        "lockstep continues before all subscribers have received the first set",
        "ros/simulator/lockstep.py",
        "        self._await_receipts(simulator, executor)\n",
        "",
        "test/ros/simulator/test_waiting_in_lockstep.py",
    ),
)
