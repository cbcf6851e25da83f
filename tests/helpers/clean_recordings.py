"""Recordings whose speed is right, of many kinds: no sentence of a speed is due."""

from collections.abc import Callable, Iterator
from typing import Final, NamedTuple

import numpy as np

import vibroacoustics as va

RATE_HZ: Final = 8192.0
DURATION_S: Final = 16.0


class Clean(NamedTuple):
    """A recording and the source of its speed."""

    name: str
    recording: object
    speed: object


def _time():
    return np.arange(int(DURATION_S * RATE_HZ)) / RATE_HZ


def _speeds(rng) -> dict[str, Callable]:
    """Speed histories, Hz over time."""
    low, high = rng.uniform(10.0, 25.0), rng.uniform(40.0, 70.0)
    return {
        "run-up": lambda t: low + (high - low) * t / DURATION_S,
        "coast-down": lambda t: high * np.exp(-t / DURATION_S * np.log(high / low)),
        "up and down": lambda t: high - (high - low) * np.abs(2.0 * t / DURATION_S - 1.0),
        "steps": lambda t: np.interp(t, [0, 5, 6, 11, 12, 16], [low, low, 35, 35, high, high]),
        "slow steps": lambda t: np.interp(t, [0, 4, 7, 9, 12, 16], [low, low, 30, 30, high, high]),
        "dwell": lambda t: np.full_like(t, high),
        "swing": lambda t: high * (1.0 + 0.03 * np.sin(2.0 * np.pi * 0.3 * t)),
    }


def _sounds(rng, angle, time_s) -> dict[str, np.ndarray]:
    """Sounds of a shaft, and of no shaft."""

    def orders(peaks, of=angle):
        return sum(
            peak * np.cos(order * of + rng.uniform(0.0, 6.0)) for order, peak in peaks.items()
        )

    noise = rng.standard_normal(time_s.size)
    tone = np.cos(2.0 * np.pi * rng.uniform(60.0, 300.0) * time_s)
    hum = sum(np.cos(2.0 * np.pi * 50.0 * k * time_s) / k for k in (1, 2, 3, 4, 6))
    return {
        "machine": orders({1: 1.0, 2: 0.5, 3: 0.3, 6: 0.4, 12: 0.5}) + 0.3 * noise,
        "one order": orders({8: 1.0}) + 0.1 * noise,
        "half orders": orders({0.5: 0.7, 1.5: 1.0, 2.5: 0.4}) + 0.2 * noise,
        "second shaft": orders({1: 1.0, 2: 0.5}) + orders({1: 0.8, 3: 0.6}, 1.37 * angle),
        "another shaft alone": orders({1: 0.8, 2: 0.6}, 2.37 * angle) + 0.2 * noise,
        "one tone": tone + 0.1 * noise,
        "tone and orders": 2.0 * tone + orders({2: 1.0, 5: 0.4}) + 0.2 * noise,
        "hum and orders": hum + orders({1: 0.3, 4: 0.5}) + 0.2 * noise,
        "noise": noise,
        "resonance": _resonant(orders({1: 1.0, 2: 1.0, 4: 1.0}), 150.0, 0.02) + 0.1 * noise,
    }


def _resonant(signal, frequency_hz, damping_ratio):
    """Signal behind a resonance, whose phase turns by 180° in a run-up."""
    hertz = np.fft.rfftfreq(signal.size, 1.0 / RATE_HZ) / frequency_hz
    response = 1.0 / (1.0 - hertz**2 + 2j * damping_ratio * hertz)
    return np.fft.irfft(np.fft.rfft(signal) * response, signal.size)


def _channels(rng, time_s, speed_hz, angle) -> dict[str, tuple[np.ndarray, str, object]]:
    """Speed channels, their unit and source."""
    rpm = 60.0 * speed_hz
    noisy = rpm * (1.0 + 0.005 * rng.standard_normal(rpm.size))
    pulses = np.where(angle % (2.0 * np.pi) < 0.6, 5.0, 0.0)
    many = np.where((20.0 * angle) % (2.0 * np.pi) < 3.0, 5.0, 0.0)
    return {
        "rpm": (rpm, "rpm", va.SpeedChannel("speed")),
        "noisy rpm": (noisy, "rpm", va.SpeedChannel("speed")),
        "whole rpm": (np.round(rpm), "rpm", va.SpeedChannel("speed")),
        "rad/s": (2.0 * np.pi * speed_hz, "rad/s", va.SpeedChannel("speed")),
        "angle": (angle % (2.0 * np.pi), "rad", va.SpeedChannel("speed")),
        "tacho": (pulses, "V", va.SpeedChannel("speed")),
        "encoder": (many, "V", va.SpeedChannel("speed", 20)),
    }


def clean_recordings(count: int, seed: int = 0) -> Iterator[Clean]:
    """Yield so many recordings, of all speeds and sounds in turn.

    Parameters
    ----------
    count : number of recordings
    seed : seed of levels, phases and noise
    """
    time_s = _time()
    for number in range(count):
        rng = np.random.default_rng([seed, number])
        histories = _speeds(rng)
        history = list(histories)[number % len(histories)]
        speed_hz = histories[history](time_s)
        angle = 2.0 * np.pi * np.cumsum(speed_hz) / RATE_HZ
        sounds = _sounds(rng, angle, time_s)
        sound = list(sounds)[(number // len(histories) + number) % len(sounds)]
        channels = _channels(rng, time_s, speed_hz, angle)
        channel = list(channels)[(number + number // 7) % len(channels)]
        samples, unit, source = channels[channel]
        if history == "dwell" and number % 4 == 0:
            source = va.NominalSpeed(60.0 * float(speed_hz[0]))
        recording = va.label_recording(
            [sounds[sound], samples], RATE_HZ, ["front", "speed"], ["Pa", unit]
        )
        yield Clean(f"{number}: {history}, {sound}, {channel}", recording, source)


def clean_tacholess(count: int, seed: int = 0) -> Iterator[Clean]:
    """Yield so many recordings of a machine whose speed its sound gives.

    Parameters
    ----------
    count : number of recordings
    seed : seed of levels, phases and noise
    """
    time_s = _time()
    for number in range(count):
        rng = np.random.default_rng([seed, number])
        histories = _speeds(rng)
        history = ("run-up", "coast-down", "dwell", "swing")[number % 4]
        speed_hz = histories[history](time_s)
        sounds = _sounds(rng, 2.0 * np.pi * np.cumsum(speed_hz) / RATE_HZ, time_s)
        recording = va.label_recording([sounds["machine"]], RATE_HZ, ["front"], ["Pa"])
        source = va.TacholessSpeed("front", 500.0, 5000.0, (1.0, 2.0, 3.0, 6.0, 12.0))
        yield Clean(f"{number}: {history}, machine, tacholess", recording, source)
