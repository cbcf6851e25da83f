"""The room side: k-Wave's Green's function between a microphone and the box around the machine.

By reciprocity a monopole at the microphone gives the Green's function of every point of the box
towards the microphone. k-Wave's discrete equations are kept to the last digits: spectral operators,
additive source, absorbing layer inside the grid. On the processor `spectral_step` advances them.

Walls are image sources. For hard walls this is exact in the discrete equations: these are symmetric
about a node plane and so are the sources, hence the normal velocity on that plane vanishes. A floor
of dense medium would be wrong by 0.17 dB and can be unstable.

This module alone imports k-Wave, and only inside functions. The package's own `__init__` downloads
executables, so it is never executed.
"""

import contextlib
import functools
import importlib
import importlib.metadata
import importlib.util
import platform
import sys
import threading
from collections.abc import Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Final, Protocol

import numpy as np
import psutil

from ..constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from ..errors import ParameterError, SolverError
from .arrays import Array, Progress, no_progress
from .band_limited import STENCIL_NODES
from .box import Box, BoxField
from .exact import box_green
from .mirrors import Mirror
from .pulse import pulse, pulse_duration_s, pulse_width_s, transform
from .room_grid import PML_ALPHA, PML_NODES, RoomGrid, room_grid
from .room_record import BoxRecorder, recorder_bytes, steps_per_sample
from .spectral_step import AxisOperators, PressureSource, SpectralStep, step_bytes

PRECISION: Final = np.float64
"""Single precision would change the Green's function by 0.002 dB at 25 Hz, less above."""
_STOCK_VALUES_PER_NODE: Final = 60
"""Real numbers that the stock simulation with half spectra keeps at its peak."""
_PROGRESS_STEPS: Final = 20
_SETTLING_S: Final = 5e-4
"""Recording time after the pulse has passed the furthest point of the box."""
_CLEAR_NODES: Final = STENCIL_NODES // 2
"""Nodes between microphone and box: with the source inside a stencil, errors reach 1 dB."""
_LARGEST_DIFFERENCE_DB: Final = 6.0
_DEEPEST_NULL: Final = 10 ** (-30 / 20)
_MODULES: Final = ("kwave.kgrid", "kwave.kmedium", "kwave.ksource", "kwave.ksensor")
_SOLVER: Final = "kwave.solvers.kspace_solver"
_IMPORT: Final = threading.Lock()


def load_kwave() -> None:
    """Make k-Wave's modules importable without executing its `__init__`, which downloads.

    Raises
    ------
    SolverError
        k-wave-python is not installed.
    """
    with _IMPORT:
        if "kwave" not in sys.modules:
            sys.modules["kwave"] = _bare_package()


def _bare_package() -> Any:
    """k-Wave's package, its `__init__` not executed."""
    specification = importlib.util.find_spec("kwave")
    if specification is None or specification.origin is None:
        raise SolverError("k-Wave is not installed; run: pip install k-wave-python==0.6.2")
    bare: Any = importlib.util.module_from_spec(specification)
    bare.__version__ = kwave_version()
    bare.PLATFORM = platform.system().lower()
    bare.BINARY_PATH = bare.BINARY_DIR = Path(specification.origin).parent / "bin" / bare.PLATFORM
    return bare


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


class Engine(Protocol):
    """What runs k-Wave's time steps."""

    def step(self) -> None:
        """Advance by one time step."""

    def pressure(self, block: tuple[slice, slice, slice]) -> Array:
        """Sound pressure at a block's nodes, Pa."""

    def close(self) -> None:
        """Free what the engine holds."""


class StockEngine:
    """k-Wave's own step, on the arrays of its namespace."""

    def __init__(self, simulation: Any) -> None:
        self._simulation = simulation

    def step(self) -> None:
        """Advance by one time step."""
        self._simulation.step()

    def pressure(self, block: tuple[slice, slice, slice]) -> Array:
        """Sound pressure at a block's nodes, Pa, copied to this computer's memory."""
        pressure = self._simulation.p[block]
        return np.asarray(pressure.get() if hasattr(pressure, "get") else pressure)

    def close(self) -> None:
        """Nothing is held."""


@functools.cache
def array_namespace() -> Any:
    """CuPy, where it is installed and finds a device, else NumPy."""
    try:
        cupy: Any = importlib.import_module("cupy")
        return cupy if cupy.cuda.runtime.getDeviceCount() > 0 else np
    except Exception:  # no CuPy, no driver or no device: CuPy has an exception for each
        return np


def build_engine(
    grid: RoomGrid, volume_velocity: Array, steps: int, threads: int = 1, dtype: Any = np.float64
) -> Engine:
    """k-Wave's time step with a volume velocity (step,), m³/s, at the grid's source nodes.

    On a device it is k-Wave's own; on this computer's processor the same equations, restated.
    """
    source = pressure_source(grid, volume_velocity)
    if array_namespace() is not np:
        simulation = build_simulation(grid, source, steps, array_namespace(), dtype)
        return StockEngine(simulation)
    return SpectralStep(
        axis_operators(grid),
        grid.time_step_s,
        SPEED_OF_SOUND_M_PER_S,
        AIR_DENSITY_KG_PER_M3,
        source,
        dtype,
        threads,
    )


def pressure_source(grid: RoomGrid, volume_velocity: Array) -> PressureSource:
    """k-Wave's additive pressure source that stands for a volume velocity at the grid's sources.

    A volume velocity Q adds the pressure rho c² Q dt/(dx dy dz) to its node at each step. k-Wave
    adds p 2 c dt/(3 d) to the part of each axis of spacing d: so
    p = 3 rho c Q/(2 dx dy dz (1/dx + 1/dy + 1/dz)), which is rho c Q/(2 dx²) on a cubic grid.
    """
    impedance = AIR_DENSITY_KG_PER_M3 * SPEED_OF_SOUND_M_PER_S
    area = 2.0 / 3.0 * np.prod(grid.spacing_m) * np.sum(1.0 / grid.spacing_m)
    return PressureSource(
        grid.source_nodes, grid.source_strengths, impedance / area * volume_velocity
    )


def axis_operators(grid: RoomGrid) -> list[AxisOperators]:
    """k-Wave's derivatives and absorbing layer of each axis, from one-dimensional simulations.

    Those of three dimensions are these times the k-space correction; to set them up would take
    five times the memory of the run.
    """
    operators = []
    for count, spacing in zip(grid.shape, grid.spacing_m, strict=True):
        simulation = _set_up([count], [spacing], grid.time_step_s, 1, use_kspace=False)
        operators.append(
            AxisOperators(
                spacing_m=float(spacing),
                wavenumber=simulation.k_list[0],
                gradient=simulation.op_grad_list[0],
                divergence=simulation.op_div_list[0],
                damping=simulation.pml_list[0],
                damping_staggered=simulation.pml_sg_list[0],
            )
        )
    return operators


def build_simulation(
    grid: RoomGrid,
    pressure: PressureSource,
    steps: int,
    namespace: Any = None,
    dtype: Any = np.float64,
) -> Any:
    """Stock k-Wave `Simulation` of air with additive pressure sources at the grid's nodes.

    With a namespace (CuPy, or NumPy) its arrays and transforms are used, and half spectra, which
    real fields need; without one the simulation is untouched.
    """
    load_kwave()
    source = importlib.import_module("kwave.ksource").kSource()
    source.p_mask = np.zeros(grid.shape, dtype=bool)
    source.p_mask[tuple(np.transpose(pressure.nodes))] = True
    source.p = np.outer(pressure.strengths, pressure.signal_pa)
    return _set_up(
        grid.shape,
        grid.spacing_m,
        grid.time_step_s,
        steps,
        source,
        namespace and _HalfSpectra(namespace, grid.shape),
        dtype=dtype,
    )


def _set_up(
    shape: Sequence[int],
    spacing_m: Sequence[float] | Array,
    time_step_s: float,
    steps: int,
    source: Any = None,
    namespace: Any = None,
    **options: Any,
) -> Any:
    """A set-up k-Wave `Simulation` of air."""
    load_kwave()
    kgrid_module, kmedium, ksource, ksensor = map(importlib.import_module, _MODULES)
    kgrid = kgrid_module.kWaveGrid(list(shape), list(spacing_m))
    kgrid.setTime(steps, time_step_s)
    medium = kmedium.kWaveMedium(sound_speed=SPEED_OF_SOUND_M_PER_S, density=AIR_DENSITY_KG_PER_M3)
    # The field is read after every step; k-Wave's own recording would keep all of it.
    sensor = ksensor.kSensor(record=["p_final"])
    simulation = importlib.import_module(_SOLVER).Simulation(
        kgrid,
        medium,
        source or ksource.kSource(),
        sensor,
        pml_size=(PML_NODES,) * len(shape),
        pml_alpha=(PML_ALPHA,) * len(shape),
        **options,
    )
    if namespace is not None:
        simulation.xp = namespace
    simulation.setup()
    if namespace is not None:
        _keep_half_spectra(simulation)
    return simulation


class _HalfSpectra:
    """An array namespace whose transforms are those of real fields."""

    def __init__(self, namespace: Any, shape: tuple[int, ...]) -> None:
        self._namespace = namespace
        self.fft = SimpleNamespace(
            fftfreq=namespace.fft.fftfreq,
            fftn=namespace.fft.rfftn,
            ifftn=functools.partial(namespace.fft.irfftn, s=shape, axes=(0, 1, 2)),
        )

    def __getattr__(self, name: str) -> Any:
        return getattr(self._namespace, name)


def _keep_half_spectra(simulation: Any) -> None:
    """Cut k-Wave's operators to the half of the spectrum that real fields need."""
    half = simulation.grid_shape[-1] // 2 + 1
    for name in ("op_grad_list", "op_div_list"):
        operators = getattr(simulation, name)
        setattr(simulation, name, [full[..., :half].copy() for full in operators])
    simulation.source_kappa = simulation.source_kappa[..., :half].copy()
    simulation._setup_source_operators()  # they hold on to the operator of the source


def kwave_green(
    box: Box,
    microphone: Array,
    frequency_hz: Array,
    maximum_frequency_hz: float,
    largest_spacing_m: float,
    mirrors: Sequence[Mirror] = (),
    name: str = "microphone",
    progress: Progress = no_progress,
    threads: int = 2,
) -> BoxField:
    """Green's function (1/m) of a microphone on both layers of the box.

    Normalised so that free field is exp(-jkr)/(4 pi r). Several calls may run side by side in
    threads.

    Raises
    ------
    ParameterError
        The microphone lies in the box, too close to it or behind a wall, or the grid needs more
        memory than is available.
    SolverError
        k-Wave's field is not finite or further than 6 dB from the closed form.
    """
    check_receiver(name, microphone, box, largest_spacing_m, mirrors, frequency_hz.size)
    grid = room_grid(microphone, box, largest_spacing_m, mirrors)
    field = _run(grid, box, frequency_hz, maximum_frequency_hz, name, progress, threads)
    expected = box_green(box, microphone, frequency_hz, mirrors)
    difference = float(np.max(np.abs(green_difference_db(field, expected))))
    if not difference <= _LARGEST_DIFFERENCE_DB:
        raise SolverError(
            f"receivers.{name}: k-Wave is {difference:.3g} dB off the closed form "
            f"(at most {_LARGEST_DIFFERENCE_DB:g} dB is plausible)"
        )
    return field


def green_difference_db(field: BoxField, expected: BoxField) -> Array:
    """Largest level difference over the box, signed, dB, (frequency,).

    Points are left out where images cancel to less than -30 dB of the largest expected value:
    an error of a thousandth of that is no error of the level there.
    """
    simulated = np.abs(np.concatenate([field.inner, field.outer], axis=1))
    exact = np.abs(np.concatenate([expected.inner, expected.outer], axis=1))
    counted = exact >= _DEEPEST_NULL * exact.max(axis=1, keepdims=True)
    difference = np.where(counted, 20.0 * np.log10(simulated / exact), 0.0)
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
    threads: int,
) -> BoxField:
    width, time_step = pulse_width_s(maximum_frequency_hz), grid.time_step_s
    pulse_steps = int(np.ceil(pulse_duration_s(width) / time_step))
    passage = _furthest_m(grid, box) / SPEED_OF_SOUND_M_PER_S + _SETTLING_S
    steps = pulse_steps + int(np.ceil(passage / time_step))
    # Sources act in the middle of a step and end with the pulse.
    source_time = time_step * (np.arange(pulse_steps) + 0.5)
    volume_velocity = pulse(source_time, width)
    per_sample = steps_per_sample(time_step, frequency_hz, width)
    recorder = BoxRecorder(grid, box, frequency_hz)
    with contextlib.closing(
        build_engine(grid, volume_velocity, steps, threads, PRECISION)
    ) as engine:
        for step in range(1, steps + 1):
            engine.step()
            if step % per_sample == 0:
                recorder.add(step * time_step, engine.pressure(grid.block))
            if step % _PROGRESS_STEPS == 0:
                progress(f"k-Wave {name}", step, steps)
    progress(f"k-Wave {name}", steps, steps)
    # p = j omega rho Q G.
    omega = 2.0 * np.pi * frequency_hz
    source = (
        1j * omega * AIR_DENSITY_KG_PER_M3 * transform(frequency_hz, source_time, volume_velocity)
    )
    return recorder.field(source / per_sample)


def _furthest_m(grid: RoomGrid, box: Box) -> float:
    """Longest way from a source to a point of the box, m."""
    return max(float(np.linalg.norm(box.outer - source, axis=1).max()) for source in grid.sources)


def check_receiver(
    name: str,
    microphone: Array,
    box: Box,
    largest_spacing_m: float,
    mirrors: Sequence[Mirror],
    frequencies: int,
) -> None:
    """Check a microphone's position and the memory of its run, before any run.

    Raises
    ------
    ParameterError
        See `kwave_green`.
    """
    for mirror in mirrors:
        if mirror.depth_m(microphone) < -1e-9:
            raise ParameterError(
                f"receivers.{name}: the microphone lies behind the wall at "
                f"{'xyz'[mirror.axis]} = {mirror.position_m:.4g} m"
            )
    outside = np.maximum(np.maximum(box.lower - microphone, microphone - box.upper), 0.0)
    grid = room_grid(microphone, box, largest_spacing_m, mirrors)
    if np.all(outside < _CLEAR_NODES * grid.spacing_m):
        distance, least = float(np.max(outside)), _CLEAR_NODES * float(grid.spacing_m.max())
        raise ParameterError(
            f"receivers.{name}: the microphone must stand at least {least:.3g} m off the box "
            f"around the shell ({box.lower.round(3).tolist()} to {box.upper.round(3).tolist()} m), "
            f"got {distance:.3g} m; a smaller radiation.room_spacing_mm lets it stand closer"
        )
    _check_memory(name, grid, box, frequencies)


def _check_memory(name: str, grid: RoomGrid, box: Box, frequencies: int) -> None:
    needed = memory_bytes(grid, box, frequencies) / 2**30
    available = _available_bytes() / 2**30
    if needed > available:
        raise ParameterError(
            f"radiation.room_spacing_mm: the k-Wave grid of {grid.shape[0]}×{grid.shape[1]}×"
            f"{grid.shape[2]} nodes for receivers.{name} needs {needed:.3g} GiB, "
            f"{available:.3g} GiB are available"
        )


def memory_bytes(grid: RoomGrid, box: Box, frequencies: int) -> float:
    """Memory that a run takes at its peak, beside what is loaded before."""
    recorder = recorder_bytes(box, frequencies)
    if array_namespace() is np:
        return step_bytes(grid.shape, PRECISION) + recorder
    values = _STOCK_VALUES_PER_NODE * np.prod(grid.shape, dtype=float)
    return float(values * np.dtype(PRECISION).itemsize) + recorder


def _available_bytes() -> float:
    namespace = array_namespace()
    if namespace is np:
        return float(psutil.virtual_memory().available)
    return float(namespace.cuda.runtime.memGetInfo()[0])
