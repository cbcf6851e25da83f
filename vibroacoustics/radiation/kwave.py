"""k-Wave: its solver without its downloads, and the engine that advances its discrete equations.

These are kept to the last digits: spectral operators, additive source, absorbing layer inside the
grid. On the processor `spectral_step` advances them, on a device k-Wave's own step.

This module alone imports k-Wave, and only inside functions. The package's own `__init__` downloads
executables, so it is never executed.
"""

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

from ..base.constants import AIR_DENSITY_KG_PER_M3, AIR_IMPEDANCE_PA_S_PER_M, SPEED_OF_SOUND_M_PER_S
from ..base.errors import SolverError
from . import device
from .arrays import Array
from .room_grid import PML_ALPHA, PML_NODES, RoomGrid
from .spectral_step import AxisOperators, PressureSource, SpectralStep

_MODULES: Final = ("kwave.kgrid", "kwave.kmedium", "kwave.ksource", "kwave.ksensor")
_SOLVER: Final = "kwave.solvers.kspace_solver"
_IMPORT: Final = threading.Lock()


def load_kwave() -> None:
    """Make k-Wave's modules importable without executing its `__init__`, which downloads."""
    with _IMPORT:
        if "kwave" not in sys.modules:
            sys.modules["kwave"] = _bare_package()


def _bare_package() -> Any:
    """k-Wave's package, its `__init__` not executed."""
    specification = importlib.util.find_spec("kwave")
    if specification is None or specification.origin is None:
        raise SolverError(
            "k-Wave is not installed; run: pip install --no-deps k-wave-python==0.6.2"
        )
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
    """Engine of k-Wave's time steps."""

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


def build_engine(
    grid: RoomGrid, volume_velocity: Array, steps: int, threads: int = 1, dtype: Any = np.float64
) -> Engine:
    """k-Wave's time step with a volume velocity (step,), m³/s, at the grid's source nodes.

    On a device it is k-Wave's own; on this computer's processor the same equations, restated.
    """
    source = pressure_source(grid, volume_velocity)
    if device.array_namespace() is not np:
        simulation = build_simulation(grid, source, steps, device.array_namespace(), dtype)
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
    area = 2.0 / 3.0 * np.prod(grid.spacing_m) * np.sum(1.0 / grid.spacing_m)
    pressure = AIR_IMPEDANCE_PA_S_PER_M / area * volume_velocity
    return PressureSource(grid.source_nodes, grid.source_strengths, pressure)


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
