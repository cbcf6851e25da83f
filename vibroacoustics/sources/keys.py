"""Keys of the Oldham ring, and of further rings, as a source."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np
from pydantic import Field

from ..base.arrays import Array, ComplexArray
from ..base.curves import Curve
from ..base.parameters import Parameters
from ..base.registry import register
from ..machine.machine import Machine
from ..machine.shell_structure import BEARING_HOUSING, JOINTS, STATOR
from ..machine.source import Case, Source
from ..mechanics.added import FurtherRing, RingForce
from ..mechanics.capabilities import Capability, OldhamRing
from ..mechanics.loads import JOINT_COMPONENTS, Loads, Noise
from ..orders import order_spectrum
from .gas import gas_cycle, gas_tables
from .joint_loads import key_loads, key_torque_n_m
from .oldham_keys.contact_loss import contact_loss_speed_rpm
from .oldham_keys.curves import oldham_key_curves
from .oldham_keys.parameters import OldhamKeys
from .oldham_keys.rattle import KeyForces, steady_key_forces
from .oldham_keys.spectra import spectral_density, split_periodic
from .scroll_gas.parameters import ScrollGas, ScrollWraps

KEY_COMPONENTS: Final = (0, 1, 3)
"""Components that the keys load: along x and y, about z."""
NOTHING_HUNG: Final = RingForce(np.zeros(1))
"""Force on a ring that carries nothing."""


@dataclass(frozen=True)
class _Ring:
    """A ring at one speed: its mass, its stroke, what turns the scroll, what hangs on it."""

    mass_kg: float
    stroke_m: float
    moment_n_m: Array
    hung_n: Array


_Spectra = tuple[ComplexArray, ComplexArray, Noise]
"""Orders of the load on the joints and of the shaft's torque, and the load's noise."""


@register
class OldhamKeyForces(Source):
    """Keys that press, slide and strike in their slots."""

    kind: ClassVar[str] = "oldham-keys"
    position: ClassVar[float] = 2.0
    label: ClassVar[str] = "Oldham keys"
    labels: ClassVar[Mapping[str, str]] = {
        "key_impacts_per_revolution": "Impacts of the keys per revolution",
        "key_force_peak_n": "Largest force on a key",
        "key_contact_lost_above_rpm": "Speed above which keys lose contact, with friction",
    }
    tables: ClassVar[Mapping[str, type[Parameters]]] = {
        "keys": OldhamKeys,
        "wraps": ScrollWraps,
        "gas": ScrollGas,
    }
    needs: ClassVar[type[Capability]] = OldhamRing
    drives_shell: ClassVar[bool] = True
    revolutions: int = Field(default=8, ge=1, le=1000)
    """Over which the forces are taken."""

    @classmethod
    def tables_read(cls, machine: Machine) -> Mapping[str, type[Parameters]]:
        """Keys, and what the gas that presses them needs."""
        return {"keys": OldhamKeys, **gas_tables(machine)}

    def loads(self, case: Case, before: Mapping[str, Loads]) -> Loads:
        """Loads of the ring's keys on the bearing housing, of further rings' on the stator."""
        ring, keys = case.machine.require(OldhamRing), case.machine.table(OldhamKeys)
        turning, hung = _turning(case), case.added.on_ring or NOTHING_HUNG
        moment = turning.moment_n_m
        forces = self._forces(case, turning)
        spectra = [_spectra(case, keys, turning, forces, BEARING_HOUSING, 1.0)]
        figures = {
            "key_impacts_per_revolution": forces.impacts_per_revolution,
            "key_force_peak_n": float(forces.peak_n.max()),
        }
        first = order_spectrum(hung.force_n, 1)[1] if hung.force_n.size > 1 else 0.0j
        if hung.from_housing:
            spectra[0][0][BEARING_HOUSING, 0, 1] -= first
        if hung.inertial:
            omega = 2.0 * np.pi * case.shaft_frequency_hz
            carried = ring.mass_kg + first.real / (ring.stroke_m * omega**2)
            lost = contact_loss_speed_rpm(keys, carried, ring.stroke_m, moment)
            figures["key_contact_lost_above_rpm"] = lost
        for further in case.added.rings:
            twin, seen = self._further(case, further)
            spectra.append(twin)
            figures |= seen
        joints, torques, noise = zip(*spectra, strict=True)
        return Loads(
            joints=np.sum(joints, axis=0),
            shaft_torque_n_m=np.sum(torques, axis=0),
            noise=noise,
            figures=figures,
        )

    def curves(self, case: Case) -> Iterable[Curve]:
        """Forces on the keys of the machine's ring; see `oldham_key_curves`."""
        one = self.model_copy(update={"revolutions": 1})
        return oldham_key_curves(one._forces(case, _turning(case)))

    def _further(self, case: Case, ring: FurtherRing) -> tuple[_Spectra, dict[str, float]]:
        """Spectra and figures of the keys of a second ring, which no gas presses."""
        free = _Ring(ring.mass_kg, ring.stroke_m, np.zeros(1), np.zeros(1))
        forces, keys = self._forces(case, free), case.machine.table(OldhamKeys)
        # In opposite phase: all is turned by half a turn about the shaft.
        return _spectra(case, keys, free, forces, STATOR, -1.0), {
            "twin_key_impacts_per_revolution": forces.impacts_per_revolution,
            "twin_key_force_peak_n": float(forces.peak_n.max()),
        }

    def _forces(self, case: Case, ring: _Ring) -> KeyForces:
        """Simulated forces of one ring's keys, once for all cases that share them."""
        keys, numbers = case.machine.table(OldhamKeys), (ring.mass_kg, ring.stroke_m)
        courses = (ring.moment_n_m.tobytes(), ring.hung_n.tobytes())
        return case.shared(
            ("keys", keys, *numbers, case.speed_rpm, self.revolutions, *courses),
            lambda: steady_key_forces(
                keys, *numbers, case.speed_rpm, ring.moment_n_m, ring.hung_n, self.revolutions
            ),
        )


def _turning(case: Case) -> _Ring:
    """The machine's ring with the gas moment that presses its keys and what hangs on it."""
    ring = case.machine.require(OldhamRing)
    moment = gas_cycle(case.machine, case.shared, case.speed_rpm).self_rotation_moment_n_m
    return _Ring(ring.mass_kg, ring.stroke_m, moment, (case.added.on_ring or NOTHING_HUNG).force_n)


def _spectra(
    case: Case, keys: OldhamKeys, ring: _Ring, forces: KeyForces, joint: int, sense: float
) -> _Spectra:
    """Orders of the load on the joints and of the shaft's torque, and the load's noise.

    Parameters
    ----------
    case : for the highest frequency
    keys, ring : that made the forces
    forces : of all four keys
    joint : that they load
    sense : -1 for a ring in opposite phase
    """
    highest = case.maximum_order
    load = key_loads(forces, keys.radius_m, ring.stroke_m)
    load[:2] *= sense
    mean, rest = split_periodic(load, forces.revolutions)
    orders = np.zeros((len(JOINTS), JOINT_COMPONENTS, highest + 1), dtype=complex)
    orders[joint, KEY_COMPONENTS] = order_spectrum(mean, highest)
    torque_n_m = key_torque_n_m(forces, ring.stroke_m)
    torque = order_spectrum(split_periodic(torque_n_m, forces.revolutions)[0], highest)
    torque[0] = 0.0  # all friction is left out of the mean
    block = 2 * mean.shape[-1] if forces.revolutions > 1 else mean.shape[-1]
    frequency, density = spectral_density(rest, forces.sample_rate_hz, block)
    kept = frequency <= case.maximum_frequency_hz
    return orders, torque, Noise(joint, KEY_COMPONENTS, frequency[kept], density[..., kept])
