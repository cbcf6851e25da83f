"""Runs of a room's air: a monopole at a microphone each, recorded at points."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain
from threading import Lock
from typing import Final

import numpy as np

from ...base.decibel import SILENCE_DB, level_of_amplitude, level_of_power
from ...base.errors import ParameterError, SolverError
from ...base.forms import returned
from ...base.pieces import stored
from ...base.progress import Progress, no_progress
from ...base.threads import mapped_in_threads
from ..arrays import Array, ComplexArray
from .air import Air, stable_air
from .cutting import AirBox, Face, cut, faces
from .diffuse import reverberation_time_s
from .lattice import Lattice, holding, pieces_of
from .machine_field import Pulse, Record
from .reading import Readings
from .room import Room
from .settings import RoomSettings

_PROGRESS_STEPS: Final = 200
_WATCH_S: Final = 0.02
"""Stretch of time over which the largest pressure is taken."""
ALL_DERIVATIVES: Final = (-1, 0, 1, 2)
"""Pressure and its derivatives along x, y, z."""
PRESSURE: Final = (-1,)


@dataclass(frozen=True)
class RoomResponse:
    """Green's function of a microphone at lattices of points."""

    values: tuple[ComplexArray, ...]
    """Values of each lattice, (frequency, quantity, x, y, z): the Green's function, 1/m, and on
    request its derivatives along x, y and z, 1/m²; free field is exp(-jkr)/(4 pi r)."""
    remaining_db: float
    """Level at which the run ended, of its largest pressure: what was cut off."""


class Runs:
    """Shared data of the runs of a room: air, time step, points.

    Parameters
    ----------
    boxes, faces : boxes and faces of the air
    lattices : where is recorded
    quantities : quantities of each lattice, pressure (-1) and derivatives by axis
    settings : spacing and duration
    longest_s : duration after the pulse, at most
    """

    def __init__(
        self,
        boxes: Sequence[AirBox],
        faces: Sequence[Face],
        lattices: Sequence[Lattice],
        quantities: Sequence[Sequence[int]],
        settings: RoomSettings,
        longest_s: float,
    ) -> None:
        self._boxes, self._faces, self._settings = boxes, faces, settings
        air = stable_air(boxes, faces, settings.longest_step_s, settings.maximum_frequency_hz)
        self.step_s = air.time_step_s
        self._shapes = [
            (len(quantity), *lattice.shape)
            for lattice, quantity in zip(lattices, quantities, strict=True)
        ]
        first = np.cumsum([0, *(int(np.prod(shape)) for shape in self._shapes)])
        self._columns = int(first[-1])
        pieces = (
            pieces_of(boxes, lattice, self.step_s, quantity, int(start))
            for lattice, quantity, start in zip(lattices, quantities, first[:-1], strict=True)
        )
        self._readings = Readings(air.plan, list(chain.from_iterable(pieces)))
        self._pulse = Pulse(*settings.force(self.step_s), self.step_s)
        self._every = settings.sampling_steps(self.step_s)
        self.steps = int(np.ceil((self._pulse.time_s[-1] + longest_s) / self.step_s))
        """Steps of a run, at most."""

    @property
    def sample_s(self) -> float:
        """Time between samples."""
        return self._every * self.step_s

    @property
    def samples(self) -> int:
        """Samples of a run, at most."""
        return -(-self.steps // self._every)

    def record(self, name: str, microphone: Array, progress: Progress = no_progress) -> Record:
        """One run.

        Raises
        ------
        SolverError
            The pressure is no finite number.
        """
        highest_hz, force = self._settings.maximum_frequency_hz, self._pulse.force
        air = Air(self._boxes, self._faces, self.step_s, highest_hz)
        air.set_source(holding(self._boxes, microphone), microphone)
        samples, taken = np.empty((self.samples, self._columns)), 0
        decay = _Decay(max(1, round(_WATCH_S / self.sample_s)), self._settings.decay_db)
        for step in range(self.steps):
            now = float(force[step]) if step < force.size else 0.0
            air.exchange(now)
            if step % self._every == 0:
                row = samples[taken]
                self._readings.read(air, row)
                taken += 1
                if decay.ended(row) and step > force.size:
                    break
            air.advance(now)
            if step % _PROGRESS_STEPS == 0:
                progress(f"room {name}", step, self.steps)
        progress(f"room {name}", self.steps, self.steps)
        if not np.isfinite(decay.remaining_db):
            raise SolverError(f"room: the pressure of {name} is no number")
        return Record(samples[:taken], self._shapes, self._pulse, self._every, decay.remaining_db)


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
    quantities = [ALL_DERIVATIVES if gradient else PRESSURE] * len(lattices)
    runs = Runs(boxes, faces, lattices, quantities, settings, longest_s)
    advance = together(progress, len(microphones))

    def of_microphone(microphone: tuple[str, Array]) -> RoomResponse:
        record = runs.record(*microphone, advance)
        return RoomResponse(record.greens_at(frequency_hz), record.remaining_db)

    in_parallel = partial(mapped_in_threads, of_microphone, workers=workers)
    responses = stored(
        ("room", frequency_hz, settings), microphones.items(), in_parallel, returned(of_microphone)
    )
    return dict(zip(microphones, responses, strict=True))


def together(progress: Progress, runs: int) -> Progress:
    """Progress of several runs as one: steps of all of them."""
    done: dict[str, int] = {}
    lock = Lock()

    def of_one(name: str, step: int, steps: int) -> None:
        with lock:
            done[name] = step
            progress("room", sum(done.values()), runs * steps)

    return of_one


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


def room_transfer(
    room: Room,
    lattices: Sequence[Lattice],
    microphones: Mapping[str, Array],
    frequency_hz: Array,
    settings: RoomSettings | None = None,
    gradient: bool = False,
    progress: Progress = no_progress,
    workers: int | None = None,
) -> dict[str, RoomResponse]:
    """Green's functions between microphones and points of a room, by microphone.

    A monopole at the microphone gives those of all points towards it (reciprocity). Pressure is
    read off the series: points and microphones may lie anywhere in the air, but points nearer to
    the microphone than two spacings see a monopole that the series blurs.

    Parameters
    ----------
    room : its origin is the origin of all coordinates
    lattices : lattices of points, such as those of `join_lattices`
    microphones : (3,) by name, m
    frequency_hz : frequencies up to the highest of the settings, shape (frequency,)
    settings : spacing and duration
    gradient : whether derivatives are asked for, too
    progress : reports steps done
    workers : microphones at a time; None: as many as there are processors

    Raises
    ------
    ParameterError
        A microphone or a point lies in a block, a gap is too thin, or a frequency too high.
    SolverError
        The pressure is no finite number.
    """
    settings = settings or RoomSettings()
    if frequency_hz.size and frequency_hz.max() > settings.maximum_frequency_hz * (1.0 + 1e-9):
        raise ParameterError(
            f"room: {frequency_hz.max():g} Hz is asked for; the room is computed to "
            f"{settings.maximum_frequency_hz:g} Hz"
        )
    boxes = cut(room, settings.spacing_m)
    for name, position in microphones.items():
        holding(boxes, position, f"microphones.{name}")
    longest = settings.longest_s or reverberation_time_s(room)
    return run_all(
        boxes, faces(room, boxes), lattices, gradient, microphones, frequency_hz, settings, longest,
        progress, workers,
    )  # fmt: skip


def spacing_error_db(
    room: Room,
    lattices: Sequence[Lattice],
    microphones: Mapping[str, Array],
    frequency_hz: Array,
    settings: RoomSettings | None = None,
    progress: Progress = no_progress,
) -> dict[str, Array]:
    """Level of the room minus that with half the spacing, by microphone, (frequency, point), dB.

    The finer run takes sixteen times the work. Errors fall with the spacing's square, so that the
    difference is some four thirds of the error that is left: it is published as it is.
    """
    settings = settings or RoomSettings()
    finer = replace(settings, nodes_per_wave=2.0 * settings.wavelength_m / settings.spacing_m)
    of = (room, lattices, microphones, frequency_hz)
    coarse, fine = (
        room_transfer(*of, accuracy, progress=progress) for accuracy in (settings, finer)
    )
    return {name: _difference_db(coarse[name].values, fine[name].values) for name in microphones}


def _difference_db(coarse: Sequence[ComplexArray], fine: Sequence[ComplexArray]) -> Array:
    parts = [
        level_of_power(np.abs(a[:, 0]) ** 2 / np.abs(b[:, 0]) ** 2).reshape(a.shape[0], -1)
        for a, b in zip(coarse, fine, strict=True)
    ]
    return np.concatenate(parts, axis=1)
