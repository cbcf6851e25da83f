"""Keys of the ring, and of a twin ring: what they do to joints and shaft."""

from dataclasses import dataclass, field
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..mechanics.added import Added, FurtherRing, RingForce
from ..mechanics.capabilities import OldhamRing
from ..mechanics.rotation import Array
from ..orders import order_spectrum
from ..parameters.oldham_keys import OldhamKeys
from ..parameters.shell_structure import JOINTS
from ..sources.joint_loads import (
    BEARING_HOUSING,
    COMPONENTS,
    STATOR,
    key_loads,
    key_torque_n_m,
)
from ..sources.oldham_keys.contact_loss import contact_loss_speed_rpm
from ..sources.oldham_keys.rattle import KeyForces, steady_key_forces
from ..sources.oldham_keys.spectra import spectral_density, split_periodic
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
    ring: OldhamRing,
    added: Added,
    moment_n_m: Array,
    operating: Operating,
) -> KeySources:
    """Loads of the ring's keys and of those of further rings.

    Parameters
    ----------
    runs : of the keys
    ring : of the machine
    added : by the option
    moment_n_m : of the gas on the orbiting scroll, over uniform crank angles
    operating : the speed
    """
    keys, stroke, hung = runs.keys, ring.stroke_m, added.on_ring or NOTHING_HUNG
    forces = runs.forces(ring.mass_kg, stroke, operating, moment_n_m, hung.force_n)
    load = key_loads(forces, keys.radius_m, stroke)
    total = _spectra(load, key_torque_n_m(forces, stroke), forces, operating, BEARING_HOUSING)
    total.facts.update(
        key_impacts_per_revolution=forces.impacts_per_revolution,
        key_force_peak_n=float(forces.peak_n.max()),
    )
    first = order_spectrum(hung.force_n, 1)[1]
    if hung.from_housing:
        total.load[BEARING_HOUSING, 0, 1] -= first
    if hung.inertial:
        omega = 2.0 * np.pi * shaft_frequency_hz(operating.speed_rpm)
        carried = ring.mass_kg + first.real / (stroke * omega**2)
        lost = contact_loss_speed_rpm(keys, carried, stroke, moment_n_m)
        total.facts["key_contact_lost_above_rpm"] = lost
    for further in added.rings:
        total = _with(total, _further_ring(runs, further, operating))
    return total


NOTHING_HUNG: Final = RingForce(np.zeros(64))
"""Force on a ring that carries nothing: few samples, all zero."""


def _further_ring(runs: KeyRuns, ring: FurtherRing, operating: Operating) -> KeySources:
    """Keys of a second ring, which no gas loads."""
    free = np.zeros(1)
    forces = runs.forces(ring.mass_kg, ring.stroke_m, operating, free, free)
    load = key_loads(forces, runs.keys.radius_m, ring.stroke_m)
    load[:2] *= -1.0  # in opposite phase: all is turned by half a turn about the shaft
    torque = key_torque_n_m(forces, ring.stroke_m)
    turned = _spectra(load, torque, forces, operating, STATOR)
    turned.facts.update(
        twin_key_impacts_per_revolution=forces.impacts_per_revolution,
        twin_key_force_peak_n=float(forces.peak_n.max()),
    )
    return turned


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
