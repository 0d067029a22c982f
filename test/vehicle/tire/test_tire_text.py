"""Text of tire files as it comes from other programs: read alike, or refused by its line."""

import pytest
from tire_texts import BASE, changed
from vehicle_files import line_of, refused


def behind(line: str, added: str) -> str:
    """The file with lines added behind one."""
    return BASE.replace(f"{line}\n", f"{line}\n{added}\n")


COMMENTS = {
    "dollar": "$ a comment = 3",
    "exclamation": "! a comment = 3",
    "number sign": "# a comment = 3",
    "percent": "% a comment = 3",
    "slashes": "// a comment = 3",
    "indented": "\t  # a comment = 3",
    "rule": "$-----------------------------------------------------------units",
    "blank": "   \t ",
    "end of a DOS file": "\x1a",
}


@pytest.mark.parametrize("kind", COMMENTS)
def test_a_line_that_is_a_comment_is_passed_over(read, base, kind):
    assert read(behind("VXLOW = 1", COMMENTS[kind])) == base


@pytest.mark.parametrize("mark", ["$", "!", "#", "%", "//", " $", "\t! 20 °C, "])
def test_a_comment_behind_a_value_or_a_section_is_passed_over(read, base, mark):
    text = changed({"FNOMIN": f"FNOMIN = 3800{mark} nominal", "TYRESIDE": f"TYRESIDE = Left{mark}"})
    assert read(text.replace("[VERTICAL]", f"[VERTICAL] {mark} load")) == base


BLOCKS = {
    "comments": "(COMMENTS)\n{comment_string}\n'Tire - made up'\n'Pressure = 2 bar'",
    "unquoted": '(COMMENTS)\n{comment_string}\nTire: made up\n"PKY1 = 3"',
    "head with a comment": "(COMMENTS)  $ of the maker\n{text}\nno values here",
    "table": "[SHAPE]\n{radial width}\n 1.0 0.0\n 1.0 0.4 ! end\n 0.9 1.0\n-1.D0 +2.5E+00",
    "curve": "[DEFLECTION_LOAD_CURVE]\n{pen fz}\n0.000 0.0\n0.001 212.0",
}


@pytest.mark.parametrize("kind", BLOCKS)
def test_sub_blocks_and_tables_are_passed_over(read, base, kind):
    assert read(behind("FILE_FORMAT = 'ASCII'", BLOCKS[kind])) == base


def test_a_key_in_a_block_of_comments_is_not_lost(read):
    text = behind("FILE_FORMAT = 'ASCII'", "(COMMENTS)\n{comment_string}\nLMUX = 0.5")
    assert read(text).coefficients["LMUX"] == 0.5


ENCODED = {
    "Windows-1252": BASE.replace("= 3800", "= 3800 $ Prüfstand, 20 °C – „neu“").encode("cp1252"),
    "Windows-1252 in a name": b"! Fran\xe7ois, 100 \x80\n" + BASE.encode(),
    "Latin-1": BASE.replace("small", "größerer").encode("latin-1"),
    "byte order mark": b"\xef\xbb\xbf" + BASE.encode(),
    "line separators": BASE.replace("small", "\u2028 small \x85 \x0c").encode(),
    "CRLF and tabs": BASE.replace(" = ", "\t=\t").replace("\n", "\r\n").encode("utf-8-sig"),
    "CR": BASE.replace("\n", "\r").encode(),
    "CRLF, blanks at the end": BASE.replace("\n", "  \t\r\n").encode(),
    "no line end": BASE.rstrip("\n").encode(),
}


@pytest.mark.parametrize("kind", ENCODED)
def test_encodings_and_line_ends_are_read_alike(read, base, kind):
    assert read(ENCODED[kind]) == base


@pytest.mark.parametrize("content", [b"\x81\x8d" + BASE.encode(), BASE.encode("utf-16")])
def test_another_encoding_is_refused(read, content):
    with refused("some.tir"):
        read(content)


def test_small_letters_are_read_alike(read, base):
    assert read(BASE.lower()) == base
    assert read(BASE.title()) == base


NUMBERS = {
    "D exponent": ("-1.8D+01", ".165D1", "-.6D0", "0.2D4"),
    "small d": ("-1.8d1", "16.5d-1", "-0.6d0", "2.d2"),
    "E exponent": ("-.180000E+02", ".165E+01", "-.6e0", "2E2"),
    "no digit in front": ("-18.", "+1.65", "-.6", "+2.e2"),
    "in quotes": ("'-18'", '"1.65"', "'-0.6'", "'200'"),
}


@pytest.mark.parametrize("kind", NUMBERS)
def test_numbers_in_every_notation_are_the_same(read, base, kind):
    pky1, pcx1, pey1, fzmin = NUMBERS[kind]
    lines = {"PKY1": f"PKY1 = {pky1}", "PCX1": f"PCX1={pcx1}", "PEY1": f"PEY1 ={pey1}"}
    low = fzmin.replace("0.2D4", "0.2D3")
    assert read(changed(lines | {"FZMIN": f"FZMIN= {low}"})) == base


@pytest.mark.parametrize(
    "line",
    [
        "FNOMIN = 3800 [N]  nominal load",
        "FNOMIN = 3800 N",
        "FNOMIN = '3800' N",
        "FNOMIN = 3800, 4000",
        "FNOMIN = 3.800,5",
        "FNOMIN = 3800 4000",
        "FNOMIN = ",
    ],
)
def test_text_behind_a_value_is_refused_with_its_line(read, line):
    text = changed({"FNOMIN": line})
    with refused("some.tir", line_of(text, "FNOMIN"), "FNOMIN", "$ or !"):
        read(text)


@pytest.mark.parametrize("value", ["nan", "NaN", "inf"])
def test_what_is_no_finite_number_is_refused_as_that(read, value):
    text = changed({"FNOMIN": f"FNOMIN = {value}"})
    with refused(line_of(text, "FNOMIN"), f"FNOMIN: '{value}'", "a finite number"):
        read(text)


SAME = ("PEY1 = -0.6", "PEY1 = -.60D0", "PEY1 = -0.6 $ again", "\n[EXTRA]\npey1 = -6e-1")


@pytest.mark.parametrize("line", SAME)
def test_a_key_with_the_same_value_twice_is_read_once(read, base, line):
    assert read(BASE + line + "\n") == base


@pytest.mark.parametrize("section", ["", "[LATERAL_COEFFICIENTS]\n", "[EXTRA]\n"])
def test_a_key_with_two_values_is_refused_with_both_lines(read, section):
    text = BASE + section + "PEY1 = -0.5\n"
    first, second = (n for n, line in enumerate(text.splitlines(), 1) if line.startswith("PEY1"))
    with refused("PEY1", "'-0.6'", "'-0.5'", f"line {first} in", f"line {second} in"):
        read(text)


@pytest.mark.parametrize("line", ["TYRESIDE = 'RIGHT'", "USE_MODE = 4", "FILE_TYPE = 'other'"])
def test_two_values_of_words_and_modes_are_refused_too(read, line):
    text = behind("VXLOW = 1", line)
    with refused(line.split()[0], "given twice"):
        read(text)


def test_two_units_of_a_quantity_are_refused(read):
    with refused("LENGTH", "'meter'", "'mm'"):
        read(behind("TIME = 'second'", "LENGTH = 'mm'"))


@pytest.mark.parametrize("line", ["PKY1 -18", "= 3", "what is this", "1.0 0.4 x", "[VERTICAL"])
def test_a_line_of_no_kind_is_refused_by_its_number(read, line):
    text = behind("VXLOW = 1", line)
    with refused(" line 16:", repr(line)):
        read(text)
