"""Keys of tire files other than the coefficients of force and moment curves."""

import math

from vehicle_roll_sim.vehicle.tire.key import ALL, NEW, NEWEST, OLD, table

HEADER = table(
    {
        "FILE_TYPE": "file type",
        "FILE_VERSION": "version of the file format",
        "FILE_FORMAT": "encoding of the file",
        "FILE_NAME": "name of the file",
        "COMMENT": "comment",
    },
    idle=ALL,
)
UNITS = table(
    {
        "LENGTH": "unit of lengths: meter, mm, inch, ...",
        "FORCE": "unit of forces: newton, kN, pound_force, ...",
        "ANGLE": "unit of the slip and inclination ranges: radians or degrees",
        "MASS": "unit of masses: kg, pound_mass, ...",
        "TIME": "unit of times: second, ...",
        "PRESSURE": "unit of pressures: pascal, bar, psi, ...; else FORCE over LENGTH squared",
    },
    idle=ALL,
)
MODEL = table(
    {
        "PROPERTY_FILE_FORMAT": "format of the file: PAC2002, MF_05, MF-TYRE, USER, MF61, ...",
        "FITTYP": "version of the Magic Formula: 6 or 52 for 5.2, 61, 62",
        "TYRESIDE": "side of the vehicle it was measured for; mirrored on the other side",
        "USE_MODE": "forces in use: 4 combined slip, 3 uncombined; negative: mirrored",
        "FE_METHOD": "YES: combined slip by a friction ellipse; not simulated",
        "SIGN_CONVENTION": "signs of the coefficients: ISO, ADAPTED_SAE, SAE, ADAPTED_ISO",
        "COORDINATE_SYSTEM": "the same as SIGN_CONVENTION",
        "AXIS_SYSTEM": "the same as SIGN_CONVENTION",
        "VXLOW": "speed below which slip is limited (m/s)",
        "ROAD_INCREMENT": "increment in road sampling",
        "ROAD_DIRECTION": "direction of travelled distance",
        "USER_SUB_ID": "number of the Adams subroutine",
        "FUNCTION_NAME": "name of the Adams function",
        "N_TIRE_STATES": "number of tire states in Adams",
        "HMAX_LOCAL": "step of the local integrator",
        "SWITCH_INTEG": "switch of the local integrator",
        "TIME_SWITCH_INTEG": "time at which the local integrator starts",
        "CONTACT_MODEL": "contact with the road in Adams",
        "PLYSTEER": "switch for ply steer of fitting tools",
        "TURNSLIP": "switch for turn slip of fitting tools",
        "TYPE": "kind of vehicle",
        "PLUS": "switch of the axes in which moments are reported",
        "MODEL_NAME": "name of the model",
    },
    idle=ALL,
)
SPEED = table({"LONGVL": "speed of the measurement (m/s)"}, ALL, default=16.7, dimension="speed")
SIZE = table({"UNLOADED_RADIUS": "unloaded radius (m)"}, ALL, dimension="length")
SECTION = table(
    {"WIDTH": "section width of the tire (m)"}, NEWEST, ("5.2", "6.1"), dimension="length"
)
ASPECT = table(
    {"ASPECT_RATIO": "section height of the tire over its width"}, NEWEST, ("5.2", "6.1")
)
PRESSURE = table(
    {
        "INFLPRES": "inflation pressure (Pa)",
        "NOMPRES": "nominal pressure, to which the coefficients apply (Pa)",
    },
    NEW,
    OLD,
    dimension="pressure",
)
LOAD = table(
    {"FNOMIN": "nominal load, above 0 (N); the loads below are relative to it"},
    ALL,
    dimension="force",
)
STIFFNESS = table(
    {
        "VERTICAL_STIFFNESS": "vertical stiffness (N/m)",
        "LONGITUDINAL_STIFFNESS": "longitudinal stiffness of the carcass (N/m)",
        "LATERAL_STIFFNESS": "lateral stiffness of the carcass (N/m)",
    },
    ALL,
    dimension="stiffness",
)
EFFECTIVE_RADIUS = table(
    {
        "BREFF": "increase of the effective rolling radius at low load",
        "DREFF": "peak of the effective rolling radius",
        "FREFF": "decrease of the effective rolling radius at high load",
    },
    ALL,
)
FREE_RADIUS = table({"Q_RE0": "free radius over unloaded radius"}, NEW, OLD, default=1.0)
LOADED_RADIUS = table(
    {
        "Q_V1": "increase of the radius with speed",
        "Q_V2": "increase of the vertical stiffness with speed",
        "Q_FZ2": "quadratic term of load over deflection",
        "Q_FCX": "decrease of the vertical stiffness with longitudinal force",
        "Q_FCY": "decrease of the vertical stiffness with lateral force",
        "PFZ1": "variation of the vertical stiffness with pressure",
        "PCFX1": "variation of the longitudinal stiffness with deflection",
        "PCFX2": "variation of the longitudinal stiffness with deflection squared",
        "PCFX3": "variation of the longitudinal stiffness with pressure",
        "PCFY1": "variation of the lateral stiffness with deflection",
        "PCFY2": "variation of the lateral stiffness with deflection squared",
        "PCFY3": "variation of the lateral stiffness with pressure",
    },
    NEW,
    OLD,
)
LARGE_CAMBER = table(
    {
        "Q_FCY2": "variation with deflection of the effect of lateral force on load",
        "Q_CAM1": "effect of inclination on load, constant term",
        "Q_CAM3": "decrease of the load with inclination",
    },
    NEWEST,
)
CONTOUR = table(
    {"Q_CAM2": "effect of inclination on load, term of the radius (1/m)"},
    NEWEST,
    dimension="curvature",
)
CAMBER_FORCE = table(
    {
        "Q_FYS1": "lateral force due to inclination, for the loaded radius, constant term (N)",
        "Q_FYS2": "lateral force due to inclination, for the loaded radius, linear term (N)",
        "Q_FYS3": "lateral force due to inclination, for the loaded radius, quadratic term (N)",
    },
    NEWEST,
    dimension="force",
)
LOWEST = {
    "KPUMIN": ("smallest slip ratio for which the coefficients are valid", ""),
    "ALPMIN": ("smallest slip angle for which the coefficients are valid (rad)", "angle"),
    "CAMMIN": ("smallest inclination angle for which the coefficients are valid (rad)", "angle"),
    "FZMIN": ("smallest load for which the coefficients are valid (N)", "force"),
    "PRESMIN": ("smallest pressure for which the coefficients are valid (Pa)", "pressure"),
}
HIGHEST = {
    "KPUMAX": ("largest slip ratio for which the coefficients are valid", ""),
    "ALPMAX": ("largest slip angle for which the coefficients are valid (rad)", "angle"),
    "CAMMAX": ("largest inclination angle for which the coefficients are valid (rad)", "angle"),
    "FZMAX": ("largest load for which the coefficients are valid (N)", "force"),
    "PRESMAX": ("largest pressure for which the coefficients are valid (Pa)", "pressure"),
}
RANGES = {
    name: key
    for ends, default in ((LOWEST, -math.inf), (HIGHEST, math.inf))
    for name, (meaning, dimension) in ends.items()
    for key in table({name: meaning}, ALL, (), default, dimension).values()
}
GENERAL = (
    HEADER
    | MODEL
    | SPEED
    | SIZE
    | SECTION
    | ASPECT
    | PRESSURE
    | LOAD
    | STIFFNESS
    | EFFECTIVE_RADIUS
    | FREE_RADIUS
    | LOADED_RADIUS
    | LARGE_CAMBER
    | CONTOUR
    | CAMBER_FORCE
    | RANGES
)
"""All but those of [UNITS], which are separate since MASS there is a unit."""
