"""A second implementation, in numpy, of the rates of every model and option.

Wheels are arrays in the order lf, rf, lr, rr. The equations of the body are written as residuals,
linear in its accelerations, which are found by probing the residuals with unit accelerations.
"""

import functools
from types import SimpleNamespace

import magic_formula
import numpy as np
from tire_springs import tire_compressions, tire_loads

from vehicle_roll_sim.model.records import MODEL_STATE

G = 9.81
FRONT, REAR = np.array([1, 1, 0, 0]), np.array([0, 0, 1, 1])
LEFT, RIGHT = [0, 2], [1, 3]
PROBE = 10.0  # m/s^2 and rad/s^2: the size of the real accelerations


class Form:
    """Which equations of the list a model has, told by its name alone."""

    def __init__(self, options):
        model = self.model = options.model
        self.small = model != "1"
        self.light_links = model not in ("1", "1a")
        self.light_wheels = self.light_links and model != "1b-turning-kept"
        self.static_strut = model in ("1b-static-strut", "1b-no-strut")
        self.no_roll_centre, self.euler = options.no_roll_centre, options.euler_terms
        self.upright = options.tire_normal_to_ground
        self.each_side = options.link_load_transfer == "asymmetric"


def parameters(vehicle) -> SimpleNamespace:
    """Parameters of the source's table, per wheel, and what is at rest (18-20)."""
    a, b = vehicle.cg_to_front_axle, vehicle.cg_to_rear_axle
    names = ("unsprung_mass", "spring_stiffness", "damping", "roll_centre_depth")
    mu, ks, bs, hrc = (vehicle.per_wheel(name) for name in names)
    m, c = vehicle.sprung_mass, vehicle.per_wheel("track")
    load = m * G * (FRONT * b + REAR * a) / (2 * (a + b))
    xti = tire_compressions(vehicle, load + mu * G)
    lsi = vehicle.cg_height - (vehicle.tire_radius - xti)
    x, y = FRONT * a - REAR * b, np.array([1, -1, 1, -1]) * c / 2
    inertia = np.array([vehicle.roll_inertia, vehicle.pitch_inertia, vehicle.yaw_inertia])
    known = {"m": m, "mu": mu, "ks": ks, "bs": bs, "hrc": hrc, "x": x, "y": y, "c": c}
    known |= {"tires": functools.partial(tire_loads, vehicle)}
    known |= {"xsi": load / ks, "lsi": lsi, "h": vehicle.cg_height, "r0": vehicle.tire_radius}
    return SimpleNamespace(**known, J=inertia, Jw=vehicle.wheel_inertia)


def named(state) -> SimpleNamespace:
    """The state under the symbols of the source."""
    symbols = ("phi", "theta", "psi", "u", "v", "w", "wx", "wy", "wz", "xs", "xt", "wu", "spin")
    values = (state[name] for name in MODEL_STATE.names[3:])
    return SimpleNamespace(**dict(zip(symbols, values, strict=True)))


def functions(form, s):
    """sin and cos of roll, sin and cos of pitch, as the model has them."""
    if form.small:
        return s.phi, 1.0, s.theta, 1.0
    return np.sin(s.phi), np.cos(s.phi), np.sin(s.theta), np.cos(s.theta)


def move(form, p, s):
    """Velocities of corners and unsprung masses, lengths and radii (1, 9-17, 45, 69, 75)."""
    s.us, s.vs = s.u - p.y * s.wz, s.v + p.x * s.wz
    s.xs_rate = s.wu - (s.w + p.y * s.wx - p.x * s.wy)
    s.ls = p.lsi - (s.xs - p.xsi)
    arm = p.lsi if form.static_strut else s.ls
    s.uu, s.vu = s.us - arm * s.wy, s.vs + arm * s.wx
    if form.model == "1b-no-strut":
        s.uu, s.vu = s.us, s.vs
    drop = np.minimum(s.xt, 0.0)
    tilt = np.arctan((drop[RIGHT] - drop[LEFT]) / (p.c[LEFT] * np.cos(s.phi)))
    s.tilt = np.repeat(tilt, 2) * form.upright
    leaning = np.cos(s.tilt if form.upright else s.phi)
    shorter = s.xt if form.small else s.xt / (np.cos(s.theta) * leaning)
    s.r = np.where(s.xt > 0, p.r0 - shorter, p.r0)
    s.load = np.where(s.xt > 0, p.tires(s.xt), 0.0)


def contact_velocity(form, p, s):
    """ug and vg (7, 8, 41, 42, 65-68)."""
    sp, cp, st, ct = functions(form, s)
    if form.model == "1c-iv":
        return s.us, s.vs
    if form.small:
        reach = p.h if form.static_strut else s.ls + s.r
        return s.us - s.wy * reach, s.vs + s.wx * reach
    if form.upright:
        sn, cn, rate = np.sin(s.tilt), np.cos(s.tilt), np.where(s.tilt == 0, 0.0, s.wx)
        back = s.wy * s.ls + (s.wy * cn - s.wz * sn) * s.r
        up = s.wu * cp + (s.wx * s.ls + s.vs) * sp + rate * s.r * sn
        aside = cp * (s.vs + s.wx * s.ls) + rate * s.r * cn - s.wu * sp
        return ct * (s.us - back) + st * up, aside
    up = s.wu * cp + sp * (s.wx * s.r + s.vu)
    return ct * (s.uu - s.wy * s.r) + st * up, cp * (s.vu + s.wx * s.r) - s.wu * sp


def press(form, p, s, command, tire):
    """Tire forces along the wheel, in frame 2 and in frame 1 (2-6, 23, 38, 59, 74)."""
    sp, cp, st, ct = functions(form, s)
    ug, vg = contact_velocity(form, p, s)
    delta = FRONT * command["steering"] + REAR * command["rear_steering"]
    sd, cd = np.sin(delta), np.cos(delta)
    rolling = ug * cd + vg * sd
    kappa = (s.r * s.spin - rolling) / np.abs(rolling)
    alpha = np.arctan2(vg * cd - ug * sd, np.abs(rolling))
    s.fxt, fyt = np.where(s.load > 0, magic_formula.combined(tire, kappa, alpha, s.load), 0.0)
    s.fx, s.fy = s.fxt * cd - fyt * sd, fyt * cd + s.fxt * sd
    s.fxgs = ct * s.fx - st * s.load
    s.fygs = cp * s.fy + sp * (ct * s.load if form.small else st * s.fx + ct * s.load)
    if form.model == "1c-i":
        s.fxgs, s.fygs = s.fx, s.fy
    upright = np.cos(s.tilt) * s.fy + np.sin(s.tilt) * (s.load * ct + s.fx * st)
    s.rolling = upright if form.upright else s.fygs
    s.fzs = p.ks * s.xs + p.bs * s.xs_rate + command["normal_force"]


def links(form, p, s, q):
    """Fxs, Fys and Fdz at the accelerations q (21, 22, 26, 46, 47, 54-57, 59, section 7.3)."""
    sp, _, st, ct = functions(form, s)
    uu_rate = q[0] - p.y * q[5] + s.xs_rate * s.wy - s.ls * q[4]
    vu_rate = q[1] + p.x * q[5] - s.xs_rate * s.wx + s.ls * q[3]
    fx, fy = s.fxgs + p.mu * G * st, s.fygs - p.mu * G * sp * ct
    if form.model == "1c-i":
        fx, fy = s.fxgs, s.fygs
    if not form.light_links:
        fx = fx - p.mu * (uu_rate - s.wz * s.vu + s.wy * s.wu)
        fy = fy - p.mu * (vu_rate - s.wx * s.wu + s.wz * s.uu)
    own = s.rolling * s.r + fy * s.ls - fy * p.hrc
    fdz = own / (p.c / 2) if form.each_side else np.repeat(own[LEFT] + own[RIGHT], 2) / p.c
    fdz = fdz * [-1, 1, -1, 1]
    return fx, fy, np.zeros(4) if form.no_roll_centre else fdz


def residuals(form, p, s, q):
    """Left less right of the equations of the sprung mass at the accelerations q (24-34)."""
    sp, cp, st, ct = functions(form, s)
    fx, fy, fdz = links(form, p, s, q)
    mx = s.rolling * s.r + fy * s.ls if form.no_roll_centre else fy * p.hrc
    upright = s.phi - s.tilt if form.upright else 0.0
    my = -(s.fxgs * s.r * np.cos(upright) + fx * s.ls)
    mz = s.fx * s.r * np.sin(upright)
    lumped = p.m + p.mu.sum() * (form.model == "1b-mass-lumped")
    turning = np.array([s.wx, s.wy, s.wz])
    inertia = [lumped, lumped, p.m] * (q[:3] + np.cross(turning, [s.u, s.v, s.w]))
    weight = p.m * G * np.array([st, -sp * ct, -cp * ct])
    fz = s.fzs + fdz
    moments = [mx + p.y * s.fzs, my - p.x * fz, mz + p.x * fy - p.y * fx]
    gyroscopic = np.cross(turning, p.J * turning) * form.euler
    forces = inertia - np.sum([fx, fy, fz], axis=1) - weight
    return np.append(forces, p.J * q[3:] + gyroscopic - np.sum(moments, axis=1))


def wheel_rates(form, p, s, fdz):
    """Rates of wu and xt (11, 14, 43, 44, 58, 60, 61)."""
    sp, cp, st, ct = functions(form, s)
    load = s.load - p.mu * G
    force = load if form.model == "1c-ii" else cp * (ct * load + st * s.fx) - sp * s.fy
    turning = 0.0 if form.light_wheels else p.mu * (s.vu * s.wx - s.uu * s.wy)
    rise = ct * (s.wu * cp + s.vu * sp) - s.uu * st
    return (force - fdz - s.fzs - turning) / p.mu, -(s.wu if form.model == "1c-iii" else rise)


def position_rates(form, s):
    """Rates of x, y and z: Rz Ry Rx (u, v, w), of small angles where the model has them."""
    sp, cp, st, ct = functions(form, s)
    up = sp * s.v + cp * s.w
    ahead, aside = ct * s.u + st * up, cp * s.v - sp * s.w
    turned = (ahead + 1j * aside) * np.exp(1j * s.psi)
    return turned.real, turned.imag, ct * up - st * s.u


def attitude_rates(form, s):
    """Rates of roll, pitch and yaw (35-37, 51-53, 62-64)."""
    sp, cp, st, ct = functions(form, s)
    if form.model == "1c-iii":
        return s.wx, s.wy, s.wz
    if form.small:
        return s.wx + s.wz * s.theta, s.wy - s.wz * s.phi, s.wy * s.phi + s.wz
    turning = s.wy * sp + s.wz * cp
    return s.wx + turning * st / ct, s.wy * cp - s.wz * sp, turning / ct


def rates(vehicle, options, state, command) -> dict:
    """The rates of the 28 states by name."""
    form, p, s = Form(options), parameters(vehicle), named(state)
    move(form, p, s)
    press(form, p, s, command, vehicle.tire.coefficients)
    at_rest = residuals(form, p, s, np.zeros(6))
    probed = [residuals(form, p, s, PROBE * unit) - at_rest for unit in np.eye(6)]
    q = -PROBE * np.linalg.solve(np.array(probed).T, at_rest)
    hold = command["speed_hold_gain"] * (command["speed_hold_target"] - s.u)
    torque = command["wheel_torque"] + REAR * hold
    wu_rate, xt_rate = wheel_rates(form, p, s, links(form, p, s, q)[2])
    values = (*position_rates(form, s), *attitude_rates(form, s), *q)
    values += (s.xs_rate, xt_rate, wu_rate, (torque - s.r * s.fxt) / p.Jw)
    return dict(zip(MODEL_STATE.names, values, strict=True))
