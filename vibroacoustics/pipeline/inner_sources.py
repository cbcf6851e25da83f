"""Loads of gas, keys and motor on the shell's joints, as lines and as random noise."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..mechanisms.induction_motor.torque_lines import TorqueLine, TorqueLines, torque_lines
from ..mechanisms.inner_loads import (
    BEARING_HOUSING,
    COMPONENTS,
    STATOR,
    gas_loads,
    key_loads,
    stator_loads,
)
from ..mechanisms.oldham_keys.contact_loss import contact_loss_speed_rpm
from ..mechanisms.oldham_keys.rattle import KeyForces, steady_key_forces
from ..mechanisms.oldham_keys.spectra import spectral_density, split_periodic
from ..mechanisms.scroll_gas.cycle import ScrollGasCycle, scroll_gas_cycle
from ..orders import order_spectrum
from ..parameters.inside import Inside
from ..parameters.oldham_scroll import OldhamScroll
from ..parameters.options import Option, RingDamping, TwinOldham
from ..parameters.shell_structure import JOINTS
from ..rotation import Array, uniform_crank_angle
from ..units import shaft_frequency_hz

Complex = NDArray[np.complex128]

GAS_SAMPLES: Final = 8192
"""Crank angles a revolution: the step of the force where a pocket opens makes an error of the
step over the samples, below 1 % of the order at 4 kHz."""
LOWEST_LINE_HZ: Final = 10.0
"""Sidebands below are no sound."""
KEY_COMPONENTS: Final = (0, 1, 3)
"""Components that the keys load: along x and y, about z."""


@dataclass(frozen=True)
class Lines:
    """Lines of one source.

    Attributes
    ----------
    load : complex peaks on the joints, shape (joint, component, line), N and N m
    roll_moment_n_m : on the machine as a rigid body, complex peaks, shape (line,)
    """

    load: Complex
    roll_moment_n_m: Complex


@dataclass(frozen=True)
class Noise:
    """What does not repeat with the revolution, of one source on one joint.

    Attributes
    ----------
    joint : index into JOINTS
    frequency_hz : shape (line,)
    density : of force along x, y and moment about z, shape (3, 3, line), N²/Hz
    """

    joint: int
    frequency_hz: Array
    density: Complex


@dataclass(frozen=True)
class InnerLoads:
    """Loads of all inner sources at one speed.

    Attributes
    ----------
    line_name, frequency_hz : of the lines: shaft orders from zero, then those of the motor
    lines : by source
    noise : by source
    facts : figures to report, by name
    """

    line_name: tuple[str, ...]
    frequency_hz: Array
    lines: dict[str, Lines]
    noise: dict[str, list[Noise]]
    facts: dict[str, float]


@dataclass(frozen=True)
class Operating:
    """One speed of a study.

    Attributes
    ----------
    speed_rpm : of the shaft
    line_frequency_hz : of the motor's supply
    maximum_frequency_hz : lines and noise up to here
    key_revolutions : over which the keys are simulated
    """

    speed_rpm: float
    line_frequency_hz: float
    maximum_frequency_hz: float
    key_revolutions: int

    @property
    def maximum_order(self) -> int:
        return int(self.maximum_frequency_hz / shaft_frequency_hz(self.speed_rpm))


def inner_loads(
    inside: Inside,
    machine: OldhamScroll,
    option: Option,
    ring_force_n: Array,
    operating: Operating,
) -> InnerLoads:
    """Loads of gas, keys, torque ripple and motor with one balancing option.

    Parameters
    ----------
    inside : gas, keys, motor, rotor
    machine : the ring and its stroke
    option : of the study
    ring_force_n : of what hangs on the ring, along x over uniform crank angles, shape (samples,)
    operating : the speed
    """
    gas = scroll_gas_cycle(inside.wraps, inside.gas, uniform_crank_angle(GAS_SAMPLES))
    highest = operating.maximum_order
    torques = _motor_torques(inside, gas, operating)
    own = [
        line
        for line in (*torques.line, *torques.sidebands)
        if LOWEST_LINE_HZ <= line.frequency_hz <= operating.maximum_frequency_hz
    ]
    keys, noise, facts = _keys(inside, machine, option, ring_force_n, gas, operating)
    count = highest + 1 + len(own)
    lines = {
        "gas": _at_orders(order_spectrum(gas_loads(gas), highest), len(own)),
        "keys": _at_orders(keys, len(own)),
        "torque_ripple": _torques(torques.shaft, 1, count),
        "motor": _torques(own, highest + 1, count),
    }
    order_hz = shaft_frequency_hz(operating.speed_rpm) * np.arange(highest + 1)
    return InnerLoads(
        (*(f"order {order}" for order in range(highest + 1)), *(line.name for line in own)),
        np.concatenate([order_hz, [line.frequency_hz for line in own]]),
        lines,
        {"keys": noise},
        facts,
    )


def _at_orders(load: Complex, more: int) -> Lines:
    """Lines at the shaft's orders only."""
    whole = np.pad(load, ((0, 0), (0, 0), (0, more)))
    return Lines(whole, np.zeros(whole.shape[-1], dtype=complex))


def _torques(lines: Sequence[TorqueLine], first: int, count: int) -> Lines:
    """Torques of neighbouring lines among all."""
    load, moment = stator_loads(lines)
    after = count - first - len(lines)
    return Lines(np.pad(load, ((0, 0), (0, 0), (first, after))), np.pad(moment, (first, after)))


def _motor_torques(inside: Inside, gas: ScrollGasCycle, operating: Operating) -> TorqueLines:
    """Torque balance with the motor on the supply of this speed, at the same flux."""
    ratio = operating.line_frequency_hz / inside.motor.line_frequency_hz
    grown = {name: ratio * getattr(inside.motor, name) for name in _GROW_WITH_FREQUENCY}
    motor = inside.motor.model_copy(
        update={"line_frequency_hz": operating.line_frequency_hz, **grown}
    )
    torque = order_spectrum(gas.torque_n_m, operating.maximum_order)
    return torque_lines(motor, inside.rotor.inertia_kg_m2, list(torque))


_GROW_WITH_FREQUENCY: Final = (
    "line_voltage_v",
    "main_leakage_ohm",
    "auxiliary_leakage_ohm",
    "magnetising_ohm",
    "rotor_leakage_ohm",
)


def _keys(
    inside: Inside,
    machine: OldhamScroll,
    option: Option,
    ring_force_n: Array,
    gas: ScrollGasCycle,
    operating: Operating,
) -> tuple[Complex, list[Noise], dict[str, float]]:
    """Orders (joint, component, order), noise and figures of the ring's keys and a twin's."""
    ring, stroke = machine.oldham.mass_kg, machine.kinematics.orbit_radius_m
    moment = gas.self_rotation_moment_n_m[:: GAS_SAMPLES // ring_force_n.size]
    run = (operating.speed_rpm, moment, ring_force_n, operating.key_revolutions)
    forces = steady_key_forces(inside.keys, ring, stroke, *run)
    order, noise = _key_spectra(forces, inside.keys.radius_m, operating, BEARING_HOUSING)
    lost = contact_loss_speed_rpm(inside.keys, ring, stroke, moment)
    facts = {
        "key_impacts_per_revolution": forces.impacts_per_revolution,
        "key_force_peak_n": float(forces.peak_n.max()),
        "key_contact_lost_above_rpm": lost,
    }
    if not isinstance(option, TwinOldham):
        return order, [noise], facts
    free = np.zeros(1)
    twin = steady_key_forces(
        inside.keys, option.mass_kg, option.stroke_ratio * stroke, operating.speed_rpm, free, free,
        operating.key_revolutions,
    )  # fmt: skip
    # In opposite phase: the same forces turned by half a turn about the shaft.
    turned, twin_noise = _key_spectra(twin, inside.keys.radius_m, operating, STATOR)
    turned[:, :2] *= -1.0
    facts["twin_key_impacts_per_revolution"] = twin.impacts_per_revolution
    facts["twin_key_force_peak_n"] = float(twin.peak_n.max())
    return order + turned, [noise, twin_noise], facts


def _key_spectra(
    forces: KeyForces, radius_m: float, operating: Operating, joint: int
) -> tuple[Complex, Noise]:
    load = key_loads(forces, radius_m)
    mean, rest = split_periodic(load, forces.revolutions)
    orders = np.zeros((len(JOINTS), COMPONENTS, operating.maximum_order + 1), dtype=complex)
    orders[joint, KEY_COMPONENTS] = order_spectrum(mean, operating.maximum_order)
    block = 2 * mean.shape[-1] if forces.revolutions > 1 else mean.shape[-1]
    frequency, density = spectral_density(rest, forces.sample_rate_hz, block)
    kept = frequency <= operating.maximum_frequency_hz
    return orders, Noise(joint, frequency[kept], density[..., kept])


def ring_force(option: Option, hanging_n: Array, machine: OldhamScroll, speed_rpm: float) -> Array:
    """Force on the ring along x of what an option hangs on it, over uniform crank angles, N.

    Parameters
    ----------
    option : of the study
    hanging_n : force of the option's moving parts along x, shape (samples,)
    machine : stroke of the ring
    speed_rpm : of the shaft
    """
    if isinstance(option, RingDamping):
        speed = 2.0 * np.pi * shaft_frequency_hz(speed_rpm) * machine.kinematics.orbit_radius_m
        return np.asarray(
            option.damping_ns_per_m * speed * np.sin(uniform_crank_angle(hanging_n.size))
        )
    return hanging_n
