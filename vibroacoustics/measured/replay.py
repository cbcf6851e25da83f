"""A recording with an option of a study in place: its orders changed, the residual its own."""

from collections.abc import Mapping, Sequence
from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ..base.allowed import check_range
from ..base.arrays import Array
from ..base.constants import REFERENCE_BY_UNIT
from ..base.decibel import SILENCE_DB, amplitude_of_level, level_of_amplitude
from ..base.errors import ParameterError
from ..base.plain_bytes import canonical_json
from ..base.progress import Progress, no_progress
from ..orders.crank_motion import CrankMotion
from ..orders.ratio_over_speed import is_studied, ratio_over_speed
from ..orders.recorded_speed import recorded_speed
from ..orders.separated import LEAST_DISTANCE, changed_signal, separated_orders
from ..orders.vold_kalman_equations import Track
from ..recordings import LabelledBlocks
from ..results import provenance
from ..study.order_analysis import SpeedSource
from .option_ratios import (
    OptionRatios,
    OrderRatio,
    changed_noise_bands,
    check_names,
    option_ratios,
    response_units,
)
from .replayed_levels import ReplayedLine, replayed_line, summary_of

SHAFT_RATIOS: Final = (0.01, 100.0)
_LEAST_BANDWIDTH_HZ: Final = 1.0
_BELOW_NOISE: Final = "below the recording's noise"


class Replay(NamedTuple):
    """A recording before and after.

    Attributes
    ----------
    summary : levels of orders and of the whole; attribute `unchanged`: reasons by channel and line
    before, after : where the speed is known, in the unit of each channel, shape (channel, time)
    sample_rate_hz : sample rate of both

    Examples
    --------
    >>> import xarray as xr
    >>> sound = np.zeros((1, 4))
    >>> replayed = va.Replay(xr.Dataset(), sound, 0.5 * sound, 8000.0)
    >>> replayed.after.shape
    (1, 4)
    """

    summary: xr.Dataset
    before: Array
    after: Array
    sample_rate_hz: float


def replay(
    recording: xr.Dataset,
    results: xr.Dataset,
    option: str,
    pairs: Mapping[str, str],
    speed: SpeedSource,
    bandwidth_hz: float | None = None,
    orders_only: bool = False,
    shaft_ratio: float = 1.0,
    progress: Progress = no_progress,
) -> Replay:
    """Change the orders of a recording as an option of a study changes them.

    Every order that study and recording have is separated (`separated_orders`) and multiplied by
    the complex ratio with over without the option, of one sample, interpolated over the speed. All
    else in the recording stays. The part with other speeds than those of the study is omitted.

    Parameters
    ----------
    recording : from `read_recording` or `label_recording`
    results : results of a run
    option : name in the results
    pairs : response of the study by channel of the recording: a microphone, or a channel as
        `compare` names it, such as `foot acceleration rear_left z`
    speed : where the recording's speed comes from
    bandwidth_hz : full width at -3 dB of what belongs to an order at most; None for √s where the
        highest changed order rises by s Hz/s, 1 Hz at least
    orders_only : whether an option that changes the noise is accepted
    shaft_ratio : speed of the study's shaft over that of the recorded shaft, 0.01 to 100
    progress : called with the advance

    Raises
    ------
    ParameterError
        A name is unknown, units differ, the study has no speed of the recording or holds two lines
        at one order, the option changes the noise, a channel is silent, or bandwidth or ratio does
        not fit.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> option = str(results["option"].values[1])
    >>> speed = float(results["speed"].values[0])
    >>> time = np.arange(20480) / 4096.0
    >>> tone = 0.1 * np.cos(2.0 * np.pi * speed / 60.0 * time)
    >>> recording = va.label_recording([tone], 4096.0, ["microphone"], ["Pa"])
    >>> replayed = va.replay(
    ...     recording, results, option, {"microphone": "front_1m"}, va.NominalSpeed(speed))
    >>> replayed.after.shape
    (1, 20480)
    """
    with provenance.naming(recording.attrs):
        _check(recording, results, option, pairs, orders_only)
        check_range("shaft_ratio", shaft_ratio, *SHAFT_RATIOS)
        rate_hz = float(recording.attrs["sample_rate_hz"])
        recorded = recorded_speed(LabelledBlocks(recording), speed)
        every = recorded.motion.geared(shaft_ratio)
        motion = _studied_part(every, results)
        signals = [_audible(recording, channel) for channel in pairs]
        part = _known_part(motion, rate_hz, signals[0].size)
        before, after, lines, reasons, errors = [], [], [], {}, []
        for number, (channel, response) in enumerate(pairs.items()):
            progress("replay", number, len(pairs))
            ratios = option_ratios(results, option, response, *_speeds(motion))
            width = _bandwidth(motion, ratios.orders, bandwidth_hz)
            changed = _changed(signals[number], rate_hz, motion, ratios, width)
            before.append(signals[number][part])
            after.append(changed[0][part])
            lines.append(changed[1])
            reasons[channel] = {**ratios.unchanged, **changed[2]}
            errors += [each.error for each in ratios.orders]
        about = {
            **provenance.of_recording(recording.attrs, "replay"),
            **recorded.attributes(),
            "shaft_ratio": shaft_ratio,
            "option": option,
            "pairs": canonical_json(dict(pairs)),
            "unchanged": canonical_json(reasons),
            "noise_changes": int(bool(_noise_changes(results, option, pairs))),
            "highest_order": float(np.nanmax(results["line_order"].values)),
            "bandwidth_hz": width,
            "replayed_from_s": part.start / rate_hz,
            "replayed_to_s": part.stop / rate_hz,
            "has_further_speeds": int(motion is not every),
            "recorded_rpm": _speeds(every),
            "study_rpm": (float(results["speed"].min()), float(results["speed"].max())),
            "speed_gap": ratios.gap,
            "interpolation_error_db": _largest_error_db(errors),
        }
        sounds = (np.array(before), np.array(after))
        units = {channel: response_units(results)[response] for channel, response in pairs.items()}
        summary = summary_of(units, *sounds, rate_hz, lines)
        return Replay(summary.assign_attrs(about), *sounds, rate_hz)


def _largest_error_db(errors: Sequence[float]) -> float:
    """Largest error; not a number where none is a number."""
    finite = [error for error in errors if np.isfinite(error)]
    return float(level_of_amplitude(1.0 + max(finite))) if finite else np.nan


def _check(
    recording: xr.Dataset,
    results: xr.Dataset,
    option: str,
    pairs: Mapping[str, str],
    orders_only: bool,
) -> None:
    """Refuse unknown names, other units, and options that change the noise."""
    units = dict(zip(recording["channel"].values, recording["channel_unit"].values, strict=True))
    if not pairs:
        raise ParameterError("pair: none given; give --pair CHANNEL=RESPONSE")
    for channel, response in pairs.items():
        if channel not in units:
            names = ", ".join(map(str, units))
            raise ParameterError(f"pair: no channel {channel!r}; there are {names}")
        check_names(results, option, response)
        unit = response_units(results)[response]
        if units[channel] != unit:
            raise ParameterError(
                f"pair {channel}={response}: channel {channel} is in {units[channel]}, the "
                f"response in {unit}: the units must agree"
            )
        if unit not in REFERENCE_BY_UNIT:
            allowed = ", ".join(REFERENCE_BY_UNIT)
            raise ParameterError(
                f"pair {channel}={response}: unit {unit}: must be one of {allowed}"
            )
    bands = _noise_changes(results, option, pairs)
    if bands and not orders_only:
        raise ParameterError(
            f"option = {option}: changes the noise too, in {len(bands)} third octaves from "
            f"{min(bands):g} to {max(bands):g} Hz, which a replay does not; give --orders-only to "
            "change the orders alone"
        )


def _noise_changes(results: xr.Dataset, option: str, pairs: Mapping[str, str]) -> set[float]:
    """Third octaves in which the noise changes in any of the responses, Hz."""
    every = (changed_noise_bands(results, option, response) for response in pairs.values())
    return {band for bands in every for band in bands}


def _audible(recording: xr.Dataset, channel: str) -> Array:
    """Samples of a channel; refused where nothing changes in it, which has no order to change."""
    of_channel = recording["signal"].sel(channel=channel)
    samples, unit = (
        np.asarray(of_channel.values, dtype=float),
        str(of_channel["channel_unit"].item()),
    )
    if np.ptp(samples) <= REFERENCE_BY_UNIT[unit] * amplitude_of_level(SILENCE_DB):
        raise ParameterError(
            f"channel {channel}: is silent: all samples are {samples[0]:g} {unit}; name another "
            "by --pair"
        )
    return samples


def _known_part(motion: CrankMotion, rate_hz: float, samples: int) -> slice:
    """Samples at which the speed is known."""
    first = max(0, int(np.ceil(motion.start_s * rate_hz - 1e-6)))
    return slice(first, min(samples, int(np.floor(motion.end_s * rate_hz + 1e-6)) + 1))


def _studied_part(motion: CrankMotion, results: xr.Dataset) -> CrankMotion:
    """Longest part of a motion with speeds of the study; all of it where it has none."""
    time, speeds = _times(motion), np.sort(results["speed"].values.astype(float))
    studied = is_studied(speeds, 60.0 * motion.frequency_hz(time))
    edges = np.flatnonzero(np.diff(studied, prepend=False, append=False))
    if studied.all() or not edges.size:
        return motion
    spans = [(time[first], time[end - 1]) for first, end in edges.reshape(-1, 2)]
    return motion.between(*max(spans, key=lambda span: span[1] - span[0]))


def _speeds(motion: CrankMotion) -> tuple[float, float]:
    """Lowest and highest speed, rpm."""
    speed = 60.0 * motion.frequency_hz(_times(motion))
    return float(np.min(speed)), float(np.max(speed))


def _times(motion: CrankMotion) -> Array:
    return np.asarray(np.linspace(motion.start_s, motion.end_s, 2000))


def _bandwidth(
    motion: CrankMotion, orders: Sequence[OrderRatio], bandwidth_hz: float | None
) -> float:
    """Bandwidth of the orders, Hz.

    Raises
    ------
    ParameterError
        It is larger than the distance of the orders allows.
    """
    numbers = np.array([0.0, *sorted(each.order for each in orders)], dtype=float)
    time = _times(motion)
    distance_hz = np.min(np.diff(numbers), initial=1.0) * np.min(motion.frequency_hz(time))
    most = float(distance_hz / LEAST_DISTANCE)
    if bandwidth_hz is None:
        rise = np.abs(np.gradient(motion.frequency_hz(time), time)) * numbers[-1]
        return min(max(_LEAST_BANDWIDTH_HZ, float(np.sqrt(np.max(rise)))), most)
    if not 0.0 < bandwidth_hz <= most:
        raise ParameterError(
            f"bandwidth = {bandwidth_hz:g} Hz: must be above 0 and up to {most:.3g} Hz, 1/"
            f"{LEAST_DISTANCE:g} of the distance of neighbouring orders at the lowest speed"
        )
    return bandwidth_hz


def _changed(
    signal: Array, rate_hz: float, motion: CrankMotion, ratios: OptionRatios, bandwidth_hz: float
) -> tuple[Array, list[ReplayedLine], dict[str, str]]:
    """Changed signal, mean squares of its orders, and why further lines stay."""
    time = _times(motion)
    rpm = 60.0 * motion.frequency_hz(time)
    highest_hz = 0.5 * rate_hz - 4.0 * bandwidth_hz
    limit = highest_hz / (np.max(rpm) / 60.0)
    stays = {
        each.line: "above half the sample rate" for each in ratios.orders if each.order > limit
    }
    kept = sorted((each for each in ratios.orders if each.order <= limit), key=_number)
    if not kept:
        return signal, [], stays
    separated = separated_orders(
        signal, rate_hz, [Track(motion, each.order) for each in kept], bandwidth_hz
    )
    hertz = motion.frequency_hz(separated.time_s)
    every = np.array([each.ratio for each in kept])
    audible = separated.order_square >= separated.noise_square
    ratio = ratio_over_speed(ratios.speed_rpm, every, 60.0 * hertz)
    ratio = np.where(audible[:, None], ratio, 1.0)
    lines = [
        replayed_line(each, envelope, of_line, each.order * hertz, ratios.speed_rpm)
        ._replace(noise=float(noise))
        for each, envelope, of_line, noise in zip(
            kept, separated.envelope, ratio, separated.noise_square, strict=True
        )
    ]  # fmt: skip
    stays |= {line.name: _BELOW_NOISE for line in lines if line.before < line.noise}
    return changed_signal(signal, rate_hz, separated, ratio), lines, stays


def _number(order: OrderRatio) -> float:
    return order.order
