"""What a study can fix or vary, by names such as `vehicle.cg_height`; and the case of a point."""

import dataclasses
import math
from collections.abc import Mapping

from vehicle_roll_sim.batch.case import Case
from vehicle_roll_sim.declaration import InputError, Parameter, parameters_of, unknown_name
from vehicle_roll_sim.simulation.options import Options, options_for
from vehicle_roll_sim.simulation.road import Road
from vehicle_roll_sim.studies.study import Study
from vehicle_roll_sim.vehicle.masses import Load
from vehicle_roll_sim.vehicle.parameters import Vehicle
from vehicle_roll_sim.vehicle.tire.keys import SIMULATED

TIRES = {"tire": ("front", "rear"), "front_tire": ("front",), "rear_tire": ("rear",)}
"""Sections whose names are coefficients of tire files, and the axles that they concern."""
PAYLOAD, MODEL = "payload", "options.model"
SECTIONS = ("vehicle", *TIRES, PAYLOAD, "road", "manoeuvre", "controller", "options")


def quantity(name: str, driving: Mapping[str, object], field: str) -> Parameter:
    """The declaration of what a name stands for; raises InputError naming `field`.

    driving: as of a Study.
    """
    section, dot, key = name.partition(".")
    if section not in SECTIONS:
        raise unknown_name(section, SECTIONS, field)
    if not dot:
        raise InputError(field, name, f"a section and a name in it, such as {_example(section)}")
    if section == PAYLOAD:
        number, _, key = key.partition(".")
        if not number.isdecimal() or not number.isascii() or not int(number):
            allowed = f"the number of a mass in the vehicle file, such as {_example(section)}"
            raise InputError(field, name, allowed)
        known = parameters_of(Load)
    elif section in TIRES:
        known = {each: _coefficient(each) for each in SIMULATED}
    else:
        declaring = {"vehicle": Vehicle, "road": Road, "options": Options, **driving}[section]
        if declaring is None:
            raise InputError(field, name, "a controller to be named first", "there is none")
        known = parameters_of(declaring)
    if key not in known:
        raise unknown_name(key, known, field)
    return known[key]


def unit_of(name: str, study: Study) -> str:
    """The unit of a quantity that the study has."""
    return quantity(name, study.driving, name).unit


def _example(section: str) -> str:
    examples = {"vehicle": "cg_height", PAYLOAD: "1.mass", "road": "bank", "manoeuvre": "speed"}
    examples["controller"] = "gain"
    return f"{section}.{examples.get(section, 'model' if section == 'options' else 'LMUY')}"


def _coefficient(name: str) -> Parameter:
    """The declaration of a coefficient of a tire file, in SI units and ISO signs."""
    free = (-math.inf, math.inf)
    about = f"coefficient {name} of the tire file"
    return Parameter(name, float, None, "", *free, about, "", (), False, 0, "", ("", 0.0))


def case_of(study: Study, values: Mapping[str, float | str]) -> Case:
    """The run with these values of the factors; raises InputError if they are refused."""
    parts = {section: {} for section in SECTIONS}
    for name, value in {**study.fixed, **values}.items():
        section, _, key = name.partition(".")
        parts[section][key] = value
    road = study.road
    if parts["road"]:
        road = dataclasses.replace(road or Road(), **parts["road"])
    vehicle = _with_tires(_with_payload(study.vehicle, parts[PAYLOAD]), parts)
    if parts["vehicle"]:
        vehicle = vehicle.with_values(parts["vehicle"])
    return Case(
        vehicle=vehicle,
        manoeuvre=study.manoeuvre.with_values(parts["manoeuvre"]),
        controller=study.controller
        and dataclasses.replace(study.controller, **parts["controller"]),
        options=options_for(vehicle, **parts["options"]),
        road=road,
        step=study.settings.step,
        rollover_angle=math.radians(study.settings.stop_roll),
    )


def _with_payload(vehicle: Vehicle, values: Mapping[str, float]) -> Vehicle:
    """values: by number of the mass and its parameter, such as `1.mass`."""
    if not values:
        return vehicle
    loads = list(vehicle.payload)
    for name, value in values.items():
        number, _, key = name.partition(".")
        loads[int(number) - 1] = dataclasses.replace(loads[int(number) - 1], **{key: value})
    others = vehicle.not_numbers | {"payload": tuple(loads)}
    return Vehicle.checked(vehicle.given, **others)


def _with_tires(vehicle: Vehicle, parts: Mapping[str, Mapping[str, float]]) -> Vehicle:
    if not any(parts[section] for section in TIRES):
        return vehicle
    tires = dict(vehicle.axle_tires)
    for section, axles in TIRES.items():
        for axle in axles:
            tires[axle] = tires[axle].with_coefficients(**parts[section])
    others = {"tire": None, **{f"{axle}_tire": tire for axle, tire in tires.items()}}
    return Vehicle.checked(vehicle.given, **vehicle.not_numbers | others)
