"""Keys of tire files that are terms of the longitudinal and lateral force."""

from vehicle_roll_sim.vehicle.tire.key import ALL, NEW, OLD, Key, table

SCALING = table(
    {
        "LFZO": "scales the nominal load, above 0",
        "LCX": "scales the shape factor of Fx, not 0",
        "LMUX": "scales the peak friction of Fx",
        "LEX": "scales the curvature of Fx",
        "LKX": "scales the longitudinal slip stiffness",
        "LHX": "scales the horizontal shift of Fx; 0: no shift",
        "LVX": "scales the vertical shift of Fx; 0: no shift",
        "LXAL": "scales the influence of slip angle on Fx",
        "LCY": "scales the shape factor of Fy, not 0",
        "LMUY": "scales the peak friction of Fy",
        "LEY": "scales the curvature of Fy",
        "LKY": "scales the cornering stiffness",
        "LHY": "scales the horizontal shift of Fy; 0: no shift",
        "LVY": "scales the vertical shift of Fy; 0: no shift",
        "LYKA": "scales the influence of slip ratio on Fy",
        "LVYKA": "scales the Fy induced by slip ratio; 0: none",
    },
    ALL,
    default=1.0,
)
SCALING_OLD = table(
    {
        "LGAX": "scales the influence of inclination on Fx",
        "LGAY": "scales the influence of inclination on Fy",
        "LGAZ": "scales the influence of inclination on Mz",
        "LSGKP": "scales the longitudinal relaxation length",
        "LSGAL": "scales the lateral relaxation length",
    },
    OLD,
    default=1.0,
)
SCALING_NEW = table(
    {
        "LKYC": "scales the camber stiffness of Fy",
        "LKZC": "scales the camber stiffness of Mz",
    },
    NEW,
    default=1.0,
)
LONGITUDINAL = table(
    {
        "PCX1": "shape factor of Fx, not 0",
        "PDX1": "peak friction of Fx at nominal load",
        "PDX2": "variation of the peak friction of Fx with load",
        "PDX3": "variation of the peak friction of Fx with inclination",
        "PEX1": "curvature factor of Fx at nominal load",
        "PEX2": "variation of the curvature factor of Fx with load",
        "PEX3": "variation of the curvature factor of Fx with load squared",
        "PEX4": "difference in the curvature factor of Fx between driving and braking",
        "PKX1": "longitudinal slip stiffness over load, at nominal load, above 0",
        "PKX2": "variation of the longitudinal slip stiffness with load",
        "PKX3": "exponent of the variation of the longitudinal slip stiffness with load",
        "PHX1": "horizontal shift of Fx at nominal load",
        "PHX2": "variation of the horizontal shift of Fx with load",
        "PVX1": "vertical shift of Fx over load, at nominal load",
        "PVX2": "variation of the vertical shift of Fx with load",
        "RBX1": "combined slip: stiffness factor of the weighting function of Fx",
        "RBX2": "variation of that stiffness factor with slip ratio",
        "RCX1": "shape factor of the weighting function of Fx",
        "REX1": "curvature factor of the weighting function of Fx at nominal load",
        "REX2": "variation of that curvature factor with load",
        "RHX1": "shift of the weighting function of Fx (rad)",
    },
    ALL,
)
LATERAL = table(
    {
        "PCY1": "shape factor of Fy, not 0",
        "PDY1": "peak friction of Fy at nominal load, of either sign",
        "PDY2": "variation of the peak friction of Fy with load",
        "PDY3": "variation of the peak friction of Fy with inclination",
        "PEY1": "curvature factor of Fy at nominal load",
        "PEY2": "variation of the curvature factor of Fy with load",
        "PEY3": "difference in the curvature factor of Fy between the signs of slip angle",
        "PEY4": "variation of the curvature factor of Fy with inclination",
        "PKY1": "maximum cornering stiffness over nominal load (1/rad), below 0",
        "PKY2": "load at maximum cornering stiffness, over nominal load; not 0",
        "PKY3": "variation of the cornering stiffness with inclination",
        "PHY1": "horizontal shift of Fy at nominal load (rad)",
        "PHY2": "variation of the horizontal shift of Fy with load",
        "PVY1": "vertical shift of Fy over load, at nominal load",
        "PVY2": "variation of the vertical shift of Fy with load",
        "PVY3": "variation of the vertical shift of Fy with inclination",
        "PVY4": "variation of the vertical shift of Fy with inclination and load",
        "RBY1": "combined slip: stiffness factor of the weighting function of Fy",
        "RBY2": "variation of that stiffness factor with slip angle",
        "RBY3": "slip-angle offset of that variation (rad)",
        "RCY1": "shape factor of the weighting function of Fy",
        "REY1": "curvature factor of the weighting function of Fy at nominal load",
        "REY2": "variation of that curvature factor with load",
        "RHY1": "shift of the weighting function of Fy at nominal load",
        "RHY2": "variation of that shift with load",
        "RVY1": "Fy induced by slip ratio, over the peak of Fy, at nominal load",
        "RVY2": "variation of the induced Fy with load",
        "RVY3": "variation of the induced Fy with inclination",
        "RVY4": "variation of the induced Fy with slip angle",
        "RVY5": "shape factor of the variation of the induced Fy with slip ratio",
        "RVY6": "stiffness factor of the variation of the induced Fy with slip ratio",
    },
    ALL,
)
FORCES_OLD = table(
    {
        "PTX1": "longitudinal relaxation length over radius, at nominal load",
        "PTX2": "variation of the longitudinal relaxation length with load",
        "PTX3": "exponent of the variation of the longitudinal relaxation length with load",
        "PTY1": "maximum lateral relaxation length over radius",
        "PTY2": "load at maximum lateral relaxation length, over nominal load",
        "PHY3": "variation of the horizontal shift of Fy with inclination",
    },
    OLD,
)
FORCES_NEW = table(
    {
        "RBX3": "combined slip: variation of the stiffness factor of Fx with inclination",
        "RBY4": "combined slip: variation of the stiffness factor of Fy with inclination",
        "PEY5": "variation of the curvature factor of Fy with inclination squared",
        "PKY5": "variation of the load at maximum cornering stiffness with inclination",
        "PKY6": "camber stiffness of Fy over load, at nominal load",
        "PKY7": "variation of the camber stiffness of Fy with load",
        "PPX1": "variation of the longitudinal slip stiffness with pressure",
        "PPX2": "variation of the longitudinal slip stiffness with pressure squared",
        "PPX3": "variation of the peak friction of Fx with pressure",
        "PPX4": "variation of the peak friction of Fx with pressure squared",
        "PPY1": "variation of the maximum cornering stiffness with pressure",
        "PPY2": "variation of the load at maximum cornering stiffness with pressure",
        "PPY3": "variation of the peak friction of Fy with pressure",
        "PPY4": "variation of the peak friction of Fy with pressure squared",
        "PPY5": "variation of the camber stiffness of Fy with pressure",
    },
    NEW,
)
FORCES = (
    SCALING
    | SCALING_OLD
    | SCALING_NEW
    | LONGITUDINAL
    | LATERAL
    | FORCES_OLD
    | FORCES_NEW
    | {"PKY4": Key("curvature of the cornering stiffness over load; 2 in 5.2", NEW, default=2.0)}
)
