"""One pass over the blocks of a recording: orders, their average and levels."""

from collections import ChainMap, Counter
from collections.abc import Sequence
from dataclasses import replace
from typing import Final

import numpy as np
import xarray as xr
from scipy.interpolate import PPoly

from ..base.progress import Progress
from ..base.recording_blocks import RecordingBlocks, block_by_block
from ..levels.recorded import PressureLevels
from ..orders import recorded as of_recording
from ..orders.angular_plan import known_samples
from ..orders.angular_stream import AngularStream
from ..orders.block_orders import MOST_UNASKED_MAP_BYTES, BlockOrders, map_size
from ..orders.crank_motion import CrankMotion
from ..orders.fitted_orders import FittedOrders
from ..orders.loud_lines import MOST_LOUDEST
from ..orders.synchronous_average import RevolutionAverage
from ..recordings.measured_function import DERIVATIVES
from ..study.order_analysis import OrderAnalysis
from .vibration import VibrationLevels

_PARTS: Final = 16
"""Parts of a long recording in which its loudest orders are looked for."""
_PART_SHARE: Final = 0.05
"""Share of the recording that the parts have together."""


def passed_over(
    recording: RecordingBlocks,
    names: Sequence[str],
    motion: CrankMotion,
    settings: OrderAnalysis,
    progress: Progress,
) -> xr.Dataset:
    """Orders, average and levels of the channels, in one pass over the blocks of a recording.

    Attributes: the resolution, what is omitted.
    """
    if settings.is_fit:
        return _fitted(recording, names, motion, settings)
    rate_hz, samples = recording.sample_rate_hz, recording.samples
    channel = _labels(recording, names)
    plan = of_recording.angular_plan(rate_hz, samples, motion, settings)
    _, blocks, lines = map_size(plan, settings)
    if not settings.orders and 16 * len(names) * blocks * lines > MOST_UNASKED_MAP_BYTES:
        loudest = _loudest_of_parts(recording, names, motion, settings)
        settings = replace(settings, orders=loudest)
    stream = AngularStream(plan, len(names))
    orders = BlockOrders(plan, len(names), settings)
    average = RevolutionAverage(plan.samples_per_revolution)
    sound, vibration = _offsets(recording, names)
    levels = PressureLevels(channel, samples, rate_hz, sound, settings.bands)
    severity = VibrationLevels(channel, samples, rate_hz, vibration)
    passed = 0
    for block in block_by_block(recording, names):
        progress("orders", passed, samples)
        angular = stream.add(block)
        orders.add(angular)
        average.add(angular)
        levels.add(block)
        severity.add(block)
        passed += block.shape[1]
    progress("orders", samples, samples)
    of_blocks = orders.result(channel["channel_unit"].values == "Pa")
    results = of_recording.recorded_orders(channel, of_blocks, settings)
    averages = of_recording.synchronous_average(channel, average)
    in_db = levels.result()
    over_blocks = levels.over_blocks(of_blocks.time_s, of_blocks.duration_s)
    moving = severity.result(of_blocks.time_s, of_blocks.duration_s)
    results = results.merge(averages).merge(in_db).merge(over_blocks).merge(moving)
    about = (averages.attrs, in_db.attrs, moving.attrs)
    results.attrs = {**of_recording.resolution(of_blocks), **ChainMap(*about)}
    return results


def _loudest_of_parts(
    recording: RecordingBlocks, names: Sequence[str], motion: CrankMotion, settings: OrderAnalysis
) -> tuple[float, ...]:
    """Loudest orders of parts of a long recording, whose map is too large to be kept."""
    rate_hz = recording.sample_rate_hz
    units = _labels(recording, names)["channel_unit"].values
    covered = known_samples(motion, rate_hz, recording.samples)
    loudest: Counter[float] = Counter()
    starts = np.linspace(*covered, _PARTS, endpoint=False).astype(int)
    length = int(_PART_SHARE * (covered[1] - covered[0]) / _PARTS)
    for first in starts.tolist():
        part = CrankMotion(PPoly(motion.curve.c, motion.curve.x - first / rate_hz))
        plan = of_recording.angular_plan(rate_hz, length, part, settings)
        orders = BlockOrders(plan, len(names), settings)
        stream = AngularStream(plan, len(names))
        orders.add(stream.add(recording.read(names, first, first + length)))
        loudest.update(orders.result(units == "Pa").order.tolist())
    return tuple(sorted(order for order, _ in loudest.most_common(MOST_LOUDEST)))


def _fitted(
    recording: RecordingBlocks, names: Sequence[str], motion: CrankMotion, settings: OrderAnalysis
) -> xr.Dataset:
    """Orders by one fit to the whole recording, and levels; without a synchronous average."""
    rate_hz, samples = recording.sample_rate_hz, recording.samples
    channel = _labels(recording, names)
    orders = FittedOrders(rate_hz, samples, len(names), motion, settings)
    sound, vibration = _offsets(recording, names)
    levels = PressureLevels(channel, samples, rate_hz, sound, settings.bands)
    severity = VibrationLevels(channel, samples, rate_hz, vibration)
    for block in block_by_block(recording, names):
        orders.add(block)
        levels.add(block)
        severity.add(block)
    fitted, in_db, moving = orders.result(), levels.result(), severity.result()
    results = of_recording.recorded_orders(channel, fitted, settings).merge(in_db).merge(moving)
    window = "least squares, hann" if orders.is_tapered else "least squares, rectangular"
    omitted = {"left_out": "synchronous average: orders are fitted to the whole recording"}
    results.attrs = {
        **of_recording.resolution(fitted), "window": window, **omitted, **in_db.attrs,
        **moving.attrs,
    }  # fmt: skip
    return results


def _labels(recording: RecordingBlocks, names: Sequence[str]) -> xr.DataArray:
    """Names of channels, with their units and calibration factors."""
    rows = [recording.channels.index(name) for name in names]
    coords = {
        "channel": list(names),
        "channel_unit": ("channel", [recording.channel_units[row] for row in rows]),
        "calibration_factor": ("channel", [recording.calibration_factors[row] for row in rows]),
    }
    return xr.Dataset(coords=coords)["channel"]


def _offsets(
    recording: RecordingBlocks, names: Sequence[str]
) -> tuple[dict[int, float], dict[int, float]]:
    """Means of the channels of sound pressure, and of vibration, by position among the names."""
    units = dict(zip(recording.channels, recording.channel_units, strict=True))
    averaged = [name for name in names if units[name] in ("Pa", *DERIVATIVES)]
    if not averaged:
        return {}, {}
    sums = [block.sum(axis=1) for block in block_by_block(recording, averaged)]
    means = dict(zip(averaged, np.sum(sums, axis=0) / recording.samples, strict=True))
    sound, vibration = (
        {
            names.index(name): float(mean)
            for name, mean in means.items()
            if (units[name] == "Pa") is is_sound
        }
        for is_sound in (True, False)
    )
    return sound, vibration
