"""Keys of tire files that are not simulated.

Most have no effect on what is simulated. Those of FOREIGN would have one in every version: a file
may give them only the value with which their term vanishes.
"""

from vehicle_roll_sim.vehicle.tire.key import ALL, table

TURN_SLIP = table(
    {
        "LMP": "scales the parking moment",
        "PDXP1": "decrease of the peak of Fx with turn slip",
        "PDXP2": "variation of that decrease with load",
        "PDXP3": "variation of that decrease with slip ratio",
        "PKYP1": "decrease of the cornering stiffness with turn slip",
        "PDYP1": "decrease of the peak of Fy with turn slip",
        "PDYP2": "variation of that decrease with load",
        "PDYP3": "variation of that decrease with slip angle",
        "PDYP4": "decrease of the peak of Fy with the square root of turn slip",
        "PHYP1": "shape of the lateral shift due to turn slip",
        "PHYP2": "peak of the lateral shift due to turn slip",
        "PHYP3": "variation of that peak with load",
        "PHYP4": "stiffness of the lateral shift due to turn slip",
        "PECP1": "camber reduction factor",
        "PECP2": "variation of the camber reduction factor with load",
        "QDTP1": "decrease of the trail with turn slip",
        "QCRP1": "moment of turning on the spot",
        "QCRP2": "moment of turning at a slip angle of 90 degrees",
        "QBRP1": "decrease of the residual moment with slip angle",
        "QDRP1": "peak of the moment due to turn slip",
    },
    idle=ALL,
)
STRUCTURE = table(
    {
        "RIM_RADIUS": "radius of the rim (m)",
        "RIM_WIDTH": "width of the rim (m)",
        "MASS": "mass of the tire (kg)",
        "MASS1": "mass of the tire (kg)",
        "TIRE_MASS": "mass of the tire (kg)",
        "IXX": "moment of inertia about a diameter (kg m2)",
        "IYY": "moment of inertia about the spin axis (kg m2)",
        "IZZ": "moment of inertia about a diameter (kg m2)",
        "BELT_MASS": "mass of the belt (kg)",
        "MBELT": "mass of the belt (kg)",
        "BELT_IXX": "moment of inertia of the belt about a diameter (kg m2)",
        "BELT_IYY": "moment of inertia of the belt about the spin axis (kg m2)",
        "BELT_IZZ": "moment of inertia of the belt about a diameter (kg m2)",
        "GRAVITY": "gravity on the belt (m/s2)",
        "VERTICAL_DAMPING": "vertical damping (N s/m)",
        "BOTTOM_OFFST": "distance to the rim at which it touches (m)",
        "BOTTOM_STIFF": "vertical stiffness when the rim touches (N/m)",
        "BOTTOM_TRNSF": "transition to the stiffness when the rim touches (m)",
        "YAW_STIFFNESS": "yaw stiffness of the carcass (N m/rad)",
        "PCMZ1": "variation of the yaw stiffness with pressure",
        "LGYR": "scales the gyroscopic moment",
        "QTZ1": "gyroscopic moment of the belt",
    },
    idle=ALL,
)
BELT = table(
    {
        "FREQ_LONG": "frequency of the longitudinal mode of the belt",
        "FREQ_LAT": "frequency of the lateral mode of the belt",
        "FREQ_YAW": "frequency of the yaw mode of the belt",
        "FREQ_WINDUP": "frequency of the wind-up mode of the belt",
        "DAMP_LONG": "damping of the longitudinal mode of the belt",
        "DAMP_LAT": "damping of the lateral mode of the belt",
        "DAMP_YAW": "damping of the yaw mode of the belt",
        "DAMP_WINDUP": "damping of the wind-up mode of the belt",
        "DAMP_RESIDUAL": "residual damping of the belt",
        "DAMP_VLOW": "damping of the belt at low speed",
        "Q_BVX": "variation of the stiffness of the belt with load and speed",
        "Q_BVT": "variation of the wind-up stiffness of the belt with load and speed",
        "Q_RA1": "root term of the length of the contact patch",
        "Q_RA2": "linear term of the length of the contact patch",
        "Q_RB1": "root term of the width of the contact patch",
        "Q_RB2": "linear term of the width of the contact patch",
        "Q_A1": "root term of the length of the contact patch in 5.2",
        "Q_A2": "linear term of the length of the contact patch in 5.2",
        "Q_CFG1": "term of the contact patch",
        "ELLIPS_SHIFT": "distance of the enveloping ellipses",
        "ELLIPS_LENGTH": "length of the enveloping ellipses",
        "ELLIPS_HEIGHT": "height of the enveloping ellipses",
        "ELLIPS_ORDER": "order of the enveloping ellipses",
        "ELLIPS_MAX_STEP": "largest step of the road",
        "ELLIPS_NWIDTH": "number of enveloping ellipses across",
        "ELLIPS_NLENGTH": "number of enveloping ellipses along",
        "ENV_C1": "attenuation of the effective height of the road",
        "ENV_C2": "attenuation of the effective slope of the road",
    },
    idle=ALL,
)
PAC2002 = table(
    {
        "IP": "inflation pressure in Adams (Pa)",
        "IP_NOM": "nominal pressure in Adams (Pa)",
        "LIP": "scales the nominal pressure in Adams",
        "LCZ": "scales the vertical stiffness in Adams",
        "QV1": "increase of the radius with speed in Adams",
        "QV2": "increase of the vertical stiffness with speed in Adams",
        "QRE0": "free radius over unloaded radius in Adams",
        "QFZ1": "linear term of load over deflection in Adams",
        "QFZ2": "quadratic term of load over deflection in Adams",
        "QFZ3": "variation of the vertical stiffness with inclination in Adams",
        "QFCX1": "decrease of the vertical stiffness with longitudinal force in Adams",
        "QFCY1": "decrease of the vertical stiffness with lateral force in Adams",
        "QFCG1": "decrease of the vertical stiffness with inclination in Adams",
        "QPFZ1": "variation of the vertical stiffness with pressure in Adams",
        "Q_FZ1": "linear term of load over deflection",
        "Q_FZ3": "decrease of the vertical stiffness with inclination",
        "Q_CAM": "decrease of the vertical stiffness with inclination, before 6.2",
        "MC_CONTOUR_A": "semi-axis of the contour of motorcycle tires",
        "MC_CONTOUR_B": "semi-axis of the contour of motorcycle tires",
        "MFSAFE1": "switch of the fitting tool",
        "MFSAFE2": "switch of the fitting tool",
        "MFSAFE3": "switch of the fitting tool",
        "PTX4": "damping at low speed in Adams",
        "PTY3": "damping at low speed in Adams",
    },
    idle=ALL,
)
FOREIGN = table(
    {
        "QPX1": "variation of the overturning moment with pressure in Adams",
        "QPY1": "variation of the rolling resistance with pressure in Adams",
        "QPZ1": "variation of the peak trail with pressure in Adams",
        "QPZ2": "variation of the peak residual moment with pressure in Adams",
        "LMUV": "decrease of friction with sliding speed",
    }
) | table(
    {
        "LAMU": "decrease of shifts with scaled friction",
        "LKYG": "scales the camber stiffness in Adams",
    },
    default=1.0,
)
IDLE = TURN_SLIP | STRUCTURE | BELT | PAC2002 | FOREIGN
