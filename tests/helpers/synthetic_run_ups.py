"""Run-ups and run-downs of machines of several kinds, with resonances and hum."""

import numpy as np
from synthetic_machines import RATE_HZ, Machine

KINDS = ("falling", "even", "weak first", "blades", "halves", "mesh")
TEN = tuple(float(order) for order in range(1, 11))
HALVES = tuple(0.5 * order for order in TEN)


def synthetic_run_up(number: int) -> Machine:
    """A machine of its own for every number; all of it is sampled.

    From 600 to 1500 rpm up to four times as fast, or down, in 8 to 20 s; orders of one of the kinds
    through three resonances; three in four with hum at multiples of 50 or 60 Hz; noise from -20 to
    5 dB. Half of them within narrow limits, half within wide ones.
    """
    rng = np.random.default_rng([7, number])
    duration_s = rng.uniform(8, 20)
    time = np.arange(int(duration_s * RATE_HZ)) / RATE_HZ
    speed = _history(time / duration_s, rng)
    angle = 2.0 * np.pi * np.cumsum(speed) / RATE_HZ
    kind, orders = _orders(rng)
    modes = [(rng.uniform(40, 1200), rng.uniform(0.02, 0.1), rng.uniform(0.5, 3)) for _ in "abc"]
    signal = sum(
        amplitude
        * _gain(order * speed, modes)
        * np.cos(order * angle + rng.uniform(0, 6.28))
        * (order * speed < 3000.0)
        for order, amplitude in orders.items()
    )
    signal = signal / signal.std()
    mains = float(rng.choice([50.0, 60.0]))
    signal = signal + _hum(time, mains * (1.0 + rng.uniform(-1e-3, 1e-3)), rng)
    signal = signal + 10.0 ** (-rng.uniform(-5, 20) / 20.0) * rng.standard_normal(time.size)
    limits = (8.0, min(110.0, 2.2 * speed.max()))
    if rng.uniform() < 0.5:
        limits = (speed.min() * rng.uniform(0.4, 0.9), speed.max() * rng.uniform(1.1, 2.2))
    comb = HALVES if kind == "halves" else TEN
    return Machine(signal, speed, comb, mains, float(limits[0]), float(limits[1]), kind)


def _history(share, rng):
    slow = rng.uniform(600, 1500) / 60.0
    quick = slow * rng.uniform(1.5, 4.0)
    shape = rng.choice(["linear", "s", "exp", "down"])
    if shape == "linear":
        return slow + (quick - slow) * share
    if shape == "s":
        return slow + (quick - slow) * (share - 0.8 * np.sin(2 * np.pi * share) / (2 * np.pi))
    return slow * (quick / slow) ** share if shape == "exp" else quick * (slow / quick) ** share


def _orders(rng):
    """Kind of the machine and its orders with their amplitudes."""
    kind = str(rng.choice(KINDS))
    if kind == "falling":
        last = int(rng.integers(5, 11))
        return kind, {k: 10 ** rng.uniform(-0.3, 0.3) / k for k in range(1, last)}
    if kind == "even":
        last = int(rng.integers(7, 13))
        size = lambda k: 1.0 if k % 2 == 0 else 10 ** rng.uniform(-2, -1)  # noqa: E731
        return kind, {k: size(k) * 10 ** rng.uniform(-0.4, 0.2) for k in range(1, last)}
    if kind == "weak first":
        last = int(rng.integers(5, 10))
        return kind, {
            k: 10 ** (rng.uniform(-2, -1) if k == 1 else rng.uniform(-0.8, 0.2))
            for k in range(1, last)
        }
    if kind == "halves":
        return kind, {
            0.5 * k: 10 ** rng.uniform(-1, 0) * (1.0 if k % 2 == 0 else 0.5) for k in range(1, 13)
        }
    if kind == "blades":
        blades = int(rng.integers(5, 12))
        return kind, {1: 0.5, 2: 0.25, 3: 0.1, blades: 1.0, 2 * blades: 0.5}
    teeth = int(rng.integers(11, 30))
    return kind, {1: 0.3, 2: 0.2, 3: 0.1, teeth - 1: 0.3, teeth: 1.0, teeth + 1: 0.3}


def _gain(frequency, modes):
    """Amplification by resonances."""
    gain = np.ones_like(frequency)
    for natural, damping, size in modes:
        ratio = frequency / natural
        gain = gain + 2 * size * damping / np.sqrt((1 - ratio**2) ** 2 + (2 * damping * ratio) ** 2)
    return gain


def _hum(time, actual, rng):
    """Up to five multiples of the mains frequency, in three of four machines."""
    if rng.uniform() >= 0.75:
        return 0.0
    multiples = rng.choice([1, 2, 3, 4, 6, 8, 10, 12], int(rng.integers(1, 6)), replace=False)
    return sum(
        10 ** rng.uniform(-1.3, 0.4) * np.cos(2 * np.pi * n * actual * time + rng.uniform(0, 6.28))
        for n in multiples
    )
