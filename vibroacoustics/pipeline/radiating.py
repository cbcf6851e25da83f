"""The housing's radiation: transfer vectors, and what map and sound power make of them."""

from collections.abc import Mapping, Sequence

import xarray as xr

from .. import radiation
from ..base.errors import ParameterError
from ..base.progress import Progress, no_progress
from ..base.vocabulary import check, label_coordinates
from ..levels import sound_field as levels
from ..levels.insertion_loss import airborne_factor
from ..machine.shell import Shell
from ..radiation import SurfaceMotion
from ..radiation.given import Radiation
from ..radiation.pressure import pressure_on_map, pressure_on_surface, wrench_pressure
from ..radiation.receiver_methods import (
    GIVEN,
    MEASURED,
    ReceiverMethod,
    receiver_methods,
    with_methods,
)
from ..radiation.transfer_vectors import kwave_names
from ..results import provenance, storage
from ..study.radiation import RadiationSettings
from ..study.receivers import Receiver
from ..study.study import Study
from .shell import shell_path

_Inputs = tuple[
    Shell,
    Mapping[str, Receiver],
    RadiationSettings,
    radiation.SoundField,
    Sequence[SurfaceMotion],
    tuple[str, ...],
]


def transfer_vectors(
    study: Study, progress: Progress, motions: Sequence[SurfaceMotion] = ()
) -> tuple[xr.Dataset, bool]:
    """Pressure per velocity of the housing and of the motions; from the cache if it is there."""
    inputs = inputs_of(study, motions)
    return storage.cached(
        "transfer-vectors",
        radiation.cache_key_material(*inputs),
        lambda: radiation.transfer_vectors(*inputs, progress),
    )


def inputs_of(study: Study, motions: Sequence[SurfaceMotion]) -> _Inputs:
    """What the transfer vectors of a study follow from."""
    sound_field = radiation.SoundField.of_study(study)
    at_all = study.radiation.kwave_receivers == "all"
    by_kwave = tuple(study.receivers) if at_all else (study.catalogue_receiver,)
    shell, settings = study.machine.shell, study.radiation
    return shell, study.receivers, settings, sound_field, motions, by_kwave


def methods_of(study: Study) -> dict[str, ReceiverMethod]:
    """Method of each microphone and why it is not k-Wave, from the study alone."""
    if study.measured is not None and study.measured.sound is not None:
        return dict.fromkeys(study.receivers, MEASURED)
    _, receivers, settings, *_, by_kwave = inputs_of(study, ())
    return receiver_methods(receivers, settings, kwave_names(receivers, settings, by_kwave))


def radiated_by(
    radiation: Radiation,
    study: Study,
    progress: Progress,
    motions: Sequence[SurfaceMotion],
) -> tuple[xr.Dataset, bool]:
    """Transfer vectors with the method of each microphone, and whether they were cached."""
    radiated, was_cached = radiation(study, progress, motions)
    if "radiation_method" not in radiated.coords:
        radiated = with_methods(radiated, dict.fromkeys(study.receivers, GIVEN))
    return radiated, was_cached


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
        unit_power = levels.unit_sound_power(surface, study.sound_power, area)
        radiated["unit_sound_power_level"] = unit_power
    radiated.attrs = provenance.radiation_attributes(study, radiated, was_cached)
    return check(label_coordinates(radiated))


def sound_field(study: Study, results: xr.Dataset) -> xr.Dataset:
    """Level of the 1x line on the map, sound power of every order; what the study asks for."""
    factor = airborne_factor(study.options, results["order_frequency"])
    velocity = factor * results["velocity_order"].sum("source")
    fields = xr.Dataset()
    if "map_transfer_vector" in results:
        fields = fields.merge(levels.map_level(pressure_on_map(velocity, results)))
    if study.sound_power is not None:
        pressure = pressure_on_surface(velocity, results)
        frequency, surface = results["order_frequency"], results["surface_transfer_vector"]
        power = levels.sound_power_variables(pressure, frequency, study.sound_power, surface)
        fields = fields.merge(power)
    return fields


def line_difference(study: Study, results: xr.Dataset) -> xr.Dataset:
    """1x level with k-Wave's Green's function against the closed form; empty without k-Wave."""
    if "transfer_vector_closed_form" not in results:
        return xr.Dataset()
    first = results.sel(order=1)
    factor = airborne_factor(study.options, results["order_frequency"]).sel(order=1)
    pressure, closed_form = (
        (factor * wrench_pressure(first, name)).sum("source")
        for name in ("transfer_vector", "transfer_vector_closed_form")
    )
    return levels.line_difference(pressure, closed_form)
