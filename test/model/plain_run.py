"""Runs in a separate process: python plain_run.py STEPS FILE [without-numba | variants].

Saves the STATE and OUTPUTS records after every step of a J-turn, and how the model ran; with numba
also, behind the name of each of OPTIONS and `_`, those of A_FEW steps with them. With `variants`:
those of a swerve on a slope, one after the other, of every variant, what sensors read, and how a
step of a state that is not finite ends.
"""

import sys

if sys.argv[3:] == ["without-numba"]:
    sys.modules["numba"] = None  # importing it now fails

import numpy as np
from programmes import ramp_and_hold, record_run
from road_kinds import FEATURES, TILT, road
from swing_axles import on_swing_axles

from vehicle_roll_sim import Command, Options, Simulation, Vehicle, preset
from vehicle_roll_sim.model.compiled import jit
from vehicle_roll_sim.model.records import OUTPUTS, STATE
from vehicle_roll_sim.simulation.options import ASYMMETRIC, MODELS
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.simulation.sensors import Sensors

A_FEW = 100
"""Steps: well into the turn."""
STEP = 0.004
"""s; long, for plain Python takes 2 to 13 ms for one."""
HELD = {
    "wheel_torque": (0.0, 50.0, 120.0, -80.0),
    "brake_torque": (40.0, 0.0, 10.0, 20.0),
    "normal_force": (100.0, 0.0, -200.0, 300.0),
}
FULL = Options(euler_terms=True)
PARTS = ("state", "outputs")
OPTIONS = {
    "8dof": Options(model="8dof"),
    "steady": Options(euler_terms=True, steady_state_slip=True),
}

VARIANTS = (
    *(Options(model=name) for name in MODELS),
    Options(no_roll_centre=True),
    Options(tire_normal_to_ground=True),
    Options(link_load_transfer=ASYMMETRIC),
    Options(steady_state_slip=True, euler_terms=True),
    Options(wheel_gyroscopics=True),
    Options(model="2", wheel_gyroscopics=True),
    Options(body_contact=True),
    Options(model="2", body_contact=True),
)
DETAILS = {
    "front_spring_force": ((0.0, 0.0), (0.1, 3000.0), (0.15, 6000.0), (0.2, 10000.0)),
    "rear_rebound_damping": 3000.0,
    "rear_bump_stop_clearance": 0.01,
    "rear_bump_stop_progression": 4e6,
    "front_roll_steer": -0.1,
    "front_lateral_force_steer": -3e-6,
    "ackermann_percentage": 80.0,
    "front_toe_change": 0.1,
    "engine_drag": 1.0,
}
"""Of vehicles with gyroscopic wheels."""
SENSED = {
    "imu_x": 1.0,
    "imu_roll": 0.3,
    "accelerometer_noise_density": 0.1,
    "gyro_bias_walk": 0.1,
    "imu_orientation_noise_density": 0.01,
    "wheel_speed_sensor_resolution": 0.01,
}
PERIOD_NS = 10_000_000
SLOPE = Road(grade=0.05, bank=-0.03)
LOW = 0.3
"""Of their usual heights: all together, they stay below the wheel centres."""
ROUGH = road(
    {"kind": "commanded"},
    {**TILT, "angles": [[0, 0], [0.1, 5]]},
    *(
        {**feature, "start": -2.0}
        | ({"height": LOW * feature["height"]} if "height" in feature else {})
        for feature in FEATURES.values()
    ),
)
"""Every kind of feature, all of them under the wheels at once."""
ON_ROADS = (
    *((options, SLOPE) for options in VARIANTS),
    *((Options(name), ROUGH) for name in ("1", "1b", "2")),
    (Options(body_contact=True), ROUGH),
)


def run(steps: int, options: Options = FULL):
    simulation = Simulation(preset(), options, step=STEP)
    return record_run(simulation, ramp_and_hold(0.1, 40.0, 10.0, **HELD), steps * STEP)


SCRAPING = {"body_floor_height": 0.0, "body_friction": 0.4}
"""A body that scrapes along the road, with friction for which STEP is not too long."""


def vehicle_for(options: Options) -> Vehicle:
    """The reference vehicle; model 2 on swing axles, so that it looks up tables."""
    if options.wheel_gyroscopics:
        return preset().with_values(DETAILS)
    if options.body_contact:
        return preset().with_values(SCRAPING)
    return on_swing_axles(preset()) if options.is_kinematic else preset()


def run_variants(steps: int) -> dict[str, np.ndarray]:
    """STATE and OUTPUTS records of a swerve of each variant, one after the other."""
    swerve = ramp_and_hold(0.0, 80.0, 6.0, **HELD)
    runs = [
        record_run(
            Simulation(vehicle_for(options), options, step=STEP, road=where), swerve, steps * STEP
        )
        for options, where in ON_ROADS
    ]
    parts = {p: np.concatenate([getattr(r, p) for r in runs]) for p in PARTS}
    return parts | {"readings": readings(steps)}


def readings(samples: int) -> np.ndarray:
    """What sensors read of random states, one row a sample."""
    generator, found = np.random.default_rng(1), []
    sensors = Sensors(preset().with_values(SENSED), PERIOD_NS, None)
    sensors.rest()
    for number in range(samples):
        state, outputs = (np.zeros(1, kind) for kind in (STATE, OUTPUTS))
        for record in (state, outputs):
            numbers = record.view(float)
            numbers[:] = generator.uniform(-1.0, 1.0, numbers.shape)
        sensors.sample(number * PERIOD_NS, state[0], outputs[0])
        found.append(sensors.readings())
    return np.array(found)


def diverging() -> str:
    """How a step ends of a body that is turned by infinity."""
    simulation = Simulation(preset())
    simulation.state.roll = float("inf")
    return simulation.step(Command(), 0.001).name


def run_options(steps: int) -> dict[str, np.ndarray]:
    """STATE and OUTPUTS records of the J-turn with each of OPTIONS."""
    runs = {name: run(steps, options) for name, options in OPTIONS.items()}
    return {f"{name}_{part}": getattr(runs[name], part) for name in runs for part in PARTS}


if __name__ == "__main__":
    steps, file, *words = sys.argv[1:]
    if words == ["variants"]:
        np.savez(file, **run_variants(int(steps)), diverging=diverging())
    else:
        result = run(int(steps))
        parts = {part: getattr(result, part) for part in PARTS}
        np.savez(file, **parts, **({} if words else run_options(A_FEW)), how=jit.describe())
