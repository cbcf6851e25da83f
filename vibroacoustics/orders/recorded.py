"""Orders of a recording, labelled: by block, at operating points, over the revolution."""

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray, IndexArray
from ..base.errors import ParameterError
from ..base.vocabulary import stamp
from ..study.order_analysis import OrderAnalysis
from .angular import AngularSignal, angular_resample
from .crank_motion import CrankMotion
from .order_cut import order_cut
from .order_map import OrderMap, block_phasors, mean_order_spectrum
from .pulse_faults import PulseFault
from .synchronous import time_synchronous_average

STEADY_RATIO: Final = 0.02
"""A speed that stays within this share of its mean makes one operating point."""
WINDOW: Final = "hann"
_HALF_LOBE: Final = 4.0 / 3.0
"""Half of the window's main lobe over its noise bandwidth: room for the highest order's band."""


def resampled(
    signal: xr.DataArray, rate_hz: float, motion: CrankMotion, settings: OrderAnalysis
) -> AngularSignal:
    """The channels over the crank angle, up to the highest order that the settings need."""
    highest = max(
        settings.maximum_order, max(settings.orders) + _HALF_LOBE * settings.resolution_order
    )
    return angular_resample(signal.values, rate_hz, motion, highest)


def recorded_orders(
    signal: xr.DataArray, angular: AngularSignal, spectra: OrderMap, settings: OrderAnalysis
) -> xr.Dataset:
    """Orders of every block and at every operating point, and the mean spectrum.

    Parameters
    ----------
    signal : channels over time
    angular : the same over the crank angle
    spectra : of its blocks
    settings : the orders that are wanted
    """
    phasors = block_phasors(angular, spectra, settings.orders)
    rms = order_cut(spectra, settings.orders).rms
    block_speed = 60.0 * spectra.shaft_frequency_hz
    speeds, point = operating_points(block_speed, settings.speed_step_rpm)
    at_points = _at_points(phasors, rms, point, speeds.size)
    by_line = {"channel": signal["channel"], "map_order": spectra.order}
    by_block = {
        "channel": signal["channel"],
        "block": np.arange(spectra.time_s.size),
        "order": np.array(settings.orders),
    }
    by_speed = {"channel": signal["channel"], "speed": speeds, "order": by_block["order"]}
    labelled = {
        **{name: stamp(name, values, by_speed) for name, values in at_points.items()},
        "block_order": stamp("block_order", phasors, by_block),
        "block_order_rms": stamp("block_order_rms", rms, by_block),
        "mean_order_spectrum": stamp("mean_order_spectrum", mean_order_spectrum(spectra), by_line),
    }
    if settings.with_map:
        by_map = {**by_line, "block": by_block["block"]}
        labelled["order_map"] = stamp("order_map", spectra.amplitude, by_map)
    coords = {
        "block_time": ("block", spectra.time_s),
        "block_speed": ("block", block_speed),
        "block_count": ("speed", np.bincount(point, minlength=speeds.size)),
        "channel_unit": signal["channel_unit"],
        "calibration_factor": signal["calibration_factor"],
    }
    return xr.Dataset(labelled, coords=coords)


def operating_points(block_speed_rpm: Array, speed_step_rpm: float) -> tuple[Array, IndexArray]:
    """Speeds (point,) that the blocks belong to, rpm, and the point of each block (block,).

    A steady speed is one point, at its mean; a run-up has one at every multiple of the step to
    which a block is nearest.
    """
    mean = float(np.mean(block_speed_rpm))
    if np.ptp(block_speed_rpm) <= STEADY_RATIO * mean:
        return np.array([mean]), np.zeros(block_speed_rpm.size, dtype=np.intp)
    nearest = np.maximum(np.rint(block_speed_rpm / speed_step_rpm), 1.0)
    numbers, point = np.unique(nearest, return_inverse=True)
    return speed_step_rpm * numbers, point


def _at_points(
    lines: ComplexArray, rms: Array, point: IndexArray, number: int
) -> dict[str, Array | ComplexArray]:
    """Coherent mean, root mean power and coherence, (channel, point, order), of the blocks."""
    member = np.equal.outer(np.arange(number), point).astype(float)
    share = member / member.sum(axis=1, keepdims=True)
    mean = np.einsum("pb,cbo->cpo", share, lines)
    power = np.einsum("pb,cbo->cpo", share, np.abs(lines) ** 2)
    return {
        "channel_order": mean,
        "channel_order_rms": np.sqrt(np.einsum("pb,cbo->cpo", share, rms**2)),
        "channel_order_coherence": np.abs(mean) ** 2 / np.maximum(power, np.finfo(float).tiny),
    }


def synchronous_average(signal: xr.DataArray, angular: AngularSignal) -> xr.Dataset:
    """Mean revolution of the channels and its standard error.

    Where there are fewer than two revolutions it is left out: the attribute `left_out` says why.
    """
    try:
        average = time_synchronous_average(angular)
    except ParameterError as error:
        return xr.Dataset(attrs={"left_out": f"synchronous average: {error}"})
    samples = angular.samples_per_revolution
    angle = 2.0 * np.pi * np.arange(samples) / samples
    coords = {"channel": signal["channel"], "average_angle": angle}
    values = {
        "synchronous_average": average.mean,
        "synchronous_average_error": average.standard_error,
    }
    return xr.Dataset({name: stamp(name, value, coords) for name, value in values.items()})


def fault_times(faults: Sequence[PulseFault]) -> xr.Dataset:
    """When pulses of the tacho were missing or double; empty without faults."""
    if not faults:
        return xr.Dataset()
    names = [f"{number} {fault.kind}" for number, fault in enumerate(faults, 1)]
    times = [fault.time_s for fault in faults]
    return xr.Dataset({"fault_time": stamp("fault_time", times, {"fault": names})})


def resolution(spectra: OrderMap) -> dict[str, Any]:
    """Attributes that say how finely the blocks tell orders apart."""
    return {
        "window": WINDOW,
        "revolutions_per_block": spectra.revolutions,
        "resolution_order": spectra.resolution_order,
        "band_order": spectra.main_lobe_order,
    }
