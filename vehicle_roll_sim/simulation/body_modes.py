"""The largest step for a body on its corners: its modes on the ground, in closed form.

The modes at the start of a run, with the vehicle on its wheels, do not contain these.
"""

import itertools

import numpy as np

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.model.body_contact import STICKING_SPEED
from vehicle_roll_sim.simulation.stability import largest_stable_step, rounded_down
from vehicle_roll_sim.vehicle.masses import tensor

UNITS = {"stiffness": "N/m", "damping": "N s/m", "friction": "(-)"}


def largest_mobility(vehicle: np.record) -> float:
    """Largest eigenvalue of M^-1 sum(g g^T), over all contacts of the box with the ground (1/kg).

    vehicle: a VEHICLE record. M: mass matrix of the sprung mass alone, to which the wheels could
    only add. g = (n, P x n): a normal force at each corner P that touches the ground, which are the
    four of one face with their common normal, or a single one with any normal.
    """
    body = vehicle["body"]
    axes, faces = np.eye(3), (("ahead", "behind"), ("left", "right"), ("top", "bottom"))
    ends = [(body[one], -body[other]) for one, other in faces]
    corners = np.array(list(itertools.product(*ends)))
    names = ("roll_inertia", "pitch_inertia", "yaw_inertia")
    names += ("roll_pitch_product", "roll_yaw_product", "pitch_yaw_product")
    inverse = np.zeros((6, 6))
    inverse[:3, :3] = np.eye(3) / vehicle["sprung_mass"]
    inverse[3:, 3:] = np.linalg.inv(tensor({name: vehicle[name] for name in names}))
    of_corners = [[np.concatenate((n, np.cross(p, n))) for n in axes] for p in corners]
    contacts = [np.array(each) for each in of_corners]
    for axis in range(3):
        for value in {*corners[:, axis]}:
            face = np.flatnonzero(corners[:, axis] == value)
            contacts.append(np.array([of_corners[k][axis] for k in face]))
    return max(float(np.linalg.eigvalsh(g @ inverse @ g.T)[-1]) for g in contacts)


def largest_step_on_body(vehicle: np.record, most: float) -> float:
    """Largest step (s), up to `most` (s), at which the body on the ground is stable.

    Each mode of mobility a is s^2 + c a s + k a = 0; that of friction with the coefficient mu under
    the weight W, which is viscous up to the speed V, is s + mu W a / V = 0. vehicle: a VEHICLE
    record.
    """
    body, mobility = vehicle["body"], largest_mobility(vehicle)
    poles = np.roots([1.0, body["damping"] * mobility, body["stiffness"] * mobility])
    weight = (vehicle["sprung_mass"] + vehicle["unsprung_mass"].sum()) * vehicle["gravity"]
    of_friction = -body["friction"] * weight * mobility / STICKING_SPEED
    return largest_stable_step(np.append(poles, of_friction).astype(complex), most)


def check_step_on_body(vehicle: np.record, step: float) -> None:
    """Raise InputError if an integration step (s) is too long for the corners of the body."""
    largest = largest_step_on_body(vehicle, step)
    if largest < step:
        of = (f"body_{name} {vehicle['body'][name]:.4g} {unit}" for name, unit in UNITS.items())
        raise InputError("step", step, f"at most {rounded_down(largest):g} s with {', '.join(of)}")
