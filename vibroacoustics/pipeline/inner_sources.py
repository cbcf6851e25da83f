"""Loads of gas, keys and motor on the shell's joints, as lines and as random noise."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np

from ..mechanics.added import Added
from ..mechanics.capabilities import OldhamRing
from ..mechanics.rotation import Array, uniform_crank_angle
from ..orders import order_spectrum
from ..parameters.inside import Inside
from ..sources.induction_motor.torque_lines import TorqueLine, TorqueLines, torque_lines
from ..sources.joint_loads import gas_loads, stator_loads
from ..sources.scroll_gas.cycle import ScrollGasCycle, scroll_gas_cycle
from ..units import shaft_frequency_hz
from .inner_keys import Complex, KeyRuns, Noise, Operating, key_sources

GAS_SAMPLES: Final = 8192
"""Crank angles a revolution: the step of the force where a pocket opens makes an error of the
step over the samples, below 1 % of the order at 4 kHz."""
LOWEST_LINE_HZ: Final = 10.0
"""Sidebands below are no sound."""


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
class InnerSources:
    """The inner sources with one set of values, and what no speed or option changes of them."""

    inside: Inside

    @cached_property
    def gas(self) -> ScrollGasCycle:
        """One revolution."""
        return scroll_gas_cycle(
            self.inside.wraps, self.inside.gas, uniform_crank_angle(GAS_SAMPLES)
        )

    @cached_property
    def key_runs(self) -> KeyRuns:
        return KeyRuns(self.inside.keys)

    def loads(self, ring: OldhamRing, added: Added, operating: Operating) -> InnerLoads:
        """Loads of gas, keys, torque ripple and motor with one balancing option.

        Parameters
        ----------
        ring : of the machine
        added : by the option
        operating : the speed
        """
        highest, gas = operating.maximum_order, self.gas
        moment = gas.self_rotation_moment_n_m
        keys = key_sources(self.key_runs, ring, added, moment, operating)
        torque = order_spectrum(gas.torque_n_m, highest)
        torque[1:] += keys.torque_n_m[1:]  # all friction is left out of the mean
        torques = _motor_torques(self.inside, torque, operating)
        own = [
            line
            for line in (*torques.line, *torques.sidebands)
            if LOWEST_LINE_HZ <= line.frequency_hz <= operating.maximum_frequency_hz
        ]
        count = highest + 1 + len(own)
        lines = {
            "gas": _at_orders(order_spectrum(gas_loads(gas), highest), len(own)),
            "keys": _at_orders(keys.load, len(own)),
            "torque_ripple": _torques(torques.shaft, 1, count),
            "motor": _torques(own, highest + 1, count),
        }
        order_hz = shaft_frequency_hz(operating.speed_rpm) * np.arange(highest + 1)
        return InnerLoads(
            (*(f"order {order}" for order in range(highest + 1)), *(line.name for line in own)),
            np.concatenate([order_hz, [line.frequency_hz for line in own]]),
            lines,
            {"keys": keys.noise},
            keys.facts,
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


def _motor_torques(inside: Inside, load_torque: Complex, operating: Operating) -> TorqueLines:
    """Torque balance with the motor on the supply of this speed, at the same flux."""
    ratio = operating.line_frequency_hz / inside.motor.line_frequency_hz
    grown = {name: ratio * getattr(inside.motor, name) for name in _GROW_WITH_FREQUENCY}
    motor = inside.motor.model_copy(
        update={"line_frequency_hz": operating.line_frequency_hz, **grown}
    )
    return torque_lines(motor, inside.rotor.inertia_kg_m2, list(load_torque))


_GROW_WITH_FREQUENCY: Final = (
    "line_voltage_v",
    "main_leakage_ohm",
    "auxiliary_leakage_ohm",
    "magnetising_ohm",
    "rotor_leakage_ohm",
)
