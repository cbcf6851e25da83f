"""Compliant floor under the feet: a mass on a spring, or measured mobilities."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, ClassVar, Final

import numpy as np
from pydantic import Field, model_validator

from ..base.arrays import Array, ComplexArray
from ..base.column_file import read_layouts
from ..base.column_head import Layout
from ..base.file_table import FileTable
from ..base.parameters import Parameters

LAYOUTS: Final = tuple(
    Layout(
        ("frequency_hz", f"vertical_{quantity}", "vertical_phase_rad"),
        (f"lateral_{quantity}", "lateral_phase_rad"),
        optional_texts=("foot",),
    )
    for quantity in ("mobility_m_per_ns", "receptance_m_per_n")
)


class Floor(Parameters):
    """Mass on a spring under each foot, up and down; sideways it is rigid."""

    mass_kg: float = Field(ge=0.0, le=1e6)
    stiffness_n_per_m: float = Field(ge=1e3, le=1e12)
    loss_factor_ratio: float = Field(ge=0.0, le=1.0)

    def receptance(self, foot: str, frequency_hz: Array) -> ComplexArray:
        """Motion along x, y and z per force of a foot, shape (..., 3), m/N.

        1/(K (1 + jη) - ω² M), without loss at frequency zero.

        Parameters
        ----------
        foot : its name; here all have the same floor
        frequency_hz : at least zero, shape (...)
        """
        omega = 2.0 * np.pi * np.asarray(frequency_hz, dtype=float)
        loss = self.loss_factor_ratio * (omega > 0.0)
        vertical = 1.0 / (self.stiffness_n_per_m * (1.0 + 1j * loss) - omega**2 * self.mass_kg)
        return np.stack([0.0 * vertical, 0.0 * vertical, vertical], axis=-1)


class FloorMobility(FileTable):
    """Point mobility under each foot, velocity per force, by amplitude and phase.

    Between its frequencies the complex mobility is linear in frequency, towards zero at 0 Hz, where
    a floor is a spring; above the highest it is held. Feet do not move one another.
    """

    content: ClassVar[str] = "frequency_hz"
    foot: tuple[str, ...] = ()
    """Foot of each row; empty where it holds for every foot."""
    frequency_hz: tuple[float, ...] = ()
    vertical_m_per_ns: tuple[float, ...] = ()
    vertical_phase_rad: tuple[float, ...] = ()
    lateral_m_per_ns: tuple[float, ...] = ()
    lateral_phase_rad: tuple[float, ...] = ()

    @model_validator(mode="after")
    def _alike(self) -> "FloorMobility":
        self.check_lengths(
            (self.foot, self.frequency_hz, self.vertical_m_per_ns, self.vertical_phase_rad,
             self.lateral_m_per_ns, self.lateral_phase_rad)
        )  # fmt: skip
        return self

    @classmethod
    def read(cls, path: Path, table: dict[str, Any]) -> dict[str, Any]:
        """Columns as of `docs/mounts.md`: a mobility or a receptance, for all feet or by foot."""
        columns = read_layouts(path, LAYOUTS)
        numbers = columns.numbers
        omega = 2.0 * np.pi * numbers["frequency_hz"]
        foot = columns.texts.get("foot", ("",) * omega.size)
        if "" in foot and any(foot):
            raise columns.refusal(foot.index(""), "foot: is missing, other rows name one")
        last: dict[str, float] = {}
        for row, (name, hertz) in enumerate(zip(foot, numbers["frequency_hz"], strict=True)):
            if hertz <= last.get(name, 0.0):
                raise columns.refusal(row, f"frequency_hz = {hertz:g}: must rise, from above 0")
            last[name] = float(hertz)
        values: dict[str, Array] = {"frequency_hz": numbers["frequency_hz"]}
        for axis in ("vertical", "lateral"):
            amplitude, phase = _mobility(numbers, axis, omega)
            if np.any(amplitude < 0.0):
                row = int(np.argmax(amplitude < 0.0))
                raise columns.refusal(row, f"{axis} amplitude: must be at least 0")
            values |= {f"{axis}_m_per_ns": amplitude, f"{axis}_phase_rad": phase}
        return {"foot": foot, **{name: tuple(each.tolist()) for name, each in values.items()}}

    def why_not_under(self, feet: Sequence[str]) -> str | None:
        """Say why the file does not fit the feet of a machine; none where it does."""
        if not any(self.foot):
            return None
        without = [foot for foot in feet if foot not in self.foot]
        if without:
            return f"{self.file}: has no rows for {without[0]}"
        unknown = [foot for foot in self.foot if foot not in feet]
        return (
            f"{self.file}: no foot {unknown[0]}; there are {', '.join(feet)}" if unknown else None
        )

    def receptance(self, foot: str, frequency_hz: Array) -> ComplexArray:
        """Motion along x, y and z per force of a foot, shape (..., 3), m/N.

        Parameters
        ----------
        foot : its name
        frequency_hz : at least zero, shape (...)
        """
        rows = [row for row, name in enumerate(self.foot) if name in ("", foot)]
        frequencies = np.array(self.frequency_hz)[rows]
        lateral, vertical = (
            _over_frequency(
                frequency_hz, frequencies, np.array(amplitude)[rows], np.array(phase)[rows]
            )
            for amplitude, phase in (
                (self.lateral_m_per_ns, self.lateral_phase_rad),
                (self.vertical_m_per_ns, self.vertical_phase_rad),
            )
        )
        return np.stack([lateral, lateral, vertical], axis=-1)


def _mobility(numbers: dict[str, Array], axis: str, omega: Array) -> tuple[Array, Array]:
    """Amplitude and phase; zero where the file has none."""
    nothing = np.zeros_like(omega)
    phase = numbers.get(f"{axis}_phase_rad", nothing)
    if f"{axis}_receptance_m_per_n" in numbers:
        return omega * numbers[f"{axis}_receptance_m_per_n"], phase + 0.5 * np.pi
    return numbers.get(f"{axis}_mobility_m_per_ns", nothing), phase


def _over_frequency(
    frequency_hz: Array, rows_hz: Array, amplitude: Array, phase: Array
) -> ComplexArray:
    """Receptance of a mobility that is linear from zero at 0 Hz; its real part at 0 Hz."""
    mobility = np.concatenate([[0.0], amplitude * np.exp(1j * phase)])
    frequency = np.asarray(frequency_hz, dtype=float)
    static = mobility[1] / (2j * np.pi * rows_hz[0])  # below the first row the floor is a spring
    moving = np.where(frequency > 0.0, frequency, 1.0)
    values = np.interp(moving, np.concatenate([[0.0], rows_hz]), mobility) / (2j * np.pi * moving)
    return np.where(frequency > 0.0, values, max(static.real, 0.0))
