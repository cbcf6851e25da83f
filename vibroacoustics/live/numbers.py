"""Arrays of numbers as one text that a script reads back: 32-bit floats, deflated, in base 85."""

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..report.live.assets import packed

NOTHING: Final = -1
"""Stands for an array that is not there."""
FULL_BITS: Final = 23
"""Bits of the fraction of a 32-bit float, for what is summed as energy: within 6e-8, 3e-7 dB."""
LOAD_BITS: Final = 19
"""Within 1e-6, 8e-6 dB of an amplitude: where loads cancel but for a hundredth, 8e-4 dB of that."""
FEW_BITS: Final = 15
"""Within 1.5e-5, 1.3e-4 dB of an amplitude, of what is only multiplied: it deflates better."""
NOISE_BITS: Final = 10
"""Within 5e-4, 0.002 dB of an energy, of third octaves that are drawn and heard."""


class Numbers:
    """Arrays one after the other; equal ones are kept once."""

    def __init__(self) -> None:
        self._parts: list[bytes] = []
        self._offsets: dict[bytes, int] = {}
        self._length = 0

    def put(self, values: ArrayLike, bits: int = FULL_BITS) -> int:
        """Keep real numbers, or complex ones as pairs; the number of the first one of them.

        Parameters
        ----------
        values : array of any shape
        bits : number of bits of their fractions
        """
        array = np.ascontiguousarray(values)
        if np.iscomplexobj(array):
            array = array.astype(np.complex128).view(np.float64)
        with np.errstate(over="ignore"):  # of levels that nothing reaches
            part = _rounded(array.astype("<f4"), bits).tobytes()
        if part not in self._offsets:
            self._offsets[part] = self._length
            self._parts.append(part)
            self._length += array.size
        return self._offsets[part]

    def put_unless(self, values: ArrayLike, trivial: float, bits: int = FULL_BITS) -> int:
        """Return what `put` does, or `NOTHING` where all of them are one trivial value."""
        return NOTHING if np.all(np.asarray(values) == trivial) else self.put(values, bits)

    @property
    def text(self) -> str:
        """All numbers: the first bytes of each, then the second ones and so on, deflated."""
        planes = np.frombuffer(b"".join(self._parts), dtype=np.uint8).reshape(-1, 4).T
        return packed(planes.tobytes())


def _rounded(values: NDArray[np.float32], bits: int) -> NDArray[np.float32]:
    """Values with the last bits of their fractions zero."""
    if bits == FULL_BITS:
        return values
    last = FULL_BITS - bits
    raised = values.view("<u4").astype(np.uint64) + (1 << (last - 1))
    return (raised >> last << last).astype("<u4").view("<f4")
