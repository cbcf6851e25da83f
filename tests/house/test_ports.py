"""Rooms above the transfer name no load port but the housing."""

import ast

import pytest
from support import ROOT

from vibroacoustics.machine.cavities import SPACES
from vibroacoustics.machine.frame import PARTS
from vibroacoustics.machine.stator_yoke import STATOR_YOKE

ROOMS = ("levels", "pipeline", "design", "report", "commands")
NAMES = {*SPACES, *(port.name for port in (*PARTS, STATOR_YOKE))}
"""The block is a body of the results, too: its constant counts, its name does not."""
CONSTANTS = {*(name.upper() for name in NAMES), "BLOCK", "PARTS", "SPACES", "GasPort", "Part"}


def ports_named(text: str) -> set[str]:
    """Ports that a module imports, writes as a name or as text."""
    named = set()
    for node in ast.walk(ast.parse(text)):
        match node:
            case ast.ImportFrom(module=module, names=aliases) if module:
                if module.rpartition(".")[2] in ("frame", "cavities", "stator_yoke", "suspension"):
                    named |= {alias.name for alias in aliases} & CONSTANTS
            case ast.Constant(value=str(word)):
                named |= {word} & NAMES
    return named


@pytest.mark.parametrize("room", ROOMS)
def test_no_port_but_the_housing_is_named(room):
    files = sorted((ROOT / "vibroacoustics" / room).rglob("*.py"))
    assert files
    found = {str(file): ports_named(file.read_text("utf-8")) for file in files}
    assert not {file: names for file, names in found.items() if names}


def test_ports_are_found():
    text = 'from ..machine.frame import STATOR\nload["fixed_scroll"] = 1'
    assert ports_named(text) == {"STATOR", "fixed_scroll"}
    assert not ports_named('from ..machine.frame import Frame\nbody = "housing"')
