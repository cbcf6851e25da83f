"""Orders of a recording, labelled: by block, at operating points, over the revolution."""

import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray, IndexArray
from ..base.decibel import level_of_power
from ..base.errors import ParameterError
from ..base.vocabulary import stamp
from ..study.order_analysis import LEAST_BLOCKS, OrderAnalysis
from .analysis_defaults import highest_order
from .angular_plan import AngularPlan
from .block_orders import WINDOW, OrdersOfBlocks, is_steady
from .branches import DWELL, Names, branch_of_blocks, load_levels
from .crank_motion import CrankMotion
from .pulse_faults import PulseFault
from .synchronous_average import RevolutionAverage


def angular_plan(
    rate_hz: float, samples: int, motion: CrankMotion, settings: OrderAnalysis
) -> AngularPlan:
    """Plan of a recording over the crank angle, up to the highest order that the settings need."""
    return AngularPlan(rate_hz, samples, motion, highest_order(settings))


def recorded_orders(
    channel: xr.DataArray, blocks: OrdersOfBlocks, settings: OrderAnalysis
) -> xr.Dataset:
    """Orders of every block and at every operating point, and the mean spectrum.

    Parameters
    ----------
    channel : names, with `channel_unit` and `calibration_factor`
    blocks : blocks of the recording
    settings : the orders that are wanted
    """
    block_speed = 60.0 * blocks.shaft_frequency_hz
    branch = branch_of_blocks(block_speed, order_square(blocks.phasor))
    for name in np.unique(branch[np.char.startswith(branch, DWELL)]):
        _warn_of_load(str(name), order_square(blocks.phasor)[branch == name])
    speeds, branches, point = points_of_branches(block_speed, branch, settings.speed_step_rpm)
    at_points = mean_orders(blocks.phasor, blocks.rms, point, speeds.size)
    by_line = {"channel": channel["channel"], "map_order": blocks.map_order}
    by_block = {
        "channel": channel["channel"],
        "block": np.arange(blocks.time_s.size),
        "order": blocks.order,
    }
    by_speed = {"channel": channel["channel"], "speed": speeds, "order": by_block["order"]}
    labelled = {
        **{name: stamp(name, values, by_speed) for name, values in at_points.items()},
        "block_order": stamp("block_order", blocks.phasor, by_block),
        "block_order_rms": stamp("block_order_rms", blocks.rms, by_block),
        "mean_order_spectrum": stamp("mean_order_spectrum", blocks.mean_spectrum, by_line),
    }
    if blocks.amplitude is not None:
        by_map = {**by_line, "block": by_block["block"]}
        labelled["order_map"] = stamp("order_map", blocks.amplitude, by_map)
    coords = {
        "block_time": ("block", blocks.time_s),
        "block_speed": ("block", block_speed),
        "branch": ("speed", branches),
        "block_count": ("speed", np.bincount(point[point >= 0], minlength=speeds.size)),
        "channel_unit": channel["channel_unit"],
        "calibration_factor": channel["calibration_factor"],
    }
    return xr.Dataset(labelled, coords=coords)


class LoadWarning(UserWarning):
    """The orders of a steady speed stay at two levels: their mean is of neither."""


def _warn_of_load(branch: str, square: Array) -> None:
    """Name two levels of the orders of a branch of steady speed."""
    levels = load_levels(square)
    if levels is not None:
        low, high, louder = levels
        warnings.warn(
            f"{branch}: the orders stay at two levels, {level_of_power(high / low):.3g} dB apart, "
            f"in {louder} and {square.size - louder} blocks, as of two loads: the mean is of "
            "neither; choose a part by from_s and to_s",
            LoadWarning,
            stacklevel=4,
        )


def operating_points(block_speed_rpm: Array, speed_step_rpm: float) -> tuple[Array, IndexArray]:
    """Speeds (point,) that the blocks belong to, rpm, and the point of each block (block,).

    A steady speed is one point, at its mean; a run-up has one at every multiple of the step to
    which a block is nearest.
    """
    mean = float(np.mean(block_speed_rpm))
    if is_steady(block_speed_rpm):
        return np.array([mean]), np.zeros(block_speed_rpm.size, dtype=np.intp)
    nearest = np.maximum(np.rint(block_speed_rpm / speed_step_rpm), 1.0)
    numbers, point = np.unique(nearest, return_inverse=True)
    return speed_step_rpm * numbers, point


def points_of_branches(
    block_speed_rpm: Array, branch: Names, speed_step_rpm: float
) -> tuple[Array, Names, IndexArray]:
    """Operating points of each branch, in the order of time; see `operating_points`.

    Parameters
    ----------
    block_speed_rpm : shape (block,)
    branch : branch of each block, shape (block,); empty where it has none
    speed_step_rpm : step of the operating points of a run-up

    Returns
    -------
    speeds, rpm, and branches, shape (point,); point of each block, shape (block,), or -1
    """
    names = list(dict.fromkeys(branch[branch != ""].tolist()))
    speeds: list[float] = []
    branches: list[str] = []
    point = np.full(block_speed_rpm.size, -1, dtype=np.intp)
    for name in names:
        of_name = branch == name
        of_branch, position = operating_points(block_speed_rpm[of_name], speed_step_rpm)
        point[of_name] = len(speeds) + position
        speeds += of_branch.tolist()
        branches += [name] * of_branch.size
    return np.array(speeds), np.array(branches), point


def order_square(lines: ComplexArray) -> Array:
    """Square of the orders in each block, each channel over its greatest, shape (block,).

    Parameters
    ----------
    lines : complex peaks, shape (channel, block, order)
    """
    square = np.sum(np.abs(lines) ** 2, axis=-1)
    greatest = square.max(axis=1, keepdims=True)
    return np.asarray(np.sum(square / np.where(greatest > 0.0, greatest, 1.0), axis=0))


def mean_orders(
    lines: ComplexArray, rms: Array, point: IndexArray, number: int
) -> dict[str, Array | ComplexArray]:
    """Coherent mean, root mean power and coherence of the blocks of each operating point.

    The coherence |mean X|² / mean |X|² of one block is 1 whatever it holds, of n blocks of noise
    about 1/n: with fewer than `LEAST_BLOCKS` it is not a number.

    Parameters
    ----------
    lines : complex peaks, shape (channel, block, order)
    rms : in the orders' bands, same shape
    point : operating point of each block, shape (block,); -1 where it has none
    number : number of operating points

    Returns
    -------
    `channel_order`, `channel_order_rms`, `channel_order_coherence`, shape (channel, point, order)
    """
    member = np.equal.outer(np.arange(number), point).astype(float)
    count = member.sum(axis=1, keepdims=True)
    share = member / count
    mean = np.einsum("pb,cbo->cpo", share, lines)
    power = np.einsum("pb,cbo->cpo", share, np.abs(lines) ** 2)
    coherence = np.abs(mean) ** 2 / np.maximum(power, np.finfo(float).tiny)
    return {
        "channel_order": mean,
        "channel_order_rms": np.sqrt(np.einsum("pb,cbo->cpo", share, rms**2)),
        "channel_order_coherence": np.where(count < LEAST_BLOCKS, np.nan, coherence),
    }


def synchronous_average(channel: xr.DataArray, revolutions: RevolutionAverage) -> xr.Dataset:
    """Mean revolution of the channels and its standard error.

    Where there are fewer than two revolutions it is omitted: the attribute `left_out` says why.
    """
    try:
        average = revolutions.result()
    except ParameterError as error:
        return xr.Dataset(attrs={"left_out": f"synchronous average: {error}"})
    samples = average.mean.shape[-1]
    angle = 2.0 * np.pi * np.arange(samples) / samples
    coords = {"channel": channel["channel"], "average_angle": angle}
    values = {
        "synchronous_average": average.mean,
        "synchronous_average_error": average.standard_error,
    }
    return xr.Dataset({name: stamp(name, value, coords) for name, value in values.items()})


def fault_times(faults: Sequence[PulseFault]) -> xr.Dataset:
    """Return the times at which pulses of the tacho were missing or double; empty without
    faults."""
    if not faults:
        return xr.Dataset()
    names = [f"{number} {fault.kind}" for number, fault in enumerate(faults, 1)]
    times = [fault.time_s for fault in faults]
    return xr.Dataset({"fault_time": stamp("fault_time", times, {"fault": names})})


def resolution(blocks: OrdersOfBlocks) -> dict[str, Any]:
    """Attributes on the order resolution of the blocks."""
    return {
        "window": WINDOW,
        "revolutions_per_block": blocks.revolutions,
        "resolution_order": blocks.resolution_order,
        "band_order": blocks.band_order,
    }
