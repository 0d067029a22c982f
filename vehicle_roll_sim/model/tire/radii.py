"""Rolling radius and loaded radius from the tire file (Pacejka, 2012, A3).

The free radius of a rotating tire is R_OMEGA = R0 (Q_RE0 + Q_V1 (omega R0 / V0)^2). The effective
rolling radius is forward speed over spin in free rolling. The load rises with the
deflection r,

    Fz = F0 (1 + PFZ1 dp) (q1 r / R0 + Q_FZ2 (r / R0)^2)
         (1 + Q_V2 R0 |omega| / V0 - (Q_FCX Fx / F0)^2 - Y^2),

with q1 from the vertical stiffness. In version 6.1 r = R_OMEGA - RL and Y = Q_FCY Fy / F0; in 6.2
both depend on the loaded radius RL and on inclination.
"""

from vehicle_roll_sim.model.compiled.elementary import arctan
from vehicle_roll_sim.model.compiled.jit import kernel, math, term
from vehicle_roll_sim.model.records import LR, WHEEL_COUNT

STEPS, HALVINGS = 200, 60
"""Search for the loaded radius: steps over the radius, then bisections of the step that brackets
it, down to the resolution of a double."""

ROUNDS = 30
"""Iterations for spin and rolling radius, which depend weakly on each other."""


@term
def free_radius(spin, tire):
    """R_OMEGA (m) at a spin (rad/s)."""
    ratio = spin * tire.UNLOADED_RADIUS / tire.LONGVL
    return tire.UNLOADED_RADIUS * (tire.Q_RE0 + tire.Q_V1 * ratio * ratio)


@term
def rolling_depth(fz, tire):
    """R_OMEGA - RE (m) at a load (N); 0 if the tire file does not give it."""
    load = max(fz, 0.0) / tire.FNOMIN
    part = tire.DREFF * arctan(tire.BREFF * load) + tire.FREFF * load
    return tire.nominal_compression * part if tire.rolls_on_own_radius != 0.0 else 0.0


@kernel
def effective_rolling_radius(fz, spin, tire):
    """RE (m) at a load (N) and a spin (rad/s)."""
    return free_radius(spin, tire) - rolling_depth(fz, tire)


@kernel
def free_spin(speed, fz, tire):
    """Spin of a wheel that rolls freely (rad/s) at a speed (m/s) and a load (N)."""
    spin = 0.0
    for _ in range(ROUNDS):
        spin = speed / effective_rolling_radius(fz, spin, tire)
    return spin


@kernel
def rolling_radii(spin, tires, outputs):
    """Rolling radius of every wheel (m); the loaded radius if its tire file gives none.

    spin: of every wheel (rad/s). After `terms_of_loads`.
    """
    terms = outputs.tire_terms
    for i in range(WHEEL_COUNT):
        tire = tires.front if i < LR else tires.rear
        outputs.rolling_radius[i] = outputs.loaded_radius[i]
        if tire.rolls_on_own_radius != 0.0:
            outputs.rolling_radius[i] = free_radius(spin[i], tire) - terms.rolling_depth[i]


@term
def deflection(radius, free, gamma, tire):
    """r (m) at a loaded radius (m); negative values mean no deflection."""
    depth = free - radius
    if tire.version < 6.15:
        return depth
    tread = (1.075 - 0.5 * tire.ASPECT_RATIO) * tire.WIDTH
    contour = (tire.Q_CAM1 + tire.Q_CAM2 * radius) * radius
    free_contour = (tire.Q_CAM1 + tire.Q_CAM2 * free) * free
    share = contour / free_contour if free_contour != 0.0 else 0.0
    edge = share * share * tread / 8 * abs(math.tan(gamma))
    return max(depth, 0.0) + edge - tire.Q_CAM3 * max(depth, 0.0) * abs(gamma)


@kernel
def load_at_radius(radius, spin, gamma, fx, fy, tire):
    """Fz (N) at a loaded radius (m), spin (rad/s), inclination (rad) and forces (N)."""
    nominal, unloaded = tire.FNOMIN, tire.UNLOADED_RADIUS
    free = free_radius(spin, tire)
    r = deflection(radius, free, gamma, tire) / unloaded
    if r <= 0.0:
        return 0.0
    if tire.version < 6.15:
        across = tire.Q_FCY * fy / nominal
    else:
        share = radius / free
        camber = (tire.Q_FYS1 + (tire.Q_FYS2 + tire.Q_FYS3 * share) * share) * gamma
        across = r**tire.Q_FCY2 * tire.Q_FCY * (fy - camber) / nominal
    along = tire.Q_FCX * fx / nominal
    stiffness = tire.VERTICAL_STIFFNESS * unloaded / nominal
    linear = math.sqrt(stiffness * stiffness - 4 * tire.Q_FZ2)
    spring = (linear + tire.Q_FZ2 * r) * r * (1 + tire.PFZ1 * tire.pressure_change) * nominal
    speed = abs(spin) * unloaded / tire.LONGVL
    return (1 + tire.Q_V2 * speed - along * along - across * across) * spring


@kernel
def loaded_radius(fz, spin, gamma, fx, fy, tire):
    """RL (m): the largest radius that carries the load fz (N); nan if none does.

    gamma (rad), fy: in the axes of the tire, mirrored if the tire is. spin: rad/s. fx, fy: N.
    """
    free = free_radius(spin, tire)
    for k in range(1, STEPS):
        low, high = free * (1 - k / STEPS), free * (1 - (k - 1) / STEPS)
        if load_at_radius(low, spin, gamma, fx, fy, tire) >= fz:
            for _ in range(HALVINGS):
                middle = (low + high) / 2
                if load_at_radius(middle, spin, gamma, fx, fy, tire) >= fz:
                    low = middle
                else:
                    high = middle
            return low
    return math.nan


@kernel
def radii_at(points, forces, tires, side, radii):
    """Loaded and effective rolling radius (m) of a tire at points; nan where its file has none.

    Off the ground the loaded radius is that of the free tire. points: normal load (N), slip ratio,
    slip angle, inclination (rad) and speed (m/s), shape (n, 5). forces: Fx and Fy (N) there come
    first, shape (n, m). tires: an array of one TIRE record. side: that of the wheel. radii: set,
    shape (n, 2).
    """
    tire = tires[0]
    is_known = tire.VERTICAL_STIFFNESS > 0.0 and tire.UNLOADED_RADIUS > 0.0 and tire.LONGVL > 0.0
    for k in range(len(points)):
        radii[k, 0] = radii[k, 1] = math.nan
        if is_known:
            load, ratio, speed = float(points[k, 0]), float(points[k, 1]), float(points[k, 4])
            spin = free_spin((1 + ratio) * speed, load, tire)
            if tire.rolls_on_own_radius != 0.0:
                radii[k, 1] = effective_rolling_radius(load, spin, tire)
            if tire.version >= 6.0:
                gamma = side * float(points[k, 3])
                fx, fy = float(forces[k, 0]), side * float(forces[k, 1])
                carried = 0.0 if load < 0.0 else load
                radii[k, 0] = loaded_radius(carried, spin, gamma, fx, fy, tire)
