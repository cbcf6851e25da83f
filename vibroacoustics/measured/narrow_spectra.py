"""Narrow-band spectra at microphones as a baseline: orders, and what is none in third octaves."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import mean_square_level
from ..base.errors import ParameterError
from ..base.units import shaft_frequency_hz
from ..levels.bands import bands_between
from ..levels.narrow_band import TakenApart, taken_apart
from ..orders.windows import WINDOWS
from ..study.baseline import HIGHEST_HZ, LOWEST_HZ
from ..study.baseline_files import BaselineContent

BANDS: Final = bands_between(3, LOWEST_HZ, HIGHEST_HZ)
HIGHEST_ORDER: Final = 100
"""Highest order that is taken out of a spectrum; higher ones count with their band."""
UNEVEN: Final = 0.01
"""Largest distance of a frequency from its place among even ones, in steps."""


@dataclass(frozen=True)
class NarrowSpectrum:
    """Spectrum at a microphone and a speed.

    Attributes
    ----------
    microphone, speed_rpm : where and when
    frequency_hz : shape (line,)
    mean_square : mean square of a tone on the line, shape (line,), Pa²
    block_rpm : block of a run-up that counts to the speed; none where it is the speed
    """

    microphone: str
    speed_rpm: float
    frequency_hz: Array
    mean_square: Array
    block_rpm: float | None = None

    def __post_init__(self) -> None:
        steps = np.diff(self.frequency_hz)
        if steps.size < 2 or not np.all(np.abs(steps / steps.mean() - 1.0) < UNEVEN):
            raise ParameterError(
                f"{self.microphone}, {self.speed_rpm:g} rpm: frequencies must be even and rise"
            )

    @property
    def shaft_hz(self) -> float:
        """Frequency of the first order."""
        return shaft_frequency_hz(self.speed_rpm if self.block_rpm is None else self.block_rpm)


def of_spectra(
    spectra: Sequence[NarrowSpectrum], window: str, orders: Sequence[float] | None = None
) -> BaselineContent:
    """Orders and third octaves of spectra; those of one microphone and speed are averaged.

    Orders and bands that some speeds of a microphone lack are omitted.

    Parameters
    ----------
    spectra : at one or several microphones
    window : name
    orders : that are taken out; whole ones up to the highest that all speeds hold where none

    Raises
    ------
    ParameterError
        Frequencies are not even, or a spectrum covers no third octave.
    """
    content = BaselineContent()
    for name in dict.fromkeys(spectrum.microphone for spectrum in spectra):
        here = [spectrum for spectrum in spectra if spectrum.microphone == name]
        numbers = np.array(_whole_orders(here) if orders is None else orders, dtype=float)
        by_speed: dict[float, list[TakenApart]] = {}
        for spectrum in here:
            by_speed.setdefault(spectrum.speed_rpm, []).append(_apart(spectrum, window, numbers))
        order = {speed_rpm: _mean(few, "order") for speed_rpm, few in by_speed.items()}
        band = {speed_rpm: _mean(few, "band") for speed_rpm, few in by_speed.items()}
        kept = np.all([np.isfinite(each) for each in order.values()], axis=0)
        covered = np.all([np.isfinite(each) for each in band.values()], axis=0)
        if not covered.any():
            raise ParameterError(f"{name}: spectrum covers no third octave")
        for speed in by_speed:
            row = {"microphone": name, "speed_rpm": speed}
            content.third_octaves.append(
                row | _bands(covered, band[speed]) | {"without_orders": True}
            )
            if kept.any():
                content.orders.append(row | _orders(numbers[kept], order[speed][kept]))
    return content


def _whole_orders(spectra: Sequence[NarrowSpectrum]) -> list[int]:
    highest = [int(spectrum.frequency_hz[-1] / spectrum.shaft_hz) for spectrum in spectra]
    return list(range(1, min([*highest, HIGHEST_ORDER]) + 1))


def _apart(spectrum: NarrowSpectrum, window: str, orders: Array) -> TakenApart:
    lines_of_window = WINDOWS[window]
    return taken_apart(
        spectrum.frequency_hz,
        spectrum.mean_square,
        0.5 * lines_of_window.main_lobe_lines,
        lines_of_window.noise_bandwidth_lines,
        orders * spectrum.shaft_hz,
        BANDS,
    )


def _mean(few: Sequence[TakenApart], part: str) -> Array:
    return np.asarray(np.mean([getattr(spectrum, part) for spectrum in few], axis=0))


def _bands(covered: Array, square: Array) -> dict[str, object]:
    names = [band.nominal_hz for band, is_covered in zip(BANDS, covered, strict=True) if is_covered]
    return {"band_hz": tuple(names), "level_db": _levels(square[covered])}


def _orders(order: Array, square: Array) -> dict[str, object]:
    return {
        "order": tuple(order.tolist()),
        "level_db": _levels(square),
        "phase_rad": (None,) * order.size,
    }


def _levels(square: Array) -> tuple[float, ...]:
    return tuple(mean_square_level(square, REFERENCE_PRESSURE_PA).tolist())
