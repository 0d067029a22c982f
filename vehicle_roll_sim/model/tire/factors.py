"""What the equations of a tire use of its coefficients and its inflation pressure alone.

These values are computed once for a tire; in every derivative they would take some 150 operations.
E: as in `magic_formula`.
"""

FACTORS = (
    *("longitudinal_grip", "lateral_grip", "slip_stiffening", "largest_cornering_stiffness"),
    *("cornering_load_growth", "camber_stiffening"),
    *("trail_growth", "camber_moment_growth", "overturning_growth", "stiffness_over_friction"),
    *("per_nominal_load", "per_reference_speed"),
    *("arm_per_force", "resistance_per_force", "resistance_per_load"),
    *("nominal_compression", "longitudinal_carcass_stiffness", "lateral_carcass_stiffness"),
)


def factors_of(coefficients: dict[str, float], pressure_change: float) -> dict[str, float]:
    """The FACTORS of a tire, by name, in SI units.

    coefficients: all COEFFICIENTS. pressure_change: dp, pressure above the nominal one, relative to
    that (-).
    """
    c, dp, nominal = coefficients, pressure_change, coefficients["FNOMIN"]
    largest = c["PKY1"] * c["LFZO"] * nominal * c["LKY"]
    values = (
        above_zero(1 + c["PPX3"] * dp + c["PPX4"] * dp * dp),  # of mux (E13)
        above_zero(1 + c["PPY3"] * dp + c["PPY4"] * dp * dp),  # of muy (E23)
        above_zero(1 + c["PPX1"] * dp + c["PPX2"] * dp * dp),  # of Kx kappa (E15)
        largest * above_zero(1 + c["PPY1"] * dp),  # of the sine in Ky alpha (N/rad; E25)
        1 + c["PPY2"] * dp,  # of the load in that sine
        1 + c["PPY5"] * dp,  # of Kyg0 (E30)
        1 - c["PPZ1"] * dp,  # of Dt (E42)
        1 + c["PPZ2"] * dp,  # of the part of Dr due to inclination (E47)
        1 + c["PPMX1"] * dp,  # of QSX2 (E69)
        ratio(c["LKY"], c["LMUY"]),  # in Bt and Br (E40, E45)
        ratio(1.0, nominal),  # 1/N
        ratio(1.0, c["LONGVL"]),  # s/m
        ratio(c["SSZ2"], nominal),  # s of E76 over R0 (1/N)
        ratio(c["QSY2"], nominal),  # of Fx in E70 (1/N)
        ratio(c["QSY6"], nominal),  # of Fz in E70 (1/N)
        ratio(nominal, c["VERTICAL_STIFFNESS"] * (1 + c["PFZ1"] * dp)),  # m
        c["LONGITUDINAL_STIFFNESS"] * (1 + c["PCFX3"] * dp),  # N/m (A3.9)
        c["LATERAL_STIFFNESS"] * (1 + c["PCFY3"] * dp),  # N/m (A3.10)
    )
    return dict(zip(FACTORS, values, strict=True))


def above_zero(factor: float) -> float:
    """A factor limited to at least 0, so that no force changes sign far from nominal pressure."""
    return factor if factor > 0.0 else 0.0


def ratio(numerator: float, denominator: float) -> float:
    """0 if the denominator is 0: without that coefficient nothing depends on the ratio."""
    return numerator / denominator if denominator != 0.0 else 0.0
