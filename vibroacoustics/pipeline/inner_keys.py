"""Keys of the ring, and of a twin ring: what they do to joints and shaft."""

from dataclasses import dataclass, field
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..mechanisms.inner_loads import (
    BEARING_HOUSING,
    COMPONENTS,
    STATOR,
    key_loads,
    key_torque_n_m,
)
from ..mechanisms.oldham_keys.contact_loss import contact_loss_speed_rpm
from ..mechanisms.oldham_keys.rattle import KeyForces, steady_key_forces
from ..mechanisms.oldham_keys.spectra import spectral_density, split_periodic
from ..orders import order_spectrum
from ..parameters.oldham_keys import OldhamKeys
from ..parameters.oldham_scroll import OldhamScroll
from ..parameters.options import Option, Pendulum, RingDamping, SprungMass, TwinOldham
from ..parameters.shell_structure import JOINTS
from ..rotation import Array, uniform_crank_angle
from ..units import orders_below, shaft_frequency_hz

Complex = NDArray[np.complex128]

KEY_COMPONENTS: Final = (0, 1, 3)
"""Components that the keys load: along x and y, about z."""


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
        return orders_below(self.maximum_frequency_hz, self.speed_rpm)


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
class KeySources:
    """What the keys do.

    Attributes
    ----------
    load : on the joints by order, complex peaks, shape (joint, component, order), N and N m
    torque_n_m : that the shaft needs against them, complex peaks, shape (order,)
    noise : of each ring
    facts : figures to report, by name
    """

    load: Complex
    torque_n_m: Complex
    noise: list[Noise]
    facts: dict[str, float]


@dataclass(frozen=True)
class KeyRuns:
    """Simulations of one kind of keys; each is run once, as options share them."""

    keys: OldhamKeys
    _known: dict[tuple[object, ...], KeyForces] = field(default_factory=dict, repr=False)

    def forces(
        self,
        ring_mass_kg: float,
        stroke_m: float,
        operating: Operating,
        moment_n_m: Array,
        ring_force_n: Array,
    ) -> KeyForces:
        """Forces of all keys; for the parameters see `steady_key_forces`."""
        speed, revolutions = operating.speed_rpm, operating.key_revolutions
        numbers = (ring_mass_kg, stroke_m, speed, revolutions)
        key = (*numbers, moment_n_m.tobytes(), ring_force_n.tobytes())
        if key not in self._known:
            self._known[key] = steady_key_forces(
                self.keys, ring_mass_kg, stroke_m, speed, moment_n_m, ring_force_n, revolutions
            )
        return self._known[key]


def key_sources(
    runs: KeyRuns,
    machine: OldhamScroll,
    option: Option,
    moment_n_m: Array,
    ring_force_n: Array,
    operating: Operating,
) -> KeySources:
    """Loads of the ring's keys and, with a twin ring, of the twin's.

    Parameters
    ----------
    runs : of the keys
    machine : the ring and its stroke
    option : of the study
    moment_n_m : of the gas on the orbiting scroll, over uniform crank angles
    ring_force_n : of what hangs on the ring, along x over uniform crank angles
    operating : the speed
    """
    keys, stroke = runs.keys, machine.kinematics.orbit_radius_m
    forces = runs.forces(machine.oldham.mass_kg, stroke, operating, moment_n_m, ring_force_n)
    load = key_loads(forces, keys.radius_m, stroke)
    found = _spectra(load, key_torque_n_m(forces, stroke), forces, operating, BEARING_HOUSING)
    found.facts.update(
        key_impacts_per_revolution=forces.impacts_per_revolution,
        key_force_peak_n=float(forces.peak_n.max()),
    )
    first = order_spectrum(ring_force_n, 1)[1]
    if isinstance(option, RingDamping):  # its layer pushes the housing back
        found.load[BEARING_HOUSING, 0, 1] -= first
    if not isinstance(option, SprungMass):  # whose force does not grow as the speed squared
        omega = 2.0 * np.pi * shaft_frequency_hz(operating.speed_rpm)
        carried = machine.oldham.mass_kg + first.real / (stroke * omega**2)
        lost = contact_loss_speed_rpm(keys, carried, stroke, moment_n_m)
        found.facts["key_contact_lost_above_rpm"] = lost
    if not isinstance(option, TwinOldham):
        return found
    return _with(found, _twin(runs, option, option.stroke_ratio * stroke, operating))


def _twin(runs: KeyRuns, option: TwinOldham, stroke_m: float, operating: Operating) -> KeySources:
    """Keys of a twin ring, which no gas loads."""
    free = np.zeros(1)
    forces = runs.forces(option.mass_kg, stroke_m, operating, free, free)
    load = key_loads(forces, runs.keys.radius_m, stroke_m)
    load[:2] *= -1.0  # in opposite phase: all is turned by half a turn about the shaft
    found = _spectra(load, key_torque_n_m(forces, stroke_m), forces, operating, STATOR)
    found.facts.update(
        twin_key_impacts_per_revolution=forces.impacts_per_revolution,
        twin_key_force_peak_n=float(forces.peak_n.max()),
    )
    return found


def _with(one: KeySources, other: KeySources) -> KeySources:
    return KeySources(
        one.load + other.load,
        one.torque_n_m + other.torque_n_m,
        one.noise + other.noise,
        one.facts | other.facts,
    )


def _spectra(
    load: Array, torque_n_m: Array, forces: KeyForces, operating: Operating, joint: int
) -> KeySources:
    """Orders and noise of loads on a joint, (3, samples), and of a torque, (samples,)."""
    highest = operating.maximum_order
    mean, rest = split_periodic(load, forces.revolutions)
    orders = np.zeros((len(JOINTS), COMPONENTS, highest + 1), dtype=complex)
    orders[joint, KEY_COMPONENTS] = order_spectrum(mean, highest)
    torque = order_spectrum(split_periodic(torque_n_m, forces.revolutions)[0], highest)
    block = 2 * mean.shape[-1] if forces.revolutions > 1 else mean.shape[-1]
    frequency, density = spectral_density(rest, forces.sample_rate_hz, block)
    kept = frequency <= operating.maximum_frequency_hz
    return KeySources(orders, torque, [Noise(joint, frequency[kept], density[..., kept])], {})


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
    if isinstance(option, HUNG_ON_RING):
        return hanging_n
    return np.zeros_like(hanging_n)


HUNG_ON_RING: Final = (Pendulum, SprungMass)
"""Options whose moving parts push the ring."""
