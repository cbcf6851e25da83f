"""The job of the housing's radiation alone."""

import xarray as xr

from ..base.errors import ParameterError
from ..base.progress import Progress, no_progress
from ..base.vocabulary import check, label_coordinates
from ..levels import sound_field as levels
from ..radiation.given import Radiation, radiated_by
from ..results import provenance
from ..stages.radiation import transfer_vectors
from ..stages.shell import shell_path
from ..study.study import Study


def radiate(
    study: Study, progress: Progress = no_progress, radiation: Radiation = transfer_vectors
) -> xr.Dataset:
    """Only the radiation of the housing: transfer vectors, from the cache if they are there.

    Parameters
    ----------
    study : from `load_study`
    progress : called with the advance of long work
    radiation : gives the transfer vectors: the package's, measured ones or a second method's

    Raises
    ------
    ParameterError, SolverError, StorageError
        An input is out of range, a computation failed, a file cannot be read.

    Examples
    --------
    Transfer vectors of your own (made up here) take the place of the computation:

    >>> study = va.load_study("pipelines/copeland_thesis.toml")
    >>> frequency = np.arange(25.0, 2501.0, 25.0)
    >>> vectors = 1e-4j * frequency * np.ones((len(study.receivers), 6, 1))
    >>> radiated = va.radiate(study, radiation=va.given_radiation(vectors, frequency))
    >>> radiated["transfer_vector"].dims
    ('receiver', 'dof', 'frequency')
    """
    try:
        path = shell_path(study)
        motions = () if path is None else path.modes
        radiated, was_cached = radiated_by(radiation, study, progress, motions)
    except ParameterError as error:
        raise ParameterError(f"{study.source_file}: {error}") from None
    if study.sound_power is not None:
        surface = radiated["surface_transfer_vector"]
        area = levels.measurement_surface_m2(study.sound_power, surface)
        power = levels.unit_sound_power(surface, study.sound_power, area)
        radiated["unit_sound_power_level"] = power
    radiated.attrs = provenance.radiation_attributes(study, radiated.attrs, was_cached)
    return check(label_coordinates(radiated))
