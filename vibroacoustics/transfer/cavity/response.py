"""Pressure of a gas that a volume flow drives, mode by mode (Fahy & Gardonio 2007, chapter 7)."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from ...base.arrays import Array, ComplexArray


@dataclass(frozen=True)
class DrivenGas:
    """Modes of a gas between rigid walls, with ∫ φ² dV = 1, and what they meet.

    Attributes
    ----------
    wavenumber_squared : k² of the modes, shape (mode,), 1/m²
    at_source, at_tube : φ at the source and at the mouth of a tube without reflection, shape
        (mode,)
    on_wall : ∫ φ ψ dS with the outward motion ψ of each of the wall's modes, shape (mode, wall)
    tube_area_m2 : cross-section of the tube; 0 for none
    quality_ratio : Q
    """

    wavenumber_squared: Array
    at_source: Array
    at_tube: Array
    on_wall: Array
    tube_area_m2: float
    quality_ratio: float

    def pressure(
        self, density: float, sound_speed: float, frequency_hz: Array, drive: ComplexArray
    ) -> ComplexArray:
        """Amplitudes p of the modes, shape (mode, load, frequency).

        [(ω_n² (1 + j/Q) - ω²)/(ρ c²) + jω S/(ρ c) φ_n(tube) φ_m(tube)] p_m = drive_n; the tube's
        share by the formula of Sherman and Morrison (1950).

        Parameters
        ----------
        density, sound_speed : density and speed of sound of the gas, kg/m³ and m/s
        frequency_hz : above zero, shape (frequency,)
        drive : jω Q φ(source) of a volume flow, ω² C x of the wall; shape (mode, load, frequency)
        """
        omega = 2.0 * np.pi * frequency_hz
        squares = sound_speed**2 * self.wavenumber_squared * (1.0 + 1j / self.quality_ratio)
        compliance = density * sound_speed**2 / (squares[:, None] - omega**2)
        free = compliance[:, None] * drive
        admittance = 1j * omega * self.tube_area_m2 / (density * sound_speed)
        mouth = self.at_tube[:, None] * compliance
        share = admittance / (1.0 + admittance * (self.at_tube @ mouth))
        at_mouth = np.einsum("m,mlf->lf", self.at_tube, free)
        return np.asarray(free - mouth[:, None] * (share * at_mouth))

    def of_flow(self, density: float, sound_speed: float, frequency_hz: Array) -> ComplexArray:
        """Amplitudes of the modes per volume flow of the source, (mode, frequency), Pa s/m³."""
        drive = np.asarray(2j * np.pi * self.at_source[:, None, None] * frequency_hz)
        return np.asarray(self.pressure(density, sound_speed, frequency_hz, drive)[:, 0])

    def wall_forces(self, density: float, sound_speed: float, frequency_hz: Array) -> ComplexArray:
        """Force on each mode of the wall per volume flow of the source, (wall, frequency), N s/m³.

        The wall's motion does not act back on the gas; none at frequency zero.

        Parameters
        ----------
        density, sound_speed : density and speed of sound of the gas, kg/m³ and m/s
        frequency_hz : shape (frequency,)
        """
        forces = np.zeros((self.on_wall.shape[1], frequency_hz.size), dtype=complex)
        moves = frequency_hz > 0.0
        pressure = self.of_flow(density, sound_speed, frequency_hz[moves])
        forces[:, moves] = csr_array(self.on_wall.T) @ pressure  # orders around do not mix
        return forces
