"""Forces of the parts in the shell on its wall, per load on a part."""

import numpy as np

from ...base.arrays import Array, ComplexArray
from ..shell_modes import velocity_per_force
from .inner import InnerSet


def shell_compliance(
    modal_forces: Array,
    natural_hz: Array,
    modal_mass_kg: Array,
    loss_factor_ratio: float,
    residual: Array,
    rigid: ComplexArray | Array,
    frequency_hz: Array,
) -> ComplexArray:
    """Displacement of the shell's contacts per force on them, (frequency, contact, contact).

    Elastic modes, the flexibility that the modes leave out, and the rigid motion.

    Parameters
    ----------
    modal_forces : generalised force of each mode per force on a contact, shape (mode, contact)
    natural_hz, modal_mass_kg : of the modes, shape (mode,)
    loss_factor_ratio : of the shell
    residual : steady flexibility without the modes' share, shape (contact, contact), m/N
    rigid : acceleration of the contacts per force as a rigid body, (contact, contact), 1/kg
    frequency_hz : above zero, shape (frequency,)
    """
    omega = 2.0 * np.pi * frequency_hz[:, None]
    velocity = velocity_per_force(natural_hz, modal_mass_kg, loss_factor_ratio, frequency_hz).T
    moved = (velocity / (1j * omega))[:, None, :] * modal_forces.T
    of_modes = moved @ modal_forces
    of_rigid = rigid / omega[:, :, None] ** 2
    return np.asarray(of_modes + residual / (1.0 + 1j * loss_factor_ratio) - of_rigid)


def contact_forces(
    inner: InnerSet, stiffness: ComplexArray, compliance: ComplexArray, frequency_hz: Array
) -> ComplexArray:
    """Force of the parts on the shell per load on a part, (frequency, contact, load).

    f = Y B q with (D + Bᵀ Y B) q = P and Y = (1 + k C)⁻¹ k, which is
    (C + B D⁻¹ Bᵀ + k⁻¹)⁻¹ B D⁻¹ P and holds for soft contacts and at D's resonances too.

    Parameters
    ----------
    inner : mass and stiffness of the parts, contacts B, loads P
    stiffness : k of the contacts, shape (contact,), N/m
    compliance : C of the shell at the contacts, shape (frequency, contact, contact), m/N
    frequency_hz : above zero, shape (frequency,)
    """
    through = _held(stiffness, compliance, inner.contacts)
    dynamic = _dynamic(inner, through, frequency_hz)
    loads = np.broadcast_to(inner.loads, (frequency_hz.size, *inner.loads.shape))
    return np.asarray(through @ np.linalg.solve(dynamic, loads))


def reaction_forces(
    inner: InnerSet,
    stiffness: ComplexArray,
    compliance: ComplexArray,
    frequency_hz: Array,
    moved: ComplexArray,
) -> ComplexArray:
    """Force of the parts on a shell that something else moves, (frequency, contact, load).

    f = Y (B q - u) with (D + Bᵀ Y B) q = Bᵀ Y u, u the motion without the parts.

    Parameters
    ----------
    inner, stiffness, compliance, frequency_hz : see `contact_forces`
    moved : u of the contacts, shape (frequency, contact, load), m
    """
    through = _held(stiffness, compliance, inner.contacts)
    by_motion = _held(stiffness, compliance, moved)
    drive = inner.contacts.T @ by_motion
    parts = np.linalg.solve(_dynamic(inner, through, frequency_hz), drive)
    return np.asarray(through @ parts - by_motion)


def _held(
    stiffness: ComplexArray, compliance: ComplexArray, motion: Array | ComplexArray
) -> ComplexArray:
    """Y u, Y = (1 + k C)⁻¹ k: forces of contacts on the shell by their other ends' motion u."""
    weighted = np.eye(stiffness.size) + stiffness[:, None] * compliance
    return np.asarray(np.linalg.solve(weighted, stiffness[:, None] * motion))


def _dynamic(inner: InnerSet, through: ComplexArray, frequency_hz: Array) -> ComplexArray:
    """D + Bᵀ Y B."""
    squares = (2.0 * np.pi * frequency_hz[:, None, None]) ** 2
    return np.asarray(inner.stiffness - squares * inner.mass + inner.contacts.T @ through)
