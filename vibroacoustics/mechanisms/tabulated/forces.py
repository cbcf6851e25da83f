"""The table of forces of a machine: its file and what was read from it."""

from functools import lru_cache
from pathlib import Path
from typing import Any, ClassVar, Final, Literal

import numpy as np
from pydantic import Field

from ...base.arrays import ComplexArray
from ...base.errors import ParameterError
from ...base.file_table import FileTable
from ...base.parameters import Contradictions
from .spectra import Spectra, packed, unpacked

KEPT_TABLES: Final = 16
"""Tables that are kept as arrays."""
LARGEST_N: Final = 1e8
"""Largest force, N, or moment, N m, of an order."""
SPEED_RATIO: Final = 2.0
"""Largest usual ratio of the speeds between which, or from which, forces are computed."""


class Forces(FileTable):
    """Force and moment on the housing at one or many speeds, from a CSV, netCDF or UFF file."""

    content: ClassVar[str] = "packed"
    scaling: Literal["inertia"] | None = None
    """Scaling of a table with one speed: every force grows as the speed squared."""
    recorded_speed_rpm: float | None = Field(default=None, gt=0.0, le=1e5)
    """Speed of a recording over time, which does not say it."""
    speed_rpm: tuple[float, ...] = ()
    sources: tuple[str, ...] = ()
    packed: str = ""
    """Complex orders of what was read, see `spectra.packed`."""

    @classmethod
    def read(cls, path: Path, table: dict[str, Any]) -> dict[str, Any]:
        """Spectra of the file, by its ending."""
        spectra = _read(path, table.get("recorded_speed_rpm"))
        if not np.any(spectra.orders[..., 1:]):
            raise ParameterError(f"{path}: all forces and moments are constant")
        largest = float(np.abs(spectra.orders).max())
        if not largest <= LARGEST_N:
            raise ParameterError(
                f"{path}: force = {largest:g} N: must be at most {LARGEST_N:g} N, a moment N m"
            )
        return {
            "speed_rpm": spectra.speed_rpm,
            "sources": spectra.sources,
            "packed": packed(spectra.orders),
        }

    def contradictions(self) -> Contradictions:
        if self.scaling is not None and len(self.speed_rpm) > 1:
            yield (
                f"scaling = {self.scaling}: for a table of one speed; {self.file} has "
                f"{len(self.speed_rpm)}"
            )
        _spectra(self)  # refuses what was not read from a file

    def orders_at(self, speed_rpm: float) -> ComplexArray:
        """Orders at a speed, shape (source, component, order), N and N m.

        Raises
        ------
        ParameterError
            The table does not reach the speed.
        """
        spectra = _spectra(self)
        if self.scaling is not None:
            return np.asarray(spectra.orders[0] * (speed_rpm / self.speed_rpm[0]) ** 2)
        try:
            return spectra.between(speed_rpm)
        except ParameterError as error:
            has_one_speed = len(self.speed_rpm) == 1
            hint = (
                '; scaling = "inertia" lets forces grow as the speed squared'
                if has_one_speed
                else ""
            )
            raise ParameterError(f"{self.file}: {error}{hint}") from None

    def doubt_at(self, speed_rpm: float) -> str:
        """Say what is doubtful at a speed: how far the table's speeds are; empty where nothing."""
        below = [speed for speed in self.speed_rpm if speed <= speed_rpm]
        above = [speed for speed in self.speed_rpm if speed >= speed_rpm]
        if self.scaling is not None:
            near = max(self.speed_rpm[0], speed_rpm) / min(self.speed_rpm[0], speed_rpm)
            words = f"{self.file} is scaled from {self.speed_rpm[0]:g} rpm"
        elif below and above:
            near = above[0] / below[-1]
            words = f"{self.file} is interpolated between {below[-1]:g} and {above[0]:g} rpm"
        else:
            near = np.inf
            words = f"{self.file} has {self.speed_rpm[0]:g} to {self.speed_rpm[-1]:g} rpm"
        return f"{words}; usual is a ratio of {SPEED_RATIO:g} at most" if near > SPEED_RATIO else ""


def _read(path: Path, recorded_speed_rpm: Any) -> Spectra:
    from .csv_layout import read_csv
    from .other_files import holds_spectra, read_recorded, read_results, read_spectra

    if isinstance(recorded_speed_rpm, int | float):
        if path.suffix.lower() in (".uff", ".unv") and holds_spectra(path):
            return read_spectra(path, float(recorded_speed_rpm))
        return read_recorded(path, float(recorded_speed_rpm))
    suffix = path.suffix.lower()
    if suffix == ".csv":
        return read_csv(path)
    return read_results(path) if suffix == ".nc" else read_recorded(path, None)


@lru_cache(KEPT_TABLES)
def _spectra(forces: Forces) -> Spectra:
    orders = unpacked(forces.packed, len(forces.speed_rpm), len(forces.sources))
    return Spectra(forces.speed_rpm, forces.sources, orders)
