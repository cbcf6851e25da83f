"""Stiffness and loss of a mount over frequency, as ISO 10846 measures them."""

from pathlib import Path
from typing import Any, ClassVar, Final

import numpy as np
from pydantic import model_validator

from ..base.arrays import Array, ComplexArray
from ..base.column_file import read_columns
from ..base.file_table import FileTable

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
