"""Sound pressure per unit velocity of the shell at microphones and other points, labelled."""

import hashlib
from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ..base.constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from ..base.progress import Progress, no_progress
from ..base.regular_file import read_bytes
from ..base.vocabulary import RIGID_BODY_DOFS, check, stamp
from ..machine.shell import Shell
from ..study.body import MeshBody
from ..study.radiation import RadiationSettings
from ..study.receivers import Receiver
from . import room_grid
from .arrangements import check_outside
from .arrays import Array, ComplexArray
from .bodies import LARGEST_FILE_BYTES
from .by_cut_cells import ByCutCells
from .device import engine_name
from .interpolation import Interpolant, interpolant
from .kwave import kwave_version
from .patterns import SurfaceMotion, rigid_body, surface_motion
from .receiver_methods import receiver_methods, with_methods
from .revolution.method import ByRevolution, by_revolution
from .scene import file_patterns, machine_body, position_m, scene
from .sound_field import NO_SOUND_FIELD, SoundField, field_parts, labelled_fields
from .task import Task


def transfer_vectors(
    shell: Shell,
    receivers: Mapping[str, Receiver],
    settings: RadiationSettings,
    sound_field: SoundField = NO_SOUND_FIELD,
    motions: Sequence[SurfaceMotion] = (),
    kwave_receivers: Collection[str] | None = None,
    progress: Progress = no_progress,
) -> xr.Dataset:
    """Complex pressure at each receiver per unit complex-peak velocity of each degree of freedom.

    Parameters
    ----------
    shell : shell of the machine
    receivers : the microphones, by name
    settings : settings of the radiation
    sound_field : points that are requested besides the microphones
    motions : surface velocities besides the rigid motions
    kwave_receivers : microphones at which k-Wave computes the room where the settings name it as
        the solver; none for all of them
    progress : told of the advance

    Returns
    -------
    Dataset
        `transfer_vector` (receiver, dof, frequency) from the near field and the room's solver, its
        standard error `transfer_vector_error`; coordinate `distance` (receiver) from the origin, m.
        Where that solver is k-Wave: `transfer_vector_closed_form`, the same near field with the
        closed-form Green's function; `green_difference` (receiver, frequency), the level difference
        of the two Green's functions where it is largest on the box, dB, not a number where k-Wave
        did not run. What the sound field asks for besides, with the closed-form Green's function.
        The coordinates `radiation_method` and `radiation_method_reason` (receiver) name what
        computes each microphone, and why not k-Wave.

    Raises
    ------
    ParameterError
        A receiver lies in or too close to the shell, a mesh is not closed, things overlap, a grid
        needs more memory than is available, or walls or gaps are too thin for it.
    SolverError
        A field is not finite, not plausible or has not died down.
    """
    task = task_of(shell, receivers, settings, sound_field, motions, kwave_receivers)
    surroundings, frequency_hz = task.scene, task.frequency_hz
    method = method_of(shell, task)
    parts = field_parts(method.clear, surroundings, shell.floor_z_m, sound_field, task.tabulated)
    vectors, elsewhere = method.pressures([part.microphones for part in parts], progress)
    names = [pattern.name for pattern in task.patterns[len(RIGID_BODY_DOFS) :]]
    dataset = labelled(vectors, task.positions, task.table_hz, names)
    dataset = dataset.merge(labelled_fields(parts, elsewhere, frequency_hz, surroundings))
    dataset = with_methods(dataset, receiver_methods(receivers, settings, task.kwave))
    return check(dataset).assign_attrs(
        room_solver=settings.room_solver,
        surroundings=settings.surroundings.model_dump_json(),
        room_time_step_courant_number=room_grid.COURANT_NUMBER,
        **({"room_engine": engine_name()} if task.kwave else {}),
        **method.attributes(),
    )


def task_of(
    shell: Shell,
    receivers: Mapping[str, Receiver],
    settings: RadiationSettings,
    sound_field: SoundField = NO_SOUND_FIELD,
    motions: Sequence[SurfaceMotion] = (),
    kwave_receivers: Collection[str] | None = None,
) -> Task:
    """Return the task of a method of radiation; see `transfer_vectors`."""
    surroundings = scene(shell, settings)
    extra = [
        *file_patterns(settings.body, surroundings.machine),
        *(surface_motion(motion) for motion in motions),
    ]
    positions = {name: position_m(shell, receiver) for name, receiver in receivers.items()}
    for name, position in positions.items():
        check_outside(f"receivers.{name}", position, surroundings.body)
    table = frequencies_hz(settings)
    patterns = [*map(rigid_body, RIGID_BODY_DOFS), *extra]
    frequency_hz = np.concatenate([table, sound_field.line_frequency_hz])
    kwave = kwave_names(receivers, settings, kwave_receivers)
    return Task(surroundings, patterns, positions, settings, frequency_hz, table.size, kwave)


def method_of(shell: Shell, task: Task) -> ByRevolution | ByCutCells:
    """Boundary elements on the meridian where body and surroundings allow it, else cut cells."""
    return by_revolution(shell, task) if task.settings.revolution else ByCutCells(task)


def pressure_per_velocity(transfer_vector: xr.DataArray) -> Interpolant:
    """Transfer vectors as a function of frequencies in Hz, (receiver, dof, frequency)."""
    ordered = transfer_vector.transpose("receiver", "dof", "frequency")
    distance = ordered["distance"].values[:, None]
    return interpolant(ordered["frequency"].values, ordered.values, distance)


def interpolate_transfer_vector(
    transfer_vector: xr.DataArray, frequency: xr.DataArray
) -> xr.DataArray:
    """Transfer vectors at frequencies (any dims, Hz): (receiver, dof, dims of `frequency`).

    See `interpolation.interpolant` for method, error and what is raised.
    """
    ordered = transfer_vector.transpose("receiver", "dof", "frequency")
    values = pressure_per_velocity(ordered)(frequency.values.ravel())
    shape = (*ordered.shape[:2], *frequency.shape)
    coordinates = {name: ordered[name] for name in ("receiver", "dof", "distance")}
    return xr.DataArray(
        values.reshape(shape),
        dims=("receiver", "dof", *frequency.dims),
        coords={**frequency.coords, **coordinates},
        name="transfer_vector",
        attrs=transfer_vector.attrs,
    )


def cache_key_material(
    shell: Shell,
    receivers: Mapping[str, Receiver],
    settings: RadiationSettings,
    sound_field: SoundField = NO_SOUND_FIELD,
    motions: Sequence[SurfaceMotion] = (),
    kwave_receivers: Collection[str] | None = None,
) -> dict[str, Any]:
    """Everything that shapes the transfer vectors, as plain data to be hashed."""
    points = machine_body(shell, settings.body).vertices if motions else np.zeros((0, 3))
    return {
        "motions": {motion.name: _hash_of_velocity(motion, points) for motion in motions},
        "shell": shell.model_dump(),
        "receivers": {name: receiver.model_dump() for name, receiver in receivers.items()},
        "settings": settings.model_dump(),
        "kwave_receivers": kwave_names(receivers, settings, kwave_receivers),
        "files": _hashes_of_files(settings),
        "sound_field": sound_field.key_material(),
        "speed_of_sound_m_per_s": SPEED_OF_SOUND_M_PER_S,
        "air_density_kg_per_m3": AIR_DENSITY_KG_PER_M3,
        "solver": _source_hash(),
        "k_wave": kwave_version(),
    }


def kwave_names(
    receivers: Collection[str], settings: RadiationSettings, chosen: Collection[str] | None
) -> tuple[str, ...]:
    """Microphones at which k-Wave computes the room."""
    if settings.room_solver == "closed-form":
        return ()
    return tuple(name for name in receivers if chosen is None or name in chosen)


def _hashes_of_files(settings: RadiationSettings) -> dict[str, str]:
    """Content of the files that the settings name; what cannot be read is refused later."""
    if not isinstance(settings.body, MeshBody):
        return {}
    hashes = {}
    for name in (settings.body.file, *settings.body.patterns.values()):
        with suppress(OSError, ValueError):
            hashes[str(Path(name))] = _hash(read_bytes(Path(name), LARGEST_FILE_BYTES))
    return hashes


def _source_hash() -> str:
    """Hash of this package's source: a change of the solver never meets an old cache."""
    return _hash(
        b"".join(file.read_bytes() for file in sorted(Path(__file__).parent.rglob("*.py")))
    )


def _hash_of_velocity(motion: SurfaceMotion, points: Array) -> str:
    """Hash of a motion at the corners of the body's surface, to nine digits of its largest."""
    velocity = motion.velocity(np.asarray(points, dtype=float))
    return _hash(np.round(velocity / np.abs(velocity).max(), 9).tobytes())


def _hash(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def frequencies_hz(settings: RadiationSettings) -> Array:
    """Tabulated frequencies: whole multiples of the step, the last one at or above the maximum."""
    step = settings.table_step_hz
    count = int(np.ceil(settings.maximum_frequency_hz / step - 1e-9))
    return np.asarray(step * np.arange(1.0, count + 1.0))


def labelled(
    vectors: Mapping[str, Array | ComplexArray],
    positions: Mapping[str, Array],
    frequency: Array,
    patterns: Sequence[str],
) -> xr.Dataset:
    """Label transfer vectors of rigid motions and of patterns.

    Parameters
    ----------
    vectors : by name of the rigid motions' variable, shape (receiver, pattern, frequency), rigid
        motions first; `green_difference` without patterns
    positions : positions of the receivers by name, shape (3,), m
    frequency : shape (frequency,), Hz
    patterns : names of those besides the rigid motions
    """
    distances = [float(np.linalg.norm(position)) for position in positions.values()]
    by_receiver = {"receiver": list(positions), "frequency": frequency}
    number = len(RIGID_BODY_DOFS)
    by_dof = {**by_receiver, "dof": list(RIGID_BODY_DOFS)}
    arrays = {
        name: stamp(name, values, by_receiver)
        if name == "green_difference"
        else stamp(name, values[:, :number], by_dof)
        for name, values in vectors.items()
    }
    if patterns:
        by_pattern = {**by_receiver, "pattern": list(patterns)}
        for name in {"transfer_vector", "transfer_vector_error"} & vectors.keys():
            full = f"pattern_{name}"
            arrays[full] = stamp(full, vectors[name][:, number:], by_pattern)
    return xr.Dataset(arrays, coords={"distance": ("receiver", distances)})
