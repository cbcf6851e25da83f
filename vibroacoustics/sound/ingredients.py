"""Ingredients of the sound of an option, at a microphone or in a room: lines and noise."""

from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import (
    SILENCE_DB,
    amplitude_of_level,
    energy_sum,
    mean_square_level,
    power_of_level,
)
from ..base.errors import ParameterError, SchemaError
from ..base.units import shaft_frequency_hz
from ..base.weighting import WEIGHTING
from ..levels.bands import Band
from ..mechanics.added import third_octave_number
from .audibility import NO_TONE_AUDIBILITY_DB
from .predicted_audibility import predicted_audibility

_ORDER: Final = "order "
_AT_1_KHZ: Final = 30
"""Number of its third octave."""
AT_MICROPHONE: Final = (
    "pressure_line", "noise_band_level", "unmodelled_band_level", "baseline_band_level",
    "baseline_order_level", "level_total", "representative_noise_band_level",
    "representative_unmodelled_band_level", "total_band_level", "tone_audibility",
)  # fmt: skip
IN_ROOM: Final = (
    "room_pressure_line", "room_plate_line_level", "room_noise_band_level", "room_level",
    "room_plate_level",
)  # fmt: skip
_ALONG: Final = (
    "speed", "line", "tone_frequency", "noise_band", "baseline_band", "baseline_order",
    "judged_tone",
)  # fmt: skip
"""Coordinates of a case."""
_Case = dict[str, Any]
"""Values of an option at a position and speed, by name of variable or coordinate."""
_STEPS: Final = 30
"""Steps towards the audibility of the tones."""
_STEP_DB: Final = 3.0
"""Largest change of a line in a step."""
_INAUDIBLE_DB: Final = -3.0
"""Audibility of a line that is no audible tone in the median."""
ROUNDING_SHARE: Final = 1e-9
"""Share of a band's mean square: less is what rounding leaves where lines are taken out."""


@dataclass(frozen=True)
class SoundLines:
    """Tones, rising in frequency.

    Attributes
    ----------
    frequency_hz : shape (line,)
    pressure_pa : complex peaks at the same crank angle, x(t) = Re{P exp(+jωt)}, shape (line,)
    name : name of each, such as `order 2`
    """

    frequency_hz: Array
    pressure_pa: ComplexArray
    name: tuple[str, ...]


@dataclass(frozen=True)
class SoundBands:
    """Noise in third octaves (base ten: a band reaches from 10^-0.05 to 10^0.05 of its centre).

    Attributes
    ----------
    centre_hz : exact midband frequencies, shape (band,)
    pressure_pa : effective values of the noise, without tones, shape (band,)
    """

    centre_hz: Array
    pressure_pa: Array


@dataclass(frozen=True)
class Ingredients:
    """All that a sound is made of.

    Attributes
    ----------
    lines : tones with phase
    bands : noise
    """

    lines: SoundLines
    bands: SoundBands

    @property
    def mean_square(self) -> float:
        """Mean square of the sound, Pa²."""
        return float(
            0.5 * np.sum(np.abs(self.lines.pressure_pa) ** 2) + np.sum(self.bands.pressure_pa**2)
        )

    @property
    def a_weighted_db(self) -> float:
        """A-weighted level of the sound, noise weighted at its midband frequencies, dB."""
        of_lines, of_noise = (
            power_of_level(WEIGHTING["A"](hertz))
            for hertz in (self.lines.frequency_hz, self.bands.centre_hz)
        )
        square = 0.5 * np.sum(of_lines * np.abs(self.lines.pressure_pa) ** 2)
        square += np.sum(of_noise * self.bands.pressure_pa**2)
        return float(mean_square_level(square, REFERENCE_PRESSURE_PA))

    def louder(self, by_db: float) -> "Ingredients":
        """Return this sound at a level higher by some dB."""
        factor = amplitude_of_level(by_db)
        return Ingredients(
            replace(self.lines, pressure_pa=factor * self.lines.pressure_pa),
            replace(self.bands, pressure_pa=factor * self.bands.pressure_pa),
        )


def ingredients(results: xr.Dataset, option: str, microphone: str, speed: float) -> Ingredients:
    """Lines with phase and bands of noise of an option at a microphone or listener, and speed.

    The one source of every rendering: of `vibroacoustics listen` as of the report's page. Lines are
    the sum of all sources; orders of a measured baseline have its levels, with the phases of the
    model (0 where it has no such order). Noise is that of the sources and what the model does not
    explain: unmodelled noise or, in bands that were measured, the baseline. In a run with samples
    they are those of the representative sample, set to the median audibility of tones and median
    level of the option in each third octave, then to its median `level_total`.

    At a listener in a room they are set to `room_level` and, where the feet push a plate,
    `room_plate_level` together: structure-borne sound adds to the energy of the lines and leaves
    them their phase (assumed).

    Parameters
    ----------
    results : results of a run
    option, microphone : names in the results; also a listener's, where no microphone has it
    speed : one of theirs, rpm

    Returns
    -------
    lines above 0 Hz that sound, and bands that hold noise

    Raises
    ------
    ParameterError
        The results hold no such option, microphone, listener or speed.
    SchemaError
        The results are of a version that kept no noise.
    """
    case = _case(results, option, microphone, speed)
    sound = _in_room(case) if "room_pressure_line" in case else _at_microphone(case)
    return _at_median(case, sound) if "representative_value" in results else sound


def _at_microphone(case: _Case) -> Ingredients:
    lines = _measured_orders(case, _modelled_lines(case))
    number = third_octave_number(case["noise_band"])
    prefix = "representative_" if "representative_noise_band_level" in case else ""
    square = _square(case[f"{prefix}noise_band_level"]) + _square(
        case[f"{prefix}unmodelled_band_level"]
    )
    if "baseline_band_level" in case:
        square = _measured_bands(case, lines, number, square)
    return Ingredients(lines, _bands(case, square))


def _in_room(case: _Case) -> Ingredients:
    return Ingredients(_room_lines(case), _bands(case, _square(case["room_noise_band_level"])))


def _at_median(case: _Case, sound: Ingredients) -> Ingredients:
    """The sound at the median levels of its option, first by third octave; silence is itself."""
    if "total_band_level" in case:
        if "tone_audibility" in case and sound.bands.centre_hz.size:  # else nothing masks tones
            sound = _with_audibility(case, sound)
        sound = _in_bands(case, sound)
    names = [name for name in ("level_total", "room_level", "room_plate_level") if name in case]
    wanted = energy_sum(np.array([float(case[name]) for name in names]), axis=0)
    level_db = sound.a_weighted_db
    sounds = np.isfinite(level_db) and level_db > SILENCE_DB
    return sound.louder(float(wanted) - level_db) if sounds else sound


def _with_audibility(case: _Case, sound: Ingredients) -> Ingredients:
    """The sound with tones as audible as in the median, at the levels of its third octaves.

    Lines and noise of a third octave share its level; a change of one tone changes what masks its
    neighbours, hence the steps.
    """
    median = dict(zip(case["judged_tone"].tolist(), case["tone_audibility"], strict=True))
    wanted = np.array([median.get(name, np.nan) for name in sound.lines.name], dtype=float)
    inaudible = wanted <= NO_TONE_AUDIBILITY_DB
    for _ in range(_STEPS):
        sound = _in_bands(case, sound)
        lines, bands = sound.lines, sound.bands
        square = 0.5 * np.abs(lines.pressure_pa) ** 2
        rated = predicted_audibility(
            lines.frequency_hz, square, bands.pressure_pa**2, bands.centre_hz
        ).tone_db
        change_db = np.where(rated > NO_TONE_AUDIBILITY_DB, wanted - rated, 0.0)
        change_db = np.where(inaudible, np.minimum(_INAUDIBLE_DB - rated, 0.0), change_db)
        factor = amplitude_of_level(np.clip(np.nan_to_num(change_db), -_STEP_DB, _STEP_DB))
        sound = replace(sound, lines=replace(lines, pressure_pa=factor * lines.pressure_pa))
    return sound


def _in_bands(case: _Case, sound: Ingredients) -> Ingredients:
    """The sound with the median level in each third octave in which it sounds."""
    number = third_octave_number(case["noise_band"])
    of_lines, of_bands = (
        third_octave_number(hertz)[:, None] == number
        for hertz in (sound.lines.frequency_hz, sound.bands.centre_hz)
    )
    square = 0.5 * np.abs(sound.lines.pressure_pa) ** 2 @ of_lines
    square += sound.bands.pressure_pa**2 @ of_bands
    sounds = square > 0.0
    factor = np.ones(number.size)
    factor[sounds] = np.sqrt(_square(case["total_band_level"])[sounds] / square[sounds])
    return Ingredients(
        replace(sound.lines, pressure_pa=sound.lines.pressure_pa * _factors(of_lines, factor)),
        replace(sound.bands, pressure_pa=sound.bands.pressure_pa * _factors(of_bands, factor)),
    )


def _factors(in_band: Array, factor: Array) -> Array:
    """Factor of the band of each line; one outside of all bands."""
    return np.where(in_band.any(axis=1), in_band @ factor, 1.0)


def positions(results: xr.Dataset) -> list[str]:
    """Return the names of the microphones, then of the listeners in a room."""
    names = results.variables["receiver"].values.tolist()
    if "room_level" in results:
        names += results["listener"].values.tolist()
    return list(dict.fromkeys(names))


def _case(results: xr.Dataset, option: str, microphone: str, speed: float) -> _Case:
    if "noise_band_level" not in results:
        raise SchemaError("the results hold no noise of third octaves: run the study again")
    for word, value, available in (
        ("option", option, results.variables["option"].values),
        ("microphone", microphone, positions(results)),
        ("speed", speed, results.variables["speed"].values),
    ):
        if value not in available:
            unit = " rpm" if word == "speed" else ""
            listed = ", ".join(
                f"{value:g}" if word == "speed" else str(value) for value in available
            )
            raise ParameterError(
                f"{word} = {value}{unit}: the results hold no such one; there are {listed}"
            )
    # A microphone precedes a listener with the same name.
    in_room = microphone not in results.variables["receiver"].values
    if in_room and "room_pressure_line" not in results:
        raise SchemaError("the results hold no sound in the room: run the study again")
    names = IN_ROOM if in_room else AT_MICROPHONE
    where: dict[str, Any] = {
        "option": option,
        "listener" if in_room else "receiver": microphone,
        "speed": speed,
    }
    return _selected(results, [name for name in (*names, *_ALONG) if name in results], where)


def _selected(results: xr.Dataset, names: list[str], where: dict[str, Any]) -> _Case:
    """Values at labels of dimensions, from arrays, which is several times as fast as by labels."""
    row = {dim: results.variables[dim].values.tolist().index(where[dim]) for dim in where}
    selected = {}
    for name in names:
        variable = results.variables[name]
        index = tuple(row.get(str(dim), slice(None)) for dim in variable.dims)
        selected[name] = np.asarray(variable.values[index])
    return selected


def _bands(case: _Case, square: Array) -> SoundBands:
    """Noise of the bands that hold some, of their mean squares."""
    number = third_octave_number(case["noise_band"])
    loud = square > 0.0
    centres = [Band(3, int(band) - _AT_1_KHZ).middle_hz for band in number[loud]]
    return SoundBands(np.array(centres), np.sqrt(square[loud]))


def _room_lines(case: _Case) -> SoundLines:
    """Airborne lines of all sources, with the energy of structure-borne sound."""
    pressure = case["room_pressure_line"]
    if "room_plate_line_level" in case:
        by_plate = 2.0 * _square(case["room_plate_line_level"])
        pressure = np.sqrt(np.abs(pressure) ** 2 + by_plate) * np.exp(1j * np.angle(pressure))
    return _sounding(case, pressure)


def _modelled_lines(case: _Case) -> SoundLines:
    """Lines of all sources together that sound."""
    return _sounding(case, case["pressure_line"].sum(axis=0))


def _sounding(case: _Case, pressure: ComplexArray) -> SoundLines:
    hertz = case["tone_frequency"]
    sounds = (hertz > 0.0) & (pressure != 0.0)
    names = tuple(str(name) for name in case["line"][sounds])
    return _rising(hertz[sounds], pressure[sounds], names)


def _rising(hertz: Array, pressure: ComplexArray, names: tuple[str, ...]) -> SoundLines:
    order = np.argsort(hertz, kind="stable")
    return SoundLines(hertz[order], pressure[order], tuple(names[number] for number in order))


def _measured_orders(case: _Case, lines: SoundLines) -> SoundLines:
    """The lines with the levels of a baseline's orders."""
    if "baseline_order_level" not in case:
        return lines
    peak = dict(zip(lines.name, lines.pressure_pa, strict=True))
    hertz = dict(zip(lines.name, lines.frequency_hz, strict=True))
    for order, level in zip(case["baseline_order"], case["baseline_order_level"], strict=True):
        if np.isfinite(level):
            name = f"{_ORDER}{order:g}"
            size = np.sqrt(2.0) * REFERENCE_PRESSURE_PA * amplitude_of_level(float(level))
            peak[name] = size * np.exp(1j * np.angle(peak.get(name, 1.0)))
            hertz[name] = order * shaft_frequency_hz(float(case["speed"]))
    return _rising(np.array(list(hertz.values())), np.array(list(peak.values())), tuple(peak))


def _measured_bands(case: _Case, lines: SoundLines, number: Array, otherwise: Array) -> Array:
    """Mean squares of the noise, Pa²: measured bands less their lines, others as they are."""
    level_of = dict(zip(case["baseline_band"].tolist(), case["baseline_band_level"], strict=True))
    levels = np.array([level_of.get(band, np.nan) for band in case["noise_band"].tolist()])
    of_lines = third_octave_number(lines.frequency_hz)[:, None] == number
    tones = (0.5 * np.abs(lines.pressure_pa) ** 2) @ of_lines
    measured = REFERENCE_PRESSURE_PA**2 * power_of_level(levels)
    noise_pa2 = np.where(measured - tones > ROUNDING_SHARE * measured, measured - tones, 0.0)
    return np.where(np.isnan(measured), otherwise, noise_pa2)


def _square(level_db: Array) -> Array:
    """Mean squares of levels, Pa²; nothing of those that stand for silence."""
    return np.where(level_db > -200.0, REFERENCE_PRESSURE_PA**2 * power_of_level(level_db), 0.0)
