"""Order analysis of a recording: speed, crank angle, orders, levels."""

from typing import Any, Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from .. import levels, orders, provenance
from ..constants import REFERENCE_PRESSURE_PA
from ..errors import ParameterError, VibroacousticsError
from ..parameters.order_analysis import NominalSpeed, OrderAnalysis, SpeedChannel, TacholessSpeed
from ..schema import WEIGHTINGS, check, label_coordinates, stamp
from ..units import shaft_frequency_hz
from .progress import Progress

Array = NDArray[np.float64]

STEADY_RATIO: Final = 0.02
"""A speed that stays within this share of its mean makes one operating point."""
_LOWEST_BAND_HZ: Final = 25.0
_WINDOW: Final = "hann"
_HALF_LOBE: Final = 4.0 / 3.0
"""Half of the window's main lobe over its noise bandwidth: room for the highest order's band."""
_STAGES: Final = ("speed", "crank angle", "order map", "levels")


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
    source = str(recording.attrs.get("source_file", "recording"))
    try:
        return _analyse(recording, settings, progress)
    except VibroacousticsError as error:
        raise type(error)(f"{source}: {error}") from None


def _analyse(recording: xr.Dataset, settings: OrderAnalysis, progress: Progress) -> xr.Dataset:
    progress(_STAGES[0], 0, len(_STAGES))
    motion, told = crank_motion(recording, settings.speed)
    signal = _without_speed(recording["signal"], settings.speed)
    rate_hz = float(recording.attrs["sample_rate_hz"])
    progress(_STAGES[1], 1, len(_STAGES))
    highest = max(
        settings.maximum_order, max(settings.orders) + _HALF_LOBE * settings.resolution_order
    )
    angular = orders.angular_resample(signal.values, rate_hz, motion, highest)
    progress(_STAGES[2], 2, len(_STAGES))
    spectra = orders.order_map(angular, settings.resolution_order, _WINDOW)
    results = _order_variables(signal, spectra, settings).merge(_average(signal, angular))
    if told["faults"]:
        results = results.merge(_faults(told["faults"]))
    progress(_STAGES[3], 3, len(_STAGES))
    results = results.merge(_levels(signal, rate_hz))
    progress(_STAGES[3], 4, len(_STAGES))
    results.attrs = _attributes(recording, settings, spectra, told)
    return check(label_coordinates(results))


def crank_motion(
    recording: xr.Dataset, speed: SpeedChannel | NominalSpeed | TacholessSpeed
) -> tuple[orders.CrankMotion, dict[str, Any]]:
    """Crank angle over time, and what there is to tell about it: source, faults, confidence.

    Raises
    ------
    ParameterError
        There is no such channel, no pulse, or the shaft stops.
    """
    signal = recording["signal"]
    rate_hz = float(recording.attrs["sample_rate_hz"])
    if isinstance(speed, NominalSpeed):
        if not speed.speed_rpm > 0.0:
            raise ParameterError(f"speed = {speed.speed_rpm:g} rpm: must be above 0 rpm")
        end_s = (signal.sizes["time"] - 1) / rate_hz
        motion = orders.constant_speed(shaft_frequency_hz(speed.speed_rpm), 0.0, end_s)
        return motion, {"source": f"nominal {speed.speed_rpm:g} rpm", "faults": ()}
    if isinstance(speed, TacholessSpeed):
        found = orders.tacholess_motion(
            _channel(signal, speed.channel).values,
            rate_hz,
            shaft_frequency_hz(speed.minimum_rpm),
            shaft_frequency_hz(speed.maximum_rpm),
        )
        confidence = float(np.mean(found.confidence))
        source = (
            f"from the signal, within {speed.minimum_rpm:g} to {speed.maximum_rpm:g} rpm; "
            f"mean confidence {confidence:.2f} of 1"
        )
        return found.motion, {"source": source, "faults": (), "confidence": confidence}
    return _from_channel(signal, rate_hz, speed)


def _from_channel(
    signal: xr.DataArray, rate_hz: float, speed: SpeedChannel
) -> tuple[orders.CrankMotion, dict[str, Any]]:
    channel = _channel(signal, speed.channel)
    if channel["channel_unit"].item() == "rpm":
        motion = orders.rpm_motion(channel.values, rate_hz)
        return motion, {"source": f"channel {speed.channel}, rpm", "faults": ()}
    index = None
    if speed.index_channel is not None:
        index = orders.pulse_times(_channel(signal, speed.index_channel).values, rate_hz)
    pulses = orders.pulse_times(channel.values, rate_hz)
    found = orders.tacho_motion(pulses, speed.pulses_per_revolution, index)
    source = (
        f"tacho {speed.channel}, {speed.pulses_per_revolution} pulses a revolution, "
        f"jitter {100.0 * found.jitter:.2g} % of a period"
    )
    return found.motion, {"source": source, "faults": found.faults, "jitter": found.jitter}


def _channel(signal: xr.DataArray, name: str | None) -> xr.DataArray:
    """One channel by name, or the only one."""
    names = [str(channel) for channel in signal["channel"].values]
    if name is None and len(names) == 1:
        return signal.isel(channel=0)
    if name not in names:
        raise ParameterError(f"speed: no channel {name!r}; there are {', '.join(names)}")
    return signal.sel(channel=name)


def _without_speed(
    signal: xr.DataArray, speed: SpeedChannel | NominalSpeed | TacholessSpeed
) -> xr.DataArray:
    """The channels that are analysed."""
    if not isinstance(speed, SpeedChannel):
        return signal
    others = [
        name
        for name in signal["channel"].values
        if name not in (speed.channel, speed.index_channel)
    ]
    if not others:
        raise ParameterError("there is no channel besides that of the speed")
    return signal.sel(channel=others)


def _order_variables(
    signal: xr.DataArray, spectra: orders.OrderMap, settings: OrderAnalysis
) -> xr.Dataset:
    """Orders of every block and at every operating point, and the mean spectrum."""
    block_speed = 60.0 * spectra.shaft_frequency_hz
    speeds, point = operating_points(block_speed, settings.speed_step_rpm)
    lines = orders.order_lines(spectra, settings.orders)
    rms = orders.order_cut(spectra, settings.orders).rms
    mean, effective, coherence = _at_points(lines, rms, point, speeds.size)
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
        "block_order": stamp("block_order", lines, by_block),
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
            "channel_unit": signal["channel_unit"],
        },
    )


def operating_points(
    block_speed_rpm: Array, speed_step_rpm: float
) -> tuple[Array, NDArray[np.intp]]:
    """Speeds (point,) that the blocks belong to, rpm, and the point of each block (block,).

    A steady speed is one point, at its mean; a run-up has one at every multiple of the step.

    Raises
    ------
    ParameterError
        The step is not above zero.
    """
    if not speed_step_rpm > 0.0:
        raise ParameterError(f"speed_step_rpm = {speed_step_rpm:g} rpm: must be above 0 rpm")
    mean = float(np.mean(block_speed_rpm))
    if np.ptp(block_speed_rpm) <= STEADY_RATIO * mean:
        return np.array([mean]), np.zeros(block_speed_rpm.size, dtype=np.intp)
    nearest = np.maximum(np.rint(block_speed_rpm / speed_step_rpm), 1.0)
    numbers, point = np.unique(nearest, return_inverse=True)
    return speed_step_rpm * numbers, point


def _at_points(
    lines: NDArray[np.complex128], rms: Array, point: NDArray[np.intp], number: int
) -> tuple[NDArray[np.complex128], Array, Array]:
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

    A recording without sound pressure has none.
    """
    pressure = signal["channel_unit"].values == "Pa"
    if not pressure.any():
        return xr.Dataset()
    bands = levels.measurable_bands(levels.bands_between(3, _LOWEST_BAND_HZ, 20e3), rate_hz)
    shape = (signal.sizes["channel"], len(WEIGHTINGS))
    names = ("equivalent", "fast_maximum", "slow_maximum")
    whole = {name: np.full(shape, np.nan) for name in names}
    in_bands = np.full((*shape, len(bands)), np.nan)
    for number, weighting in enumerate(WEIGHTINGS):
        sound = (signal.values[pressure], rate_hz)
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
    told: dict[str, Any],
) -> dict[str, Any]:
    source = recording.attrs.get("source_file", "a recording")
    return {
        **provenance.software_attributes(f"orders of {source}"),
        "title": f"Orders of {source}",
        "source_file": source,
        "source_sha256": recording.attrs.get("source_sha256", ""),
        "sample_rate_hz": recording.attrs["sample_rate_hz"],
        "speed_source": told["source"],
        **{key: told[key] for key in ("confidence", "jitter") if key in told},
        "tacho_faults": len(told["faults"]),
        "window": _WINDOW,
        "revolutions_per_block": spectra.revolutions,
        "resolution_order": spectra.resolution_order,
        "analysis": repr(settings),
    }
