"""Wheels of a vehicle that falls over, with the option `body_contact`. Not in the paper.

The tire of model 1 is as high as an upright one at any roll angle: r0 - xt is the height of the
wheel centre, and equation 15 divides by the cosine c of the angle between the body's z axis and the
normal of the road. When the vehicle lies on its side this would press wheels deep into the road.
From RISING on, the tire therefore becomes the disc that it is in model 2, of which the lowest point
is r0 c below the centre: its compression is then x = xt - b r0 (1 - c), where b goes from 0 at the
cosine RISING to 1 at DISC. In both models the load fades out before the disc lies flat.

Wheels that spin in the air wind up their tires when they land while the vehicle slides sideways:
above walking pace, slip decays only as the wheel rolls. When the slip velocity reverses, the slip
beyond the peak is therefore released, as at standstill.
"""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.jit import kernel, term
from vehicle_roll_sim.model.contact import contact_velocity, normal_force
from vehicle_roll_sim.model.records import LR, WHEEL_COUNT
from vehicle_roll_sim.model.tire.spring import spring_force
from vehicle_roll_sim.model.tire.standing import held_slips
from vehicle_roll_sim.model.tire.transient_slip import RELEASE_TIME

RISING, DISC = 0.7, 0.4
"""Cosines (46 and 66 degrees) between which the tire of model 1 becomes a disc."""
LEANING, FLAT = 0.5, 0.1
"""Cosines (60 and 84 degrees) between which the load of a wheel fades from full to zero."""
SMALLEST = 0.5
"""Lower limit of the loaded radius over the unloaded one: there a tire has reached its rim."""


@term
def part_of_way(cosine, begin, end):
    """How much of the way from `end` (0) to `begin` (1) a cosine is, smoothly: 3 s^2 - 2 s^3."""
    share = min(max((cosine - end) / (begin - end), 0.0), 1.0)
    return share * share * (3.0 - 2.0 * share)


@term
def share_of_load(cosine):
    """Share of its load that a wheel carries: 1 upright, 0 on its side and, in model 1, beyond."""
    return part_of_way(cosine, LEANING, FLAT)


@term
def as_disc(compression, radius, cosine):
    """Compression (m) of a tire that leans, from that of an upright one at the same height."""
    return compression - (1.0 - part_of_way(cosine, RISING, DISC)) * radius * (1.0 - cosine)


@term
def held_radius(compression, radius, cosine):
    """Loaded radius (m; eq. 15), within the limits that it has where the cosine is small."""
    pressed = max(compression, 0.0) / max(cosine, FLAT)
    return max(radius - pressed, SMALLEST * radius)


@term
def lightened(support, share):
    """A share of the load of a wheel (N); off the road its support stays as it is."""
    return support * share if support > 0.0 else support


@kernel
def contact_of_fallen_wheels(state, vehicle, attitude, outputs):
    """Load, loaded radius and contact velocity of leaning wheels of model 1 on a plane.

    After `contact_kinematics`, whose results are kept for wheels that are upright.
    """
    _, c_roll, _, c_pitch = attitude
    cosine = c_pitch * c_roll
    xt, wu = state[at.TIRE_COMPRESSION], state[at.UNSPRUNG_VELOCITY]
    wx, wy = state[at.ROLL_RATE], state[at.PITCH_RATE]
    for i in range(WHEEL_COUNT):
        radius = vehicle.tire_radius[i]
        if cosine >= RISING and outputs.loaded_radius[i] >= SMALLEST * radius:
            continue
        compression = as_disc(xt[i], radius, cosine)
        stiffness, progression = vehicle.tire_stiffness[i], vehicle.tire_progression[i]
        support = spring_force(compression, stiffness, progression)
        outputs.support[i] = lightened(support, share_of_load(cosine))
        outputs.normal_force[i] = normal_force(outputs.support[i])
        r = outputs.loaded_radius[i] = held_radius(compression, radius, cosine)
        uu, vu = outputs.unsprung_u[i], outputs.unsprung_v[i]
        ug, vg = contact_velocity(uu, vu, wu[i], wx, wy, r, attitude)
        outputs.contact_u[i], outputs.contact_v[i] = ug, vg


@kernel
def release_lying_wheels(vehicle, ground, outputs):
    """Model 2: wheels that lie on their sides carry no load; after the contact is known.

    The load F(r0 - zc / c) / c of a disc at the cosine c grows without limit as it falls flat. From
    LEANING on, c is therefore replaced by LEANING at the same depth r0 c - zc, and the load fades.
    Upside down the disc meets the road as well, and may carry the vehicle.
    """
    for i in range(WHEEL_COUNT):
        cosine, radius = outputs.inclination_cosine[i], vehicle.tire_radius[i]
        outputs.loaded_radius[i] = max(outputs.loaded_radius[i], SMALLEST * radius)
        if ground is not None:
            outputs.road_terms.arm_z[i] = -outputs.loaded_radius[i]  # the contact point stays
        if cosine >= LEANING:
            continue
        if ground is None:
            depth = outputs.suspension_terms.tire_compression[i]
        else:
            depth = cosine * outputs.road_terms.deflection[i]
        stiffness, progression = vehicle.tire_stiffness[i], vehicle.tire_progression[i]
        share = share_of_load(cosine)
        support = spring_force(depth / LEANING, stiffness, progression) / LEANING
        outputs.support[i] = lightened(support, share)
        outputs.normal_force[i] = normal_force(outputs.support[i])
        if ground is not None:
            outputs.road_terms.side_x[i] *= share
            outputs.road_terms.side_y[i] *= share


@kernel
def release_wound_tires(tires, outputs):
    """Release slip beyond the peak of tires that now slide the other way; after `contact_forces`.

    Adds -(x - XHELD) / RELEASE to the rates of transient slip (see `tire.transient_slip`).
    """
    for i in range(WHEEL_COUNT):
        along, across = outputs.patch_slip_ratio[i], outputs.patch_slip_tangent[i]
        spins_back = along * (outputs.tread[i] - outputs.rolling[i]) < 0.0
        slides_back = across * outputs.sliding[i] < 0.0
        fz = outputs.normal_force[i]
        if fz <= 0.0 or not (spins_back or slides_back):
            continue
        side, grip = outputs.side[i], outputs.road_friction[i]
        tire = tires.front if i < LR else tires.rear
        inclination = side * outputs.inclination[i]
        along_held, across_held = held_slips(along, across, inclination, side, fz, grip, tire)
        if spins_back:
            outputs.longitudinal_slip_rate[i] -= (along - along_held) / RELEASE_TIME
        if slides_back:
            outputs.lateral_slip_rate[i] -= (across - across_held) / RELEASE_TIME
