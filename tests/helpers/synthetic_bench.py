"""Machine on soft mounts and its recordings: a tacho with jitter, noise, speeds that differ."""

from typing import NamedTuple

import numpy as np
import xarray as xr

import vibroacoustics as va
from vibroacoustics.base.arrays import Array, ComplexArray

SENSORS = ("front", "rear", "side")
RATE_HZ = 1024.0
SECONDS = 12.0
JITTER = 0.002
"""Standard deviation of a pulse, in revolutions."""
NOISE_RATIO = 0.1
"""Noise over 1×, effective values: 20 dB."""


class Machine(NamedTuple):
    """Two modes below the speeds of a rotor with two planes.

    Attributes
    ----------
    natural_hz : shape (mode,)
    damping : damping ratios, shape (mode,)
    sensor_shape : of each sensor, shape (mode, sensor)
    plane_shape : of each plane, shape (mode, plane)
    mass_kg : modal masses, shape (mode,)
    unbalance_kg_m : complex, with the rotation from the mark, shape (plane,)
    """

    natural_hz: Array
    damping: Array
    sensor_shape: Array
    plane_shape: Array
    mass_kg: Array
    unbalance_kg_m: ComplexArray

    def influence(self, speed_rpm: float) -> ComplexArray:
        """Velocity per moment, mm/s per kg m, shape (sensor, plane)."""
        omega, natural = speed_rpm * np.pi / 30.0, 2.0 * np.pi * self.natural_hz
        stiffness = natural**2 - omega**2 + 2j * self.damping * natural * omega
        modal = 1e3j * omega**3 / (self.mass_kg * stiffness)
        return np.einsum("m,ms,mp->sp", modal, self.sensor_shape, self.plane_shape)


def machine(rng: np.random.Generator) -> Machine:
    """Translation and rocking of a block of about 30 kg on mounts, and an unbalance."""
    arms = np.array([0.2, -0.2]) * rng.uniform(0.8, 1.2, 2)
    sensors = np.array([0.25, -0.25, 0.05]) * rng.uniform(0.8, 1.2, 3)
    mass = 30.0 * rng.uniform(0.8, 1.2)
    unbalance = 1e-3 * rng.uniform(0.5, 2.0, 2) * np.exp(2j * np.pi * rng.random(2))
    return Machine(
        rng.uniform([4.0, 6.0], [7.0, 10.0]),
        rng.uniform(0.03, 0.1, 2),
        np.array([np.ones(3), sensors]),
        np.array([np.ones(2), arms]),
        np.array([mass, mass * 0.2**2 * rng.uniform(0.8, 1.2)]),
        unbalance,
    )


def recording(
    rng: np.random.Generator, bench: Machine, weights: ComplexArray, speed_rpm: float
) -> xr.Dataset:
    """Recording of three velocities and a tacho of one pulse a revolution at the mark.

    Weights, kg m, are with the rotation; the first pulse is at a random time.
    """
    time_s = np.arange(int(SECONDS * RATE_HZ)) / RATE_HZ
    turns = speed_rpm / 60.0 * time_s + rng.random()
    turns = turns + 0.002 * np.sin(2.0 * np.pi * 0.2 * time_s)  # drift of the speed
    phasor = bench.influence(speed_rpm) @ (bench.unbalance_kg_m + weights)
    signal = np.real(phasor[:, None] * np.exp(2j * np.pi * turns))
    size = np.abs(bench.influence(speed_rpm) @ bench.unbalance_kg_m) / np.sqrt(2.0)
    signal += NOISE_RATIO * size[:, None] * rng.standard_normal(signal.shape)
    return va.label_recording(
        [*(1e-3 * signal), tacho(rng, turns)], RATE_HZ, [*SENSORS, "tacho"], [*3 * ["m/s"], "V"]
    )


def tacho(rng: np.random.Generator, turns: Array) -> Array:
    """Smooth pulses at whole turns, each off by the jitter."""
    number = np.rint(turns).astype(int)
    late = JITTER * rng.standard_normal(number.max() + 1)[number]
    return np.exp(-0.5 * ((turns - number - late) / 0.08) ** 2)


TRIAL_KG_M = 1.5e-3
RUNS = ("first", "repeat", "front", "rear")


def settings(runs: tuple[str, ...] = RUNS) -> str:
    """Text of the file of runs that are recorded at two speeds; add the names of recordings."""
    lines = [
        'amplitudes = "peak"\nphases = "lead"\nangles = "with rotation"',
        'trial_weights = "removed"\n[speed]\nchannel = "tacho"',
        "[planes.front]\nradius_mm = 100.0\n[planes.rear]\nradius_mm = 100.0",
        *(f'[sensors.{name}]\nunit = "mm/s"' for name in SENSORS),
    ]
    for name in runs:
        lines += [f"[runs.{name}]", f'recordings = ["{name}_1500.nc", "{name}_3000.nc"]']
        if name in ("front", "rear"):
            lines += [f"weights.{name} = {{ mass_g = {1e4 * TRIAL_KG_M}, angle_deg = 0.0 }}"]
    return "\n".join(lines) + "\n"


def weights_of(name: str) -> ComplexArray:
    """Trial weights of a run, shape (plane,), kg m."""
    return TRIAL_KG_M * np.array([name == "front", name == "rear"], dtype=complex)


def speeds_of(rng: np.random.Generator, name: str) -> tuple[float, float]:
    """Speeds of a run, up to 1 % off."""
    off = 0.0 if name == "first" else 0.01
    return tuple(rpm * (1.0 + off * rng.uniform(-1.0, 1.0)) for rpm in (1500.0, 3000.0))


def of_prior(rng: np.random.Generator, mass: float = 1.0, stiffness: float = 1.0) -> Machine:
    """Machine of known geometry on mounts; mass and inertia ±10 %, stiffness ±20 %, damping ±54 %.

    The factors take mass and stiffness out of these ranges.
    """
    mass_kg = 30.0 * mass * rng.uniform(0.9, 1.1)
    inertia = mass_kg * 0.2**2 * rng.uniform(0.9, 1.1)
    vertical, rocking = (
        stiffness * rng.uniform(0.8, 1.2) * nominal * (2.0 * np.pi * hertz) ** 2
        for nominal, hertz in ((30.0, 5.5), (30.0 * 0.2**2, 8.0))
    )
    natural = np.sqrt(np.array([vertical / mass_kg, rocking / inertia])) / (2.0 * np.pi)
    unbalance = 1e-3 * rng.uniform(0.5, 2.0, 2) * np.exp(2j * np.pi * rng.random(2))
    return Machine(
        natural,
        rng.uniform(0.03, 0.1, 2),
        np.array([np.ones(3), [0.25, -0.25, 0.05]]),
        np.array([np.ones(2), [0.2, -0.2]]),
        np.array([mass_kg, inertia]),
        unbalance,
    )


def influence_of(bench: Machine) -> ComplexArray:
    """Influence at both speeds, shape (row, plane)."""
    return np.concatenate([bench.influence(rpm) for rpm in (1500.0, 3000.0)])
