"""A machine in a room: sound pressure at listeners per velocity of its wall, by waves to 1 kHz."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Final

import numpy as np
import xarray as xr

from ...base.errors import ParameterError
from ...base.forms import returned
from ...base.pieces import stored
from ...base.progress import Progress, no_progress
from ...base.revolution import Profile
from ...base.threads import mapped_in_threads
from ...base.vocabulary import RIGID_BODY_DOFS, check, stamp
from ...machine.shell import Shell
from ...study.radiation import RadiationSettings
from ..arrangements import hemisphere_positions, reference_box
from ..arrays import Array, ComplexArray
from ..band_limited import STENCIL_NODES, interpolation_weights
from ..patterns import SurfaceMotion, rigid_body, surface_motion
from ..revolution.profile import body_profile
from ..revolution.side import RevolutionSide
from ..scene import machine_body
from ..transfer_vectors import frequencies_hz
from .cutting import cut, faces
from .diffuse import reverberation_time_s
from .join_box import JoinBox
from .lattice import Lattice, holding
from .machine_field import MachineField
from .room import Room
from .run import PRESSURE, Runs, together
from .settings import RoomSettings
from .standing import Standing, check_listeners, standing

MOST_HZ: Final = 1000.0
"""Highest frequency of the waves in a room."""
_PADDING: Final = 2
"""Lines of the fine grid for each that the record's duration needs."""
_MORE_LINES: Final = STENCIL_NODES // 2
"""More lines above the highest frequency, for interpolation below it."""
_POSITIONS: Final = 20
_LEAST_RADIUS_M: Final = 1.0
"""Least radius of the hemisphere, which is twice the characteristic dimension of the machine or
more."""


def room_vectors(
    shell: Shell,
    settings: RadiationSettings,
    room: Room,
    foot_m: Array,
    listeners: Mapping[str, Array],
    maximum_frequency_hz: float,
    motions: Sequence[SurfaceMotion] = (),
    progress: Progress = no_progress,
) -> xr.Dataset:
    """Complex pressure at listeners in a room per unit velocity of each pattern, by waves.

    The machine's field over a hard floor, from boundary elements on its meridian, is joined on a
    box around it with the room's Green's functions. What it stands on is taken as hard and level
    within the box. The body is a solid in the room, a cuboid of its volume and height, where the
    air beside it allows that: then its echo is that of the cuboid, else there is none.

    Parameters
    ----------
    shell, settings : shell and settings of the machine; the room replaces the settings'
        surroundings for them
    room : without the machine
    foot_m : foot of the axis of the shell on what it stands on, in the room's coordinates, shape
        (3,); the axes of machine and room are parallel
    listeners : (3,) by name, in the room's coordinates, m
    maximum_frequency_hz : maximum frequency of the waves
    motions : surface velocities besides the rigid motions
    progress : told of the advance

    Returns
    -------
    Dataset
        `room_transfer_vector` (listener, pattern, room_frequency), Pa s/m, `room_green_of_foot`
        (listener, room_frequency), 1/m, the mean of the points beside the foot, and
        `hemisphere_transfer_vector` (hemisphere_position, pattern, frequency): pressure at the 20
        positions of ISO 3744, Table B.1, over a hard floor in the open, up to the settings'
        highest frequency; its radius is the attribute `hemisphere_radius_m`. Patterns are
        `RIGID_BODY_DOFS` and then the motions.

    Raises
    ------
    ParameterError
        The body is not of revolution; its foot is neither on the floor nor on a block; it is too
        close to walls or blocks; a listener is in a block or too close; a gap is too thin.
    SolverError
        The pressure is no finite number.
    """
    if not 0.0 < maximum_frequency_hz <= MOST_HZ:
        raise ParameterError(
            f"room.maximum_frequency_hz = {maximum_frequency_hz:g} Hz: must be above 0 and at most "
            f"{MOST_HZ:g} Hz"
        )
    waves = RoomSettings(maximum_frequency_hz)
    profile, stands = placed(shell, settings, room, foot_m, listeners, waves)
    names = [*RIGID_BODY_DOFS, *(motion.name for motion in motions)]
    patterns = [*map(rigid_body, RIGID_BODY_DOFS), *map(surface_motion, motions)]
    highest = max(maximum_frequency_hz, settings.maximum_frequency_hz)
    side = RevolutionSide(profile, patterns, highest, shell.floor_z_m)
    in_room = _in_room(side, stands, listeners, waves, names, progress)
    open_, radius_m = _in_the_open(shell, settings, side, names, progress)
    return check(xr.merge([in_room, open_])).assign_attrs(
        hemisphere_radius_m=radius_m, body_in_room=stands.body_in_room, **in_room.attrs
    )


def placed(
    shell: Shell,
    settings: RadiationSettings,
    room: Room,
    foot_m: Array,
    listeners: Mapping[str, Array],
    waves: RoomSettings,
) -> tuple[Profile, Standing]:
    """Meridian of the body and where it stands, once nothing is left to refuse.

    Raises
    ------
    ParameterError
        See `room_vectors`.
    """
    profile = body_profile(shell, settings.body)
    if profile is None:
        raise ParameterError(
            f'room: radiation.body.kind = "{settings.body.kind}": must be shell or sphere: a '
            f"machine in a room is computed by boundary elements on its meridian"
        )
    stands = standing(shell, profile, room, foot_m, waves.spacing_m)
    check_listeners(stands, listeners)
    boxes = cut(stands.room, waves.spacing_m)
    for name, position in listeners.items():
        holding(boxes, position, f"room.listeners.{name}")
    return profile, stands


def _in_room(
    side: RevolutionSide,
    stands: Standing,
    listeners: Mapping[str, Array],
    waves: RoomSettings,
    names: Sequence[str],
    progress: Progress,
) -> xr.Dataset:
    """`room_transfer_vector` and `room_green_of_foot`, with attributes of the runs."""
    highest, clearance_m = waves.maximum_frequency_hz, stands.clearance_m
    box = JoinBox(stands.lower, stands.upper, highest, clearance_m, on_floor=True)
    boxes = cut(stands.room, waves.spacing_m)
    lattices = [*box.lattices, _around_foot(stands)]
    quantities = [*((-1, axis) for axis in box.axes), PRESSURE]
    longest_s = reverberation_time_s(stands.room)
    runs = Runs(boxes, faces(stands.room, boxes), lattices, quantities, waves, longest_s)
    length = _PADDING * runs.samples
    step_hz = 1.0 / (length * runs.sample_s)
    lines = int(np.ceil(highest / step_hz)) + _MORE_LINES
    origin_m = stands.foot_m - [0.0, 0.0, side.floor_z_m or 0.0]
    field = MachineField(side, box, origin_m, clearance_m, lines * step_hz, progress)
    advance = together(progress, len(listeners))

    def of_listener(listener: tuple[str, Array]) -> tuple[ComplexArray, ComplexArray, float]:
        record = runs.record(*listener, advance)
        green = record.on_grid(len(box.lattices), length, lines)[:, 0].mean(axis=-1)
        return field.join(record, length, lines, step_hz), green, record.remaining_db

    in_parallel = partial(mapped_in_threads, of_listener)
    of_listeners = stored("machine in room", listeners.items(), in_parallel, returned(of_listener))
    values, green, remaining_db = zip(*of_listeners, strict=True)
    ears = {"listener": list(listeners)}
    hertz = {"room_frequency": step_hz * np.arange(1.0, lines + 1.0)}
    coords = {**ears, "pattern": list(names), **hertz}
    arrays = {
        "room_transfer_vector": stamp("room_transfer_vector", np.array(values), coords),
        "room_green_of_foot": stamp("room_green_of_foot", np.array(green), ears | hertz),
    }
    attributes = {
        "room_maximum_frequency_hz": highest,
        "room_record_s": runs.samples * runs.sample_s,
        "room_remaining_db": max(remaining_db),
        "room_boxes": len(boxes),
        "room_terms": int(sum(np.prod(grid.nodes) for grid in boxes)),
        "room_time_step_s": runs.step_s,
    }
    return xr.Dataset(arrays, attrs=attributes)


def _around_foot(stands: Standing) -> Lattice:
    """The corners of the box around the machine, on what it stands on."""
    (x, y, z), (far_x, far_y, _) = stands.lower, stands.upper
    return Lattice(np.array([x, far_x]), np.array([y, far_y]), np.array([z]))


def _in_the_open(
    shell: Shell,
    settings: RadiationSettings,
    side: RevolutionSide,
    names: Sequence[str],
    progress: Progress,
) -> tuple[xr.DataArray, float]:
    """`hemisphere_transfer_vector` and its radius, m."""
    box = reference_box(machine_body(shell, settings.body), shell.floor_z_m)
    radius_m = max(_LEAST_RADIUS_M, 2.0 * box.characteristic_dimension_m)
    points = box.origin_m + hemisphere_positions(radius_m, _POSITIONS)
    table_hz = frequencies_hz(settings)
    sampled = side.spectrum(points, table_hz, "machine in the open", progress)
    labelled = stamp(
        "hemisphere_transfer_vector",
        np.moveaxis(sampled.pressure, 0, -1),
        {
            "hemisphere_position": np.arange(1, _POSITIONS + 1),
            "pattern": list(names),
            "frequency": table_hz,
        },
    )
    return labelled, radius_m


def room_pressure_per_velocity(vectors: xr.Dataset) -> Callable[[Array], ComplexArray]:
    """`room_transfer_vector` as a function of frequencies in Hz, (listener, pattern, frequency).

    Raises
    ------
    ParameterError
        The function is called with a frequency that is negative or above the table.
    """
    table = vectors["room_transfer_vector"].transpose("listener", "pattern", "room_frequency")
    return _between_lines(table.values, vectors)


def green_of_foot(vectors: xr.Dataset) -> Callable[[Array], ComplexArray]:
    """`room_green_of_foot` as a function of frequencies in Hz, (listener, frequency), 1/m."""
    table = vectors["room_green_of_foot"].transpose("listener", "room_frequency")
    return _between_lines(table.values, vectors)


def _between_lines(values: ComplexArray, vectors: xr.Dataset) -> Callable[[Array], ComplexArray]:
    """Values at lines, (..., line), as a function of frequencies in Hz, (..., frequency).

    The response lasts for as long as the record and is tabulated twice as finely as that needs:
    with half of that duration taken out of its delay, it is band limited to half of what the grid
    carries, and `interpolation_weights` errs by 2e-4 of it.
    """
    line_hz = vectors["room_frequency"].values
    step_hz, highest_hz = float(line_hz[0]), float(vectors.attrs["room_maximum_frequency_hz"])
    middle_s = 0.5 / (_PADDING * step_hz)
    turned = values * np.exp(2j * np.pi * line_hz * middle_s)
    below = turned[..., _MORE_LINES - 1 :: -1][..., -_MORE_LINES:].conj()
    around = np.concatenate([below, np.zeros((*values.shape[:-1], 1)), turned], axis=-1)

    def interpolated(frequency_hz: Array) -> ComplexArray:
        frequency_hz = np.asarray(frequency_hz, dtype=float)
        if frequency_hz.size and not (
            frequency_hz.min() >= 0.0 and frequency_hz.max() <= highest_hz * (1.0 + 1e-9)
        ):
            raise ParameterError(
                f"room.maximum_frequency_hz: waves in the room are computed from 0 to "
                f"{highest_hz:g} Hz, {frequency_hz.max():g} Hz is needed"
            )
        line = np.minimum(frequency_hz / step_hz, highest_hz / step_hz)
        cell = np.floor(line).astype(int)
        weights = interpolation_weights(line - cell)
        result = np.zeros((*values.shape[:-1], line.size), dtype=complex)
        for node in range(STENCIL_NODES):
            result += weights[:, node] * around[..., cell + node + 1]
        result *= np.exp(-2j * np.pi * frequency_hz * middle_s)
        return result

    return interpolated
