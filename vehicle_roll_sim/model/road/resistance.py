"""Forces of the road on the side of a wheel: of the face of a curb, and of a furrow in soil."""

from vehicle_roll_sim.model.compiled.jit import kernel, math
from vehicle_roll_sim.model.frames import ground_to_yawed
from vehicle_roll_sim.model.records import WHEEL_COUNT
from vehicle_roll_sim.model.road.layout import COSINE, COUNT, KIND, OWN, SINE, WALL
from vehicle_roll_sim.model.road.shapes import lift
from vehicle_roll_sim.model.road.surface import in_feature, row_of

PLOWING_SPEED = 0.1
"""m/s: lateral speed from which on the resistance of a furrow is nearly complete (tanh)."""


@kernel
def side_forces(heading, ground, outputs):
    """Forces of curbs and soil on the wheels in frame 2 (N), and their heights above the contact.

    Reads place, deflection and sinkage of the wheels, and the velocity of their contact points.
    """
    terms = outputs.road_terms
    for i in range(WHEEL_COUNT):
        x, y = terms.place_x[i], terms.place_y[i]
        ahead, left = terms.speed_ahead[i], terms.speed_left[i]
        for k in range(int(ground[COUNT])):
            row = row_of(k, ground)
            if ground[row + KIND] == WALL:
                strike(i, x, y, ahead, left, heading, row, ground, outputs)
        if terms.sinkage[i] > 0.0:
            plow(i, ahead, left, outputs)


@kernel
def strike(i, x, y, ahead, left, heading, row, ground, outputs):
    """Force of the face of a curb on the sidewall of a tire.

    Its own numbers: length of the curb, its height (m), distance from the wheel plane to the
    sidewall (m), stiffness (N/m) and damping (N s/m) of the sidewall, rounding, and length of the
    face across (m). The low side is at n < 0. The force is that of a spring and a damper that never
    pull, in proportion to the part of the face that the tire covers: zero when the wheel has
    climbed the curb. It acts in the middle of this part.
    """
    terms, at = outputs.road_terms, row + OWN
    length, height, reach = ground[at], ground[at + 1], ground[at + 2]
    s, n = in_feature(x, y, row, ground)
    if not (0.0 < s < length and n > -reach):
        return
    mx, my = ground_to_yawed(heading, -ground[row + SINE], ground[row + COSINE])
    sideways = abs(outputs.steering_cosine[i] * my - outputs.steering_sine[i] * mx)
    depth = reach * sideways + n
    climbed, _ = lift(n, 0.0, ground[at + 6], ground[at + 5])
    covered = height * (1.0 - climbed) - max(-terms.deflection[i], 0.0)
    if depth <= 0.0 or covered <= 0.0:
        return
    begun, _ = lift(min(s, length - s), 0.0, ground[at + 5], 0.5 * ground[at + 5])
    share = begun * covered / height
    speed = ahead * mx + left * my
    force = share * max(ground[at + 3] * depth + ground[at + 4] * speed, 0.0)
    terms.side_x[i] -= force * mx
    terms.side_y[i] -= force * my
    terms.side_height[i] = 0.5 * covered


@kernel
def plow(i, ahead, left, outputs):
    """Resistance of a furrow to a wheel that slides sideways in it.

    The passive earth pressure on the side of the tire at a sinkage z, a z + b z^2: its first part
    acts at z / 2, the second at z / 3 above the bottom of the furrow.
    """
    terms, depth = outputs.road_terms, outputs.road_terms.sinkage[i]
    s, c = outputs.steering_sine[i], outputs.steering_cosine[i]
    sliding = math.tanh((c * left - s * ahead) / PLOWING_SPEED)
    first, second = terms.linear[i] * depth, terms.quadratic[i] * depth * depth
    force = -sliding * (first + second)
    terms.side_x[i] -= s * force
    terms.side_y[i] += c * force
    if first + second > 0.0:
        arm = (first / 2 + second / 3) / (first + second)
        terms.side_height[i] = max(terms.side_height[i], depth * arm)
