"""Mean squares of windowed blocks from squares that are summed over short ticks."""

import numpy as np

from ..base.arrays import Array


def windowed_mean_square(
    tick_energy: Array,
    tick_s: float,
    measured_s: tuple[float, float],
    middle_s: Array,
    duration_s: Array,
) -> Array:
    """Mean square of blocks under a Hann window w: ∫ w² x² dt / ∫ w² dt.

    By Parseval's theorem it is the power of all lines of the windowed block, over the window's
    noise bandwidth (Heinzel, Rüdiger and Schilling 2002, equations 21 to 24). So the level of a
    block and its orders, under the same window, are comparable. Within a tick the power is taken
    as constant. What is not measured is omitted on both sides of the quotient; a block of which
    less than half the window is measured is not a number.

    Parameters
    ----------
    tick_energy : ∫ x² dt over each tick, as far as measured, shape (..., tick), unit² s
    tick_s : length of a tick, s
    measured_s : first and last time that is measured, s
    middle_s : centre of each block, shape (block,), s
    duration_s : length of the blocks, shape (block,), s

    Returns
    -------
    shape (..., block), unit²

    Examples
    --------
    >>> steady = np.full(100, 4.0 * 0.01)  # 2 Pa effective, for 1 s
    >>> windowed_mean_square(steady, 0.01, (0.0, 1.0), np.array([0.5]), np.array([0.2]))
    array([4.])
    """
    edges = np.clip(np.arange(tick_energy.shape[-1] + 1) * tick_s, *measured_s)
    length = np.diff(edges)
    power = tick_energy / np.where(length > 0.0, length, 1.0)
    mean = np.full((*tick_energy.shape[:-1], middle_s.size), np.nan)
    begin_s, end_s = middle_s - 0.5 * duration_s, middle_s + 0.5 * duration_s
    first = np.clip(np.searchsorted(edges, begin_s, "right") - 1, 0, length.size - 1)
    last = np.clip(np.searchsorted(edges, end_s, "left"), 1, length.size)
    for block in range(middle_s.size):
        some = slice(first[block], last[block])
        turns = (edges[first[block] : last[block] + 1] - begin_s[block]) / duration_s[block]
        weights = np.diff(_window_energy(turns))
        if weights.sum() >= 0.5:
            mean[..., block] = power[..., some] @ weights / weights.sum()
    return mean


def _window_energy(share: Array) -> Array:
    """Energy of a Hann window from its start to a share of its length, of 1 at its end.

    ∫ sin⁴(πu) du · 8/3 = u - 2 sin(2πu) / (3π) + sin(4πu) / (12π).
    """
    u = np.clip(share, 0.0, 1.0)
    swing = np.sin(2.0 * np.pi * u) * 2.0 / 3.0 - np.sin(4.0 * np.pi * u) / 12.0
    return np.asarray(u - swing / np.pi)
