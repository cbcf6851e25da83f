"""Keys of the Oldham ring, and of further rings, as a source."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from pydantic import Field

from ..base.arrays import Array, ComplexArray
from ..base.curves import Curve
from ..base.errors import ParameterError
from ..base.parameters import Parameters
from ..base.registry import register
from ..machine.frame import BEARING_HOUSING, FIXED_SCROLL, LOWER_BEARING, ORBITING_SCROLL, Frame
from ..machine.machine import Machine
from ..machine.source import Case, Source
from ..mechanics.added import FurtherRing, RingForce
from ..mechanics.capabilities import Capability, OldhamRing
from ..mechanics.loads import Loads, Noise, summed
from ..mechanics.ports import Port
from ..orders import order_spectrum
from .gas import gas_cycle, gas_tables
from .oldham_keys.contact import OldhamKeys
from .oldham_keys.rattle import (
    KeyForces,
    contact_loss_speed_rpm,
    oldham_key_curves,
    steady_key_forces,
)
from .part_loads import key_parts, key_resultants, key_torque_n_m
from .scroll_gas.parameters import ScrollGas, ScrollWraps


def split_periodic(force_n: Array, revolutions: int) -> tuple[Array, Array]:
    """Split forces into their mean revolution and the rest, which does not repeat.

    When a force never repeats, the mean keeps 1/revolutions of the power.

    Parameters
    ----------
    force_n : whole revolutions, shape (..., samples)
    revolutions : their number

    Returns
    -------
    mean, rest : shapes (..., samples of a revolution) and (..., samples)
    """
    turns = force_n.reshape(*force_n.shape[:-1], revolutions, -1)
    mean = turns.mean(axis=-2)
    return mean, (turns - mean[..., None, :]).reshape(force_n.shape)


def spectral_density(
    force_n: Array, sample_rate_hz: float, block_samples: int, highest_hz: float = np.inf
) -> tuple[Array, ComplexArray]:
    """One-sided spectral densities of forces and of their pairs (Welch 1967): N²/Hz.

    S_ij = 2/(f_s Σ w²) <X_i* X_j> over blocks that overlap by half, Hann window. A weighted sum
    Σ h_i f_i has the density Σ h_i* S_ij h_j, which keeps the phases between the keys.

    Parameters
    ----------
    force_n : shape (forces, samples)
    sample_rate_hz : samples a second
    block_samples : length of a block, even; several revolutions resolve the orders
    highest_hz : lines up to here

    Returns
    -------
    frequency_hz, density : shapes (lines,) and (forces, forces, lines)

    Raises
    ------
    ParameterError
        The block is odd, or longer than the forces.
    """
    if block_samples % 2 or not 2 <= block_samples <= force_n.shape[-1]:
        raise ParameterError(
            f"block_samples = {block_samples}: must be even and from 2 to {force_n.shape[-1]}"
        )
    window = 0.5 - 0.5 * np.cos(2.0 * np.pi * np.arange(block_samples) / block_samples)
    blocks = sliding_window_view(force_n, block_samples, axis=-1)[:, :: block_samples // 2]
    frequency = np.fft.rfftfreq(block_samples, 1.0 / sample_rate_hz).astype(float)
    share = np.where((frequency > 0.0) & (np.arange(frequency.size) < block_samples // 2), 2.0, 1.0)
    kept = frequency <= highest_hz
    spectra = np.fft.rfft(blocks * window, axis=-1)[..., kept]
    products = np.einsum("ibf,jbf->ijf", spectra.conj(), spectra, optimize=True)
    density = products * (share[kept] / (sample_rate_hz * np.sum(window**2) * blocks.shape[1]))
    return frequency[kept], np.asarray(density)


NOTHING_HUNG: Final = RingForce(np.zeros(1))
"""Force on a ring that carries nothing."""


@dataclass(frozen=True)
class _Ring:
    """A ring at one speed, with the moment on the part that it keeps from turning."""

    keys: OldhamKeys
    mass_kg: float
    stroke_m: float
    moment_n_m: Array
    force: RingForce


_Spectra = tuple[dict[Port, ComplexArray], ComplexArray, Noise]
"""Orders of the load on the parts and of the shaft's torque, and the load's noise."""


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
    """Revolutions over which the forces are taken."""
    start: int = Field(default=0, ge=0, le=2**31 - 1)
    """Number of the start: 0 from rest, others with random speeds; impacts scatter with it."""

    @classmethod
    def tables_read(cls, machine: Machine) -> Mapping[str, type[Parameters]]:
        """Keys, and what the gas that presses them needs."""
        return {"keys": OldhamKeys, **gas_tables(machine)}

    def loads(self, case: Case, before: Mapping[str, Loads]) -> Loads:
        """Loads of the keys on housing and scroll, of a second ring's on the lower bearing."""
        ring, keys = case.machine.require(OldhamRing), case.machine.table(OldhamKeys)
        turning = _turning(case)
        hung = turning.force
        moment = turning.moment_n_m
        forces = self._forces(case, turning)
        standing = _standing(case.machine)
        on_parts = key_parts(standing, ORBITING_SCROLL, ring.height_m)
        spectra = [_spectra(case, turning, forces, on_parts)]
        if case.machine.has_table(Frame):  # the gas source turns the scroll against the keys
            spectra[0][0][standing][5] -= order_spectrum(turning.moment_n_m, case.maximum_order)
        figures = {
            "key_impacts_per_revolution": forces.impacts_per_revolution,
            "key_force_peak_n": float(forces.peak_n.max()),
        }
        first = order_spectrum(hung.force_n, 1)[1] if hung.force_n.size > 1 else 0.0j
        if hung.inertial:
            omega = 2.0 * np.pi * case.shaft_frequency_hz
            carried = ring.mass_kg + first.real / (ring.stroke_m * omega**2)
            lost = contact_loss_speed_rpm(keys, carried, ring.stroke_m, moment)
            figures["key_contact_lost_above_rpm"] = lost
        for further in case.added.rings:
            twin, further_figures = self._further(case, further)
            spectra.append(twin)
            figures |= further_figures
        of_rings, torques, noise = zip(*spectra, strict=True)
        return Loads(
            lines=summed(of_rings),
            shaft_torque_n_m=np.sum(torques, axis=0),
            noise=noise,
            figures=figures,
        )

    def curves(self, case: Case) -> Iterable[Curve]:
        """Forces on the keys of the machine's ring; see `oldham_key_curves`."""
        short = self.model_copy(update={"revolutions": 1})
        return oldham_key_curves(short._forces(case, _turning(case)))

    def _further(self, case: Case, ring: FurtherRing) -> tuple[_Spectra, dict[str, float]]:
        """Spectra and figures of the keys of a second ring, which no gas presses."""
        keys, inertia = case.machine.table(OldhamKeys), ring.driven_inertia_kg_m2
        if inertia is not None:
            keys = keys.model_copy(update={"scroll_inertia_kg_m2": inertia})
        moment = np.array([ring.moment_n_m])
        free = _Ring(keys, ring.mass_kg, ring.stroke_m, moment, ring.on_ring or NOTHING_HUNG)
        forces = self._forces(case, free)
        on_parts = key_parts(LOWER_BEARING, LOWER_BEARING, ring.height_m)
        # In opposite phase: all is turned by half a turn about the shaft.
        on_parts[LOWER_BEARING][:5] *= -1.0
        return _spectra(case, free, forces, on_parts), {
            "twin_key_impacts_per_revolution": forces.impacts_per_revolution,
            "twin_key_force_peak_n": float(forces.peak_n.max()),
        }

    def _forces(self, case: Case, ring: _Ring) -> KeyForces:
        """Simulated forces of one ring's keys, once for all cases that share them."""
        keys, numbers = ring.keys, (ring.mass_kg, ring.stroke_m)
        histories = (ring.moment_n_m.tobytes(), ring.force.force_n.tobytes())
        return case.shared(
            ("keys", keys, *numbers, case.speed_rpm, self.revolutions, self.start, *histories),
            lambda: steady_key_forces(
                keys,
                *numbers,
                case.speed_rpm,
                ring.moment_n_m,
                ring.force.force_n,
                self.revolutions,
                self.start,
            ),
        )


def _standing(machine: Machine) -> Port:
    """Part with the slots that stand."""
    if machine.has_table(Frame) and machine.table(Frame).keys_on == "fixed-scroll":
        return FIXED_SCROLL
    return BEARING_HOUSING


def resolved_orders(signal: Array, highest: int) -> ComplexArray:
    """Orders 0 to the highest of one revolution, shape (order,); zero where samples are too few.

    An option gives its force at the crank angles of the forces, a study its highest order.

    Parameters
    ----------
    signal : shape (sample,)
    highest : order
    """
    resolved = min(highest, (signal.size - 1) // 2)
    spectrum = np.zeros(highest + 1, dtype=complex)
    spectrum[: resolved + 1] = order_spectrum(signal, resolved)
    return spectrum


def _turning(case: Case) -> _Ring:
    """The machine's ring with the gas moment that presses its keys and the parts on it."""
    ring = case.machine.require(OldhamRing)
    gas = gas_cycle(case.machine, case.shared, case.speed_rpm).self_rotation_moment_n_m
    moment, force = gas + case.added.on_scroll_n_m, case.added.on_ring or NOTHING_HUNG
    return _Ring(case.machine.table(OldhamKeys), ring.mass_kg, ring.stroke_m, moment, force)


def _spectra(
    case: Case,
    ring: _Ring,
    forces: KeyForces,
    on_parts: Mapping[Port, Array],
) -> _Spectra:
    """Orders of the load on the parts and of the shaft's torque, and the load's noise.

    Parameters
    ----------
    case : for the highest frequency
    ring : that made the forces
    forces : forces of all four keys
    on_parts : load on each part per unit of each resultant
    """
    highest = case.maximum_order
    resultants = key_resultants(forces, ring.keys.radius_m, ring.stroke_m)
    mean, fluctuation = split_periodic(resultants, forces.revolutions)
    torque_n_m = key_torque_n_m(forces, ring.stroke_m)
    torque = order_spectrum(split_periodic(torque_n_m, forces.revolutions)[0], highest)
    torque[0] = 0.0  # the mean holds no friction
    block = 2 * mean.shape[-1] if forces.revolutions > 1 else mean.shape[-1]
    highest_hz = case.maximum_frequency_hz
    noise = Noise(
        on_parts, *spectral_density(fluctuation, forces.sample_rate_hz, block, highest_hz)
    )
    orders = order_spectrum(mean, highest)
    if ring.force.from_housing and ring.force.force_n.size > 1:
        orders[0] -= resolved_orders(ring.force.force_n, highest)
    return {part: per_force @ orders for part, per_force in on_parts.items()}, torque, noise
