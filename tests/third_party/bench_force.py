"""A third party's source whose force over crank angle is in a data file."""

from pathlib import Path
from typing import Any, ClassVar

import numpy as np

import vibroacoustics
from vibroacoustics import Case, FileTable, Loads, Wrench, read_columns


class ForceFile(FileTable):
    """A CSV file with the column `force_n` at uniform crank angles from zero."""

    content: ClassVar[str] = "force_n"
    force_n: tuple[float, ...] = ()

    @classmethod
    def read(cls, path: Path, table: dict[str, Any]) -> dict[str, Any]:
        """The column in newtons; the file may hold it in another unit, as `force_kn`."""
        force = read_columns(path, ["force_n"]).numbers["force_n"]
        return {"force_n": tuple(force.tolist())}


@vibroacoustics.register
class BenchForce(vibroacoustics.Source):
    """A force along x that a test bench measured, the same at every speed."""

    kind: ClassVar[str] = "bench-force"
    measured: ForceFile

    def loads(self, case: Case, before: dict) -> Loads:
        """The column by linear interpolation at the crank angles of the revolution."""
        angle = case.revolution.rotation.crank_angle
        known = np.linspace(0.0, 2.0 * np.pi, len(self.measured.force_n), endpoint=False)
        force = np.zeros((3, angle.size))
        force[0] = np.interp(angle, known, self.measured.force_n, period=2.0 * np.pi)
        return Loads(wrenches={"bench": Wrench(force, np.zeros((3, angle.size)))})
