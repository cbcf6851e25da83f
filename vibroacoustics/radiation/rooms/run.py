"""One run of a room's air: a monopole at a microphone, recorded at points."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Final

import numpy as np

from ...base.decibel import SILENCE_DB, level_of_amplitude
from ...base.errors import SolverError
from ...base.progress import Progress, no_progress
from ...base.threads import in_threads
from ..arrays import Array, ComplexArray
from ..pulse import RunningTransform, transform
from .air import Air, stable_air
from .cutting import AirBox, Face
from .lattice import Lattice, Reader, holding
from .settings import RoomSettings

_PROGRESS_STEPS: Final = 200
_WATCH_S: Final = 0.02
"""Stretch of time over which the largest pressure is taken."""


@dataclass(frozen=True)
class RoomResponse:
    """Green's function of a microphone at lattices of points."""

    values: tuple[ComplexArray, ...]
    """Of each lattice, (frequency, quantity, x, y, z): the Green's function, 1/m, and if asked for
    its derivatives along x, y and z, 1/m²; free field is exp(-jkr)/(4 pi r)."""
    remaining_db: float
    """Level at which the run ended, of its largest pressure: what was cut off."""


def run_all(
    boxes: Sequence[AirBox],
    faces: Sequence[Face],
    lattices: Sequence[Lattice],
    gradient: bool,
    microphones: Mapping[str, Array],
    frequency_hz: Array,
    settings: RoomSettings,
    longest_s: float,
    progress: Progress = no_progress,
    workers: int | None = None,
) -> dict[str, RoomResponse]:
    """A run for each microphone, several at a time; see `room_transfer`."""
    step_s = stable_air(boxes, faces, settings.longest_step_s).time_step_s
    readers = [Reader(boxes, lattice, step_s, gradient) for lattice in lattices]
    runs = [
        partial(
            _run, boxes, faces, step_s, position, readers, frequency_hz, settings, longest_s,
            name, progress,
        )
        for name, position in microphones.items()
    ]  # fmt: skip
    return dict(zip(microphones, in_threads(runs, workers), strict=True))


def _run(
    boxes: Sequence[AirBox],
    faces: Sequence[Face],
    step_s: float,
    microphone: Array,
    readers: Sequence[Reader],
    frequency_hz: Array,
    settings: RoomSettings,
    longest_s: float,
    name: str,
    progress: Progress,
) -> RoomResponse:
    air, box = Air(boxes, faces, step_s), holding(boxes, microphone)
    air.set_source(box, microphone)
    time, force = settings.force(step_s)
    every = settings.sampling_steps(step_s)
    steps = int(np.ceil((time[-1] + longest_s) / step_s))
    counts = [int(np.prod(reader.shape)) for reader in readers]
    record = RunningTransform(frequency_hz, sum(counts))
    decay = _Decay(max(1, round(_WATCH_S / (every * step_s))), settings.decay_db)
    for step in range(steps):
        now = float(force[step]) if step < force.size else 0.0
        air.exchange(now)
        if step % every == 0:
            row = record.next_row(step * step_s)
            np.concatenate([reader.read(air) for reader in readers], out=row)
            if decay.ended(row) and step > force.size:
                break
        air.advance(now)
        if step % _PROGRESS_STEPS == 0:
            progress(f"room {name}", step, steps)
    progress(f"room {name}", steps, steps)
    if not np.isfinite(decay.remaining_db):
        raise SolverError(f"receivers.{name}: the room's pressure is no number")
    # A pulse in the middle of steps, as fluxes are: see `flux_gain`.
    phase = np.pi * frequency_hz * step_s
    scale = every * np.tan(phase) / phase / transform(frequency_hz, time, force)
    spectrum = record.spectrum() * scale[:, None]
    parts = np.split(spectrum, np.cumsum(counts)[:-1], axis=1)
    values = (part.reshape(-1, *reader.shape) for part, reader in zip(parts, readers, strict=True))
    return RoomResponse(tuple(values), decay.remaining_db)


class _Decay:
    """Follows the largest pressure of each stretch of time."""

    def __init__(self, samples: int, decay_db: float) -> None:
        self._samples, self._decay_db = samples, decay_db
        self._taken, self._peak, self._largest = 0, 0.0, 0.0
        self.remaining_db = 0.0

    def ended(self, row: Array) -> bool:
        """Whether a stretch ends with this sample that is as quiet as is asked for."""
        self._peak = max(self._peak, float(np.abs(row).max()))
        self._taken += 1
        if self._taken < self._samples:
            return False
        self._largest = max(self._largest, self._peak)
        ratio = self._peak / self._largest if self._largest else 1.0
        self.remaining_db = float(level_of_amplitude(ratio)) if ratio else SILENCE_DB
        self._taken, self._peak = 0, 0.0
        return self.remaining_db < -self._decay_db
