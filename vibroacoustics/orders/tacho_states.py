"""The two states of a tacho between which its pulses go."""

from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError

_BLOCKS: Final = 1000
_EXTREME_BLOCK: Final = 3
"""The highest and lowest levels are the third extreme of those of the blocks, so that spikes in two
blocks do not count; three pulses are the fewest that a speed can be told from."""
_MEDIAN_SAMPLES: Final = 2**22
"""The states' medians are those of every n-th sample, so many or half of them: of 80 s at 51.2 kHz
of all samples."""
_TWO_STATES: Final = 0.3
"""Share of the extremes' swing that lies between the two states' medians. White noise has 0.14, a
pulse with noise of 0.2 of the swing 0.34; a pulse to both sides of a rest has about 0."""

_MOST_LOW: Final = 0.4


class TachoStates:
    """Low and high state of a tacho that comes in blocks, however short its pulses are.

    Parameters
    ----------
    samples : number of samples of all blocks
    """

    def __init__(self, samples: int) -> None:
        self._samples, self._added = samples, 0
        self._length = -(-samples // _BLOCKS)  # of what an extreme is taken of
        self._every = -(-samples // _MEDIAN_SAMPLES)
        parts = -(-samples // self._length)
        self._bottom, self._top = np.full(parts, np.inf), np.full(parts, -np.inf)
        self._some: Array = np.empty(-(-samples // self._every))  # in any order

    @property
    def lowest(self) -> float:
        """Lowest sample."""
        return float(self._bottom.min())

    @property
    def highest(self) -> float:
        """Highest sample."""
        return float(self._top.max())

    def add(self, block: Array) -> None:
        """Take the next samples, shape (time,).

        Raises
        ------
        ParameterError
            A sample is not finite.
        """
        if not np.all(np.isfinite(block)):
            raise ParameterError(
                f"tacho: {np.count_nonzero(~np.isfinite(block))} of {block.size} samples are not "
                "finite numbers"
            )
        first, self._added = self._added, self._added + block.size
        parts = slice(first // self._length, (self._added - 1) // self._length + 1)
        starts = np.maximum(np.arange(parts.start, parts.stop) * self._length - first, 0)
        for extremes, extreme in ((self._bottom, np.minimum), (self._top, np.maximum)):
            extremes[parts] = extreme(extremes[parts], extreme.reduceat(block, starts))
        some = slice(-(-first // self._every), -(-self._added // self._every))
        self._some[some] = block[-first % self._every :: self._every]

    def levels(self) -> tuple[float, float, bool]:
        """Low and high level, after all samples have been added, and whether they are two states.

        A signal with pulses to both sides of a rest has no two states: its levels are its extremes.

        Raises
        ------
        ParameterError
            The signal is constant.
        """
        bottom, top = self.extremes()
        some = self._some
        above = some >= 0.5 * (bottom + top)
        if above.all() or not above.any():
            return (bottom, top, True) if self._every > 1 else (self.lowest, self.highest, True)
        low, high = (float(np.median(some[part], overwrite_input=True)) for part in (~above, above))
        if high - low > _TWO_STATES * (top - bottom):
            return low, high, True
        return bottom, top, False

    def extremes(self) -> tuple[float, float]:
        """Lowest and highest level but for spikes.

        Raises
        ------
        ParameterError
            The signal is constant.
        """
        if self.lowest == self.highest:
            raise ParameterError(f"tacho: no pulses: the signal is constant at {self.lowest:.4g}")
        nth = min(_EXTREME_BLOCK, self._bottom.size)
        bottom = float(np.sort(self._bottom)[nth - 1])
        top = float(np.sort(self._top)[-nth])
        return (bottom, top) if top > bottom else (self.lowest, self.highest)

    def is_inverted(self) -> bool:
        """Whether the signal is high but for pulses: at most 40 % of the time it is low."""
        bottom, top = self.extremes()
        low = float(np.quantile(self._some, _MOST_LOW, overwrite_input=True))
        return low >= 0.5 * (bottom + top)

    def idle(self) -> float:
        """Median of the samples, about which the height of pulses changes."""
        return float(np.median(self._some, overwrite_input=True))
