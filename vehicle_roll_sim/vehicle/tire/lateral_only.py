"""A substitute for the longitudinal force of files with lateral force only.

Assumed, not measured: the tire is taken as isotropic. Fx over slip ratio is the curve of Fy, with
the same shape, curvature and friction, and with the cornering stiffness as slip stiffness:

    PCX1 = PCY1, PDX1..3 = PDY1..3, PEX1, 2 = PEY1, 2, LCX = LCY, LMUX = LMUY, LEX = LEY, LKX = LKY
    PKX1 = |PKY1 sin(n a)|,  PKX3 = e - 1,  a = atan(1 / PKY2),  n = PKY4
    e = n cot(n a) PKY2 / (1 + PKY2^2), the exponent of the cornering stiffness over load

so that at nominal load the slip stiffness and its slope over load are those of the cornering
stiffness. A file without weighting functions gets those of a passenger-car tire (Pacejka, 2002,
table A3.1).
"""

import math

WEIGHTS = {
    "RBX1": 12.35,
    "RBX2": -10.77,
    "RCX1": 1.092,
    "RBY1": 6.461,
    "RBY2": 4.196,
    "RCY1": 1.081,
}
WITH_Y = {
    "PCX1": "PCY1",
    "PDX1": "PDY1",
    "PDX2": "PDY2",
    "PDX3": "PDY3",
    "PEX1": "PEY1",
    "PEX2": "PEY2",
    "PPX3": "PPY3",
    "PPX4": "PPY4",
    "LCX": "LCY",
    "LMUX": "LMUY",
    "LEX": "LEY",
    "LKX": "LKY",
    "LGAX": "LGAY",
    "LSGKP": "LSGAL",
}
"""Longitudinal coefficients and the lateral ones whose values they take."""
OF_FX = ("PEX3", "PEX4", "PKX2", "PHX1", "PHX2", "PVX1", "PVX2", "PPX2", "RBX3", "RHX1")
"""Longitudinal coefficients that are set to 0."""
FROM_LATERAL = "from_lateral"
NOTE = "longitudinal force: derived from the lateral force as for an isotropic tire; not measured"
TYPICAL_WEIGHTS = "combined slip: typical weighting functions; not measured"


def stand_in(c: dict[str, float], combined: bool) -> tuple[dict[str, float], list[str]]:
    """The coefficients with those of Fx derived from those of Fy, and notes that say so."""
    made = {x: c[y] for x, y in WITH_Y.items() if x in c} | {n: 0.0 for n in OF_FX if n in c}
    n, at = c.get("PKY4", 2.0), c["PKY2"]
    angle = n * math.atan(1.0 / at)
    made["PKX1"] = abs(c["PKY1"] * math.sin(angle))
    exponent = n / math.tan(angle) * at / (1.0 + at**2) if made["PKX1"] else 1.0
    made["PKX3"] = exponent - 1.0
    if "PPX1" in c:
        made["PPX1"] = c["PPY1"] - c["PPY2"] * exponent
    if "PTX1" in c and c["PTY2"]:
        made["PTX1"] = c["PTY1"] * math.sin(2.0 * math.atan(1.0 / c["PTY2"]))
        made["PTX2"] = made["PTX3"] = 0.0
    notes = [NOTE]
    if combined:
        has_weight = c["RBY1"] and c["RCY1"]
        made |= {n: v for n, v in WEIGHTS.items() if "X" in n or not has_weight}
        notes.append(TYPICAL_WEIGHTS)
    return c | made, notes
