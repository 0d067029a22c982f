"""The version of a tire file: what it says, what its coefficients say, and contradictions."""

import pytest
from tire_texts import BASE, BASE_6_1, changed
from vehicle_files import line_of, refused

FORMAT = "PROPERTY_FILE_FORMAT"
FITTED = {
    "5.2": ["5", "6", "51", "52", "6.", "6.0", "52.0", "'6'", '"52"', "5.2", "+6"],
    "6.1": ["60", "61", "61.", "61.00", "'61'", "6.1", "6.1E1"],
    "6.2": ["62", "62.", "62.0", "'62'", "6.2"],
}
CASES = [(version, text) for version, texts in FITTED.items() for text in texts]


def of(version: str) -> str:
    """A file without FITTYP and format that could be of this version."""
    return changed({FORMAT: ""}) if version == "5.2" else changed({"FITTYP": ""}, BASE_6_1)


def with_line(text: str, line: str) -> str:
    return text.replace("[MODEL]\n", f"[MODEL]\n{line}\n")


@pytest.mark.parametrize(("version", "fittyp"), CASES)
def test_fittyp_says_the_version(read, version, fittyp):
    tire = read(with_line(of(version), f"FITTYP = {fittyp}"))
    assert tire.version == version
    assert tire.notes[0].startswith(f"Magic Formula {version}: FITTYP = ")


@pytest.mark.parametrize("format", ["USER", "MF-TYRE", "MF_SWIFT", "mf-swift", "MFTYRE"])
@pytest.mark.parametrize(("version", "fittyp"), [("5.2", "6"), ("6.1", "61"), ("6.2", "62")])
def test_formats_of_no_version_leave_it_to_fittyp(read, format, version, fittyp):
    lines = f"{FORMAT} = '{format}'\nUSER_SUB_ID = 815\nN_TIRE_STATES = 4\nFITTYP = {fittyp}"
    assert read(with_line(of(version), lines)).version == version


FORMATS = {
    "PAC2002": "5.2",
    "MF_05": "5.2",
    "MF52": "5.2",
    "MF-5.2": "5.2",
    "MF61": "6.1",
    "MF_6.1": "6.1",
    "mf_62": "6.2",
    "MF-Tyre 5.2": "5.2",
    "MF-TYRE_61": "6.1",
    "MF-Swift 6.2": "6.2",
}


@pytest.mark.parametrize("format", FORMATS)
def test_a_format_of_one_version_says_it(read, format):
    version = FORMATS[format]
    tire = read(with_line(of(version), f"{FORMAT} = '{format}'"))
    assert tire.version == version
    assert FORMAT in tire.notes[0]


@pytest.mark.parametrize(
    "format", ["FTIRE", "PAC89", "PAC_MC", "MF-MCTYRE", "MF_63", "", "6.1", "FIALA"]
)
def test_another_kind_of_tire_model_is_refused(read, format):
    text = with_line(of("5.2"), f"{FORMAT} = '{format}'")
    with refused(line_of(text, FORMAT), FORMAT, repr(format), "PAC2002"):
        read(text)


@pytest.mark.parametrize("fittyp", ["21", "7", "63", "0", "-6", "6.5", "many", "", "5.3"])
def test_a_fittyp_of_no_version_is_refused(read, fittyp):
    text = with_line(of("5.2"), f"FITTYP = {fittyp}")
    with refused(line_of(text, "FITTYP"), "FITTYP", repr(fittyp), "5.0 to 5.2", "62 (6.2)"):
        read(text)


@pytest.mark.parametrize("format", ["MF_SWIFT", "USER", "MF-TYRE"])
def test_a_file_of_swift_1_is_refused_with_a_word_on_its_version(read, format):
    text = with_line(of("5.2"), f"{FORMAT} = '{format}'\nFITTYP = 21")
    with refused(line_of(text, "FITTYP"), "MF-Swift", "5.2", "FITTYP = 52"):
        read(text)


@pytest.mark.parametrize(
    ("format", "fittyp"), [("PAC2002", "61"), ("MF61", "6"), ("MF62", "61"), ("MF_05", "62")]
)
def test_a_format_and_a_fittyp_that_contradict_are_refused(read, format, fittyp):
    text = with_line(of("5.2"), f"{FORMAT} = '{format}'\nFITTYP = {fittyp}")
    with refused("some.tir", "FITTYP", FORMAT, repr(fittyp), "version"):
        read(text)


OF_ONE = {
    "5.2": ["PHY3 = 0.03", "LGAY = 0.5", "PTX1 = 2.3", "LSGAL = 1", "PTY2 = 0"],
    "6.1": ["PKY4 = 1.5", "PKY6 = -1", "PPX1 = -0.8", "RBY4 = 2", "QDZ10 = 0.3", "PKY4 = 2"],
    "6.2": ["Q_CAM1 = 50", "Q_FYS1 = -22000", "Q_FCY2 = -0.4"],
}


@pytest.mark.parametrize("format", ["", "USER", "MF-TYRE"])
@pytest.mark.parametrize(("version", "line"), [(v, x) for v, xs in OF_ONE.items() for x in xs])
def test_without_fittyp_coefficients_of_one_version_say_it(read, format, version, line):
    text = changed({FORMAT: f"{FORMAT} = '{format}'" if format else ""}) + line + "\n"
    tire = read(text)
    assert tire.version == version
    assert "FITTYP is not given" in tire.notes[0]
    assert line in tire.notes[0]


@pytest.mark.parametrize("format", ["MF-TYRE", "MF_SWIFT"])
def test_a_file_of_mf_tyre_without_anything_of_version_6_is_5_2(read, format):
    tire = read(with_line(of("5.2"), f"{FORMAT} = '{format}'"))
    assert tire.version == "5.2"
    assert "FITTYP is not given" in tire.notes[0]


@pytest.mark.parametrize("line", ["", "PROPERTY_FILE_FORMAT = 'USER'", "PKY4 = 2\nPHY3 = 0"])
def test_a_file_that_says_nothing_of_its_version_is_refused(read, line):
    with refused("some.tir", "FITTYP or PROPERTY_FILE_FORMAT"):
        read(with_line(of("5.2"), line))


@pytest.mark.parametrize("lines", ["PKY4 = 1.5\nPHY3 = 0.1", "Q_CAM1 = 50\nPTX1 = 2"])
def test_coefficients_of_two_versions_in_one_file_are_refused(read, lines):
    one, other = (line.split()[0] for line in lines.splitlines())
    with refused("some.tir", one, other, "to version 6"):
        read(of("5.2") + lines + "\n")


FOREIGN = [
    ("6", "PKY4 = 1.5"),
    ("6", "PPX1 = 0.1"),
    ("52", "LKYC = 0.9"),
    ("52", "Q_CAM1 = 3"),
    ("52", "QSY7 = 0.85"),
    ("61", "PHY3 = 0.1"),
    ("61", "LGAY = 0.5"),
    ("61", "PTX1 = 2.3"),
    ("61", "Q_FYS1 = -2e4"),
    ("62", "LSGAL = 0.5"),
    ("62", "LMUV = 0.1"),
    ("52", "QPZ1 = 0.1"),
]


@pytest.mark.parametrize(("fittyp", "line"), FOREIGN)
def test_a_coefficient_of_another_version_is_refused(read, fittyp, line):
    key, _, value = line.partition(" = ")
    text = with_line(of("5.2"), f"FITTYP = {fittyp}") + line + "\n"
    with refused(line_of(text, key), key, value, "has no effect", f"FITTYP = {fittyp}"):
        read(text)


NEUTRAL = [
    ("6", "PKY4 = 2\nPKY6 = 0\nPEY5 = 0.0\nRBX3 = 0\nLKYC = 1\nQSY7 = 1\nQSY8 = 0\nLMUV = 0"),
    ("6", "QSY5 = 0\nQSY6 = 0\nQSY7 = 0\nQSX12 = 0\nPPX1 = 0\nQ_CAM1 = 0"),
    ("61", "PHY3 = 0\nLGAX = 1\nPTX1 = 0\nPTY2 = 0\nLSGKP = 1\nQ_FYS3 = 0\nLAMU = 1"),
]


@pytest.mark.parametrize(("fittyp", "lines"), NEUTRAL)
def test_a_coefficient_of_another_version_that_has_no_effect_passes(read, fittyp, lines):
    text = with_line(of("5.2"), f"FITTYP = {fittyp}")
    assert read(text + lines + "\n").coefficients == read(text).coefficients


def test_pressure_terms_of_pac2002_pass_at_the_nominal_pressure_alone(read, base):
    terms = "PPX1 = -0.3\nPPY1 = 0.4\nQPZ1 = 0.1\n"
    for pressures in ("", "IP = 2e5\nIP_NOM = 200000\n", "IP = 1.8e5\nIP_NOM = 2e5\nLIP = 0.9\n"):
        tire = read(BASE + terms + pressures)
        assert tire.coefficients == base.coefficients
        assert any("PPX1, PPY1, QPZ1" in note for note in tire.notes)
    text = BASE + terms + "[TIRE_CONDITIONS]\nIP = 180000\nIP_NOM = 200000\n"
    with refused(line_of(text, "IP ="), "180000", "IP_NOM = 200000", "PPX1"):
        read(text)


def test_without_a_nominal_pressure_its_terms_have_no_effect_and_that_is_noted(read):
    tire = read(changed({"NOMPRES": ""}, BASE_6_1))
    assert any("warning: NOMPRES is not given" in note for note in tire.notes)
    assert tire.record()["pressure_change"][0] == 0.0
    nominal = read(changed({"INFLPRES": ""}, BASE_6_1))
    assert nominal.record()["pressure_change"][0] == 0.0
    assert read(BASE_6_1).record()["pressure_change"][0] == pytest.approx(0.1)


@pytest.mark.parametrize("line", ["INFLPRES = 2.2", "INFLPRES = 1e-300", "INFLPRES = 9e14"])
def test_a_pressure_that_no_tire_has_is_refused(read, line):
    """2.2 is likely to be in bar."""
    text = changed({"INFLPRES": line}, BASE_6_1)
    with refused(line_of(text, "INFLPRES"), "INFLPRES", "Pa", "times NOMPRES"):
        read(text)


@pytest.mark.parametrize("key", ["QSY7", "QSY8"])
def test_a_power_that_no_tire_has_is_refused(read, key):
    text = BASE_6_1 + f"{key} = 1e6\n"
    with refused(line_of(text, key), key, "-20 to 20"):
        read(text)
