"""Transfer vectors that are known: measured ones, or those of a second method."""

from collections.abc import Callable, Sequence

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError
from ..base.progress import Progress
from ..base.vocabulary import RIGID_BODY_DOFS, stamp
from ..study.study import Study
from .patterns import SurfaceMotion
from .receiver_methods import GIVEN, ReceiverMethod, with_methods
from .transfer_vectors import frequencies_hz

Radiation = Callable[[Study, Progress, Sequence[SurfaceMotion]], tuple[xr.Dataset, bool]]
"""Function of a study and the shell's modes to transfer vectors, and whether they were known
already."""


def given_radiation(
    transfer_vector: ArrayLike, frequency_hz: ArrayLike, shell_modes: ArrayLike | None = None
) -> Radiation:
    """Sound pressure per velocity of the housing, as `run` takes it in place of its own radiation.

    Parameters
    ----------
    transfer_vector : complex, shape (receiver, 6, frequency), Pa per m/s along x, y, z and Pa per
        rad/s about x, y, z, at the centre of mass; receivers in the order of the study
    frequency_hz : rising, shape (frequency,), Hz; up to the study's highest frequency. Between two
        of them a cubic spline is laid through the values without delay and growth with frequency,
        T exp(jkr)/(jω): steps of 25 Hz are good to 0.01 dB at 1 m
    shell_modes : complex, shape (receiver, mode, frequency), Pa per m/s of each mode of the shell;
        for studies whose sources drive an elastic shell

    Returns
    -------
    argument `radiation` of `run` and `radiate`

    Raises
    ------
    ParameterError
        Here, shapes or frequencies do not fit each other; in the run, they do not fit the study.

    Examples
    --------
    >>> study = va.load_study("pipelines/copeland_thesis.toml")
    >>> frequency = np.arange(25.0, 2501.0, 25.0)
    >>> vectors = 1e-4j * frequency * np.ones((len(study.receivers), 6, 1))  # made up
    >>> results = va.run(
    ...     study.replace({"operation.speed_rpm": [2900.0]}),
    ...     radiation=va.given_radiation(vectors, frequency))
    >>> results["level_total"].dims
    ('speed', 'option', 'receiver')
    """
    frequency = np.asarray(frequency_hz, dtype=float)
    if frequency.ndim != 1 or frequency.size < 2 or not np.all(np.diff(frequency) > 0.0):
        raise ParameterError("frequency_hz: must be at least two numbers that rise")
    of_housing = _checked("transfer_vector", transfer_vector, frequency)
    if of_housing.shape[1] != len(RIGID_BODY_DOFS):
        raise ParameterError(f"transfer_vector: has {of_housing.shape[1]} motions, must have 6")
    of_modes = None if shell_modes is None else _checked("shell_modes", shell_modes, frequency)

    def radiation(
        study: Study, _: Progress, motions: Sequence[SurfaceMotion] = ()
    ) -> tuple[xr.Dataset, bool]:
        names = [motion.name for motion in motions]
        return _labelled(study, names, frequency, of_housing, of_modes), False

    return radiation


def silent_radiation(study: Study, motions: Sequence[SurfaceMotion]) -> Radiation:
    """Return radiation of no sound in the shape of a study's transfer vectors."""
    frequency, receivers = frequencies_hz(study.radiation), len(study.receivers)
    counts = (len(RIGID_BODY_DOFS), len(motions))
    of_housing, of_modes = (np.zeros((receivers, count, frequency.size)) for count in counts)
    return given_radiation(of_housing, frequency, of_modes)


def radiated_by(
    radiation: Radiation,
    study: Study,
    progress: Progress,
    motions: Sequence[SurfaceMotion],
    method: ReceiverMethod = GIVEN,
) -> tuple[xr.Dataset, bool]:
    """Return transfer vectors with the method of each microphone, and whether they were known.

    Parameters
    ----------
    radiation : gives the transfer vectors
    study : with its microphones
    progress : called with the advance
    motions : modes of the shell
    method : method of microphones for which the transfer vectors name none
    """
    radiated, was_known = radiation(study, progress, motions)
    if "radiation_method" not in radiated.coords:
        radiated = with_methods(radiated, dict.fromkeys(study.receivers, method))
    return radiated, was_known


def _checked(name: str, values: ArrayLike, frequency_hz: Array) -> ComplexArray:
    array = np.asarray(values, dtype=complex)
    if array.ndim != 3 or array.shape[2] != frequency_hz.size or not np.all(np.isfinite(array)):
        raise ParameterError(
            f"{name}: shape {array.shape}: must be finite, (receiver, motion, frequency) with "
            f"{frequency_hz.size} frequencies"
        )
    return array


def _labelled(
    study: Study,
    modes: list[str],
    frequency_hz: Array,
    of_housing: ComplexArray,
    of_modes: ComplexArray | None,
) -> xr.Dataset:
    receivers = list(study.receivers)
    for name, values in (("transfer_vector", of_housing), ("shell_modes", of_modes)):
        if values is not None and len(values) != len(receivers):
            raise ParameterError(
                f"{name}: has {len(values)} receivers; the study has {', '.join(receivers)}"
            )
    if modes and (of_modes is None or of_modes.shape[1] != len(modes)):
        count = 0 if of_modes is None else of_modes.shape[1]
        raise ParameterError(f"shell_modes: has {count} modes; the shell has {len(modes)}")
    highest = study.radiation.maximum_frequency_hz
    if frequency_hz[-1] < highest * (1.0 - 1e-9):
        raise ParameterError(
            f"frequency_hz: ends at {frequency_hz[-1]:g} Hz; radiation.maximum_frequency_hz is "
            f"{highest:g} Hz"
        )
    floor_m = study.machine.shell.floor_z_m
    positions = [(r.x_m, r.y_m, r.height_m + floor_m) for r in study.receivers.values()]
    coords = {
        "receiver": receivers,
        "frequency": frequency_hz,
        "distance": ("receiver", np.linalg.norm(positions, axis=1)),
    }
    vectors = {
        "transfer_vector": stamp(
            "transfer_vector", of_housing, {**coords, "dof": list(RIGID_BODY_DOFS)}
        )
    }
    if modes and of_modes is not None:
        vectors["pattern_transfer_vector"] = stamp(
            "pattern_transfer_vector", of_modes, {**coords, "pattern": modes}
        )
    return xr.Dataset(vectors, attrs={"method": "given"})
