"""A wheel at any inclination on the road: contact point, its velocity, and the load.

The wheel is a disc. Its contact point is where the line down its plane meets the road.
"""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.elementary import arctan
from vehicle_roll_sim.model.compiled.jit import kernel, square_root
from vehicle_roll_sim.model.contact import normal_force
from vehicle_roll_sim.model.frames import body_to_yawed, yawed_to_body
from vehicle_roll_sim.model.records import WHEEL_COUNT
from vehicle_roll_sim.model.tire.spring import spring_force

NEARLY_FLAT = 1e-12
"""Lower limit of the cosine of an inclination; keeps a wheel that lies on the road finite."""


@kernel
def place_on_road(state, vehicle, attitude, outputs):
    """Heading, inclination, loaded radius (m), load (N) and contact point of every wheel.

    With the road's normal e and the spin axis n, sin gamma = n e. The contact point is the loaded
    radius rl along d = (-e + n sin gamma) / cos gamma from the wheel centre, at height zc:

        rl = zc / cos gamma,  Fzg = F(r0 - rl) / cos gamma,

    with the force F of the tire's spring: its energy is then that of the compression r0 - rl. Off
    the road Fzg = 0 and rl = r0. The
    tire compression is that of equation 15, rl = r0 - xt / cos gamma: negative off the road, where
    it is minus the height of the tire's lowest point.
    """
    terms = outputs.suspension_terms
    up_x, up_y, up_z = yawed_to_body(attitude, 0.0, 0.0, 1.0)
    z = state[at.Z]
    for i in range(WHEEL_COUNT):
        outputs.unloaded_radius[i] = vehicle.tire_radius[i]
        outputs.support[i] = vehicle.tire_stiffness[i]
        outputs.normal_force[i] = vehicle.tire_progression[i]
    for i in range(WHEEL_COUNT):
        nx, ny, nz = terms.spin_axis[0, i], terms.spin_axis[1, i], terms.spin_axis[2, i]
        ahead, left, rise = body_to_yawed(attitude, nx, ny, nz)
        cosine = max(square_root(ahead * ahead + left * left), NEARLY_FLAT)
        inverse = 1.0 / cosine
        outputs.steering_sine[i], outputs.steering_cosine[i] = -ahead * inverse, left * inverse
        terms.lean[i] = rise * inverse
        outputs.inclination_sine[i], outputs.inclination_cosine[i] = rise, cosine
        x, y, below = terms.wheel[0, i], terms.wheel[1, i], terms.wheel[2, i]
        height = z + up_x * x + up_y * y + up_z * below
        radius = outputs.unloaded_radius[i]
        terms.tire_compression[i] = radius * cosine - height
        deflection = radius - height * inverse
        stiffness, progression = outputs.support[i], outputs.normal_force[i]
        support = spring_force(deflection, stiffness, progression) * inverse
        outputs.support[i] = support
        outputs.normal_force[i] = normal_force(support)
        loaded = radius - deflection if deflection > 0.0 else radius
        outputs.loaded_radius[i] = loaded
        reach = loaded * inverse
        terms.arm[0, i] = reach * (rise * nx - up_x)
        terms.arm[1, i] = reach * (rise * ny - up_y)
        terms.arm[2, i] = reach * (rise * nz - up_z)
    for i in range(WHEEL_COUNT):
        outputs.inclination[i] = arctan(terms.lean[i])


@kernel
def contact_motion(state, attitude, outputs):
    """dP/dq of every contact point P in frame 1, and its velocity in frame 2 (m/s), not spinning.

    The carrier turns with the travel: dP/dq = T + kappa' x (rl d).
    """
    terms = outputs.suspension_terms
    wx, wy, wz = state[at.ROLL_RATE], state[at.PITCH_RATE], state[at.YAW_RATE]
    wu = state[at.UNSPRUNG_VELOCITY]
    for i in range(WHEEL_COUNT):
        x, y, z = terms.arm[0, i], terms.arm[1, i], terms.arm[2, i]
        kx, ky = terms.carrier_turn[0, i], terms.carrier_turn[1, i]
        kz, rate = terms.carrier_turn[2, i], outputs.suspension_rate[i]
        px, py, pz = ky * z - kz * y, kz * x - kx * z, kx * y - ky * x
        terms.contact_path[0, i] = terms.path[0, i] + px
        terms.contact_path[1, i] = terms.path[1, i] + py
        terms.contact_path[2, i] = 1.0 + pz
        ahead = outputs.unsprung_u[i] + wy * z - wz * y + px * rate
        left = outputs.unsprung_v[i] + wz * x - wx * z + py * rate
        up = wu[i] + wx * y - wy * x + pz * rate
        outputs.contact_u[i], outputs.contact_v[i], _ = body_to_yawed(attitude, ahead, left, up)


@kernel
def compression_rates(state, vehicle, attitude, outputs, rates):
    """Rates of the suspension springs, and of the tires while the steering is held (m/s)."""
    terms = outputs.suspension_terms
    wx, wy, wz = state[at.ROLL_RATE], state[at.PITCH_RATE], state[at.YAW_RATE]
    wu = state[at.UNSPRUNG_VELOCITY]
    for i in range(WHEEL_COUNT):
        rate = outputs.suspension_rate[i]
        _, _, rise = body_to_yawed(attitude, outputs.unsprung_u[i], outputs.unsprung_v[i], wu[i])
        nx, ny, nz = terms.spin_axis[0, i], terms.spin_axis[1, i], terms.spin_axis[2, i]
        kx = wx + terms.carrier_turn[0, i] * rate
        ky = wy + terms.carrier_turn[1, i] * rate
        kz = wz + terms.carrier_turn[2, i] * rate
        turned = (ky * nz - kz * ny, kz * nx - kx * nz, kx * ny - ky * nx)
        _, _, leaning = body_to_yawed(attitude, turned[0], turned[1], turned[2])
        rates[at.SUSPENSION_COMPRESSION][i] = rate
        rates[at.TIRE_COMPRESSION][i] = -rise - vehicle.tire_radius[i] * terms.lean[i] * leaning


@kernel
def note_tire_compression(state, options, outputs):
    """Write the compression of the tires to `state`: here it follows from the other states.

    It depends on the steering too, which may step; the rate that is integrated cannot know that.
    """
    terms = outputs.suspension_terms
    if options.kinematic:
        for i in range(WHEEL_COUNT):
            state[at.TIRE_COMPRESSION][i] = terms.tire_compression[i]
