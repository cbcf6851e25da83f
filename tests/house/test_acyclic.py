"""Circles of imports are found, also those that Python does not stumble over."""

import subprocess
import sys

import acyclic
import pytest
from acyclic import circles

IN_FUNCTION = "def f():\n    from . import first\n"
FOR_TYPES = "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from .first import F\n"
SEEDED = {
    "at the top": {"first": "from . import second", "second": "from .first import F"},
    "inside a function": {"first": "from .second import S", "second": IN_FUNCTION},
    "for types": {"first": "import made.second", "second": FOR_TYPES},
    "of three": {
        "first": "from . import second",
        "second": "from . import third",
        "third": IN_FUNCTION,
    },
    "by the face of another package": {
        "first": "from .room.low import L",
        "room/__init__": "from .high import H",
        "room/low": "",
        "room/high": "from .. import first",
    },
    "by the own face": {
        "room/__init__": "from .low import L\nF = 1",
        "room/low": "from . import F",
    },
}
NO_CIRCLES = {
    "one way": {"first": "import numpy\nfrom . import second", "second": "from numpy import first"},
    "a face and what is below it": {
        "room/__init__": "from .low import L",
        "room/low": "from .lowest import L",
        "room/lowest": "L = 1",
    },
}
FOUND = {
    "of three": ["made.first", "made.second", "made.third"],
    "by the face of another package": ["made.first", "made.room", "made.room.high"],
    "by the own face": ["made.room", "made.room.low"],
}


def package(folder, files):
    """A package `made` of files by module."""
    for name, text in {"__init__": "", **files}.items():
        path = folder / "made" / f"{name}.py"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder / "made"


@pytest.mark.parametrize("seeded", SEEDED)
def test_a_seeded_circle_is_found(tmp_path, seeded):
    ((*circle, end),) = circles(package(tmp_path, SEEDED[seeded]))
    assert end == circle[0]
    start = circle.index(min(circle))
    assert circle[start:] + circle[:start] == FOUND.get(seeded, ["made.first", "made.second"])


@pytest.mark.parametrize("files", NO_CIRCLES.values(), ids=NO_CIRCLES)
def test_what_is_no_circle_passes(tmp_path, files):
    assert circles(package(tmp_path, files)) == []


def test_circles_without_a_common_import_are_all_found(tmp_path):
    pairs = {"a": "b", "b": "a", "c": "d", "d": "c"}
    found = circles(package(tmp_path, {one: f"from . import {two}" for one, two in pairs.items()}))
    assert sorted(map(set, found), key=min) == [{"made.a", "made.b"}, {"made.c", "made.d"}]


def test_the_command_names_the_circle_and_fails(tmp_path):
    made = package(tmp_path, SEEDED["inside a function"])
    command = [sys.executable, acyclic.__file__]
    failed = subprocess.run([*command, made], capture_output=True, text=True, check=False)
    assert failed.returncode == 1
    assert failed.stdout.startswith("circle of imports: made.")
    (made / "second.py").write_text("S = 1")
    assert subprocess.run([*command, made], check=False).returncode == 0
    assert subprocess.run([*command, tmp_path], check=False, capture_output=True).returncode == 1
