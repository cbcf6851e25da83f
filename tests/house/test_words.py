"""No Python name is a word that says nothing of what it names."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest
from support import ROOT

PACKAGE = ROOT / "vibroacoustics"
FILES = sorted(PACKAGE.rglob("*.py"))
WORDS = {
    "own", "found", "place", "places", "told", "tell", "heard", "hear", "inside", "whole", "doubt",
}  # fmt: skip
NAMES = ("id", "attr", "arg", "name", "asname", "rest")  # fields of the nodes that hold a name
GIVEN = ("file.tell", "algorithm.tell")  # of the standard library and of pymoo


def _names(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Line and name of everything named, in f-strings too, without leading underscores."""
    for node in ast.walk(tree):
        for field in NAMES:
            name = getattr(node, field, None)
            if isinstance(name, str) and not _is_given(node):
                yield getattr(node, "lineno", 0), name.strip("_").lower()


def _is_given(node: ast.AST) -> bool:
    return (
        isinstance(node, ast.Attribute)
        and node.attr in {name.rpartition(".")[2] for name in GIVEN}
        and ast.unparse(node) in GIVEN
    )


def _faults(path: Path, code: str) -> list[str]:
    faults = [f"{path}:{line}: {name}" for line, name in _names(ast.parse(code)) if name in WORDS]
    return faults + ([f"{path}: {path.stem}"] if path.stem.strip("_") in WORDS else [])


def test_no_name_is_an_empty_word():
    faults = [
        fault
        for path in FILES
        for fault in _faults(path.relative_to(ROOT), path.read_text(encoding="utf-8"))
    ]
    assert not faults, "\n".join(faults)


@pytest.mark.parametrize(
    "code",
    ["own = 1", "def whole(): ...", "def f(place): ...", "f(told=1)", "a.found", "f'{heard}'",
     "lambda inside: 1", "import a as _places", "[1 for own in b]", "class Doubt: ..."],
)  # fmt: skip
def test_the_check_sees_every_kind_of_name(code):
    assert len(_faults(Path("a.py"), code)) == 1


def test_the_check_sees_a_module_and_passes_text_and_files():
    assert _faults(Path("place.py"), "") == ["place.py: place"]
    assert not _faults(Path("a.py"), "'own place'\nmany_places = file.tell()  # inside")
