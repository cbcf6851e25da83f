"""Gas and wall that act on each other both ways, for checks of the one-way path."""

from dataclasses import dataclass

import numpy as np

from vibroacoustics.base.arrays import Array, ComplexArray
from vibroacoustics.transfer.cavity.response import DrivenGas
from vibroacoustics.transfer.shell_modes.projection import velocity_per_force


@dataclass(frozen=True)
class GasAndWall:
    """A driven gas and the modes of its wall."""

    gas: DrivenGas
    density: float
    sound_speed: float
    natural_hz: Array
    modal_mass_kg: Array
    loss_factor_ratio: float

    def motion(self, frequency_hz: Array, flow: float, forces: Array) -> ComplexArray:
        """Displacement x of the wall's modes, shape (wall, frequency).

        x = H (Cᵀ p + F), p = A⁻¹ (jω Q φ + ω² C x).
        """
        omega = 2.0 * np.pi * frequency_hz
        wall = velocity_per_force(
            self.natural_hz, self.modal_mass_kg, self.loss_factor_ratio, frequency_hz
        ) / (1j * omega)
        coupling = self.gas.on_wall
        by_flow = self._pressure(
            frequency_hz, 1j * omega * flow * self.gas.at_source[:, None, None]
        )
        by_wall = self._pressure(frequency_hz, omega**2 * coupling[:, :, None] + 0j)
        drive = wall * (coupling.T @ by_flow[:, 0] + forces[:, None])
        back = wall[:, None] * np.einsum("nr,nsf->rsf", coupling, by_wall)
        system = np.eye(wall.shape[0]) - np.moveaxis(back, 2, 0)
        return np.linalg.solve(system, drive.T[..., None])[..., 0].T

    def at_source(self, frequency_hz: Array, flow: float, moved: ComplexArray) -> ComplexArray:
        """Pressure at the source where the wall moves by x, shape (frequency,)."""
        omega = 2.0 * np.pi * frequency_hz
        drive = 1j * omega * flow * self.gas.at_source[:, None] + omega**2 * (
            self.gas.on_wall @ moved
        )
        return self.gas.at_source @ self._pressure(frequency_hz, drive[:, None])[:, 0]

    def _pressure(self, frequency_hz: Array, drive: ComplexArray) -> ComplexArray:
        return self.gas.pressure(self.density, self.sound_speed, frequency_hz, drive)
