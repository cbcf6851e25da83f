"""Answers from measured levels, tones and functions."""

import numpy as np

from vibroacoustics.base.arrays import Array, ComplexArray
from vibroacoustics.levels import a_weighting, energy_sum
from vibroacoustics.levels.bands import Band
from vibroacoustics.levels.sound_power import (
    background_correction_db,
    environment_correction_db,
    hemisphere_area_m2,
    sound_power_level,
)
from vibroacoustics.measured.change import changed_response, mount_stiffness
from vibroacoustics.sound.audibility import audibility_db

from .case import Answer, Answers, Case

_FEET = 4
_LOWEST_OCTAVE = -4
"""63 Hz, counted from the octave of 1 kHz."""


def sound_power_example(case: Case) -> Answers:
    """Answer with levels and corrections of ISO 3744."""
    values = case.values
    area_m2 = hemisphere_area_m2(values["radius"])
    pressure_db = np.array([float(row["pressure_level_db"]) for row in case.rows])
    power_db = np.asarray(sound_power_level(pressure_db, area_m2))
    octaves = range(_LOWEST_OCTAVE, _LOWEST_OCTAVE + len(case.rows))
    exact_hz: Array = np.array([Band(1, octave).middle_hz for octave in octaves])
    for row, level in zip(case.rows, power_db, strict=True):
        yield Answer(f"sound power level, octave {row['octave_hz']} Hz", "dB", float(level))
    yield Answer("sound power level", "dB", float(energy_sum(power_db, axis=0)))
    weighted = energy_sum(power_db + a_weighting(exact_hz), axis=0)
    yield Answer("A-weighted sound power level", "dB", float(weighted))
    yield Answer("area of the hemisphere", "m2", area_m2)
    background = background_correction_db(values["background_margin"])
    yield Answer("background correction K1", "dB", float(background))
    environment = environment_correction_db(area_m2, values["absorption_area"])
    yield Answer("environment correction K2", "dB", float(environment))


def tone_audibility(case: Case) -> Answers:
    """Answer with the audibility of each tone."""
    for row in case.rows:
        tone, noise, hertz = (
            np.array(float(row[name])) for name in ("tone_db", "noise_line_db", "frequency_hz")
        )
        value = float(audibility_db(tone, noise, hertz, case.values["line_spacing"]))
        yield Answer(f"audibility at {row['frequency_hz']} Hz", "dB", value)


def changed_mounts(case: Case) -> Answers:
    """Answer with the pressure after a change of mounts, from the measured functions alone."""
    cells = {
        (row["frequency_hz"], row["response"], row["reference"]): complex(
            float(row["real"]), float(row["imaginary"])
        )
        for row in case.rows
    }
    frequencies = list(dict.fromkeys(row["frequency_hz"] for row in case.rows))
    points = [f"{body} {number}" for body in ("machine", "panel") for number in range(1, 5)]
    microphones = list(dict.fromkeys(row["response"] for row in case.rows))[len(points) :]

    def functions(responses: list[str], references: list[str]) -> ComplexArray:
        return np.array(
            [[[cells[f, r, c] for c in references] for r in responses] for f in frequencies]
        )

    stretch = np.hstack([np.eye(_FEET), -np.eye(_FEET)])
    hertz, values = np.array(list(map(float, frequencies))), case.values
    new, old = (
        mount_stiffness(hertz, 1e3 * values[f"{age}_stiffness"], values[f"{age}_loss_factor"])
        for age in ("new", "old")
    )
    pressure = changed_response(
        functions(microphones, [""])[..., 0],
        functions(microphones, points) @ stretch.T,
        stretch @ functions(points, points) @ stretch.T,
        functions(points, [""])[..., 0] @ stretch.T,
        np.einsum("f,eg->feg", new - old, np.eye(_FEET)),
    )
    for frequency, row in zip(frequencies, pressure, strict=True):
        for name, value in zip(microphones, row, strict=True):
            yield Answer(f"{name}, {frequency} Hz: real", "Pa", float(value.real))
            yield Answer(f"{name}, {frequency} Hz: imaginary", "Pa", float(value.imag))
