"""The stator's yoke in the shell: from forces around its bore to the wall's modes."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError
from ..machine.machine import Machine
from ..machine.shell_structure import ShellVariation
from ..machine.stator_yoke import STATOR_YOKE, YOKE_ORDERS, StatorYoke
from .path import ShellPath
from .shell_modes.loads import mean_over_band
from .shell_modes.modes import ShellMode
from .shell_modes.projection import ProjectedModes, velocity_per_force
from .shell_modes.statics import local_flexibility_factor


def ring_stiffness(yoke: StatorYoke, order: int, frequency_hz: Array) -> ComplexArray:
    """Line load per displacement outwards of a ring that moves as cos nθ, N/m², (frequency,).

    E I (n² - 1)²/R⁴ - ω² m (1 + 1/n²) of a ring whose middle does not stretch (Hoppe 1871;
    Rayleigh, Theory of Sound, § 233), and E A/R² - ω² m where it breathes, n = 0.

    Parameters
    ----------
    yoke : ring
    order : n, not one: that is a motion of the stator as a body
    frequency_hz : shape (frequency,)
    """
    area = yoke.thickness_m * yoke.length_m
    mass = yoke.density_kg_per_m3 * area * (1.0 + yoke.teeth_mass_ratio)
    modulus = yoke.youngs_modulus_pa * (1.0 + 1j * yoke.loss_factor_ratio)
    squares = (2.0 * np.pi * frequency_hz) ** 2
    if order == 0:
        return np.asarray(modulus * area / yoke.mean_radius_m**2 - squares * mass)
    bending = area * yoke.thickness_m**2 / 12.0 * (order**2 - 1) ** 2 / yoke.mean_radius_m**4
    return np.asarray(modulus * bending - squares * mass * (1.0 + 1.0 / order**2))


@dataclass(frozen=True)
class YokeOnWall:
    """A yoke fitted into the wall, order by order around; the fit is alike all around.

    Attributes
    ----------
    yoke : ring
    path : modes of the shell, the band of the stator
    frequency_factor : frequency factor of the shell's modes, beside that of the path
    """

    yoke: StatorYoke
    path: ShellPath
    frequency_factor: float

    def forces(self, frequency_hz: Array) -> ComplexArray:
        """Generalised force of each mode per line load around the yoke.

        With D of the ring, C of the wall and k of the fit per length, the wall gets the share
        1/(1 + D (C + 1/k)) of the load; none at frequency zero.

        Parameters
        ----------
        frequency_hz : shape (frequency,)

        Returns
        -------
        shape (mode, component of `STATOR_YOKE`, frequency), m
        """
        shape = len(self.path.modes), len(STATOR_YOKE.components), frequency_hz.size
        forces = np.zeros(shape, dtype=complex)
        moves = frequency_hz > 0.0
        frequency_hz = np.where(moves, frequency_hz, 1.0)
        fit = self.yoke.fit_stiffness_n_per_m / (2.0 * np.pi * self.yoke.mean_radius_m)
        for number, order in enumerate(YOKE_ORDERS):
            give = self.wall_compliance(order, frequency_hz) + 1.0 / fit
            share = moves / (1.0 + ring_stiffness(self.yoke, order, frequency_hz) * give)
            for row, mode in enumerate(self._modes):
                if mode.around.order == order:
                    turned = int(mode.around.angle_rad > 0.0)
                    of_mode = self._around(order) * self._outwards[row]
                    forces[row, 2 * number + turned] = of_mode * share
        return forces

    def wall_compliance(self, order: int, frequency_hz: Array) -> ComplexArray:
        """Displacement of the band outwards per line load on the yoke's middle, m²/N."""
        rows = [
            row
            for row, mode in enumerate(self._modes)
            if mode.around.order == order and mode.around.angle_rad == 0.0
        ]
        path, outwards = self.path, self._outwards[rows]
        natural_hz = self.frequency_factor * path.natural_hz[rows]
        omega = 2.0 * np.pi * frequency_hz
        loss = path.structure.loss_factor_ratio
        moving = velocity_per_force(natural_hz, path.modal_mass_kg[rows], loss, frequency_hz)
        of_modes = outwards**2 @ (moving / (1j * omega))
        return np.asarray(
            self._around(order) * (of_modes + self._residual(order, rows) / (1.0 + 1j * loss))
        )

    def _around(self, order: int) -> float:
        """∫ cos² nθ along the yoke's middle."""
        return float((np.pi if order else 2.0 * np.pi) * self.yoke.mean_radius_m)

    def _residual(self, order: int, rows: list[int]) -> float:
        """Steady flexibility of the band that the modes lack, m/N."""
        shell = self._wall.shell
        modes = [self._modes[row] for row in rows]
        stiffness = np.array([m.modal_mass_kg * (2.0 * np.pi * m.frequency_hz) ** 2 for m in modes])
        steady = self._wall.flexibility.of_band(self.path.structure.stator, order)
        residual = steady - float(np.sum(self._outwards[rows] ** 2 / stiffness))
        factor = local_flexibility_factor(shell.structure, self.path.structure)
        return residual * factor / self.frequency_factor**2

    @property
    def _wall(self) -> ProjectedModes:
        if self.path.wall is None:
            raise ParameterError(
                "shell_modes: measured modes do not hold the wall's flexibility under a stator's "
                "yoke; leave magnetic forces out"
            )
        return self.path.wall

    @property
    def _modes(self) -> list[ShellMode]:
        return [mode for mode in self.path.modes if isinstance(mode, ShellMode)]

    @cached_property
    def _outwards(self) -> Array:
        """Mean motion outwards over the band per amplitude of a mode, shape (mode,)."""
        mean = mean_over_band(self._wall.shell.meridian, self.path.structure.stator)[:, 0]
        return np.array([mean @ mode.shape for mode in self._modes])


def yoke_on_wall(machine: Machine, path: ShellPath) -> YokeOnWall | None:
    """The machine's yoke in its shell; none where it has none."""
    if not machine.has_table(StatorYoke):
        return None
    factor = machine.table(ShellVariation).frequency_factor_ratio
    return YokeOnWall(machine.table(StatorYoke), path, factor)
