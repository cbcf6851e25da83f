"""Printed cases of balancing: influence coefficients and readings as `amplitude@degrees`.

The numbers are in the test table of the public program hsbalance (MIT), which names the sources.
"""

from typing import Final, NamedTuple

import numpy as np

from vibroacoustics.base.arrays import ComplexArray


def vectors(text: str) -> ComplexArray:
    """Complex numbers of words such as `1.4@45`, in rows that `/` parts."""
    rows = [[_vector(word) for word in row.split()] for row in text.split("/")]
    return np.array(rows)


def _vector(word: str) -> complex:
    size, angle_deg = map(float, word.split("@"))
    return complex(size * np.exp(1j * np.deg2rad(angle_deg)))


class Case(NamedTuple):
    """Readings without weights, influence, shape (row, plane), and the printed correction."""

    response: ComplexArray
    influence: ComplexArray
    printed: ComplexArray


def _case(influence: str, response: str, printed: str) -> Case:
    return Case(vectors(response)[:, 0], vectors(influence), vectors(printed)[0])


GOODMAN: Final = _case(
    "3@0 2@180 / 5@0 2@180 / 5@0 3@180", "1@0 / 1@180 / 0@0", "0.81@0 1.48@0"
)  # fmt: skip
DARLOW: Final = _case(
    "1.41@45 2.24@27 3.61@34 / 3.16@72 4.47@27 2.24@27 / 2.83@45 2.24@27 5@37 / "
    "3.16@18 3.61@34 4.47@27",
    "3.16@72 / 3.16@18 / 4.12@14 / 5.39@68",
    "1.39@-4 1.25@-144 0.98@168",
)
DEPENDENT: Final = _case(
    "1.41@45 3.61@34 3.61@34 / 3.16@72 2.24@27 2.24@27 / 2.83@45 5@37 5@37 / "
    "3.16@18 3.61@34 4.47@27",
    "3.16@72 / 3.16@18 / 4.12@14 / 5.39@68",
    "0.87@101 4.74@100 5.08@-87",
)
FOILES: Final = _case(
    "9.8@117 17@124 7.2@114 38.5@77 / 2.7@43 14.3@317 4.5@213 14.3@270 /"
    "12.5@323 25@261 15.2@158 30@238 / 22.4@92 32.6@45 23.3@315 27.8@210 /"
    "26@94 40.3@9 25@330 34@213 / 40.3@355 43@144 29.6@61 65.4@322 /"
    "20.6@339 32.3@152 36.7@41 61.8@322 / 12.6@226 37.6@52 18.8@153 26@176 /"
    "13.4@209 26.9@76 47.5@98 71.7@312 / 13.4@154 22.4@307 52@299 102@165 /"
    "5.4@24 7.2@199 22.4@2 27.8@99",
    "55@259 / 45@118 / 124@21 / 138@349 / 107@349 / 90@280 / 58@354 / 108@201 / 88@190 / 56@48 / "
    "73@158",
    "4.42@88 2.92@352 1.588@322 1.928@304",
)


class Runs(NamedTuple):
    """Readings of the first and of two trial runs, shape (run, row), trial weights in two planes,
    and the printed correction."""

    readings: ComplexArray
    trials: ComplexArray
    printed: ComplexArray

    def weights(self, left_in: bool) -> ComplexArray:
        """Weights that are in, shape (run, plane)."""
        first, second = self.trials
        return np.array([[0.0, 0.0], [first, 0.0], [first * left_in, second]])


BRUEL_KJAER: Final = Runs(
    vectors("170@112 53@78 / 235@94 58@68 / 185@115 77@104"),
    vectors("1.15@0 1.15@0")[0],
    vectors("1.96@-122 1.06@121")[0],
)
FEESE: Final = Runs(
    vectors(
        ".68@32 .56@86 1.94@231 2.07@335 / 1.31@1 1.25@75 .93@251 1@342 / "
        ".54@9 .52@75 .81@196 .9@296"
    ),
    vectors("11.1@35 3.7@135")[0],
    vectors("15.3@3 6.6@113")[0],
)
