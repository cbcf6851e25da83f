"""Lines and noise of several machines together, and sound to listen to."""

from collections.abc import Iterable, Mapping
from math import gcd
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..levels.beats import MachineLine
from .ingredients import Ingredients, SoundBands, SoundLines
from .rendering import SAMPLE_RATE_HZ, rendered, whole_revolutions

_ORDER: Final = "order "
DURATION_S: Final = 12.0
"""Duration of a sound: some beats of each order."""
_PER_RPM: Final = 1000
"""Parts of 1 rpm in which speeds are compared."""


def line_name(machine: str, line: str) -> str:
    """Return the name of a line among those of several machines, such as `east: order 2`."""
    return f"{machine}: {line}"


def machine_line(name: str, frequency_hz: float, machines: Iterable[str]) -> MachineLine:
    """Return machine and order of a line by its name; order 0 of one that is no order.

    Parameters
    ----------
    name : name by `line_name`
    frequency_hz : frequency of the line
    machines : names of all machines
    """
    machine = next(each for each in machines if name.startswith(line_name(each, "")))
    line = name.removeprefix(line_name(machine, ""))
    is_order = line.startswith(_ORDER) and line.removeprefix(_ORDER).isdigit()
    return MachineLine(machine, int(line.removeprefix(_ORDER)) if is_order else 0, frequency_hz)


def together(parts: Mapping[str, Ingredients]) -> Ingredients:
    """Join the sound of several machines at one receiver.

    Every line stays at its own frequency; noise adds by its mean square.

    Parameters
    ----------
    parts : lines and noise by machine
    """
    hertz = np.concatenate([part.lines.frequency_hz for part in parts.values()])
    pressure = np.concatenate([part.lines.pressure_pa for part in parts.values()])
    names = [line_name(name, line) for name, part in parts.items() for line in part.lines.name]
    rising = np.argsort(hertz, kind="stable")
    lines = SoundLines(hertz[rising], pressure[rising], tuple(names[number] for number in rising))
    return Ingredients(lines, _noise([part.bands for part in parts.values()]))


def _noise(parts: Iterable[SoundBands]) -> SoundBands:
    square: dict[float, float] = {}
    for part in parts:
        for hertz, effective in zip(part.centre_hz, part.pressure_pa, strict=True):
            square[float(hertz)] = square.get(float(hertz), 0.0) + float(effective) ** 2
    centres = sorted(square)
    return SoundBands(np.array(centres), np.sqrt(np.array([square[hertz] for hertz in centres])))


def rendered_together(
    sound: Ingredients, speeds_rpm: Iterable[float], duration_s: float = DURATION_S
) -> Array:
    """Return the sound pressure of several machines, shape (sample,), Pa, 48 kHz.

    It lasts whole beats where all speeds have a common period of at most the duration, so that
    it repeats without a step.

    Parameters
    ----------
    sound : result of `together`
    speeds_rpm : speeds of the machines
    duration_s : wanted
    """
    common_rpm = gcd(*(round(_PER_RPM * speed) for speed in speeds_rpm)) / _PER_RPM
    repeats = common_rpm * duration_s >= 60.0
    samples = whole_revolutions(duration_s, common_rpm if repeats else 0.0, SAMPLE_RATE_HZ)
    return rendered(sound, samples, SAMPLE_RATE_HZ)
