"""Keys of tire files that are terms of the overturning, rolling and aligning moment."""

from vehicle_roll_sim.vehicle.tire.key import ALL, NEW, Key, table

SCALING = table(
    {
        "LTR": "scales the pneumatic trail",
        "LRES": "scales the residual moment",
        "LS": "scales the moment arm of Fx about the vertical axis",
        "LMX": "scales the overturning moment",
        "LVMX": "scales the offset of the overturning moment",
        "LMY": "scales the rolling resistance moment",
    },
    ALL,
    default=1.0,
)
OVERTURNING = table(
    {
        "QSX1": "offset of the overturning moment",
        "QSX2": "overturning moment due to inclination",
        "QSX3": "overturning moment due to lateral force",
        "QSX4": "overturning moment due to load, lateral force and inclination",
        "QSX5": "shape factor of that moment over load",
        "QSX6": "stiffness factor of that moment over load",
        "QSX7": "share of inclination in that moment",
        "QSX8": "share of lateral force in that moment",
        "QSX9": "stiffness factor of lateral force in that moment",
        "QSX10": "overturning moment due to load and inclination",
        "QSX11": "stiffness factor of load in that moment",
    },
    ALL,
)
OVERTURNING_NEW = table(
    {
        "QSX12": "overturning moment due to inclination squared",
        "QSX13": "overturning moment due to lateral force, arm over radius",
        "QSX14": "overturning moment due to lateral force and inclination",
        "PPMX1": "variation with pressure of the overturning moment due to inclination",
    },
    NEW,
)
ROLLING = table(
    {
        "QSY1": "rolling resistance",
        "QSY2": "rolling resistance due to longitudinal force",
        "QSY3": "rolling resistance due to speed",
        "QSY4": "rolling resistance due to the fourth power of speed",
    },
    ALL,
)
ROLLING_NEW = table(
    {
        "QSY5": "rolling resistance due to inclination squared",
        "QSY6": "rolling resistance due to inclination squared and load",
        "QSY8": "exponent of pressure in the rolling resistance",
    },
    NEW,
)
ALIGNING = table(
    {
        "QBZ1": "stiffness factor of the trail at nominal load",
        "QBZ2": "variation of the stiffness factor of the trail with load",
        "QBZ3": "variation of the stiffness factor of the trail with load squared",
        "QBZ4": "variation of the stiffness factor of the trail with inclination",
        "QBZ5": "variation of the stiffness factor of the trail with the magnitude of inclination",
        "QBZ9": "stiffness factor of the residual moment",
        "QBZ10": "stiffness factor of the residual moment, share of Fy",
        "QCZ1": "shape factor of the trail",
        "QDZ1": "peak trail over radius at nominal load",
        "QDZ2": "variation of the peak trail with load",
        "QDZ3": "variation of the peak trail with inclination",
        "QDZ4": "variation of the peak trail with inclination squared",
        "QDZ6": "peak residual moment at nominal load",
        "QDZ7": "variation of the peak residual moment with load",
        "QDZ8": "variation of the peak residual moment with inclination",
        "QDZ9": "variation of the peak residual moment with inclination and load",
        "QEZ1": "curvature factor of the trail at nominal load",
        "QEZ2": "variation of the curvature factor of the trail with load",
        "QEZ3": "variation of the curvature factor of the trail with load squared",
        "QEZ4": "difference in the curvature factor of the trail between the signs of slip angle",
        "QEZ5": "variation of that difference with inclination",
        "QHZ1": "horizontal shift of the trail at nominal load (rad)",
        "QHZ2": "variation of the horizontal shift of the trail with load",
        "QHZ3": "variation of the horizontal shift of the trail with inclination",
        "QHZ4": "variation of the horizontal shift of the trail with inclination and load",
        "SSZ1": "arm of Fx over radius at nominal load",
        "SSZ2": "variation of the arm of Fx with lateral force",
        "SSZ3": "variation of the arm of Fx with inclination",
        "SSZ4": "variation of the arm of Fx with inclination and load",
    },
    ALL,
)
ALIGNING_NEW = table(
    {
        "QDZ10": "variation of the peak residual moment with inclination squared",
        "QDZ11": "variation of the peak residual moment with inclination squared and load",
        "PPZ1": "variation of the peak trail with pressure",
        "PPZ2": "variation with pressure of the peak residual moment due to inclination",
    },
    NEW,
)
MOMENTS = (
    SCALING
    | OVERTURNING
    | OVERTURNING_NEW
    | ROLLING
    | ROLLING_NEW
    | {"QSY7": Key("exponent of load in the rolling resistance", NEW, default=1.0)}
    | ALIGNING
    | ALIGNING_NEW
)
