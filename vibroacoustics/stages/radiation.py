"""The housing's radiation: transfer vectors, from the cache where they are there."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
import xarray as xr

from .. import radiation
from ..base.progress import Progress
from ..base.registry import register
from ..machine.shell import Shell
from ..radiation import SurfaceMotion
from ..radiation.cost import cost_of
from ..radiation.given import Radiation, given_radiation
from ..radiation.receiver_methods import (
    GIVEN,
    MEASURED,
    ReceiverMethod,
    receiver_methods,
    with_methods,
)
from ..radiation.transfer_vectors import frequencies_hz, kwave_names, method_of, task_of
from ..results import storage
from ..results.storage import is_cached
from ..study.radiation import RadiationSettings
from ..study.receivers import Receiver
from ..study.study import Study
from ..transfer.force_sound import ForceSound
from ..transfer.path import ShellPath
from .chain import Chain
from .stage import Given, Stage, Trial, advanced

_CACHE: Final = "transfer-vectors"
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
    """Compute pressure per velocity of housing and wall motions, or read it from the cache."""
    inputs = inputs_of(study, motions)
    return storage.cached(
        _CACHE,
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


@dataclass(frozen=True)
class Radiated:
    """Where the transfer vectors come from.

    Attributes
    ----------
    attributes : of method, grids and errors
    was_cached : whether they were read, not computed
    """

    attributes: Mapping[str, object]
    was_cached: bool


@register
class HousingRadiation(Stage):
    """Pressure per velocity of the housing and of the modes of its shell."""

    name = "radiation"
    reads = (ShellPath, ForceSound)
    gives = (
        Radiated, "transfer_vector", "transfer_vector_error", "transfer_vector_closed_form",
        "pattern_transfer_vector", "pattern_transfer_vector_error", "green_difference",
        "map_transfer_vector", "surface_transfer_vector", "directivity_transfer_vector",
    )  # fmt: skip

    def run(self, chain: Chain) -> Given:
        path, measured = chain.get(ShellPath), chain.get(ForceSound)
        source = chain.radiation if measured is None else _of_forces(measured)
        modes = () if path is None else path.modes
        vectors, was_cached = radiated_by(source, chain.study, chain.progress, modes)
        return Given(vectors, (Radiated(vectors.attrs, was_cached),))

    def tried(self, chain: Chain, study: Study) -> Trial:
        """Take cached vectors, else silence of the same shape, with which levels cost as much."""
        path = chain.get(ShellPath)
        if chain.get(ForceSound) is not None:
            return Trial(advanced(chain, self))
        inputs = inputs_of(study, () if path is None else path.modes)
        if is_cached(_CACHE, radiation.cache_key_material(*inputs)):
            return Trial(advanced(replace(chain, radiation=transfer_vectors), self))
        task = task_of(*inputs)
        costs = tuple(cost_of(method_of(inputs[0], task), task))
        return Trial(advanced(replace(chain, radiation=_silence(study, path)), self), costs)


def methods_of(study: Study) -> dict[str, ReceiverMethod]:
    """Return the method of each microphone and why it is not k-Wave, from the study alone."""
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
    """Return transfer vectors with the method of each microphone, and whether they were cached."""
    radiated, was_cached = radiation(study, progress, motions)
    if "radiation_method" not in radiated.coords:
        radiated = with_methods(radiated, dict.fromkeys(study.receivers, GIVEN))
    return radiated, was_cached


def _of_forces(sound: ForceSound) -> Radiation:
    """Transfer vectors of the nominal machine from measured forces, for tables and figures."""
    given = given_radiation(sound(sound.frequency_hz), sound.frequency_hz)

    def measured(
        study: Study, progress: Progress, motions: Sequence[SurfaceMotion]
    ) -> tuple[xr.Dataset, bool]:
        vectors, was_cached = given(study, progress, motions)
        return with_methods(vectors, dict.fromkeys(study.receivers, MEASURED)), was_cached

    return measured


def _silence(study: Study, path: ShellPath | None) -> Radiation:
    frequency, receivers = frequencies_hz(study.radiation), len(study.receivers)
    modes = 0 if path is None else len(path.modes)
    of_housing, of_modes = (np.zeros((receivers, n, frequency.size)) for n in (6, modes))
    return given_radiation(of_housing, frequency, None if path is None else of_modes)
