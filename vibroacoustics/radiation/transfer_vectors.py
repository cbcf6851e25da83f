"""Sound pressure per unit velocity of the shell at microphones and other points, labelled."""

import hashlib
from collections.abc import Mapping, Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any, Final

import numpy as np
import psutil
import xarray as xr

from ..base.constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from ..base.errors import ParameterError
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
from .box import Box, BoxField
from .interpolation import interpolate
from .kwave import kwave_version
from .machine_side import (
    COARSENING,
    MachineSide,
    check_memory,
    in_threads,
    near_fields,
    outside,
    processors,
)
from .near_field import NearField
from .patterns import SurfaceMotion, rigid_body, surface_motion
from .room_green import check_receiver, green_difference_db, kwave_green, memory_bytes
from .scene import Scene, file_patterns, machine_body, position_m, scene
from .sound_field import NO_SOUND_FIELD, SoundField, elsewhere

_SHARE_OF_MEMORY: Final = 0.7
_SOLVERS: Final = {
    "k-wave": "cut cells, k-wave-python {}",
    "closed-form": "cut cells, image sources",
}


def transfer_vectors(
    shell: Shell,
    receivers: Mapping[str, Receiver],
    settings: RadiationSettings,
    sound_field: SoundField = NO_SOUND_FIELD,
    motions: Sequence[SurfaceMotion] = (),
    progress: Progress = no_progress,
) -> xr.Dataset:
    """Complex pressure at each receiver per unit complex-peak velocity of each degree of freedom.

    Returns
    -------
    Dataset
        `transfer_vector` (receiver, dof, frequency) from the near field and the room's solver, its
        standard error `transfer_vector_error`; coordinate `distance` (receiver) from the origin, m.
        Where that solver is k-Wave: `transfer_vector_closed_form`, the same near field with the
        closed-form Green's function; `green_difference` (receiver, frequency), the level difference
        of the two Green's functions where it is largest on the box, dB. What the sound field asks
        for besides, with the closed-form Green's function.

    Raises
    ------
    ParameterError
        A receiver lies in or too close to the shell, a mesh is not closed, things overlap, or a
        grid needs more memory than is available.
    SolverError
        A field is not finite, not plausible or has not died down.
    """
    surroundings = scene(shell, settings)
    extra = [
        *file_patterns(settings.body, surroundings.machine),
        *(surface_motion(motion) for motion in motions),
    ]
    positions = {name: position_m(shell, receiver) for name, receiver in receivers.items()}
    table = frequencies_hz(settings)
    near = near_fields(surroundings, settings.near_field_spacing_m, settings.maximum_frequency_hz)
    patterns = [*map(rigid_body, RIGID_BODY_DOFS), *extra]
    frequency_hz = np.concatenate([table, sound_field.line_frequency_hz])
    check_memory(near, len(patterns), frequency_hz.size)
    _check_receivers(surroundings, near, positions, settings, table.size)
    side = MachineSide(surroundings, near, patterns, frequency_hz, progress)
    microphones = _at_receivers(side, positions, settings, table, progress)
    dataset = _labelled(microphones, positions, table, [pattern.name for pattern in extra])
    dataset = dataset.merge(
        elsewhere(side, surroundings, shell.floor_z_m, sound_field, table.size, progress)
    )
    grid = near[0].grid
    return check(dataset).assign_attrs(
        solver=_SOLVERS[settings.room_solver].format(kwave_version()),
        room_solver=settings.room_solver,
        surroundings=settings.surroundings.model_dump_json(),
        near_field_cells=" x ".join(map(str, grid.shape)),
        near_field_spacing_m=grid.spacing_m,
        near_field_time_step_s=grid.time_step_s,
        near_field_extrapolation=f"from {COARSENING:g} times the spacing, second order",
        room_time_step_courant_number=room_grid.COURANT_NUMBER,
        neglected="echoes of absorbing or distant walls, scattered again by the shell",
    )


def _check_receivers(
    surroundings: Scene,
    near: Sequence[NearField],
    positions: Mapping[str, Array],
    settings: RadiationSettings,
    number: int,
) -> None:
    """Refuse what cannot be computed before anything is computed."""
    walls = surroundings.walls
    for name, position in positions.items():
        check_outside(f"receivers.{name}", position, surroundings.body)
        if settings.room_solver == "k-wave":
            check_receiver(name, position, near[0].box, settings.room_spacing_m, walls, number)
        if not outside(near, walls, position[None, :])[0]:
            raise ParameterError(
                f"receivers.{name}: stands behind a wall or within "
                f"{1e3 * near[-1].margin_m:.0f} mm of the machine or its cabinet"
            )


def _at_receivers(
    side: MachineSide,
    positions: Mapping[str, Array],
    settings: RadiationSettings,
    table: Array,
    progress: Progress,
) -> dict[str, Array | ComplexArray]:
    """Pressures (receiver, pattern, frequency) and errors; with k-Wave its check besides."""
    chosen = slice(0, table.size)
    closed, corrections = (
        np.array(part)
        for part in zip(
            *in_threads([partial(side.pressures, p, chosen) for p in positions.values()]),
            strict=True,
        )
    )
    error = np.abs(corrections)
    if settings.room_solver == "closed-form":
        return {"transfer_vector": closed, "transfer_vector_error": error}
    greens = _room_greens(side.near[0].box, positions, side, settings, table, progress)
    difference = [
        green_difference_db(green, side.green(position, chosen))
        for position, green in zip(positions.values(), greens, strict=True)
    ]
    return {
        "transfer_vector": corrections + [side.joined(green, chosen) for green in greens],
        "transfer_vector_error": error,
        "transfer_vector_closed_form": closed,
        "green_difference": np.array(difference),
    }


def _room_greens(
    box: Box,
    positions: Mapping[str, Array],
    side: MachineSide,
    settings: RadiationSettings,
    table: Array,
    progress: Progress,
) -> list[BoxField]:
    """Green's functions of the receivers by k-Wave, several at a time."""
    workers = _workers(box, positions, settings, side, table.size)
    threads = max(1, processors() // workers)
    arguments = (table, settings.maximum_frequency_hz, settings.room_spacing_m, side.walls)
    return in_threads(
        [
            partial(kwave_green, box, position, *arguments, name, progress, threads)
            for name, position in positions.items()
        ],
        workers,
    )


def _workers(
    box: Box,
    positions: Mapping[str, Array],
    settings: RadiationSettings,
    side: MachineSide,
    frequencies: int,
) -> int:
    """How many k-Wave runs the processors and the memory carry at a time."""
    largest = max(
        memory_bytes(
            room_grid.room_grid(position, box, settings.room_spacing_m, side.walls),
            box,
            frequencies,
        )
        for position in positions.values()
    )
    affordable = int(_SHARE_OF_MEMORY * psutil.virtual_memory().available / largest)
    return max(1, min(processors(), len(positions), affordable))


def interpolate_transfer_vector(
    transfer_vector: xr.DataArray, frequency: xr.DataArray
) -> xr.DataArray:
    """Transfer vectors at frequencies (any dims, Hz): (receiver, dof, dims of `frequency`).

    See `interpolation.interpolate` for method, error and what is raised.
    """
    ordered = transfer_vector.transpose("receiver", "dof", "frequency")
    values = interpolate(
        ordered["frequency"].values,
        ordered.values,
        ordered["distance"].values[:, None],
        frequency.values.ravel(),
    )
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
) -> dict[str, Any]:
    """Everything that shapes the transfer vectors, as plain data to be hashed."""
    points = machine_body(shell, settings.body).vertices if motions else np.zeros((0, 3))
    return {
        "motions": {motion.name: _hash_of_velocity(motion, points) for motion in motions},
        "shell": shell.model_dump(),
        "receivers": {name: receiver.model_dump() for name, receiver in receivers.items()},
        "settings": settings.model_dump(),
        "files": _hashes_of_files(settings),
        "sound_field": sound_field.key_material(),
        "speed_of_sound_m_per_s": SPEED_OF_SOUND_M_PER_S,
        "air_density_kg_per_m3": AIR_DENSITY_KG_PER_M3,
        "solver": _source_hash(),
        "k_wave": kwave_version(),
    }


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
    step = settings.frequency_step_hz
    count = int(np.ceil(settings.maximum_frequency_hz / step - 1e-9))
    frequencies: Array = step * np.arange(1.0, count + 1.0)
    return frequencies


def _labelled(
    vectors: Mapping[str, Array | ComplexArray],
    positions: Mapping[str, Array],
    frequency: Array,
    patterns: list[str],
) -> xr.Dataset:
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
        by_pattern = {**by_receiver, "pattern": patterns}
        for name in ("transfer_vector", "transfer_vector_error"):
            full = f"pattern_{name}"
            arrays[full] = stamp(full, vectors[name][:, number:], by_pattern)
    return xr.Dataset(arrays, coords={"distance": ("receiver", distances)})
