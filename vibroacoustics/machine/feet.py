"""Feet anywhere, mounts between them and the floor, and a mount's stiffness over frequency."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar, Final

import numpy as np
from pydantic import Field, model_validator

from ..base.arrays import Array, ComplexArray
from ..base.column_file import read_columns
from ..base.file_table import FileTable
from ..base.parameters import Parameters

LARGEST_LOSS: Final = 10.0
LEAST_N_PER_M: Final = 1e2
LARGEST_N_PER_M: Final = 1e9


class MountStiffness(FileTable):
    """Dynamic transfer stiffness k(f) and loss factor η(f) (ISO 10846-1): k (1 + jη).

    Between its frequencies the complex stiffness is linear in frequency; below the lowest and
    above the highest it is held.
    """

    content: ClassVar[str] = "frequency_hz"
    frequency_hz: tuple[float, ...] = ()
    lateral_n_per_m: tuple[float, ...] = ()
    vertical_n_per_m: tuple[float, ...] = ()
    loss_factor_ratio: tuple[float, ...] = ()

    @model_validator(mode="after")
    def _alike(self) -> "MountStiffness":
        self.check_lengths(
            (self.frequency_hz, self.lateral_n_per_m, self.vertical_n_per_m, self.loss_factor_ratio)
        )
        return self

    @classmethod
    def read(cls, path: Path, table: dict[str, Any]) -> dict[str, Any]:
        """Columns `frequency_hz, lateral_n_per_mm, vertical_n_per_mm, loss_factor`."""
        names = ("frequency_hz", "lateral_n_per_m", "vertical_n_per_m", "loss_factor")
        columns = read_columns(path, names)
        frequency, lateral, vertical, loss = (columns.numbers[name] for name in names)
        for row, hertz in enumerate(frequency):
            if hertz < 0.0 or (row and hertz <= frequency[row - 1]):
                raise columns.refusal(row, f"frequency_hz = {hertz:g}: must rise, from 0 up")
            for name, value in zip(names[1:3], (lateral[row], vertical[row]), strict=True):
                if not LEAST_N_PER_M <= value <= LARGEST_N_PER_M:
                    raise columns.refusal(
                        row,
                        f"{name} = {value:g} N/m: must be {LEAST_N_PER_M:g} to "
                        f"{LARGEST_N_PER_M:g} N/m",
                    )
            if not 0.0 <= loss[row] <= LARGEST_LOSS:
                raise columns.refusal(
                    row, f"loss_factor = {loss[row]:g}: allowed 0 to {LARGEST_LOSS:g}"
                )
        fields = (*names[:3], "loss_factor_ratio")
        of_fields = zip(fields, (frequency, lateral, vertical, loss), strict=True)
        return {name: tuple(values.tolist()) for name, values in of_fields}

    def dynamic_stiffness(self, frequency_hz: Array) -> ComplexArray:
        """Return the stiffness along x, y and z, shape (..., 3), N/m; without loss at frequency
        zero.

        Parameters
        ----------
        frequency_hz : at least zero, shape (...)
        """
        frequency = np.asarray(frequency_hz, dtype=float)
        loss = 1j * np.array(self.loss_factor_ratio)
        lateral, vertical = (
            _linear(frequency, self.frequency_hz, np.array(stiffness) * (1.0 + loss))
            for stiffness in (self.lateral_n_per_m, self.vertical_n_per_m)
        )
        stiffness = np.stack([lateral, lateral, vertical], axis=-1)
        return np.asarray(np.where(frequency[..., None] > 0.0, stiffness, stiffness.real))


def _linear(frequency_hz: Array, rows_hz: tuple[float, ...], values: ComplexArray) -> ComplexArray:
    """Linear between known points, held beyond the ends."""
    return np.asarray(np.interp(frequency_hz, rows_hz, values))


class Mounts(Parameters):
    """Four equal grommets in a square below the shell."""

    pitch_m: float = Field(ge=0.01, le=2.0)
    """Side of the square that the grommets form."""
    lateral_stiffness_n_per_m: float = Field(ge=LEAST_N_PER_M, le=LARGEST_N_PER_M)
    vertical_stiffness_n_per_m: float = Field(ge=LEAST_N_PER_M, le=LARGEST_N_PER_M)
    loss_factor_ratio: float = Field(ge=0.0, le=1.0)


FOOT_NAMES: Final = ("front_left", "front_right", "rear_left", "rear_right")
"""Names of four in a square. Front is +x, left is +y."""
LEAST_WIDTH_M: Final = 1e-3
"""Feet closer than this to one line let the machine tip over."""


class Foot(Parameters):
    """A foot; what it does not give of its mount is that of the table `mounts`."""

    x_m: float = Field(ge=-10.0, le=10.0)
    y_m: float = Field(ge=-10.0, le=10.0)
    height_m: float | None = Field(default=None, ge=-10.0, le=10.0)
    """Height of its mount from the centre of mass at rest; under the shell where none is given."""
    lateral_stiffness_n_per_m: float | None = Field(default=None, ge=1e2, le=1e9)
    vertical_stiffness_n_per_m: float | None = Field(default=None, ge=1e2, le=1e9)
    loss_factor_ratio: float | None = Field(default=None, ge=0.0, le=1.0)
    stiffness: MountStiffness | None = None
    """Stiffness over frequency, from a file."""

    @model_validator(mode="after")
    def _one_stiffness(self) -> "Foot":
        constant = (self.lateral_stiffness_n_per_m, self.vertical_stiffness_n_per_m,
                    self.loss_factor_ratio)  # fmt: skip
        if self.stiffness is not None and any(value is not None for value in constant):
            raise ValueError("stiffness: from a file, and values of its own; give one of them")
        return self

    @property
    def has_constant_values(self) -> bool:
        """Whether it gives a constant stiffness or loss."""
        return (self.lateral_stiffness_n_per_m, self.vertical_stiffness_n_per_m,
                self.loss_factor_ratio) != (None, None, None)  # fmt: skip


class Feet(Parameters):
    """Three to eight feet, from the machine's centre of mass."""

    names: ClassVar = tuple(f"foot_{number}" for number in range(1, 9))
    foot_1: Foot
    foot_2: Foot
    foot_3: Foot
    foot_4: Foot | None = None
    foot_5: Foot | None = None
    foot_6: Foot | None = None
    foot_7: Foot | None = None
    foot_8: Foot | None = None

    @property
    def by_name(self) -> Mapping[str, Foot]:
        """The feet that there are."""
        feet = {name: getattr(self, name) for name in self.names}
        return {name: foot for name, foot in feet.items() if foot is not None}

    @model_validator(mode="after")
    def _stands(self) -> "Feet":
        points = np.array([(foot.x_m, foot.y_m, foot.height_m or 0.0)
                           for foot in self.by_name.values()])  # fmt: skip
        widths = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
        if widths[1] < LEAST_WIDTH_M:
            raise ValueError("the feet stand in one line, about which the machine turns freely")
        return self


def values_not_read(feet: Feet | None, stiffness: MountStiffness | None) -> frozenset[str]:
    """Values of the table `mounts` that feet and files leave without effect, dotted."""
    fields = set() if feet is None else {"mounts.pitch_m"}
    each = () if feet is None else tuple(feet.by_name.values())
    if stiffness is not None and not any(foot.has_constant_values for foot in each):
        fields |= {
            "mounts.lateral_stiffness_n_per_m",
            "mounts.vertical_stiffness_n_per_m",
            "mounts.loss_factor_ratio",
        }
    return frozenset(fields)
