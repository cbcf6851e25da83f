"""Crank angle of a recording: from a tacho, a speed channel, a given speed or the signal."""

import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..base.recording_blocks import RecordingBlocks, block_by_block
from ..base.units import shaft_frequency_hz
from ..base.vocabulary import NO_ANGLE_ZERO
from ..study.order_analysis import (
    LINE_TOLERANCE,
    NominalSpeed,
    SpeedChannel,
    SpeedLine,
    SpeedSource,
    TacholessSpeed,
)
from .analysed import speed_channels
from .angle_channel import angle_motion_of, is_sawtooth
from .confirmed_speed import confirmed
from .crank_motion import CrankMotion, constant_speed
from .pulse_edges import pulses_of
from .pulse_heights import silent_parts
from .pulse_pattern import sampling_note
from .rpm_channel import rpm_motion_of
from .rpm_faults import SpeedFault
from .shaft_speed import RecordedSpeed, UncertainSpeedWarning
from .speed_check import MOSTLY, WIDE_LINE, SpeedCheck
from .speed_line import motion_near_line
from .tacho import tacho_motion
from .tacholess import tacholess_motion

LEAST_CONFIDENCE: Final = 0.8
"""Least confidence of a speed without a tacho that causes no warning (`SpeedCheck`)."""

MOST_SPEED_SAMPLES: Final = 2**26
"""Most samples of a channel in which the speed is sought: half a GiB, 22 min at 51.2 kHz."""

_PARTS: Final = 3
"""Parts without pulses, and faults of a speed, that are listed."""
RPM_PER_UNIT: Final = {"rpm": 1.0, "rad/s": 30.0 / np.pi}
"""Units of a channel that is a speed."""


class StandstillWarning(UserWarning):
    """A part of the recording in which the shaft stands is not analysed."""


class PulseWarning(UserWarning):
    """Warning of pulses of a tacho: other than stated, too quick, uneven, or missing in a part.

    Examples
    --------
    >>> import warnings
    >>> warnings.simplefilter("error", va.PulseWarning)  # refuse such recordings
    """


def check_speed_channels(names: Sequence[str], speed: SpeedSource) -> None:
    """Refuse a source of the speed whose channels a recording does not have."""
    if not isinstance(speed, NominalSpeed):
        _channel(names, speed.channel)
    if isinstance(speed, SpeedChannel) and speed.index_channel is not None:
        _channel(names, speed.index_channel)


def recorded_speed(recording: RecordingBlocks, speed: SpeedSource) -> RecordedSpeed:
    """Crank angle over the time of a recording, confirmed by its first channels of sound.

    Warns
    -----
    UncertainSpeedWarning
        Other speeds explain the signal as well as the one that was tracked.
    StandstillWarning
        The shaft stands at the begin or the end: that part is omitted.
    PulseWarning
        Teeth are missing, pulses unequally spaced or too quick for the sample rate, their jitter
        is above 5 % of a period, or a part of the recording has none.
    """
    shaft = _source(recording, speed)
    if isinstance(speed, TacholessSpeed | SpeedLine):  # checked beside the sound already
        return shaft
    names = [name for name in recording.channels if name not in speed_channels(speed)]
    return confirmed(recording, shaft, names) if names else shaft


def _source(recording: RecordingBlocks, speed: SpeedSource) -> RecordedSpeed:
    """Crank angle as the source of the speed gives it."""
    rate_hz = recording.sample_rate_hz
    if isinstance(speed, NominalSpeed):
        end_s = (recording.samples - 1) / rate_hz
        motion = constant_speed(shaft_frequency_hz(speed.speed_rpm), 0.0, end_s)
        return RecordedSpeed(motion, f"nominal {speed.speed_rpm:g} rpm", kind="nominal")
    name = _channel(recording.channels, speed.channel)
    if isinstance(speed, TacholessSpeed):
        return _from_signal(_samples(recording, name), rate_hz, speed)
    if isinstance(speed, SpeedLine):
        return _from_line(_samples(recording, name), rate_hz, speed)
    unit = recording.channel_units[recording.channels.index(name)]
    if unit in RPM_PER_UNIT:
        return _from_rpm(recording, name, unit)
    if unit in ("V", "1"):
        _refuse_sawtooth(recording, name)
    if unit == "rad":
        motion = angle_motion_of(_blocks(recording, name), recording.samples, rate_hz)
        return RecordedSpeed(motion, f"angle {name}", f"zero of {name}")
    return _from_pulses(recording, speed)


def _refuse_sawtooth(recording: RecordingBlocks, name: str) -> None:
    """Refuse an angle without its unit: its return to zero looks like pulses."""
    if is_sawtooth(next(_blocks(recording, name)())):
        unit = recording.channel_units[recording.channels.index(name)]
        raise ParameterError(
            f"channel {name} [{unit}]: rises evenly to a full turn and returns to zero, as an "
            "angle in rad, ° or turns, not as pulses: state its unit, rad or °"
        )


def _from_signal(samples: Array, rate_hz: float, speed: TacholessSpeed) -> RecordedSpeed:
    tracked = tacholess_motion(
        samples,
        rate_hz,
        shaft_frequency_hz(speed.minimum_rpm),
        shaft_frequency_hz(speed.maximum_rpm),
        speed.comb,
        mains_hz=speed.mains_hz,
    )
    within = f"within {speed.minimum_rpm:g} to {speed.maximum_rpm:g} rpm"
    mean_hz = float(np.mean(tracked.motion.frequency_hz(tracked.time_s)))
    return _checked(tracked.motion, mean_hz, tracked.check, within, speed.mains_hz)


def _from_line(samples: Array, rate_hz: float, speed: SpeedLine) -> RecordedSpeed:
    time_s, speed_rpm = np.array(speed.points).T
    near = motion_near_line(samples, rate_hz, time_s, speed_rpm / 60.0, speed.comb, speed.mains_hz)
    motion = near.motion
    turned = float(np.ptp(motion.angle_rad(np.array([motion.start_s, motion.end_s])))) / (2 * np.pi)
    mean_hz = turned / (motion.end_s - motion.start_s)
    rival_hz = near.check.rival_hz
    check = replace(near.check, rival_hz=None if rival_hz is None else rival_hz * mean_hz)
    within = f"within {100.0 * LINE_TOLERANCE:.0f} % of a drawn line of {len(speed.points)} points"
    return _checked(motion, mean_hz, check, within, speed.mains_hz)


def _checked(
    motion: CrankMotion, mean_hz: float, check: SpeedCheck, within: str, mains_hz: float | None
) -> RecordedSpeed:
    """Speed found in a signal, in words; with a warning where its confidence is low."""
    if check.confidence < LEAST_CONFIDENCE:
        warnings.warn(_uncertain(mean_hz, check, mains_hz), UncertainSpeedWarning, stacklevel=3)
    mains = "" if mains_hz is None else f", without mains of {mains_hz:g} Hz"
    source = (
        f"from the signal, {within}{mains}; lines at {check.in_place} of {check.orders} orders of "
        f"the comb, confidence {check.confidence:.2f} of 1"
    )
    return RecordedSpeed(motion, source, quality={"confidence": check.confidence})


def _uncertain(mean_hz: float, check: SpeedCheck, mains_hz: float | None) -> str:
    """Warning of a speed that need not be the shaft's, with its rival."""
    mean_rpm = 60.0 * mean_hz
    reasons = [f"lines at {check.in_place} of {check.orders} orders of the comb"]
    if check.width > WIDE_LINE:
        reasons.append(f"{check.width:.1f} times as wide as those of a steady speed")
    if check.followed < MOSTLY:
        reasons.append(f"followed for {100.0 * check.followed:.0f} % of the time")
    if check.mains_hz is not None:
        reasons.append(f"which never leave multiples of {check.mains_hz:g} Hz, as hum of the mains")
    if check.rival_hz is not None:
        reasons.append(f"{60.0 * check.rival_hz:.0f} rpm is the next best")
    advice = "give the comb of the machine, narrower limits or a tacho"
    if mains_hz is None:
        advice = "name the mains frequency, " + advice
    return (
        f"the speed found, {mean_rpm:.0f} rpm, is uncertain: confidence {check.confidence:.2f} of "
        f"1; {', '.join(reasons)}; {advice}"
    )


def _from_rpm(recording: RecordingBlocks, name: str, unit: str) -> RecordedSpeed:
    samples, rate_hz = recording.samples, recording.sample_rate_hz
    blocks = _blocks(recording, name)
    recorded = rpm_motion_of(blocks, samples, rate_hz, RPM_PER_UNIT[unit])
    motion, source = recorded.motion, f"channel {name}, {unit}"
    before, behind = motion.start_s, (samples - 1) / rate_hz - motion.end_s
    if max(before, behind) >= 0.5 / rate_hz:
        cut = f"standstill cut off: {before:.3g} s before, {behind:.3g} s behind"
        warnings.warn(f"channel {name}: {cut}", StandstillWarning, stacklevel=4)
        source += f"; {cut}"
    if recorded.faults:
        note = _faults_note(recorded.faults)
        warnings.warn(f"channel {name}: {note}", UncertainSpeedWarning, stacklevel=4)
        source += f"; {note}"
    return RecordedSpeed(motion, source, kind="recorded", held_s=recorded.held_s)


def _faults_note(faults: Sequence[SpeedFault]) -> str:
    """Sentence on parts of a recorded speed that are interpolated."""
    listed = [
        f"{fault.kind} of {fault.rpm:.0f} rpm "
        + (f"from {fault.start_s:.4g} to {fault.end_s:.4g} s" if fault.end_s > fault.start_s
           else f"at {fault.start_s:.4g} s")
        for fault in faults[:_PARTS]
    ]  # fmt: skip
    more = f" and {len(faults) - _PARTS} more" if len(faults) > _PARTS else ""
    return f"the speed is interpolated over {', '.join(listed)}{more}"


def _from_pulses(recording: RecordingBlocks, speed: SpeedChannel) -> RecordedSpeed:
    index, rate_hz = None, recording.sample_rate_hz
    angle_zero = f"pulse of {speed.channel}" if speed.pulses_per_revolution == 1 else NO_ANGLE_ZERO
    if speed.index_channel is not None:
        blocks = _blocks(recording, _channel(recording.channels, speed.index_channel))
        index = pulses_of(blocks, recording.samples, rate_hz).time_s
        angle_zero = f"pulse of {speed.index_channel}"
    pulses = pulses_of(
        _blocks(recording, speed.channel), recording.samples, rate_hz, speed.edge, speed.threshold
    )
    too_quick = sampling_note(pulses.time_s, rate_hz)
    try:
        tracked = tacho_motion(pulses.time_s, speed.pulses_per_revolution, index)
    except ParameterError as error:
        raise ParameterError(f"{error}; {too_quick}" if too_quick else str(error)) from None
    silence = _silence(pulses.time_s, (recording.samples - 1) / rate_hz)
    for note in (*([too_quick] if too_quick else ()), *tracked.notes, *silence):
        warnings.warn(f"tacho {speed.channel}: {note}", PulseWarning, stacklevel=2)
    number = speed.pulses_per_revolution
    edge = "falling edge, " if pulses.edge == "falling" else ""
    source = (
        f"tacho {speed.channel}, {number:g} pulse{'s' if number != 1 else ''} a revolution, "
        f"{edge}jitter {100.0 * tracked.jitter:.2g} % of a period"
    )
    return RecordedSpeed(
        tracked.motion,
        "; ".join([source, *silence]),
        angle_zero,
        tracked.faults,
        {"jitter": tracked.jitter},
    )


def _silence(pulse_times_s: Array, end_s: float) -> list[str]:
    """A sentence on the parts of the recording without pulses, none where there are none."""
    parts = [f"{a:.4g} to {b:.4g} s" for a, b in silent_parts(pulse_times_s, 0.0, end_s)]
    if not parts:
        return []
    more = f" and {len(parts) - _PARTS} more" if len(parts) > _PARTS else ""
    return [
        f"no pulses from {', '.join(parts[:_PARTS])}{more}: before the first and behind the last "
        "pulse nothing is analysed, between pulses the angle is interpolated"
    ]


def _blocks(recording: RecordingBlocks, name: str) -> Callable[[], Iterator[Array]]:
    """Starts over with the blocks of a channel."""
    return lambda: (block[0] for block in block_by_block(recording, [name]))


def _samples(recording: RecordingBlocks, name: str) -> Array:
    """All samples of a channel."""
    if recording.samples > MOST_SPEED_SAMPLES:
        raise ParameterError(
            f"speed: {recording.samples} samples of channel {name!r} are too many, at most "
            f"{MOST_SPEED_SAMPLES} are taken: choose a part by from_s and to_s; a tacho or "
            "a channel in rpm may have any number"
        )
    blocks = list(_blocks(recording, name)())
    return blocks[0] if len(blocks) == 1 else np.concatenate(blocks)


def _channel(names: Sequence[str], name: str | None) -> str:
    """Name of a channel that is there; the only one where none is given."""
    if name is None and len(names) == 1:
        return names[0]
    if name is None:
        raise ParameterError(f"speed: name the channel to find it in, one of {', '.join(names)}")
    if name not in names:
        raise ParameterError(f"speed: no channel {name!r}; there are {', '.join(names)}")
    return name
