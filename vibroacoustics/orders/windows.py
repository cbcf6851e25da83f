"""Windows of block spectra with their corrections for tones and for noise."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError


@dataclass(frozen=True)
class Window:
    """Periodic sum of cosines, 1 - a_1 cos z + a_2 cos 2z - ..., with z = 2π n / N.

    Its mean is 1, so S1 = Σ w = N and S2 = Σ w² = N (1 + Σ a_i²/2) (Heinzel, Rüdiger & Schilling
    2002, equations 19 and 20). Spectra of N windowed samples x w are scaled two ways:

    - tones: peak amplitude 2 |Σ x w exp(-j...)| / S1 (equation 23, there as the mean square);
    - noise and bands: mean square per line divided by the noise bandwidth (equation 24).
    """

    cosines: tuple[float, ...]
    """1, a_1, a_2, ..."""

    @property
    def noise_bandwidth_lines(self) -> float:
        """Normalized equivalent noise bandwidth N S2 / S1² (equation 21), lines."""
        return 1.0 + sum(a * a for a in self.cosines[1:]) / 2.0

    @property
    def main_lobe_lines(self) -> float:
        """Width of the main lobe from zero to zero, lines."""
        return 2.0 * len(self.cosines)

    def response(self, distance_lines: Array) -> Array:
        """Share of a tone's amplitude in lines at a distance from it: the window's transform.

        Σ a_i (sinc(d - i) + sinc(d + i))/2, of long blocks: Heinzel, Rüdiger & Schilling 2002,
        appendix C, has the transforms of sums of cosines.

        Parameters
        ----------
        distance_lines : distance of the lines from the tone, any shape, lines
        """
        parts = (
            size * (np.sinc(distance_lines - number) + np.sinc(distance_lines + number)) / 2.0
            for number, size in enumerate(self.cosines)
        )
        return np.asarray(sum(parts))

    def samples(self, length: int) -> Array:
        """The window over `length` samples, mean 1."""
        angle = np.linspace(-np.pi, np.pi, length + 1)[:-1]
        parts = (size * np.cos(number * angle) for number, size in enumerate(self.cosines))
        return np.asarray(sum(parts))


WINDOWS: Final = {
    "rectangular": Window((1.0,)),
    "hann": Window((1.0, 1.0)),
    "flat_top": Window((1.0, 1.933, 1.286, 0.388, 0.0322)),
}
"""Windows by the name that a user gives; the flat top is that of ISO 18431-2:2004."""


def name_of_window(window: Window) -> str:
    """Name that a user gives for a window."""
    return next(name for name, shape in WINDOWS.items() if shape == window)


def window_by_name(name: str) -> Window:
    """Window of a name.

    Raises
    ------
    ParameterError
        There is none of that name.
    """
    try:
        return WINDOWS[name]
    except KeyError:
        raise ParameterError(f"window = {name!r}: must be one of {', '.join(WINDOWS)}") from None
