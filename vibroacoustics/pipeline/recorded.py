"""Order analysis of a recording: speed, crank angle, orders, levels."""

from dataclasses import asdict
from typing import Any, Final

import numpy as np
import xarray as xr

from .. import levels, orders
from ..base.arrays import Array, ComplexArray, IndexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.errors import VibroacousticsError
from ..base.hashing import canonical_json
from ..base.vocabulary import (
    WEIGHTINGS,
    check,
    label_coordinates,
    stamp,
)
from ..results import provenance
from ..study.order_analysis import OrderAnalysis
from .progress import Progress
from .recorded_speed import RecordedSpeed, channels_without_speed, recorded_speed

STEADY_RATIO: Final = 0.02
"""A speed that stays within this share of its mean makes one operating point."""
_LOWEST_BAND_HZ: Final = 25.0
_WINDOW: Final = "hann"
_HALF_LOBE: Final = 4.0 / 3.0
"""Half of the window's main lobe over its noise bandwidth: room for the highest order's band."""
_STAGES: Final = 4


def analyse_orders(
    recording: xr.Dataset, settings: OrderAnalysis, progress: Progress = lambda *_: None
) -> xr.Dataset:
    """Orders and levels of every channel of a recording.

    Parameters
    ----------
    recording : from `read_recording` or `label_recording`
    settings : where the speed comes from, and which orders are wanted
    progress : told of the advance

    Raises
    ------
    ParameterError, SolverError
        The speed cannot be found, or an order cannot be told at the resolution.
    """
    try:
        return _analyse(recording, settings, progress)
    except VibroacousticsError as error:
        raise type(error)(f"{_source(recording)}: {error}") from None


def _analyse(recording: xr.Dataset, settings: OrderAnalysis, progress: Progress) -> xr.Dataset:
    progress("orders", 0, _STAGES)
    speed = recorded_speed(recording, settings.speed)
    signal = channels_without_speed(recording["signal"], settings.speed)
    rate_hz = float(recording.attrs["sample_rate_hz"])
    progress("orders", 1, _STAGES)
    highest = max(
        settings.maximum_order, max(settings.orders) + _HALF_LOBE * settings.resolution_order
    )
    angular = orders.angular_resample(signal.values, rate_hz, speed.motion, highest)
    progress("orders", 2, _STAGES)
    spectra = orders.order_map(angular, settings.resolution_order, _WINDOW)
    phasors = orders.block_phasors(angular, spectra, settings.orders)
    results = _order_variables(signal, spectra, phasors, settings)
    results = results.merge(_average(signal, angular))
    if speed.faults:
        results = results.merge(_faults(speed.faults))
    progress("orders", 3, _STAGES)
    results = results.merge(_levels(signal, rate_hz))
    progress("orders", 4, _STAGES)
    results.attrs = _attributes(recording, settings, spectra, speed)
    return check(label_coordinates(results))


def _source(recording: xr.Dataset) -> str:
    return str(recording.attrs.get("source_file", "recording"))


def _order_variables(
    signal: xr.DataArray,
    spectra: orders.OrderMap,
    phasors: ComplexArray,
    settings: OrderAnalysis,
) -> xr.Dataset:
    """Orders of every block and at every operating point, and the mean spectrum."""
    block_speed = 60.0 * spectra.shaft_frequency_hz
    speeds, point = operating_points(block_speed, settings.speed_step_rpm)
    rms = orders.order_cut(spectra, settings.orders).rms
    mean, effective, coherence = _at_points(phasors, rms, point, speeds.size)
    by_block = {
        "channel": signal["channel"],
        "block": np.arange(spectra.time_s.size),
        "order": np.array(settings.orders),
    }
    by_speed = {"channel": signal["channel"], "speed": speeds, "order": by_block["order"]}
    by_line = {"channel": signal["channel"], "map_order": spectra.order}
    found = {
        "channel_order": stamp("channel_order", mean, by_speed),
        "channel_order_rms": stamp("channel_order_rms", effective, by_speed),
        "channel_order_coherence": stamp("channel_order_coherence", coherence, by_speed),
        "block_order": stamp("block_order", phasors, by_block),
        "block_order_rms": stamp("block_order_rms", rms, by_block),
        "mean_order_spectrum": stamp(
            "mean_order_spectrum", orders.mean_order_spectrum(spectra), by_line
        ),
    }
    if settings.with_map:
        by_map = {**by_line, "block": by_block["block"]}
        found["order_map"] = stamp("order_map", spectra.amplitude, by_map)
    return xr.Dataset(
        found,
        coords={
            "block_time": ("block", spectra.time_s),
            "block_speed": ("block", block_speed),
            "block_count": ("speed", np.bincount(point, minlength=speeds.size)),
            "channel_unit": signal["channel_unit"],
            "calibration_factor": signal["calibration_factor"],
        },
    )


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
) -> tuple[ComplexArray, Array, Array]:
    """Coherent mean, root mean power and coherence, (channel, point, order), of the blocks."""
    member = np.equal.outer(np.arange(number), point).astype(float)
    share = member / member.sum(axis=1, keepdims=True)
    mean = np.einsum("pb,cbo->cpo", share, lines)
    power = np.einsum("pb,cbo->cpo", share, np.abs(lines) ** 2)
    coherence = np.abs(mean) ** 2 / np.maximum(power, np.finfo(float).tiny)
    return mean, np.sqrt(np.einsum("pb,cbo->cpo", share, rms**2)), coherence


def _average(signal: xr.DataArray, angular: orders.AngularSignal) -> xr.Dataset:
    average = orders.time_synchronous_average(angular)
    samples = angular.samples_per_revolution
    angle = 2.0 * np.pi * np.arange(samples) / samples
    coords = {"channel": signal["channel"], "average_angle": angle}
    values = {"": average.mean, "_error": average.standard_error}
    return xr.Dataset(
        {
            f"synchronous_average{name}": stamp(f"synchronous_average{name}", value, coords)
            for name, value in values.items()
        }
    )


def _faults(faults: tuple[orders.PulseFault, ...]) -> xr.Dataset:
    names = [f"{number} {fault.kind}" for number, fault in enumerate(faults, 1)]
    times = [fault.time_s for fault in faults]
    return xr.Dataset({"fault_time": stamp("fault_time", times, {"fault": names})})


def _levels(signal: xr.DataArray, rate_hz: float) -> xr.Dataset:
    """Levels of the channels of sound pressure; not a number for others, which have no reference.

    A recording without sound pressure has none. An offset is no sound and is taken off.
    """
    pressure = signal["channel_unit"].values == "Pa"
    if not pressure.any():
        return xr.Dataset()
    bands = levels.measurable_bands(levels.bands_between(3, _LOWEST_BAND_HZ, 20e3), rate_hz)
    shape = (signal.sizes["channel"], len(WEIGHTINGS))
    names = ("equivalent", "fast_maximum", "slow_maximum")
    whole = {name: np.full(shape, np.nan) for name in names}
    in_bands = np.full((*shape, len(bands)), np.nan)
    values = signal.values[pressure]
    sound = (values - values.mean(axis=-1, keepdims=True), rate_hz)
    for number, weighting in enumerate(WEIGHTINGS):
        told = levels.recorded_levels(*sound, REFERENCE_PRESSURE_PA, weighting)
        for name in names:
            whole[name][pressure, number] = getattr(told, f"{name}_db")
        in_bands[pressure, number] = levels.band_levels(
            *sound, bands, REFERENCE_PRESSURE_PA, weighting
        )
    coords = {"channel": signal["channel"], "weighting": list(WEIGHTINGS)}
    by_band = {**coords, "band": [band.nominal_hz for band in bands]}
    return xr.Dataset(
        {
            **{f"{name}_level": stamp(f"{name}_level", whole[name], coords) for name in names},
            "band_level": stamp("band_level", in_bands, by_band),
        }
    )


def _attributes(
    recording: xr.Dataset,
    settings: OrderAnalysis,
    spectra: orders.OrderMap,
    speed: RecordedSpeed,
) -> dict[str, Any]:
    source = _source(recording)
    kept = ("source_sha256", "start_time", "sample_rate_hz")
    parameters = asdict(settings) | {"orders": [float(order) for order in settings.orders]}
    return {
        **provenance.software_attributes(
            f"orders of {source}", provenance.RECORDING_SCHEMA_VERSION
        ),
        "title": f"Orders of {source}",
        "source_file": source,
        **{name: recording.attrs[name] for name in kept if name in recording.attrs},
        "speed_source": speed.source,
        "angle_zero": speed.angle_zero,
        **speed.quality,
        "tacho_faults": len(speed.faults),
        "window": _WINDOW,
        "revolutions_per_block": spectra.revolutions,
        "resolution_order": spectra.resolution_order,
        "band_order": spectra.main_lobe_order,
        "analysis": canonical_json(parameters),
    }
