"""Roll centre of each axle: where the force lines of its two wheels meet.

Seen from the front, the force line of a wheel goes through its contact point and stands on the path
of that point. A force along it moves the wheel without help of the spring.
"""

import math as constants

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.jit import kernel
from vehicle_roll_sim.model.frames import yawed_to_body
from vehicle_roll_sim.model.records import FRONT, LF, LR, REAR, RF, RR


@kernel
def roll_centres(state, attitude, outputs):
    """Height above the road and place to the left of the c.g. (frame 1) of each roll centre (m).

    nan where the two lines are parallel.
    """
    terms = outputs.suspension_terms
    up_x, up_y, up_z = yawed_to_body(attitude, 0.0, 0.0, 1.0)
    for axle, left, right in ((FRONT, LF, RF), (REAR, LR, RR)):
        ahead = terms.wheel[0, left] + terms.arm[0, left]
        ahead = (ahead + terms.wheel[0, right] + terms.arm[0, right]) / 2
        y0, z0 = terms.wheel[1, left] + terms.arm[1, left], terms.wheel[2, left]
        y1, z1 = terms.wheel[1, right] + terms.arm[1, right], terms.wheel[2, right]
        z0, z1 = z0 + terms.arm[2, left], z1 + terms.arm[2, right]
        ty0, tz0 = terms.contact_path[1, left], terms.contact_path[2, left]
        ty1, tz1 = terms.contact_path[1, right], terms.contact_path[2, right]
        determinant = ty0 * tz1 - ty1 * tz0
        height, place = constants.nan, constants.nan
        if determinant != 0.0:
            c0, c1 = ty0 * y0 + tz0 * z0, ty1 * y1 + tz1 * z1
            place = (c0 * tz1 - c1 * tz0) / determinant
            above = (ty0 * c1 - ty1 * c0) / determinant
            height = state[at.Z] + up_x * ahead + up_y * place + up_z * above
        outputs.roll_centre_height[axle], outputs.roll_centre_place[axle] = height, place
