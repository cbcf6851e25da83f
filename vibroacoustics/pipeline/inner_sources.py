"""Loads of gas, keys and motor on the shell's joints, as lines and as random noise."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..mechanisms.induction_motor.torque_lines import torque_lines
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
from ..parameters.options import RingDamping, TwinOldham
from ..parameters.shell_structure import JOINTS
from ..rotation import Array, uniform_crank_angle
from ..units import shaft_frequency_hz

Complex = NDArray[np.complex128]

GAS_SAMPLES: Final = 8192
"""Crank angles a revolution: the step of the force where a pocket opens makes an error of the
step over the samples, below 1 % of the order at 4 kHz."""
PAIRS: Final = ([0, 1, 3], [0, 1, 3])
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
    orders : how many of them are shaft orders
    lines : by source
    noise : by source
    facts : figures to report, by name
    """

    line_name: tuple[str, ...]
    frequency_hz: Array
    orders: int
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
    option: object,
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
    frequency, names, electrical = _motor_lines(inside, gas, operating)
    order_hz = shaft_frequency_hz(operating.speed_rpm) * np.arange(highest + 1)
    keys, noise, facts = _keys(inside, machine, option, ring_force_n, gas, operating)
    several = len(names)
    lines = {
        "gas": _padded(order_spectrum(gas_loads(gas), highest), several),
        "keys": _padded(keys, several),
        **{name: _joined(*parts, highest + 1) for name, parts in electrical.items()},
    }
    return InnerLoads(
        (*(f"order {order}" for order in range(highest + 1)), *names),
        np.concatenate([order_hz, frequency]),
        highest + 1,
        lines,
        {"keys": noise},
        facts,
    )


def _padded(load: Complex, more: int) -> Lines:
    """Lines at the shaft's orders only."""
    none = np.zeros((*load.shape[:2], more), dtype=complex)
    whole = np.concatenate([load, none], axis=-1)
    return Lines(whole, np.zeros(whole.shape[-1], dtype=complex))


def _joined(shaft: tuple[Complex, Complex], motor: tuple[Complex, Complex], orders: int) -> Lines:
    """Lines of the motor's torque: at shaft orders 1, 2, … and at frequencies of its own."""
    load, moment = shaft
    gap = orders - 1 - moment.size
    whole = np.pad(load, ((0, 0), (0, 0), (1, gap)))
    return Lines(
        np.concatenate([whole, motor[0]], axis=-1),
        np.concatenate([np.pad(moment, (1, gap)), motor[1]]),
    )


def _motor_lines(
    inside: Inside, gas: ScrollGasCycle, operating: Operating
) -> tuple[Array, list[str], dict[str, tuple[tuple[Complex, Complex], tuple[Complex, Complex]]]]:
    """Frequencies and names of lines that are no shaft orders, and the loads of both sources."""
    ratio = operating.line_frequency_hz / inside.motor.line_frequency_hz
    motor = inside.motor.model_copy(
        update={
            "line_frequency_hz": operating.line_frequency_hz,
            "line_voltage_v": ratio * inside.motor.line_voltage_v,
            **{
                name: ratio * getattr(inside.motor, name)
                for name in (
                    "main_leakage_ohm", "auxiliary_leakage_ohm", "magnetising_ohm",
                    "rotor_leakage_ohm",
                )
            },
        }
    )  # fmt: skip
    torque = order_spectrum(gas.torque_n_m, operating.maximum_order)
    found = torque_lines(motor, inside.rotor.inertia_kg_m2, list(torque))
    own = [
        line
        for line in (*found.line, *found.sidebands)
        if 10.0 <= line.frequency_hz <= operating.maximum_frequency_hz
    ]
    none = stator_loads(()), stator_loads([])
    shaft, electrical = stator_loads(found.shaft), stator_loads(own)
    quiet_shaft = np.zeros_like(shaft[0]), np.zeros_like(shaft[1])
    quiet_own = np.zeros_like(electrical[0]), np.zeros_like(electrical[1])
    del none
    return (
        np.array([line.frequency_hz for line in own]),
        [line.name for line in own],
        {"torque_ripple": (shaft, quiet_own), "motor": (quiet_shaft, electrical)},
    )


def _keys(
    inside: Inside,
    machine: OldhamScroll,
    option: object,
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
    lost = contact_loss_speed_rpm(inside.keys, ring, stroke, float(np.mean(moment)))
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
    orders[joint, PAIRS[0]] = order_spectrum(mean, operating.maximum_order)
    block = 2 * mean.shape[-1] if forces.revolutions > 1 else mean.shape[-1]
    frequency, density = spectral_density(rest, forces.sample_rate_hz, block)
    kept = frequency <= operating.maximum_frequency_hz
    return orders, Noise(joint, frequency[kept], density[..., kept])


def ring_force(option: object, hanging_n: Array, machine: OldhamScroll, speed_rpm: float) -> Array:
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
