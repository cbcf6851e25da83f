"""Spreading of unmodelled noise from the machine to the microphones of a study."""

from typing import Final

import numpy as np

from ..base.arrays import Array
from ..machine.shell import Shell
from ..study.study import Study
from .exact import green
from .outdoors.green import outdoors_of
from .scene import position_m, room_walls

_PER_BAND: Final = 16
"""Frequencies in a third octave, evenly over its logarithm."""
_HALF_BAND_DECADES: Final = 0.05
_HEIGHTS: Final = (1.0 / 6.0, 0.5, 5.0 / 6.0)
"""Shares of the shell's height at which incoherent sources are."""


def spreading_of(study: Study, middle_hz: Array) -> dict[str, Array]:
    """Compute the mean square of unmodelled noise relative to that at the published microphone.

    Over a hard floor alone the noise spreads with the distance from the foot of the machine, in
    free field from its centre. Before walls, over ground and behind a barrier it is the mean of
    |G|² over the third octave and over twelve incoherent points on the shell: a point alone would
    have deep dips that a machine has not.

    Parameters
    ----------
    study : microphones and surroundings
    middle_hz : midband frequencies of third octaves, shape (band,), Hz

    Returns
    -------
    by microphone, shape (band,)
    """
    names = list(study.receivers)
    shell = study.machine.shell
    points = np.array([position_m(shell, receiver) for receiver in study.receivers.values()])
    square = _mean_square(study, points, middle_hz)
    relative = square / square[:, [names.index(study.catalogue_receiver)]]
    return dict(zip(names, relative.T, strict=True))


def _mean_square(study: Study, points: Array, middle_hz: Array) -> Array:
    """Compute the means of |G|² over sources and bands, shape (band, point), 1/m²."""
    shell, surroundings = study.machine.shell, study.radiation.surroundings
    if not surroundings.walls and not surroundings.is_outdoors:
        foot = np.array([0.0, 0.0, shell.floor_z_m if surroundings.floor else 0.0])
        square = 1.0 / np.sum((points - foot) ** 2, axis=1)
        return np.repeat(square[None], len(middle_hz), axis=0)
    edges = np.logspace(-_HALF_BAND_DECADES, _HALF_BAND_DECADES, 2 * _PER_BAND + 1)
    hertz = np.outer(middle_hz, edges[1::2]).ravel()
    sources = _on_shell(shell)
    walls, outdoors = room_walls(shell, study.radiation), outdoors_of(shell, surroundings)
    if outdoors is None:
        fields = np.array([green(points, source, hertz, walls) for source in sources])
        square = np.mean(np.abs(fields) ** 2, axis=0)
    else:
        upright = [wall for wall in walls if wall.axis != 2]
        rows = outdoors.rows(sources, points, hertz, upright)
        square = np.array([np.mean(np.abs(row) ** 2, axis=1) for row in rows])
    return np.asarray(square.reshape(len(middle_hz), _PER_BAND, -1).mean(axis=1))


def _on_shell(shell: Shell) -> Array:
    """Place points on the shell, at three heights on four sides, shape (point, 3), m."""
    profile = shell.profile
    sides = profile.radius_m * np.array([[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]])
    return np.array(
        [
            [x, y, profile.bottom_z_m + share * profile.height_m]
            for share in _HEIGHTS
            for x, y in sides.tolist()
        ]
    )
