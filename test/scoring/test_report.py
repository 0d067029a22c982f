"""The report: the same bytes again, self-contained, its files and links there."""

import csv
import html.parser
import re
import shutil

import pytest
from scored import brake, make_setup, scored

from vehicle_roll_sim.command_line.main import main
from vehicle_roll_sim.scoring import blocks
from vehicle_roll_sim.scoring.plan import Ladder
from vehicle_roll_sim.scoring.report import PAGE, RUNS, TEXT, Report, worst_of, write_report
from vehicle_roll_sim.scoring.results import Score

pytest.importorskip("rosbags", reason="the bag of the worst run needs the library rosbags")
from vehicle_roll_sim.bags.reading import last_run

LADDERS = (
    Ladder("fishhook", "nominal", "left", (30.0, 45.0)),
    Ladder("step", "nominal", "left", (100.0,)),
)
ODD = "mine <script> & co"
VERSIONS = {"vehicle_roll_sim": "1.2.3"}


@pytest.fixture(scope="module")
def report() -> Report:
    setup, kept = make_setup(), {}
    score = scored(ODD, LADDERS, setup, brake(1500.0), kept)
    ladder, level = score.worst
    worst = worst_of(ladder, level, setup, kept[ladder.name(level)])
    scores = [score, Score("broken", (), "broken ended with status 1: KeyError: 'x'")]
    return Report(
        setup, scores, {ODD: "mine.py", "broken": "broken.py"}, VERSIONS, {ODD: worst}, True
    )


@pytest.fixture(scope="module")
def folder(report, tmp_path_factory):
    path = tmp_path_factory.mktemp("report")
    write_report(report, path)
    return path


def files_of(folder) -> dict[str, bytes]:
    files = (each for each in folder.rglob("*") if each.is_file())
    return {str(each.relative_to(folder)): each.read_bytes() for each in files}


def test_repeated_over_an_earlier_one_it_is_the_same_bytes(report, folder, tmp_path):
    again = tmp_path / "again"
    shutil.copytree(folder, again)
    for damaged in again.rglob("*"):
        if damaged.is_file():
            damaged.write_bytes(b"old")
    write_report(report, again)
    assert files_of(again) == files_of(folder)


class Page(html.parser.HTMLParser):
    """What a page has: tags, and addresses that it refers to."""

    def __init__(self, text: str):
        super().__init__()
        self.tags, self.addresses, self.texts = [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        self.addresses += [value for name, value in attrs if name in ("src", "href")]

    def handle_data(self, data):
        self.texts.append(data)


def test_the_page_contains_its_figures_and_executes_nothing(folder):
    page = Page((folder / PAGE).read_text(encoding="utf-8"))
    assert "script" not in page.tags
    assert page.tags.count("img") == 2
    pictures = [each for each in page.addresses if each.startswith("data:image/svg+xml;base64,")]
    others = [each for each in page.addresses if each not in pictures]
    assert len(pictures) == 2
    assert others
    assert all((folder / each).is_file() for each in others)
    assert any(ODD in text for text in page.texts)


def test_links_and_figures_of_the_text_are_there_and_its_tables_are_whole(folder):
    text = (folder / TEXT).read_text(encoding="utf-8")
    targets = re.findall(r"\]\(([^)]+)\)", text)
    assert len(targets) == 4
    assert all((folder / each).is_file() for each in targets)
    for lines in re.findall(r"(?:^\|.*\n)+", text, re.MULTILINE):
        widths = {len(re.findall(r"(?<!\\)\|", line)) for line in lines.splitlines()}
        assert len(widths) == 1, lines
    assert "not scored: broken ended with status 1" in text


def test_the_table_of_runs_has_a_row_for_each_in_si_units(report, folder):
    with (folder / RUNS).open() as file:
        rows = list(csv.DictReader(file))
    without = [row for row in rows if row["controller"] == "without"]
    found = [row for row in rows if row["controller"] == ODD]
    assert len(without) == sum(len(each.levels) for each in LADDERS)
    assert len(found) == len(list(report.scores[0].runs()))
    assert {float(row["brake_torque"]) for row in found} == {1500.0}
    assert {row["distance"] for row in without} == {""}
    for row in found:
        assert float(row["peak_roll"]) < 1.6  # rad


def test_the_bag_of_the_worst_run_is_repeated_to_the_bit(report, folder):
    (bag,) = (each for each in folder.iterdir() if each.is_dir())
    history, _ = last_run(bag)
    (worst,) = report.worst.values()
    assert history["roll"].tolist() == worst.found.history["roll"].tolist()
    assert history.command("brake_torque")[-1, 1] == 1500.0
    assert main(["replay", str(bag), "--strict"]) == 0


def test_texts_are_escaped_in_both_forms():
    odd = [blocks.Text("a <b> | *c* `d_e`"), blocks.Points(["[x](y)"]), blocks.Heading("# 1")]
    text = blocks.as_markdown("t", odd)
    assert r"a \<b> \| \*c\* `d_e`" in text
    assert r"- \[x\](y)" in text
    assert r"| `a\|b` | c_d |" in blocks.as_markdown("t", [blocks.Table(["`a|b`", "c_d"], [])])
    page = blocks.as_page("</title><script>", odd, None)
    assert "<b>" not in page
    assert "<code>d_e</code>" in page
    assert "script" not in Page(page).tags
