"""Decibels are worked out in one place."""

import re

from support import ROOT

PACKAGE = ROOT / "vibroacoustics"
ARITHMETIC = re.compile(r"\blog10\b|(?<![\w.])10(?:\.0?)?\s*\*\*")
NO_LEVELS = {
    "base/decibel.py": "the place itself",
    "base/rounding.py": "number of digits",
    "levels/bands.py": "ratios and numbers of octaves of base ten",
    "mechanics/added.py": "number of a third octave",
    "recordings/axes.py": "digits of a written time",
    "recordings/time_stamps.py": "nanoseconds of a second",
    "base/air_attenuation.py": "a standard's formula for the air",
    "report/charts/layout.py": "ticks of an axis",
    "sound/critical_bands.py": "powers and logarithms of a frequency",
    "study/operation.py": "rounding of a step",
}
"""Files that may, and why."""


def test_decibel_arithmetic_is_in_one_place():
    files = {
        path.relative_to(PACKAGE).as_posix()
        for path in PACKAGE.rglob("*.py")
        if ARITHMETIC.search(path.read_text(encoding="utf-8"))
    }
    assert files == set(NO_LEVELS)


def test_pattern_finds_what_it_is_meant_for():
    for text in ("20.0 * np.log10(x)", "10.0 ** (x / 20.0)", "10**-2", "10.**x", "math.log10(x)"):
        assert ARITHMETIC.search(text), text
    for text in ("0.10**2", "110 ** 2", "x10 ** 2", "log1p(x)"):
        assert not ARITHMETIC.search(text), text
