"""The bodies of the vehicle in the multibody engine."""

import mujoco
import numpy as np

from vehicle_roll_sim.vehicle.derived_values import GRAVITY

MASSLESS = 1e-9
"""kg m^2: inertia of the point masses; the engine requires one, this is 1e-12 of the body's."""

BODIES = """
<mujoco>
  <option gravity="0 0 -{gravity}"/>
  <worldbody>
    <body>
      <freejoint/>
      <inertial pos="0 0 0" mass="{mass}" {kind}="{inertia}"/>
      {wheels}
    </body>
  </worldbody>
</mujoco>"""
WHEEL = """
      <body pos="{x} {y} {z}">
        <joint type="slide" axis="0 0 1"/>
        <inertial pos="0 0 0" mass="{mass}" diaginertia="{inertia} {inertia} {inertia}"/>
      </body>"""


def engine_model(car: np.record) -> mujoco.MjModel:
    """The engine's model of a VEHICLE record; the slides are at 0 at static strut length."""
    wheels = "".join(
        WHEEL.format(x=x, y=y, z=-length, mass=mass, inertia=MASSLESS)
        for x, y, length, mass in zip(
            car.x, car.y, car.static_strut_length, car.unsprung_mass, strict=True
        )
    )
    return mujoco.MjModel.from_xml_string(with_body(car, wheels))


def with_body(car: np.record, wheels: str) -> str:
    """The engine's model as XML: the body of a VEHICLE record, with these bodies of its wheels."""
    moments = (car.roll_inertia, car.pitch_inertia, car.yaw_inertia)
    products = (car.roll_pitch_product, car.roll_yaw_product, car.pitch_yaw_product)
    kind, inertia = "diaginertia", moments
    if any(products):
        kind, inertia = "fullinertia", (*moments, *(-each for each in products))
    return BODIES.format(
        gravity=GRAVITY,
        mass=car.sprung_mass,
        kind=kind,
        inertia=" ".join(map(str, inertia)),
        wheels=wheels,
    )
