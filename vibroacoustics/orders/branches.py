"""Branches of a recording: run-up, coast-down, dwell; running and idle at a steady speed.

A machine at one speed need not be in one state: warm or cold, accelerating or braking. Blocks of
different branches are never averaged.
"""

from collections import Counter, deque
from collections.abc import Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation, median_filter

from ..base.arrays import Array
from ..study.order_analysis import LEAST_BLOCKS

RUN_UP: Final = "run-up"
COAST_DOWN: Final = "coast-down"
DWELL: Final = "dwell"
IDLE: Final = "idle"
_TURN_RATIO: Final = 0.1
"""Change of the speed, relative, that makes a run-up or a coast-down."""
_LEVEL_RATIO: Final = 0.02
"""Range of the speed, relative, within which it dwells."""
_LONGER: Final = 6.0
"""Duration of a dwell over that of an equal change beside it: 4.8 at the vertex of a parabola, 2 at
that of a triangle, 1 on a ramp."""
_MOST_NUMBERED: Final = 6
"""Branches of one kind that are separate; more are a speed that swings."""
_SILENT_RATIO: Final = 0.1
"""Mean square of the orders, over that of the running machine, of one that is idle."""
_RUNNING_RATIO: Final = 0.5
"""Mean square of one that starts or stops, at most."""
_MOST_BETWEEN: Final = 0.2
"""Share of the blocks between both: a machine starts and stops faster than a beat of two tones."""
_LOUDER: Final = 1.26
"""Ratio of the mean squares of two levels: 1 dB."""
_CLEARLY: Final = 8.0
"""Distance of two levels, over the scatter of the blocks; of a beat it is below 5."""
_SMOOTHED_BLOCKS: Final = 5
_RAMP_BLOCKS: Final = 4
"""Blocks beside a start or stop whose orders are near the speed, with a phase that turns."""

Names = NDArray[np.str_]


def branch_of_blocks(speed_rpm: Array, order_square: Array) -> Names:
    """Branch of each block, shape (block,); empty at the border of two branches.

    A change of the speed by 10 % is a run-up or a coast-down. A dwell keeps within 2 %, for six
    times as long as the speed takes for the next 2 %. Several branches of a kind are numbered. A
    recording of one steady speed is one dwell, apart from blocks in which its orders are silent.

    Parameters
    ----------
    speed_rpm : mean speed of each block, in the order of time, shape (block,)
    order_square : mean square of the orders in each block, of all channels, shape (block,); counts
        at a steady speed only
    """
    speed = np.log(speed_rpm)
    if np.ptp(speed) < _TURN_RATIO:
        pieces = list(_pieces(states_of_blocks(order_square)))
    else:
        pieces = _moving_pieces(speed, np.asarray(1.0 / speed_rpm))
    return _named(pieces, speed.size)


def states_of_blocks(order_square: Array) -> Names:
    """State of each block of a steady speed: dwell, idle, or empty in a start or stop.

    Orders are silent, 10 dB below the running machine, in an idle one. Nothing is idle where the
    level has no two states, or where fewer than eight blocks in a row are silent.

    Parameters
    ----------
    order_square : mean square of the orders in each block, shape (block,)
    """
    smooth = median_filter(order_square, min(_SMOOTHED_BLOCKS, order_square.size), mode="nearest")
    running = float(np.quantile(smooth, 0.95))
    is_silent = smooth < _SILENT_RATIO * running
    is_between = ~is_silent & (smooth < _RUNNING_RATIO * running)
    is_near = binary_dilation(is_silent | is_between, iterations=_RAMP_BLOCKS)
    states = np.where(is_silent, IDLE, np.where(is_near, "", DWELL))
    lengths = [last - first for kind, first, last in _pieces(states) if kind == IDLE]
    if min(lengths, default=0) < LEAST_BLOCKS or np.mean(is_between) > _MOST_BETWEEN:
        return np.full(smooth.size, DWELL)
    return states


def load_levels(order_square: Array) -> tuple[float, float, int] | None:
    """Mean squares of two levels at which the orders of a dwell stay, and blocks at the second.

    Two levels are 1 dB or more apart, eight times as far as the blocks scatter about them, and
    change at most a few times: those of noise, a beat or a slow drift are not. None of one level.

    Parameters
    ----------
    order_square : mean square of the orders in each block, shape (block,)
    """
    smooth = median_filter(order_square, min(_SMOOTHED_BLOCKS, order_square.size), mode="nearest")
    ranked = np.sort(smooth)
    jumps = np.diff(ranked)[LEAST_BLOCKS - 1 : ranked.size - LEAST_BLOCKS]
    if not jumps.any():
        return None
    is_high = smooth > ranked[LEAST_BLOCKS - 1 + int(np.argmax(jumps))]
    low, high = (float(smooth[part].mean()) for part in (~is_high, is_high))
    scatter = max(float(smooth[part].std()) for part in (~is_high, is_high))
    changes = np.count_nonzero(is_high[1:] != is_high[:-1])
    if changes > _MOST_NUMBERED or high < _LOUDER * low or high - low < _CLEARLY * scatter:
        return None
    return low, high, int(np.count_nonzero(is_high))


Piece = tuple[str, int, int]
"""Kind of a branch, its first block and the one after its last."""


def _pieces(kinds: Names) -> Iterator[Piece]:
    """Runs of blocks of one kind."""
    starts = np.flatnonzero(np.concatenate([[True], kinds[1:] != kinds[:-1]]))
    for first, last in zip(starts, np.append(starts[1:], kinds.size), strict=True):
        yield str(kinds[first]), int(first), int(last)


def _named(pieces: list[Piece], blocks: int) -> Names:
    """Name of the branch of each block; the blocks at both sides of a border have none."""
    names = np.full(blocks, "", dtype=object)
    total, count = Counter(kind for kind, _, _ in pieces), Counter[str]()
    for kind, first, last in pieces:
        count[kind] += 1
        is_numbered = 1 < total[kind] <= _MOST_NUMBERED
        if not kind:
            continue
        inner = slice(first + (2 if first else 0), last - (2 if last < blocks else 0))
        names[inner] = f"{kind} {count[kind]}" if is_numbered else kind
    if not (names != "").any():  # a few blocks
        names[:] = max(pieces, key=lambda piece: piece[2] - piece[1])[0]
    return np.asarray(names, dtype=str)


def _moving_pieces(speed: Array, duration: Array) -> list[Piece]:
    """Dwells and what is between them, of the logarithm of the speed."""
    levels = _dwells(speed, np.concatenate([[0.0], np.cumsum(duration)]))
    pieces, begin = [], 0
    for first, last in [*levels, (speed.size, speed.size)]:
        pieces += _monotone(speed, begin, first)
        pieces += [(DWELL, first, last)] if last > first else []
        begin = last
    return pieces


def _monotone(speed: Array, first: int, last: int) -> list[Piece]:
    """Run-ups and coast-downs of some blocks, which turn where the speed has changed by 10 %."""
    if last <= first:
        return []
    turns, low, high = [first], first, first
    for block in range(first + 1, last):
        low = block if speed[block] < speed[low] else low
        high = block if speed[block] > speed[high] else high
        if low < high and speed[high] - speed[block] > _TURN_RATIO and high > turns[-1]:
            turns.append(high)
            low = block
        elif high < low and speed[block] - speed[low] > _TURN_RATIO and low > turns[-1]:
            turns.append(low)
            high = block
    ends = [*turns[1:], last]
    return [
        (RUN_UP if speed[end - 1] >= speed[turn] else COAST_DOWN, turn, end)
        for turn, end in zip(turns, ends, strict=True)
    ]


def _dwells(speed: Array, time: Array) -> list[tuple[int, int]]:
    """First block of each dwell and the one after its last, in the order of time."""
    ends = _level_ends(speed, _LEVEL_RATIO)
    starts = np.arange(speed.size)
    before = speed.size - _level_ends(speed[::-1], _LEVEL_RATIO)[::-1]
    lasting = time[ends] - time[starts]
    # Durations of an equal change behind the end and before the start.
    behind = np.where(
        ends < speed.size, (time[ends[np.minimum(ends, speed.size - 1)]] - time[ends]), 0.0
    )
    former = np.where(starts > 0, time[starts] - time[before[np.maximum(starts - 1, 0)]], 0.0)
    is_dwell = (lasting > _LONGER * np.maximum(behind, former)) & (ends - starts >= LEAST_BLOCKS)
    dwells: list[tuple[int, int]] = []
    for start in np.flatnonzero(is_dwell)[np.argsort(-lasting[is_dwell], kind="stable")].tolist():
        end = int(ends[start])
        if all(end <= first or start >= last for first, last in dwells):
            dwells.append((start, end))
    return sorted(dwells)


def _level_ends(values: Array, width: float) -> NDArray[np.int64]:
    """Number after the last of the values from each one on that keep within a width."""
    ends = np.empty(values.size, dtype=np.int64)
    lowest: deque[int] = deque()
    highest: deque[int] = deque()
    end = 0
    for start in range(values.size):
        while end < values.size:
            low = min(values[lowest[0]], values[end]) if lowest else values[end]
            high = max(values[highest[0]], values[end]) if highest else values[end]
            if high - low > width:
                break
            while lowest and values[lowest[-1]] >= values[end]:
                lowest.pop()
            while highest and values[highest[-1]] <= values[end]:
                highest.pop()
            lowest.append(end)
            highest.append(end)
            end += 1
        ends[start] = end
        for queue in (lowest, highest):
            if queue and queue[0] == start:
                queue.popleft()
    return ends
