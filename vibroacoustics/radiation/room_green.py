"""The room side: k-Wave's Green's function between a microphone and the box around the machine.

By reciprocity a monopole at the microphone gives the Green's function of every point of the box
towards the microphone.

Walls are image sources. For hard walls this is exact in the discrete equations: these are symmetric
about a node plane and so are the sources, hence the normal velocity on that plane vanishes. A floor
of dense medium would be wrong by 0.17 dB and can be unstable.
"""

import contextlib
from collections.abc import Sequence
from typing import Final

import numpy as np

from ..base.constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from ..base.decibel import amplitude_of_level, level_of_amplitude
from ..base.errors import ParameterError, SolverError
from ..base.progress import Progress, no_progress
from . import device, kwave
from .arrays import Array, ComplexArray
from .band_limited import STENCIL_NODES, Interpolator
from .box import Box, BoxField
from .exact import Mirror, box_green
from .near_step import RunningTransform, pulse, pulse_duration_s, pulse_width_s, transform
from .room_grid import RoomGrid, room_grid
from .spectral_step import step_bytes

PRECISION: Final = np.float64
"""Single precision would change the Green's function by 0.002 dB at 25 Hz, less above."""
_STOCK_VALUES_PER_NODE: Final = 60
"""Real numbers that the stock simulation with half spectra keeps at its peak."""
_PROGRESS_STEPS: Final = 20
_SETTLING_S: Final = 5e-4
"""Recording time after the pulse has passed the furthest point of the box."""
CLEAR_NODES: Final = STENCIL_NODES // 2
"""Nodes between microphone and box: with the source inside a stencil, errors reach 1 dB."""
_LARGEST_DIFFERENCE_DB: Final = 6.0
_DEEPEST_NULL: Final = amplitude_of_level(-30.0)
_LARGEST_ALIAS: Final = 1e-8
"""Largest share of the pulse's spectrum at any frequency that decimation may fold onto it."""
_COPIES_OF_SPECTRA: Final = 4
"""Spectra that exist at once: sums and their update, result and its parts."""
_BUFFERED_SAMPLES: Final = 64


class BoxRecorder:
    """Spectra at the points of a box from samples of the grid's block around it."""

    def __init__(self, grid: RoomGrid, box: Box, frequency_hz: Array) -> None:
        points = np.concatenate([box.inner, box.outer])
        self._pairs = len(box.inner)
        self._interpolator = Interpolator(
            grid.block_origin, grid.spacing_m, grid.block_shape, points
        )
        self._transform = RunningTransform(frequency_hz, len(points))

    def add(self, time_s: float, block: Array) -> None:
        """Add a sample of the block (x, y, z)."""
        self._transform.next_row(time_s)[:] = self._interpolator(block)

    def field(self, divisor: ComplexArray) -> BoxField:
        """Sum of samples times exp(-j 2 pi f t), divided by a spectrum (frequency,)."""
        spectrum = self._transform.spectrum()
        spectrum /= divisor[:, None]
        return BoxField(spectrum[:, : self._pairs], spectrum[:, self._pairs :])


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

    Points are omitted where images cancel to less than -30 dB of the largest expected value:
    an error of a thousandth of that is no error of the level there.
    """
    simulated = np.abs(np.concatenate([field.inner, field.outer], axis=1))
    exact = np.abs(np.concatenate([expected.inner, expected.outer], axis=1))
    counted = exact >= _DEEPEST_NULL * exact.max(axis=1, keepdims=True)
    difference = np.where(counted, level_of_amplitude(simulated / exact), 0.0)
    worst = np.argmax(np.abs(difference), axis=1)
    return np.asarray(difference[np.arange(difference.shape[0]), worst])


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
    pulse_steps, steps = steps_of(grid, box, maximum_frequency_hz)
    # Sources act in the middle of a step and end with the pulse.
    source_time = time_step * (np.arange(pulse_steps) + 0.5)
    volume_velocity = pulse(source_time, width)
    per_sample = steps_per_sample(time_step, frequency_hz, width)
    recorder = BoxRecorder(grid, box, frequency_hz)
    with contextlib.closing(
        kwave.build_engine(grid, volume_velocity, steps, threads, PRECISION)
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


def steps_of(grid: RoomGrid, box: Box, maximum_frequency_hz: float) -> tuple[int, int]:
    """Time steps of the pulse, and of the whole run."""
    time_step = grid.time_step_s
    duration = pulse_duration_s(pulse_width_s(maximum_frequency_hz))
    pulse_steps = int(np.ceil(duration / time_step))
    passage = _furthest_m(grid, box) / SPEED_OF_SOUND_M_PER_S + _SETTLING_S
    return pulse_steps, pulse_steps + int(np.ceil(passage / time_step))


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
    outside = clearance_m(box, microphone)
    grid = room_grid(microphone, box, largest_spacing_m, mirrors)
    if np.all(outside < CLEAR_NODES * grid.spacing_m):
        distance, least = float(np.max(outside)), CLEAR_NODES * float(grid.spacing_m.max())
        raise ParameterError(
            f"receivers.{name}: the microphone must stand at least {least:.3g} m off the box "
            f"around the shell ({box.lower.round(3).tolist()} to {box.upper.round(3).tolist()} m), "
            f"got {distance:.3g} m; a smaller radiation.room_spacing_mm lets it stand closer"
        )
    _check_memory(name, grid, box, frequencies)


def clearance_m(box: Box, microphone: Array) -> Array:
    """Distance of a microphone from the box along each axis, (3,), m; 0 beside it."""
    return np.asarray(np.maximum(np.maximum(box.lower - microphone, microphone - box.upper), 0.0))


def _check_memory(name: str, grid: RoomGrid, box: Box, frequencies: int) -> None:
    needed = memory_bytes(grid, box, frequencies) / 2**30
    available = device.available_bytes() / 2**30
    if needed > available:
        raise ParameterError(
            f"radiation.room_spacing_mm: the k-Wave grid of {grid.shape[0]}×{grid.shape[1]}×"
            f"{grid.shape[2]} nodes for receivers.{name} needs {needed:.3g} GiB, "
            f"{available:.3g} GiB are available"
        )


def memory_bytes(grid: RoomGrid, box: Box, frequencies: int) -> float:
    """Memory that a run takes at its peak, beside what is loaded before."""
    recorder = recorder_bytes(box, frequencies)
    if device.array_namespace() is np:
        return step_bytes(grid.shape, PRECISION) + recorder
    values = _STOCK_VALUES_PER_NODE * np.prod(grid.shape, dtype=float)
    return float(values * np.dtype(PRECISION).itemsize) + recorder


def steps_per_sample(time_step_s: float, frequency_hz: Array, pulse_width_s: float) -> int:
    """Number of time steps from one recorded sample to the next.

    The pulse's spectrum is x exp(-x^2/2) with x = 2 pi f s. Sampling at the rate r folds the
    spectrum at r - f onto f; the longest interval is chosen that keeps this below 1e-8 at all
    frequencies.
    """

    def spectrum(frequency: Array) -> Array:
        x = 2 * np.pi * frequency * pulse_width_s
        return np.asarray(x * np.exp(-(x**2) / 2))

    steps = 1
    while True:
        folded = 1 / ((steps + 1) * time_step_s) - frequency_hz
        quiet = (folded > frequency_hz) & (
            spectrum(folded) <= _LARGEST_ALIAS * spectrum(frequency_hz)
        )
        if not quiet.all():
            return steps
        steps += 1


def recorder_bytes(box: Box, frequencies: int) -> float:
    """Memory that recording takes at its peak."""
    points = 2.0 * len(box.inner)
    return points * (16.0 * _COPIES_OF_SPECTRA * frequencies + 8.0 * _BUFFERED_SAMPLES)
