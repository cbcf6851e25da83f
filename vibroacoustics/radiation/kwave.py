"""The room side: k-Wave's Green's function between a microphone and the box around the machine.

By reciprocity a monopole at the microphone gives the Green's function of every point of the box
towards the microphone. k-Wave itself is stock: spectral operators, additive source,
absorbing layer inside the grid; only its FFT is replaced by a faster one.

A hard floor is an equal image source below the floor. In the discrete equations this is exact: the
equations are symmetric about a node plane and so are the two sources, hence the vertical velocity
on that plane vanishes. A floor of dense medium would be wrong by 0.17 dB and can be unstable.

This module alone imports k-Wave, and only inside functions. The package's own `__init__` downloads
executables, so it is never executed.
"""

import importlib
import importlib.metadata
import importlib.util
import platform
import sys
from pathlib import Path
from typing import Any, Final

import numpy as np
import psutil

from ..constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from ..errors import ParameterError, SolverError
from .arrays import Array, Progress, no_progress
from .band_limited import STENCIL_NODES, interpolate_field
from .box import Box, BoxField
from .exact import box_green
from .fft import fft_namespace
from .pulse import RunningTransform, pulse, pulse_duration_s, pulse_width_s, transform
from .room_grid import PML_ALPHA, PML_NODES, RoomGrid, room_grid

_BYTES_PER_NODE: Final = 480
_COPIES_OF_SPECTRA: Final = 5
"""Spectra of the recorded nodes that exist at once: sums, quotient, interpolated ones."""
_PROGRESS_STEPS: Final = 20
_SETTLING_S: Final = 5e-4
"""Recording time after the pulse has passed the furthest point of the box."""
_CLEAR_NODES: Final = STENCIL_NODES // 2
"""Nodes between microphone and box: with the source inside a stencil, errors reach 1 dB."""
_LARGEST_DIFFERENCE_DB: Final = 6.0
_MODULES: Final = ("kwave.kgrid", "kwave.kmedium", "kwave.ksource", "kwave.ksensor")
_SOLVER: Final = "kwave.solvers.kspace_solver"


def load_kwave() -> None:
    """Make k-Wave's modules importable without executing its `__init__`, which downloads.

    Raises
    ------
    SolverError
        k-wave-python is not installed.
    """
    if "kwave" in sys.modules:
        return
    specification = importlib.util.find_spec("kwave")
    if specification is None or specification.origin is None:
        raise SolverError("k-Wave is not installed; run: pip install k-wave-python==0.6.2")
    bare: Any = importlib.util.module_from_spec(specification)
    bare.__version__ = kwave_version()
    bare.PLATFORM = platform.system().lower()
    bare.BINARY_PATH = bare.BINARY_DIR = Path(specification.origin).parent / "bin" / bare.PLATFORM
    sys.modules["kwave"] = bare


def check_kwave() -> None:
    """Import all of k-Wave that is used.

    Raises
    ------
    SolverError
        k-Wave is not installed or does not load.
    """
    load_kwave()
    try:
        for name in (*_MODULES, _SOLVER):
            importlib.import_module(name)
    except Exception as error:  # whatever a broken installation raises
        raise SolverError(f"k-Wave does not load: {error}") from error


def kwave_version() -> str:
    """Version of the installed k-wave-python, or "not installed"."""
    try:
        return importlib.metadata.version("k-wave-python")
    except importlib.metadata.PackageNotFoundError:
        return "not installed"


def build_simulation(grid: RoomGrid, source_pressure: Array, steps: int) -> Any:
    """Stock k-Wave `Simulation` of air with additive pressure sources at the grid's nodes."""
    load_kwave()
    kgrid_module, kmedium, ksource, ksensor = map(importlib.import_module, _MODULES)
    kgrid = kgrid_module.kWaveGrid(grid.shape, [grid.spacing_m] * 3)
    kgrid.setTime(steps, grid.time_step_s)
    medium = kmedium.kWaveMedium(sound_speed=SPEED_OF_SOUND_M_PER_S, density=AIR_DENSITY_KG_PER_M3)
    source = ksource.kSource()
    source.p_mask = np.zeros(grid.shape, dtype=bool)
    source.p_mask[tuple(np.array(grid.source_nodes).T)] = True
    source.p = source_pressure[None, :]
    # The field is read after every step; k-Wave's own recording would keep all of it.
    sensor = ksensor.kSensor(record=["p_final"])
    simulation = importlib.import_module(_SOLVER).Simulation(
        kgrid, medium, source, sensor, pml_size=(PML_NODES,) * 3, pml_alpha=(PML_ALPHA,) * 3
    )
    simulation.xp = fft_namespace(grid.shape)
    simulation.setup()
    _keep_half_spectra(simulation)
    return simulation


def _keep_half_spectra(simulation: Any) -> None:
    """Cut k-Wave's operators to the half of the spectrum that real fields need (see `fft`)."""
    half = simulation.grid_shape[-1] // 2 + 1
    for name in ("op_grad_list", "op_div_list"):
        operators = getattr(simulation, name)
        setattr(simulation, name, [np.ascontiguousarray(full[..., :half]) for full in operators])
    simulation.source_kappa = np.ascontiguousarray(simulation.source_kappa[..., :half])
    simulation._setup_source_operators()  # they hold on to the operator of the source


def kwave_green(
    box: Box,
    microphone: Array,
    frequency_hz: Array,
    maximum_frequency_hz: float,
    largest_spacing_m: float,
    floor_z_m: float | None,
    name: str = "microphone",
    progress: Progress = no_progress,
) -> BoxField:
    """Green's function (1/m) of a microphone on both layers of the box.

    Normalised so that free field is exp(-jkr)/(4 pi r).

    Raises
    ------
    ParameterError
        The microphone lies in the box, too close to it or below the floor, or the grid needs more
        memory than is available.
    SolverError
        k-Wave's field is not finite or further than 6 dB from the closed form.
    """
    check_receiver(name, microphone, box, largest_spacing_m, floor_z_m, frequency_hz.size)
    grid = room_grid(microphone, box, largest_spacing_m, floor_z_m)
    field = _run(grid, box, frequency_hz, maximum_frequency_hz, name, progress)
    expected = box_green(box, microphone, frequency_hz, floor_z_m)
    difference = float(np.max(np.abs(green_difference_db(field, expected))))
    if not difference <= _LARGEST_DIFFERENCE_DB:
        raise SolverError(
            f"receivers.{name}: k-Wave is {difference:.3g} dB off the closed form "
            f"(at most {_LARGEST_DIFFERENCE_DB:g} dB is plausible)"
        )
    return field


def green_difference_db(field: BoxField, expected: BoxField) -> Array:
    """Largest level difference over the box, signed, dB, (frequency,)."""
    simulated = np.concatenate([field.inner, field.outer], axis=1)
    exact = np.concatenate([expected.inner, expected.outer], axis=1)
    difference = 20.0 * np.log10(np.abs(simulated) / np.abs(exact))
    worst = np.argmax(np.abs(difference), axis=1)
    result: Array = difference[np.arange(difference.shape[0]), worst]
    return result


def _run(
    grid: RoomGrid,
    box: Box,
    frequency_hz: Array,
    maximum_frequency_hz: float,
    name: str,
    progress: Progress,
) -> BoxField:
    width, time_step = pulse_width_s(maximum_frequency_hz), grid.time_step_s
    pulse_steps = int(np.ceil(pulse_duration_s(width) / time_step))
    passage = _furthest_m(grid, box) / SPEED_OF_SOUND_M_PER_S + _SETTLING_S
    steps = pulse_steps + int(np.ceil(passage / time_step))
    # Sources act in the middle of a step; they end with the pulse because each costs FFTs.
    source_time = time_step * (np.arange(pulse_steps) + 0.5)
    volume_velocity = pulse(source_time, width)
    # One node of volume velocity Q: p = rho c Q/(2 dx²) in k-Wave's scaling.
    impedance = AIR_DENSITY_KG_PER_M3 * SPEED_OF_SOUND_M_PER_S
    scale = grid.source_strength * impedance / (2.0 * grid.spacing_m**2)
    simulation = build_simulation(grid, scale * volume_velocity, steps)
    shape = [part.stop - part.start for part in grid.block]
    transformer = RunningTransform(frequency_hz, int(np.prod(shape)))
    for step in range(steps):
        simulation.step()
        transformer.next_row((step + 1) * time_step)[:] = simulation.p[grid.block].ravel()
        if step % _PROGRESS_STEPS == 0:
            progress(f"k-Wave {name}", step, steps)
    progress(f"k-Wave {name}", steps, steps)
    # p = j omega rho Q G.
    omega = 2.0 * np.pi * frequency_hz
    source = (
        1j * omega * AIR_DENSITY_KG_PER_M3 * transform(frequency_hz, source_time, volume_velocity)
    )
    field = (transformer.spectrum() / source[:, None]).reshape(-1, *shape)
    return BoxField(
        interpolate_field(field, grid.block_origin, grid.spacing_m, box.inner),
        interpolate_field(field, grid.block_origin, grid.spacing_m, box.outer),
    )


def _furthest_m(grid: RoomGrid, box: Box) -> float:
    """Longest way from a source to a point of the box, m."""
    sources = grid.origin + grid.spacing_m * np.array(grid.source_nodes)
    return max(float(np.linalg.norm(box.outer - source, axis=1).max()) for source in sources)


def check_receiver(
    name: str,
    microphone: Array,
    box: Box,
    largest_spacing_m: float,
    floor_z_m: float | None,
    frequencies: int,
) -> None:
    """Check a microphone's position and the memory of its run, before any run.

    Raises
    ------
    ParameterError
        See `kwave_green`.
    """
    if floor_z_m is not None and microphone[2] < floor_z_m - 1e-9:
        raise ParameterError(f"receivers.{name}: the microphone lies below the floor")
    outside = np.maximum(np.maximum(box.lower - microphone, microphone - box.upper), 0.0)
    grid = room_grid(microphone, box, largest_spacing_m, floor_z_m)
    distance, least = float(np.max(outside)), _CLEAR_NODES * grid.spacing_m
    if distance < least:
        raise ParameterError(
            f"receivers.{name}: the microphone must stand at least {least:.3g} m off the box "
            f"around the shell ({box.lower.round(3).tolist()} to {box.upper.round(3).tolist()} m), "
            f"got {distance:.3g} m; a smaller radiation.room_spacing_mm lets it stand closer"
        )
    _check_memory(name, grid, frequencies)


def _check_memory(name: str, grid: RoomGrid, frequencies: int) -> None:
    recorded = np.prod([part.stop - part.start for part in grid.block], dtype=float)
    spectra = _COPIES_OF_SPECTRA * 16.0 * frequencies * recorded
    needed = (_BYTES_PER_NODE * np.prod(grid.shape, dtype=float) + spectra) / 2**30
    available = psutil.virtual_memory().available / 2**30
    if needed > available:
        raise ParameterError(
            f"radiation.room_spacing_mm: the k-Wave grid of {grid.shape[0]}×{grid.shape[1]}×"
            f"{grid.shape[2]} nodes for receivers.{name} needs {needed:.3g} GiB, "
            f"{available:.3g} GiB are available"
        )
