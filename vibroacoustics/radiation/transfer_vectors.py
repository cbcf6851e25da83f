"""Sound pressure at the microphones per unit rigid-body velocity of the shell, labelled."""

import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ..constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from ..parameters.radiation import RadiationSettings
from ..parameters.receivers import Receiver
from ..parameters.shell import Shell
from ..schema import RIGID_BODY_DOFS, check, stamp
from . import room_grid
from .arrays import Array, ComplexArray, Progress, no_progress
from .bodies import Cylinder
from .exact import box_green
from .interpolation import interpolate
from .join import join
from .kwave import check_receiver, green_difference_db, kwave_green, kwave_version
from .near_field import NearField
from .patterns import rigid_body


def transfer_vectors(
    shell: Shell,
    receivers: Mapping[str, Receiver],
    settings: RadiationSettings,
    progress: Progress = no_progress,
) -> xr.Dataset:
    """Complex pressure at each receiver per unit complex-peak velocity of each degree of freedom.

    Returns
    -------
    Dataset
        `transfer_vector` (receiver, dof, frequency) from the near field and k-Wave;
        `transfer_vector_closed_form`, the same near field with the closed-form Green's function;
        `green_difference` (receiver, frequency), the level difference of the two Green's functions
        where it is largest on the box, dB; coordinate `distance` (receiver) from the origin, m.

    Raises
    ------
    ParameterError
        A receiver lies in or too close to the shell, or a grid needs more memory than is available.
    SolverError
        A field is not finite, not plausible or has not died down.
    """
    frequency = frequencies_hz(settings)
    floor = floor_z_m(shell, settings)
    near = NearField(
        cylinder(shell), settings.near_field_spacing_m, settings.maximum_frequency_hz, floor
    )
    positions = {name: position_m(shell, receiver) for name, receiver in receivers.items()}
    for name, position in positions.items():
        check_receiver(name, position, near.box, settings.room_spacing_m, floor, frequency.size)
    fields = [near.radiate(rigid_body(dof), frequency, progress) for dof in RIGID_BODY_DOFS]

    shape = (len(positions), len(fields), frequency.size)
    simulated, closed_form = np.zeros(shape, dtype=complex), np.zeros(shape, dtype=complex)
    difference = np.zeros((len(positions), frequency.size))
    for row, (name, position) in enumerate(positions.items()):
        expected = box_green(near.box, position, frequency, floor)
        green = kwave_green(
            near.box,
            position,
            frequency,
            settings.maximum_frequency_hz,
            settings.room_spacing_m,
            floor,
            name,
            progress,
        )
        difference[row] = green_difference_db(green, expected)
        simulated[row] = [join(near.box, field, green) for field in fields]
        closed_form[row] = [join(near.box, field, expected) for field in fields]
    return _labelled(positions, frequency, simulated, closed_form, difference).assign_attrs(
        solver=f"cut cells, k-wave-python {kwave_version()}",
        surroundings=settings.surroundings,
        near_field_cells=" x ".join(map(str, near.grid.shape)),
        near_field_spacing_m=near.grid.spacing_m,
        near_field_time_step_s=near.grid.time_step_s,
        room_time_step_courant_number=room_grid.COURANT_NUMBER,
        neglected="echoes of the room, the floor excepted, scattered again by the shell",
    )


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
    shell: Shell, receivers: Mapping[str, Receiver], settings: RadiationSettings
) -> dict[str, Any]:
    """Everything that shapes the transfer vectors, as plain data to be hashed."""
    return {
        "shell": shell.model_dump(),
        "receivers": {name: receiver.model_dump() for name, receiver in receivers.items()},
        "settings": settings.model_dump(),
        "speed_of_sound_m_per_s": SPEED_OF_SOUND_M_PER_S,
        "air_density_kg_per_m3": AIR_DENSITY_KG_PER_M3,
        "solver": _source_hash(),
        "k_wave": kwave_version(),
    }


def _source_hash() -> str:
    """Hash of this package's source: a change of the solver never meets an old cache."""
    source = b"".join(file.read_bytes() for file in sorted(Path(__file__).parent.glob("*.py")))
    return hashlib.sha256(source).hexdigest()


def frequencies_hz(settings: RadiationSettings) -> Array:
    """Tabulated frequencies: whole multiples of the step, the last one at or above the maximum."""
    step = settings.frequency_step_hz
    count = int(np.ceil(settings.maximum_frequency_hz / step - 1e-9))
    frequencies: Array = step * np.arange(1.0, count + 1.0)
    return frequencies


def cylinder(shell: Shell) -> Cylinder:
    """The shell about its centre of mass."""
    bottom = -shell.centre_of_mass_height_m
    return Cylinder(shell.radius_m, bottom, bottom + shell.height_m)


def floor_z_m(shell: Shell, settings: RadiationSettings) -> float | None:
    """Vertical coordinate of the hard floor; none in free field."""
    return shell.floor_z_m if settings.surroundings == "hard-floor" else None


def position_m(shell: Shell, receiver: Receiver) -> Array:
    """Receiver (x, y, z) about the centre of mass; its height counts from the floor's level."""
    return np.array([receiver.x_m, receiver.y_m, shell.floor_z_m + receiver.height_m])


def _labelled(
    positions: Mapping[str, Array],
    frequency: Array,
    simulated: ComplexArray,
    closed_form: ComplexArray,
    difference: Array,
) -> xr.Dataset:
    distances = [float(np.linalg.norm(position)) for position in positions.values()]
    by_receiver = {"receiver": list(positions), "frequency": frequency}
    coords = {**by_receiver, "dof": list(RIGID_BODY_DOFS)}
    return check(
        xr.Dataset(
            {
                "transfer_vector": stamp("transfer_vector", simulated, coords),
                "transfer_vector_closed_form": stamp(
                    "transfer_vector_closed_form", closed_form, coords
                ),
                "green_difference": stamp("green_difference", difference, by_receiver),
            },
            coords={"distance": ("receiver", distances)},
        )
    )
