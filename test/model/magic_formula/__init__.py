"""The Magic Formula 5.2, 6.1 and 6.2 once more, from the list of its equations: an oracle.

Numbers of equations are those of Pacejka (2012), section 4.3. Functions take slips, load and
inclination in arrays and `p`, the coefficients of the file by name, in SI units; what `p` lacks has
the default of its version. Angles are measured on the side that the file was made for, but
`evaluate` takes the side as well. Axes are ISO (TYDEX W). Turn slip is zero and the tire rolls
forward. Sources differ on where the scaling factors LGAX, LGAY and LGAZ of 5.2 act: here on the
inclination in all of Fx, Fy and Mz.
"""

from magic_formula.coefficients import Coefficients, complete, is_number, read
from magic_formula.combined import combined, lateral_weight, limits, longitudinal_weight
from magic_formula.curves import relative_load
from magic_formula.evaluation import Forces, evaluate, slopes
from magic_formula.lateral import cornering_stiffness, lateral_peak, pure_lateral
from magic_formula.longitudinal import (
    longitudinal_peak,
    longitudinal_stiffness,
    pure_longitudinal,
)
from magic_formula.radii import load_at, loaded_radius
