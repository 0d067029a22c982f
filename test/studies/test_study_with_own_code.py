"""Studies with controllers, and with code of the user's own: it counts, and it is not mixed."""

import dataclasses
import json
import math
import shutil
from pathlib import Path

import pytest

from vehicle_roll_sim import ControlLaw, InputError, Vehicle, parameter
from vehicle_roll_sim.control_laws.active_roll_bar import ActiveRollBar
from vehicle_roll_sim.control_laws.catalogue import LAWS
from vehicle_roll_sim.manoeuvres.base import Manoeuvre
from vehicle_roll_sim.manoeuvres.catalogue import STANDARD
from vehicle_roll_sim.studies import folder as folders
from vehicle_roll_sim.studies.driven_again import kept_results
from vehicle_roll_sim.studies.folder import run_study, show_study
from vehicle_roll_sim.studies.quantities import case_of, unit_of
from vehicle_roll_sim.studies.source import Source
from vehicle_roll_sim.studies.study_file import study_of

EXAMPLES = Path(__file__).parents[2] / "examples" / "studies"
LAW = """\
import dataclasses

from vehicle_roll_sim import ControlLaw, parameter


@dataclasses.dataclass(kw_only=True)
class Damper(ControlLaw):
    commands = ("normal_force",)
    damping: float = parameter("force per roll rate", "N s/rad", 0.0, 1e5, default=4000.0)

    def answer(self, sensed):
        force = self.damping * sensed.state["roll_rate"]
        return {"normal_force": [-force, force, -force, force]}


soft = Damper(damping=100.0)
"""
TURN = """\
import dataclasses

import numpy as np

from vehicle_roll_sim.declaration import parameter
from vehicle_roll_sim.manoeuvres.base import OpenLoop


@dataclasses.dataclass(frozen=True, kw_only=True)
class Swing(OpenLoop):
    duration: float = parameter("simulated time", "s", 0.0, 100.0, default=0.5)
    amplitude: float = parameter("road-wheel angle", "deg", -10.0, 10.0, default=3.0)

    def drive(self, times, commands):
        commands["steering"] = np.radians(self.amplitude) * np.sin(6.0 * times)
"""
SPEC = {
    "manoeuvre": "j_turn",
    "controller": "law.py:Damper",
    "factors": {"controller.damping": [0.0, 2000.0]},
}
PARAMETERS = {
    "active_roll_bar": "share",
    "lqr_roll_bar": "front_share",
    "rear_steering": "gain",
    "roll_braking": "horizon",
    "rollover_mpc": "ratio_limit",
    "stability_control": "grip",
    "yaw_control": "grip",
}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The current folder, with a law and a manoeuvre."""
    monkeypatch.chdir(tmp_path)
    Path("law.py").write_text(LAW)
    Path("turn.py").write_text(TURN)
    return tmp_path


def read(**changes):
    return study_of(Source({**SPEC, **changes}))


def test_parameters_of_a_named_law_are_factors():
    factors = {"controller.share": [0.1, 0.5], "vehicle.cg_height": [0.6]}
    study = read(controller="active_roll_bar", factors=factors, fixed={"controller.track": 1.6})
    case = case_of(study, {"controller.share": 0.5, "vehicle.cg_height": 0.6})
    assert case.controller == ActiveRollBar(share=0.5, track=1.6)
    assert unit_of("controller.damping", study) == "N m s/rad"
    assert "code" not in study.identity
    assert PARAMETERS.keys() == LAWS.keys()
    for name, factor in PARAMETERS.items():
        of_law = read(controller=name, factors={f"controller.{factor}": [0.5]})
        law = case_of(of_law, {f"controller.{factor}": 0.5}).controller
        assert law == dataclasses.replace(LAWS[name](), **{factor: 0.5})


def test_parameters_of_a_law_in_a_file_beside_the_study_are_factors(folder):
    (folder / "sub").mkdir()
    shutil.move("law.py", "sub/law.py")
    text = "manoeuvre: j_turn\ncontroller: law.py:Damper\nfactors: {controller.damping: [1, 2]}\n"
    Path("sub/study.yaml").write_text(text)
    study = study_of(Source.of_file("sub/study.yaml"))
    assert case_of(study, {"controller.damping": 2.0}).controller.damping == 2.0
    assert unit_of("controller.damping", study) == "N s/rad"


def test_a_manoeuvre_in_a_file_and_an_object_of_a_file_are_used(folder):
    factors = {"manoeuvre.amplitude": [1.0]}
    study = read(manoeuvre="turn.py:Swing", controller="law.py:soft", factors=factors)
    case = case_of(study, {"manoeuvre.amplitude": 1.0})
    assert (case.manoeuvre.amplitude, case.manoeuvre.duration) == (1.0, 0.5)
    assert case.controller.damping == 100.0


def test_the_definition_of_the_study_has_text_values_and_declarations(folder):
    found = json.loads(json.dumps(read().identity))["code"]["controller"]
    assert (found["class"], found["values"], found["text"]) == ("Damper", {"damping": 4000.0}, LAW)
    declared = found["parameters"]["damping"]
    assert [declared[key] for key in ("unit", "maximum")] == ["N s/rad", 1e5]


@pytest.mark.parametrize(
    ("change", "is_same"),
    [
        (lambda text: text, True),
        (lambda text: text.replace("[-force", "[-2 * force"), False),
        (lambda text: text.replace("1e5", "1e4"), False),
        (lambda text: text + "# a word\n", False),
    ],
)
def test_a_folder_of_other_code_is_refused_and_not_mixed(folder, by_formula, change, is_same):
    run_study(read(), folder / "out", "csv")
    computed = sum(by_formula)
    Path("law.py").write_text(change(LAW))
    if is_same:
        run_study(read(), folder / "out", "csv")
    else:
        before = (folder / "out" / "study.json").read_bytes()
        with pytest.raises(InputError, match="out has the results of another controller: "):
            run_study(read(), folder / "out", "csv")
        with pytest.raises(InputError, match="out has the results of another controller"):
            kept_results(folder / "out", "DIR")
        assert (folder / "out" / "study.json").read_bytes() == before
    assert sum(by_formula) == computed


def test_with_another_law_or_none_it_is_another_study(folder, by_formula):
    run_study(read(factors={"road.bank": [0.0]}), folder / "out", "csv")
    for other in ("active_roll_bar", None):
        with pytest.raises(InputError, match="another value of controller"):
            run_study(read(controller=other, factors={"road.bank": [0.0]}), folder / "out", "csv")


def test_shown_again_the_code_is_neither_needed_nor_executed(folder, by_formula):
    fixed = {"manoeuvre.speed_hold": None}
    study = read(manoeuvre="turn.py:Swing", fixed=fixed)
    report = run_study(study, folder / "out", "csv")
    for name in ("law.py", "turn.py"):
        Path(name).write_text("raise SystemExit(3)")
    assert show_study(folder / "out").summary == report.summary
    assert "controller: law.py:Damper" in report.summary
    assert "speed_hold = adapted to the vehicle" in report.summary


@pytest.mark.parametrize(
    "spoil",
    [
        lambda code: code["controller"].pop("parameters"),
        lambda code: code["controller"]["parameters"]["damping"].pop("unit"),
        lambda code: code["controller"]["parameters"]["damping"].update(kind="complex"),
        lambda code: code.update(controller=3),
    ],
)
def test_a_definition_whose_code_was_changed_is_refused(folder, by_formula, spoil):
    run_study(read(), folder / "out", "csv")
    path = folder / "out" / "study.json"
    content = json.loads(path.read_text())
    spoil(content["code"])
    path.write_text(json.dumps(content))
    with pytest.raises(
        InputError, match=r"controller: its code was changed there: .*study.json as it"
    ):
        show_study(folder / "out")


@pytest.mark.parametrize(
    ("name", "before", "after", "problem"),
    [
        ("active_rol_bar", "", "", "'active_rol_bar' is unknown: did you mean active_roll_bar?"),
        (3, "", "", "controller: 3 is not allowed: one of active_roll_bar, .*, FILE.py:NAME"),
        ("lawn.py:Damper", "", "", "file lawn.py: No such file .*: give the name of an existing"),
        (".py:Damper", "", "", "file .py: No such file"),
        ("law.py:Dampers", "", "", "law.py has no Dampers: FILE.py:NAME, a ControlLaw in this"),
        ("law.py", "", "", "law.py has no NAME given: FILE.py:NAME"),
        ("law.py:dataclasses", "", "", r"it is none: a .*\.ControlLaw, or a class of it"),
        ("law.py:Damper", "def answer(", "def (", "law.py: SyntaxError: .* can be executed"),
        ("law.py:Damper", "import dataclasses\n", "raise SystemExit\n", "law.py: SystemExit"),
        ("law.py:Damper", "1e5, default", "1e5, defaul", "law.py: TypeError: .*defaul"),
        ("law.py:Damper", ", default=4000.0", "", "a class whose parameters all have defaults"),
        ("law.py:Damper", "default=4000.0", "default=-1.0", "damping: -1.0 is not allowed"),
        ("law.py:Damper", "def answer", "def reply", "abstract method '?answer"),
        ("law.py:Damper", "@dataclasses.dataclass(kw_only=True)", "", "@dataclasses.dataclass"),
        (
            "law.py:Damper",
            "import data",
            "from __future__ import annotations\nimport data",
            "texts",
        ),
        ("law.py:Damper", '("normal_force",)', "()", r"its commands are \(\): .* steering, rear_"),
        ("law.py:Damper", '("normal_force",)', '("speed",)', r"its commands are \('speed',\)"),
        ("law.py:Damper", '("normal_force",)', '"steering"', "its commands are 'steering'"),
    ],
)
def test_a_controller_that_cannot_be_used_is_refused_in_one_line(
    folder, name, before, after, problem
):
    text = LAW.partition("\n\n\nsoft")[0] + "\n"
    assert before in text
    Path("law.py").write_text(text.replace(before, after, 1) if before else text)
    with pytest.raises(InputError, match=problem) as refused:
        read(controller=name)
    assert str(refused.value).startswith("study: controller: ")
    assert "\n" not in str(refused.value)


def test_a_controller_that_is_not_named_has_no_parameters():
    with pytest.raises(InputError, match=r"controller\.damping: there is none: a controller to be"):
        read(controller=None)


def test_values_are_validated_by_their_declarations(folder):
    with pytest.raises(InputError, match="damping: 1: -1 is not allowed: a number from 0 to 1"):
        read(factors={"controller.damping": [-1]})


@dataclasses.dataclass(kw_only=True)
class Brake(ControlLaw):
    """A law of a program that makes a study."""

    commands = ("brake_torque",)
    torque: float = parameter("torque", "N m", 0.0, 1e4, default=100.0)

    def answer(self, sensed):
        return {"brake_torque": [self.torque] * 4}


def test_objects_and_classes_of_a_program_are_used_and_count(tmp_path, by_formula):
    given = {"manoeuvre": dataclasses.replace(STANDARD["j_turn"], amplitude=5.0)}
    given["factors"] = {"controller.torque": [0.0, 50.0]}
    study = read(controller=Brake(torque=20.0), **given)
    assert case_of(study, {}).controller.torque == 20.0
    assert case_of(study, {}).manoeuvre.amplitude == 5.0
    assert "class Brake" in study.code["controller"]["text"]
    assert "text" not in study.code["manoeuvre"]
    assert study.said["manoeuvre"] == "a RampAndHold"
    assert case_of(read(controller=Brake, **given), {}).controller.torque == 100.0
    run_study(study, tmp_path, "csv")
    with pytest.raises(InputError, match="the results of another controller"):
        run_study(read(controller=Brake(torque=21.0), **given), tmp_path, "csv")
    other = given | {"manoeuvre": dataclasses.replace(given["manoeuvre"], amplitude=6.0)}
    with pytest.raises(InputError, match="the results of another manoeuvre"):
        run_study(read(controller=Brake(torque=20.0), **other), tmp_path, "csv")


def test_an_object_whose_attributes_cannot_be_kept_is_refused():
    law = Brake()
    law.memory = {3}
    with pytest.raises(InputError, match="'Brake' is not allowed: attributes that are numbers"):
        read(controller=law, factors={"controller.torque": [1.0]})
    with pytest.raises(InputError, match=r"it is none: a .*ControlLaw"):
        read(controller=Vehicle)
    with pytest.raises(InputError, match=f"a {Manoeuvre.__module__}.Manoeuvre"):
        read(manoeuvre=Brake)


def test_the_example_finds_where_a_roll_bar_prevents_the_rollover(tmp_path, monkeypatch):
    """More of the roll moment in the bars never causes a rollover, and the highest c.g. needs more
    than there is."""
    monkeypatch.setattr(folders, "draw", lambda results, path: [])
    report = run_study(study_of(Source.of_file(EXAMPLES / "roll_bar.yaml")), tmp_path, "csv")
    over = {}
    for row in report.results.runs:
        happened = not math.isnan(row["rollover_time"])
        over.setdefault(row["vehicle.cg_height"], []).append(happened)
    assert over == {0.6: [False] * 4, 0.68: [True, True, False, False], 0.76: [True] * 4}
