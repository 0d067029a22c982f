"""Terms of the tires that depend on load, inclination and inflation pressure only.

They precede slip, since relaxation lengths and forces share them.
"""

from vehicle_roll_sim.model.compiled.elementary import exponential
from vehicle_roll_sim.model.compiled.jit import kernel, math
from vehicle_roll_sim.model.records import LR, WHEEL_COUNT
from vehicle_roll_sim.model.tire import pure_slip
from vehicle_roll_sim.model.tire.coefficients import all_tire_constants
from vehicle_roll_sim.model.tire.moments import load_power
from vehicle_roll_sim.model.tire.radii import rolling_depth


@kernel
def terms_of_loads(tires, outputs):
    """From normal load and inclination of every wheel; tires: a TIRES record."""
    terms_of_load(tires.front, 0, outputs)
    if tires.front.shared == 0.0:
        terms_of_load(tires.rear, LR, outputs)


@kernel
def terms_of_load(tire, first, outputs):
    """Those of one kind of tire, at the wheels from `first` on.

    One loop: a short one would not be vectorized. Plain tires need exp(PKX3 dfz) only, and the
    depth of a rolling radius of their own.
    """
    if tire.plain != 0.0:
        for i in range(first, WHEEL_COUNT):
            dfz = pure_slip.relative_load(outputs.normal_force[i], tire)
            outputs.tire_terms.stiffening[i] = math.exp(tire.PKX3 * dfz)
            if tire.rolls_on_own_radius != 0.0:
                outputs.tire_terms.rolling_depth[i] = rolling_depth(outputs.normal_force[i], tire)
        return
    if tire.PKY5 != 0.0:
        complete_terms(tire, first, True, outputs)
    else:
        complete_terms(tire, first, None, outputs)


@kernel
def complete_terms(tire, first, wave_inclines, outputs):
    """Those of a tire that is not plain. wave_inclines: None if PKY5 is 0."""
    terms, tire = outputs.tire_terms, all_tire_constants(tire)
    for i in range(WHEEL_COUNT):
        mine, fz, gamma = i >= first, outputs.normal_force[i], outputs.inclination[i]
        dfz = pure_slip.relative_load(fz, tire)
        along = pure_slip.slip_stiffness(0.0, fz, dfz, exponential(tire.PKX3 * dfz), tire)
        wave = pure_slip.cornering_wave(0.0, fz, tire)
        across = pure_slip.upright_stiffness_of_wave(wave, tire)
        power = load_power(fz, tire)
        depth = rolling_depth(fz, tire)
        if wave_inclines is not None:
            wave = pure_slip.cornering_wave(gamma, fz, tire)
        terms.relative_load[i] = dfz if mine else terms.relative_load[i]
        terms.slip_stiffness[i] = along if mine else terms.slip_stiffness[i]
        terms.cornering_wave[i] = wave if mine else terms.cornering_wave[i]
        terms.upright_stiffness[i] = across if mine else terms.upright_stiffness[i]
        terms.load_power[i] = power if mine else terms.load_power[i]
        terms.rolling_depth[i] = depth if mine else terms.rolling_depth[i]
