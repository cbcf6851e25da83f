"""A machine described by a table of its forces, with what options may work on."""

from collections.abc import Iterable, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any, ClassVar, Final, Literal

import numpy as np
from pydantic import Field

from ...base.arrays import ComplexArray
from ...base.errors import ParameterError
from ...base.file_table import FileTable
from ...base.parameters import Contradictions, Parameters
from ...base.registry import register
from ...base.units import shaft_frequency_hz
from ...machine.machine import PART_MASS, Machine
from ...machine.usual import doubt_of_forces, doubt_of_mass
from ...mechanics.capabilities import (
    HEIGHT,
    BalancePlanes,
    Capability,
    CrankFrame,
    OldhamRing,
    Slider,
)
from ...mechanics.moving_parts import Revolution, Wrench
from ...mechanics.rotation import constant_rotation
from .shaft_axes import ShaftAxes
from .spectra import Spectra, over_revolution, packed, unpacked

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


STROKE = Field(gt=0.0, le=1.0)


class SlidingMass(Parameters):
    """A mass that slides to and fro with the crank; without mass and stroke that of the forces."""

    mass_kg: float | None = Field(default=None, gt=0.0, le=100.0)
    amplitude_m: float | None = Field(default=None, gt=0.0, le=1.0)
    """Half its stroke."""
    height_m: float = HEIGHT
    """Height along the shaft, from the origin of the shaft's axes."""

    def contradictions(self) -> Contradictions:
        if (self.mass_kg is None) != (self.amplitude_m is None):
            yield "mass_kg, amplitude_mm: give both or none"


class Ring(Parameters):
    """An Oldham ring; its stroke is along x."""

    mass_kg: float = PART_MASS
    amplitude_m: float = STROKE
    """Half its stroke."""
    height_m: float = HEIGHT


def oscillating_mass_moment(along_n: complex, across_n: complex, speed_rpm: float) -> float:
    """Find mass times amplitude of a sliding mass from the first order of the force, kg m.

    An oscillation m r ω² cos θ is a force of half its size that turns with the shaft and one that
    turns against it; a rotating unbalance turns with the shaft only. Hence m r = |A - i C|/ω².

    Parameters
    ----------
    along_n, across_n : A along the stroke and C a quarter turn later, of Re(A exp(iθ)), N
    speed_rpm : mean
    """
    speed = 2.0 * np.pi * shaft_frequency_hz(speed_rpm)
    return float(abs(along_n - 1j * across_n)) / speed**2


@register
class TabulatedMachine(Machine):
    """Force and moment come from a file; the shaft turns at constant speed."""

    kind: ClassVar[str] = "table"
    template: ClassVar[str] = "reciprocating_table.toml"
    orders: ClassVar[str] = "Orders are those of the machine's table of forces."
    reads: ClassVar[frozenset[str]] = Machine.reads | {
        "shaft_axes", "sliding_mass", "oldham", "counterweights",
    }  # fmt: skip
    forces: Forces
    shaft_axes: ShaftAxes
    sliding_mass: SlidingMass | None = None
    """Mass for options that balance it."""
    oldham: Ring | None = None
    """Ring of the machine, for options that add to it."""
    counterweights: BalancePlanes | None = None
    """Planes for weights on the shaft."""

    def contradictions(self) -> Contradictions:
        if self.sliding_mass is not None and self.counterweights is None:
            yield "sliding_mass: needs the table counterweights"

    def doubts(self) -> Iterable[str]:
        """Forces at the table's highest speed, against masses and speed of the machine."""
        speed_rpm = max(self.forces.speed_rpm)
        first = self.forces.orders_at(speed_rpm).sum(axis=0)[:3, 1]
        force = float(np.linalg.norm(first))
        speed = 2.0 * np.pi * shaft_frequency_hz(speed_rpm)
        if words := doubt_of_forces(self.scale.mass_kg, force, speed):
            yield f"forces.file = {self.forces.file}: {words}"
            return  # one cause, one line
        along = float(np.abs(np.dot(self.crank_frame.stroke, first)))
        for name, part in (("sliding_mass", self.sliding_mass), ("oldham", self.oldham)):
            if part is not None and part.mass_kg is not None and part.amplitude_m is not None:
                mass = part.mass_kg, part.amplitude_m
                if words := doubt_of_mass(name, along, *mass, speed_rpm):
                    yield f"forces.file = {self.forces.file}: {words}"

    def doubts_at(self, speeds_rpm: Sequence[float]) -> Iterable[str]:
        """Speeds of the table far from those of a study, and doubts of every machine."""
        for speed_rpm in speeds_rpm:
            if words := self.forces.doubt_at(speed_rpm):
                yield f"operation.speed_rpm = {speed_rpm:g} rpm: forces.file = {words}"
        yield from super().doubts_at(speeds_rpm)

    @property
    def crank_frame(self) -> CrankFrame:
        """Axes of stroke and shaft."""
        return self.shaft_axes.frame

    @property
    def capabilities(self) -> tuple[Capability, ...]:
        """Capabilities that the tables name for options."""
        named: list[Capability] = []
        if self.sliding_mass is not None and self.counterweights is not None:
            named.append(self._slider(self.sliding_mass, self.counterweights))
        if self.oldham is not None:
            ring = self.oldham
            named.append(OldhamRing(ring.mass_kg, ring.amplitude_m, ring.height_m))
        return tuple(named)

    def _slider(self, sliding: SlidingMass, planes: BalancePlanes) -> Slider:
        """Return the sliding mass; where its table gives none, a mass at the planes' radius."""
        mass_kg, amplitude_m = sliding.mass_kg, sliding.amplitude_m
        if mass_kg is None or amplitude_m is None:
            speed_rpm, frame = max(self.forces.speed_rpm), self.crank_frame
            first_n = self.forces.orders_at(speed_rpm).sum(axis=0)[:3, 1]
            along_n, across_n = np.dot(frame.stroke, first_n), np.dot(frame.across, first_n)
            moment = oscillating_mass_moment(along_n, across_n, speed_rpm)
            mass_kg, amplitude_m = moment / planes.radius_m, planes.radius_m
        return Slider(mass_kg, amplitude_m, sliding.height_m, planes, self.crank_frame)

    def revolution(self, speed_rpm: float, samples: int) -> Revolution:
        """Forces and moments of the table at a speed; the shaft turns evenly.

        Parameters
        ----------
        speed_rpm : that the table reaches
        samples : uniform crank angles

        Raises
        ------
        ParameterError
            The table does not reach the speed.
        """
        values = over_revolution(self.forces.orders_at(speed_rpm), samples)
        wrenches = {
            source: Wrench(each[:3], each[3:])
            for source, each in zip(self.forces.sources, values, strict=True)
        }
        return Revolution(speed_rpm, constant_rotation(speed_rpm, samples), wrenches)

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Effects that a table neglects."""
        return _LEAVES_OUT


_LEAVES_OUT: Final = (
    "Forces and moments are those of a table: what makes them is not modelled, nor what would "
    "change them but speed. Between the table's speeds each complex order is linear in the speed "
    "squared. The shaft turns evenly.",
)
