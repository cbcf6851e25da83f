"""Impulse responses from the machine of a study to the listeners in its room."""

import xarray as xr

from ..base.errors import ParameterError
from ..base.progress import Progress, no_progress
from ..sound.room_paths import labelled_responses
from ..stages import room
from ..study.study import Study


def impulse_responses(study: Study, progress: Progress = no_progress) -> xr.DataArray:
    """Sound pressure at the listeners in the room per acceleration of the shell, over time.

    At 48 kHz, per sample: the convolution of a sampled acceleration of a rigid motion with it is
    the pressure that this motion makes. To the crossover frequency it is by waves, above it by
    direct sound and decaying noise of a fixed seed.

    Parameters
    ----------
    study : with its table of the room
    progress : told of the advance

    Returns
    -------
    `room_impulse_response` (listener, dof, time), Pa/(m/s²) and, of rotations about the centre of
    mass, Pa/(rad/s²)

    Raises
    ------
    ParameterError
        The study has no room, or the machine cannot stand in it.

    Examples
    --------
    >>> study = va.load_study("pipelines/kitchen.toml")
    >>> coarse = study.replace({"room.maximum_frequency_hz": 250.0})
    >>> responses = va.impulse_responses(coarse)
    >>> at_table = responses.sel(listener="table", dof="tz")
    """
    settings = study.room
    if settings is None:
        raise ParameterError("room: the study has none; impulse responses are those of a room")
    vectors, _ = room.vectors_of(study, settings, (), progress)
    return labelled_responses(settings, study.machine.shell, vectors)
