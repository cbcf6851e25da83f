"""Stages and pipeline join rooms: they are short and calculate nothing."""

import ast

import pytest
from support import ROOT

from vibroacoustics.base.patterns import is_among
from vibroacoustics.base.vocabulary import VARIABLES
from vibroacoustics.stages.stage import EVERYTHING, STAGES

FILES = sorted(
    file
    for room in ("pipeline", "stages")
    for file in (ROOT / "vibroacoustics" / room).glob("*.py")
)
MOST_LINES = 2250
MOST_LINES_OF_FUNCTION = 40
ARITHMETIC = (ast.Mult, ast.Div, ast.FloorDiv, ast.Mod, ast.Pow, ast.MatMult)


def calculations(text: str) -> list[int]:
    """Lines with products, quotients, powers or numpy."""
    lines = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.BinOp | ast.AugAssign) and isinstance(node.op, ARITHMETIC):
            lines.append(node.lineno)
        if isinstance(node, ast.Import | ast.ImportFrom):
            names = [alias.name for alias in node.names] + [getattr(node, "module", None) or ""]
            lines += [node.lineno for name in names if name.split(".")[0] in ("numpy", "scipy")]
    return lines


def long_functions(text: str) -> list[str]:
    """Functions longer than allowed."""
    return [
        node.name
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.FunctionDef)
        and node.end_lineno - node.lineno >= MOST_LINES_OF_FUNCTION
    ]


@pytest.mark.parametrize(
    "text",
    ["a * b", "a /= b", "a ** 2", "a @ b", "import numpy as np", "from numpy.linalg import norm"],
)
def test_calculations_are_found(text: str) -> None:
    assert calculations(text) == [1]
    assert calculations("@register\ndef f(*a: int | None, **b): return {*a, *b}") == []


def test_a_long_function_is_found() -> None:
    assert long_functions("def f():\n" + 39 * "    a\n") == []
    assert long_functions("def f():\n" + 40 * "    a\n") == ["f"]


def test_stages_and_pipeline_calculate_nothing() -> None:
    found = {file.name: calculations(file.read_text()) for file in FILES}
    assert len(found) > 20
    assert {name: lines for name, lines in found.items() if lines} == {}


def test_stages_and_pipeline_are_short() -> None:
    assert sum(len(file.read_text().splitlines()) for file in FILES) <= MOST_LINES
    assert [name for file in FILES for name in long_functions(file.read_text())] == []


def test_no_two_stages_give_a_variable_and_every_pattern_fits_one() -> None:
    """A pattern must not take in what another stage gives."""
    kinds = dict(STAGES.items())
    for variable in VARIABLES:
        givers = [name for name, kind in kinds.items() if is_among(variable, kind.gives)]
        assert len(givers) <= 1, (variable, givers)
    for name, kind in kinds.items():
        for thing in {*kind.reads, *kind.gives} - {EVERYTHING}:
            if isinstance(thing, str):
                assert any(is_among(one, (thing,)) for one in VARIABLES), (name, thing)
