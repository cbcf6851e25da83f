"""Pages of the site that are made from the code hold all of it; links of the others lead on."""

import re
import sys
import tomllib

import pytest
import typer
from support import ROOT

import vibroacoustics
from vibroacoustics.base.vocabulary import COORDINATES, VARIABLES
from vibroacoustics.commands import cli
from vibroacoustics.machine.machine import MACHINES
from vibroacoustics.machine.option import OPTIONS
from vibroacoustics.machine.source import SOURCES
from vibroacoustics.results.claim_kinds import KINDS, UNCONDITIONAL
from vibroacoustics.results.claims import claims
from vibroacoustics.study.criterion import CRITERIA

DOCS = ROOT / "docs"
MADE = {"generated/" + name for name in (
    "vocabulary.md", "command_line.md", "registered.md", "errors.md", "evidence.md", "changelog.md",
    "contributing.md", "layers.svg", "claims.md",
)} | {"examples/index", "examples/balancer_of_your_own"}  # fmt: skip
PAGES = sorted([*DOCS.glob("*.md"), *DOCS.glob("machines/*.md")])


@pytest.fixture(scope="module", autouse=True)
def _generators():
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(DOCS))
        yield
    for name in [name for name in sys.modules if name.partition(".")[0] == "generators"]:
        del sys.modules[name]


def test_vocabulary_has_every_variable_with_unit_and_maker():
    from generators import vocabulary

    page = vocabulary.page()
    for name, one in [*VARIABLES.items(), *COORDINATES.items()]:
        (line, *_) = re.findall(rf"^\| `{name}` \|.*$", page, re.MULTILINE)
        assert f"| {one.units} |" in line, name
        assert one.long_name in line, name
    without = [name for name in VARIABLES if not vocabulary.makers_of(name)]
    assert len(without) < 0.05 * len(VARIABLES), without


def test_pictures_that_are_missing_are_told(tmp_path):
    from generators import pictures

    (tmp_path / "there.svg").touch()
    page = '<img alt="a" src="there.svg"/><img src="../gone.png" width="3"><img src="data:x">'
    (tmp_path / "page.html").write_text(page, encoding="utf-8")
    assert pictures.missing(tmp_path) == ["page.html: no picture ../gone.png"]


def test_command_line_has_every_option():
    from generators import command_line

    page = command_line.page()
    for name, command in typer.main.get_command(cli.app).commands.items():
        assert f"## `{name}`" in page
        for parameter in command.params:
            assert parameter.opts[0] in page or parameter.metavar in page, parameter.name


def test_registered_kinds_are_listed():
    from generators import registered

    page = registered.page()
    for registry in (MACHINES, OPTIONS, SOURCES, CRITERIA):
        for name in registry:
            assert f"| `{name}` |" in page, name


def test_page_of_claims_has_every_command_and_every_condition():
    """What a command states is compared with this list in test_grammar.py."""
    from generators import claims as page_of_claims
    from generators import tables

    page = page_of_claims.page()
    commands = set(typer.main.get_command(cli.app).commands)
    conditional = {name for kind in KINDS for name in kind.commands}
    assert conditional | set(UNCONDITIONAL) == commands
    assert not conditional & set(UNCONDITIONAL)
    for kind in KINDS:
        named = ", ".join(f"`{name}`" for name in kind.commands)
        for each in kind.conditions:
            row = f"| {named} | {kind.name} | {each.name} | {tables.cell(each.needed)} |"
            assert f"\n{row} {each.effect} |" in page
    assert all(f"\n| `{name}` |" in page for name in UNCONDITIONAL)


def test_page_of_evidence_has_every_claim_and_every_known_miss():
    from generators import evidence, tables

    page = evidence.page()
    assert all(f"\n| {tables.cell(claim.what)} |" in page for claim in claims())
    assert all(claim.reason in page for claim in claims())
    assert all(f"\n| {row['fact']} | {row['source']} |" in page for row in evidence.trends())
    numbers = [page.count(f" | {kind} | `test_") for kind in evidence.KINDS]
    assert sum(numbers) == len(claims())
    assert len({claim.kind for claim in claims()} - set(evidence.KINDS)) == 0


def test_every_class_of_error_has_an_example_that_raises_it():
    from generators import errors

    assert set(errors.EXAMPLES) == set(errors.classes())
    page = errors.page()
    assert "fast.toml: operation: speed_rpm = 90000 rpm" in page
    assert page.count("error: ") == len(errors.EXAMPLES)


def test_picture_has_every_room_of_the_contract():
    from generators import layers

    picture = layers.picture()
    rooms = [room for line in layers.layers() for room in line]
    folders = {path.parent.name for path in (ROOT / "vibroacoustics").glob("*/__init__.py")}
    assert folders <= set(rooms)
    for room in rooms:
        assert f">{room}</text>" in picture


def test_public_names_are_on_the_page_of_them():
    from generators import api

    page = api.page()
    for name in vibroacoustics.__all__:
        assert re.search(rf"^(\.\. auto\w+:: )?{name}$", page, re.MULTILINE), name


def test_docstrings_keep_signs_and_examples():
    from generators.docstrings import readable

    lines = ["Size |x|.", "", "Parameters", "----------", "a : N, a*b", "", ">>> 2 ** 3", "8"]
    assert readable(lines) == [
        "Size \\|x\\|.", "", "Parameters", "----------", "a", "    N, a\\*b", "", ">>> 2 ** 3", "8",
    ]  # fmt: skip


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_links_lead_somewhere(page):
    for target in re.findall(r"\]\(([^)#:\s]+)(?:#[^)]*)?\)", page.read_text(encoding="utf-8")):
        file = (page.parent / target).resolve()
        assert file.exists() or str(file.relative_to(ROOT / "docs")) in MADE, target


def test_version_is_one():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert f"\nversion: {project['version']}\n" in (ROOT / "CITATION.cff").read_text()
    assert f"\n## {project['version']} (" in (ROOT / "CHANGELOG.md").read_text()


def test_readme_says_what_it_is_for_at_once():
    first = " ".join((ROOT / "README.md").read_text().split("\n\n")[1].split())
    for words in ("noise prediction reports", "order spectra", "scores solutions automatically"):
        assert words in first
