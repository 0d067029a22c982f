"""The files for contributors are valid and agree with the rest of the repository."""

import json
import re
import subprocess
from pathlib import Path
from xml.etree import ElementTree

import pytest
import yaml
from patience import PATIENCE

PAGES = ("CONTRIBUTING.md", "SECURITY.md", ".github/PULL_REQUEST_TEMPLATE.md")
FORMS = (".github/ISSUE_TEMPLATE/bug.yml", ".github/ISSUE_TEMPLATE/feature.yml")
WORKFLOW = ".github/workflows/ci.yml"
LINK = re.compile(r"\]\(([^)#:]+)\)")
TARGET = re.compile(r"^([a-z][a-z-]*):", re.MULTILINE)
NAMED_TARGET = re.compile(r"`make ([a-z-]+)")
EXAMPLE = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)
TEST_FILE = re.compile(r"\btest/[\w/]+\.py\b")
FIVE = ["make setup", "make test-quick", "make docs", "make lint", ".ci/run"]
SOURCE = {"volume": 45, "issue": 3, "start": 191, "end": 216, "year": 2007}
"""Of the paper that the model is from."""


@pytest.fixture(scope="module")
def text(root):
    """text(name): what a file of the checkout says."""
    return lambda name: (root / name).read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def manifest(root) -> ElementTree.Element:
    return ElementTree.parse(root / "package.xml").getroot()


@pytest.fixture(scope="module")
def workflow(text) -> dict:
    return yaml.safe_load(text(WORKFLOW))


@pytest.mark.parametrize("page", PAGES)
def test_links_lead_to_files_of_the_checkout(text, root, page):
    for link in LINK.findall(text(page)):
        assert (root / page).parent.joinpath(link).exists(), link


@pytest.mark.parametrize("page", PAGES)
def test_every_command_of_make_that_is_named_is_there(text, page):
    assert {*NAMED_TARGET.findall(text(page))} <= {*TARGET.findall(text("Makefile"))}


def test_the_five_commands_are_told_of_and_ci_is_a_program(text, root):
    rows = re.findall(r"^\| `(.+?)` \|", text("CONTRIBUTING.md"), re.MULTILINE)
    assert rows == FIVE
    assert (root / ".ci" / "run").stat().st_mode & 0o111


def test_the_example_of_a_name_is_that_of_a_test(text, root):
    (name,) = re.findall(r"`(test_\w+)`", text("CONTRIBUTING.md"))
    files = (root / "test").rglob("test_*.py")
    assert any(f"def {name}(" in path.read_text(encoding="utf-8") for path in files)


@pytest.mark.parametrize("number", [0, 1])
def test_an_example_of_style_is_a_part_of_the_package(text, sources, number):
    examples = EXAMPLE.findall(text("CONTRIBUTING.md"))
    assert len(examples) == 2
    assert any(examples[number] in source for source in sources.values())


@pytest.mark.parametrize("form", FORMS)
def test_a_form_for_issues_asks_under_names_of_its_own(text, form):
    read = yaml.safe_load(text(form))
    assert {"name", "description", "body"} <= read.keys()
    asked = [part for part in read["body"] if part["type"] != "markdown"]
    assert all(part["attributes"]["label"] for part in asked)
    assert len({part["id"] for part in asked}) == len(asked) >= 3
    assert any(part.get("validations", {}).get("required") for part in asked)


def test_the_workflow_runs_what_a_contributor_runs_with_the_least_rights(workflow):
    assert workflow["permissions"] == {"contents": "read"}
    ((_, job),) = workflow["jobs"].items()
    assert [step["run"] for step in job["steps"] if "run" in step] == [".ci/run"]
    assert all("@" in step["uses"] for step in job["steps"] if "uses" in step)
    assert {"push", "pull_request"} == workflow[True].keys()  # YAML 1.1 reads `on` as true


def test_the_workflow_has_the_python_that_the_package_begins_with(workflow, text):
    oldest = re.search(r'python_requires=">=([\d.]+)"', text("setup.py")).group(1)
    ((_, job),) = workflow["jobs"].items()
    versions = [step["with"].get("python-version") for step in job["steps"] if "with" in step]
    assert oldest in versions
    assert f"Python {oldest}" in text("CONTRIBUTING.md")


def test_the_hook_runs_the_linter_of_ci_and_states_no_version(text):
    (repository,) = yaml.safe_load(text(".pre-commit-config.yaml"))["repos"]
    assert repository["repo"] == "local"
    assert [hook["entry"] for hook in repository["hooks"]] == ["make lint"]
    assert "make lint\n" in text(".ci/run")


def test_every_test_file_that_make_and_the_guide_name_is_there(text, root):
    """A file that was moved would otherwise be noticed by the last step of CI."""
    command = ["make", "--dry-run", "oldest", "soak", "kilted"]
    result = subprocess.run(
        command, cwd=root, capture_output=True, text=True, timeout=PATIENCE, check=True
    )
    named = [{*TEST_FILE.findall(each)} for each in (text("CONTRIBUTING.md"), result.stdout)]
    assert all(named)
    assert not [name for name in set.union(*named) if not Path(root, name).exists()]


def test_the_citation_is_of_this_version_and_of_the_paper(text, manifest):
    citation = yaml.safe_load(text("CITATION.cff"))
    assert citation["cff-version"] == "1.2.0"
    assert citation["title"] == manifest.findtext("name")
    assert citation["version"] == manifest.findtext("version")
    assert citation["license"] == manifest.findtext("license")
    assert [author["name"] for author in citation["authors"]] == [manifest.findtext("author")]
    (paper,) = citation["references"]
    assert {name: paper[name] for name in SOURCE} == SOURCE
    assert re.fullmatch(r"10\.\d{4,}/\S+", paper["doi"])


def test_placeholders_for_addresses_are_called_that(text, manifest):
    """Nobody should wait for an answer from an address that is not read."""
    addresses = [manifest.find("maintainer").get("email"), *(u.text for u in manifest.iter("url"))]
    are_called_that = "placeholders at example.org" in " ".join(text("SECURITY.md").split())
    assert {"example.org" in address for address in addresses} == {are_called_that}


def test_the_container_builds_from_the_manifest_and_the_pinned_versions(text, root):
    settings = json.loads(text(".devcontainer/devcontainer.json"))
    assert settings["build"] == {"dockerfile": "Dockerfile", "context": ".."}
    dockerfile = text(".devcontainer/Dockerfile")
    copied = re.findall(r"^COPY (\S+) ", dockerfile, re.MULTILINE)
    assert copied == ["package.xml", "requirements/base.txt"]
    of_pip = re.search(r"'\^\((.+?)\)=='", dockerfile).group(1).split("|")
    pinned = re.findall(r"^(\w+)==", text("requirements/base.txt"), re.MULTILINE)
    assert {*of_pip} <= {*pinned}
    assert settings["remoteUser"] == re.search(r"^USER (\w+)", dockerfile, re.MULTILINE).group(1)
