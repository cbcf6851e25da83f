"""From loads on the shell's joints to sound at the receivers, by source."""

from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
import xarray as xr

from .. import levels, measurements, radiation
from ..mechanics.rotation import Array
from ..parameters.inside import MeasuredModes
from ..parameters.shell_structure import JOINTS
from ..parameters.study import Study
from ..transfer.shell_modes import (
    JointLoads,
    SampledMode,
    ShellMode,
    elastic_shell,
    modal_forces,
    velocity_per_force,
)
from .inner_keys import Complex
from .inner_sources import InnerLoads

MODES_BEYOND: Final = 1.1
"""Modes up to this many times the highest frequency take part."""
LOWEST_BAND_HZ: Final = 20.0


@dataclass(frozen=True)
class ShellPath:
    """The elastic modes of a machine's shell, and how loads on its joints drive them.

    Attributes
    ----------
    modes : computed or measured
    joint_forces : generalised force per unit load, shape (mode, joint, component)
    maximum_frequency_hz : of the study's transfer vectors
    """

    modes: tuple[ShellMode, ...] | tuple[SampledMode, ...]
    joint_forces: Array
    maximum_frequency_hz: float

    @cached_property
    def natural_hz(self) -> Array:
        """Shape (mode,)."""
        return np.array([mode.frequency_hz for mode in self.modes])

    @cached_property
    def modal_mass_kg(self) -> Array:
        """Shape (mode,)."""
        return np.array([mode.modal_mass_kg for mode in self.modes])


def shell_path(study: Study) -> ShellPath | None:
    """The elastic shell of a study with inner sources; none without.

    Computed modes reach the highest frequency in every draw, measured ones as far as their file.
    """
    if study.inside is None:
        return None
    inside, highest = study.inside.inside, study.radiation.maximum_frequency_hz
    joints = [getattr(inside.shell, name) for name in JOINTS]
    if study.inside.modes is not None:
        modes = _measured(study.inside.modes)
        radius = study.machine.shell.radius_m
        forces = [[mode.modal_forces(joint, radius) for joint in joints] for mode in modes]
        return ShellPath(modes, np.array(forces), highest)
    ranges = [d.lowest for d in study.inside.doubts if d.field == "frequency_factor_ratio"]
    lowest = min([inside.doubt.frequency_factor_ratio, *ranges])
    elastic = elastic_shell(study.machine.shell, inside.shell, MODES_BEYOND * highest / lowest)
    loads = [modal_forces(elastic, JointLoads(joint)) for joint in joints]
    return ShellPath(elastic.modes, np.stack(loads, axis=1), highest)


def _measured(settings: MeasuredModes) -> tuple[SampledMode, ...]:
    """Modes of a universal file."""
    found = measurements.read_modes(settings.file, file_unit_m=settings.file_unit_m)
    rows = zip(found.frequency_hz, found.modal_mass_kg, found.shape, strict=True)
    return tuple(
        SampledMode(f"measured_{number:02d}", float(hertz), float(mass), found.nodes_m, shape)
        for number, (hertz, mass, shape) in enumerate(rows, 1)
    )


def pressure_per_load(
    path: ShellPath,
    pressure_per_velocity: Complex,
    frequency_hz: Array,
    loss_factor_ratio: float,
    frequency_factor_ratio: float,
) -> Complex:
    """Pressure per unit load on a joint, shape (receiver, joint, component, frequency).

    Σ over the modes of transfer vector, velocity per force and force per load.

    Parameters
    ----------
    path : modes and joints
    pressure_per_velocity : of the modes, shape (receiver, mode, frequency), Pa s/m
    frequency_hz : shape (frequency,)
    loss_factor_ratio : of the shell
    frequency_factor_ratio : times the natural frequencies
    """
    natural_hz = frequency_factor_ratio * path.natural_hz
    moving = velocity_per_force(natural_hz, path.modal_mass_kg, loss_factor_ratio, frequency_hz)
    heard = pressure_per_velocity * moving
    return np.asarray(np.einsum("rmf,mjc->rjcf", heard, path.joint_forces, optimize=True))


@dataclass(frozen=True)
class SourceSound:
    """Mean squares of the pressure at the receivers, by source; those of a band are unweighted.

    Attributes
    ----------
    sources : names
    band : of each source alone, shape (source, receiver, band), Pa²
    weighted : A-weighted, of each source alone, shape (source, receiver), Pa²
    part : what each source adds to the A-weighted total, shape (source, receiver), Pa²; where
        lines of two sources cancel a part can be negative. The sum is the total
    """

    sources: tuple[str, ...]
    band: Array
    weighted: Array
    part: Array

    @property
    def total(self) -> Array:
        """A-weighted mean square of all sources together, shape (receiver,), Pa²."""
        return np.asarray(self.part.sum(axis=0))


def whole_octave_thirds(maximum_frequency_hz: float) -> tuple[levels.Band, ...]:
    """Third-octave bands that a study's frequencies fill."""
    bands = levels.bands_between(3, LOWEST_BAND_HZ, maximum_frequency_hz)
    return tuple(band for band in bands if band.upper_hz <= maximum_frequency_hz)


def source_sound(
    loads: InnerLoads,
    line_pressure: dict[str, Complex],
    noise_pressure: dict[str, list[Complex]],
    bands: tuple[levels.Band, ...],
) -> SourceSound:
    """Mean squares of lines, which add as phasors, and of noise, which adds as energy.

    Parameters
    ----------
    loads : for the frequencies
    line_pressure : complex peaks at the lines, by source, shape (receiver, line), Pa
    noise_pressure : pressure per load of each noise of a source, shape (receiver, 3, frequency)
    bands : of the result
    """
    sources = tuple(line_pressure)
    pressure = np.stack(list(line_pressure.values()))
    alone = 0.5 * np.abs(pressure) ** 2
    shared = 0.5 * (pressure * pressure.sum(axis=0).conj()).real
    audible = loads.frequency_hz > 0.0
    weight = 10.0 ** (levels.WEIGHTING["A"](loads.frequency_hz) / 10.0) * audible
    band = alone @ _membership(loads.frequency_hz, bands)
    weighted, part = alone @ weight, shared @ weight
    for source, paths in noise_pressure.items():
        row = sources.index(source)
        for noise, per_load in zip(loads.noise[source], paths, strict=True):
            density = np.einsum(
                "rif,ijf,rjf->rf", per_load.conj(), noise.density, per_load, optimize=True
            ).real
            power = density * (noise.frequency_hz[1] - noise.frequency_hz[0])
            band[row] += power @ _membership(noise.frequency_hz, bands)
            loud = power @ 10.0 ** (levels.WEIGHTING["A"](noise.frequency_hz) / 10.0)
            weighted[row] += loud
            part[row] += loud
    return SourceSound(sources, band, weighted, part)


def _membership(frequency_hz: Array, bands: tuple[levels.Band, ...]) -> Array:
    """1 where a frequency lies in a band, shape (frequency, band)."""
    edges = np.array([(band.lower_hz, band.upper_hz) for band in bands])
    inside = (frequency_hz[:, None] >= edges[:, 0]) & (frequency_hz[:, None] < edges[:, 1])
    return inside.astype(float)


def mode_pressures(results: xr.Dataset, frequency_hz: Array) -> Complex:
    """Transfer vectors of the shell's modes at any frequencies, (receiver, mode, frequency)."""
    vectors = results["pattern_transfer_vector"].rename(pattern="dof")
    at = xr.DataArray(frequency_hz, dims="line")
    return np.asarray(radiation.interpolate_transfer_vector(vectors, at).values)


def rigid_pressures(results: xr.Dataset, frequency_hz: Array) -> Complex:
    """Transfer vectors of the rigid motions at any frequencies, (receiver, dof, frequency)."""
    at = xr.DataArray(frequency_hz, dims="line")
    return np.asarray(radiation.interpolate_transfer_vector(results["transfer_vector"], at).values)
