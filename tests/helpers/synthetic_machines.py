"""Machines with hum, mesh lines and a weak first order, for speeds without a tacho."""

from dataclasses import dataclass

import numpy as np

RATE_HZ = 6400.0


@dataclass(frozen=True)
class Machine:
    """A recording with its speed, and what its user knows of it."""

    signal: np.ndarray
    speed_hz: np.ndarray
    """Of the shaft at every sample."""
    comb: tuple[float, ...]
    """Orders that the user expects; one may be silent."""
    mains_hz: float
    minimum_hz: float
    maximum_hz: float
    kind: str


def synthetic_machine(number: int) -> Machine:
    """A machine of its own for every number; all of it is sampled.

    800 to 7000 rpm, steady, run-up, run-down or fluctuating; four to eight orders of random size
    with a weak first; hum at multiples of 50 or 60 Hz, off the nominal by up to 0.1 %; a gear mesh
    of another shaft with sidebands; a foreign steady line near an order; noise.
    """
    rng = np.random.default_rng(number)
    duration = rng.uniform(12.0, 25.0)
    time = np.arange(int(duration * RATE_HZ)) / RATE_HZ
    mean_hz = np.exp(rng.uniform(np.log(800.0), np.log(7000.0))) / 60.0
    kind = str(rng.choice(["steady", "run-up", "run-down", "fluctuating"]))
    speed = mean_hz * _shape(kind, time / duration, duration, rng)
    angle = 2.0 * np.pi * np.cumsum(speed) / RATE_HZ
    comb, shaft = _shaft_orders(angle, rng)
    signal = shaft + _hum(time, mains := float(rng.choice([50.0, 60.0])), rng)
    signal += _mesh(angle, rng) + _near_line(time, mean_hz, comb, rng)
    signal += 10.0 ** rng.uniform(-1.2, -0.2) * rng.standard_normal(time.size)
    low, high = speed.min() * rng.uniform(0.5, 0.85), speed.max() * rng.uniform(1.15, 1.7)
    return Machine(signal, speed, comb, mains, float(low), float(high), kind)


def _shape(kind, share, duration, rng):
    """Speed over its mean, along the recording."""
    if kind == "steady":
        return np.ones_like(share)
    if kind == "fluctuating":
        period = rng.uniform(2.0, 8.0)
        turn = 2.0 * np.pi * (duration * share / period + rng.uniform())
        return 1.0 + rng.uniform(0.002, 0.02) * np.sin(turn)
    span = rng.uniform(0.1, 0.6) * (1.0 if kind == "run-up" else -1.0)
    return 1.0 + span * (share - 0.5) + 0.1 * span * np.sin(2.0 * np.pi * share)


def _tone(angle, amplitude, rng):
    return amplitude * np.cos(angle + rng.uniform(0.0, 2.0 * np.pi))


def _shaft_orders(angle, rng):
    """Orders that the user names, one of which may be silent, and their sound."""
    count = int(rng.integers(4, 9))
    base = rng.choice([1, 2], p=[0.7, 0.3])
    orders = [float(base * (number + 1)) for number in range(count)]
    sound = _tone(angle, 10.0 ** rng.uniform(-1.7, -1.0), rng)  # a weak first order
    silent = orders[int(rng.integers(count))] if rng.uniform() < 0.4 else None
    for order in orders:
        if order not in (1.0, silent):
            sound = sound + _tone(order * angle, 10.0 ** rng.uniform(-0.9, 0.1), rng)
    return tuple(orders), sound


def _hum(time, mains, rng):
    """Two to six multiples of the mains frequency, up to three times the largest order."""
    actual = mains * (1.0 + rng.uniform(-1e-3, 1e-3))
    multiples = rng.choice(np.arange(1, 13), size=int(rng.integers(2, 7)), replace=False)
    size = 10.0 ** rng.uniform(-1.0, 0.5, multiples.size)
    return sum(
        _tone(2.0 * np.pi * n * actual * time, a, rng) for n, a in zip(multiples, size, strict=True)
    )


def _mesh(angle, rng):
    """Mesh of a gear on another shaft, two harmonics, with sidebands of that shaft."""
    ratio, teeth = rng.uniform(0.23, 3.7), int(rng.integers(11, 40))
    other = ratio * angle
    while ratio * teeth > 18.0:
        teeth //= 2
    sound = np.zeros_like(angle)
    for harmonic, size in ((1, 1.0), (2, 0.4)):
        for side in range(-2, 3):
            line = harmonic * teeth + side
            part = size * 10.0 ** rng.uniform(-1.0, 0.2) * (0.4 ** abs(side))
            sound += _tone(line * other, part, rng) if line > 0 else 0.0
    return sound


def _near_line(time, mean_hz, comb, rng):
    """A steady line 1 to 5 % off one of the orders."""
    off = 1.0 + rng.choice([-1.0, 1.0]) * rng.uniform(0.01, 0.05)
    frequency = mean_hz * off * float(rng.choice(comb))
    return _tone(2.0 * np.pi * frequency * time, 10.0 ** rng.uniform(-0.7, 0.3), rng)
