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
from ..radiation.cost import cost_of
from ..radiation.given import Radiation, given_radiation
from ..radiation.transfer_vectors import frequencies_hz, method_of, task_of
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
    Sequence[radiation.SurfaceMotion],
    tuple[str, ...],
]


def transfer_vectors(
    study: Study, progress: Progress, motions: Sequence[radiation.SurfaceMotion] = ()
) -> tuple[xr.Dataset, bool]:
    """Compute pressure per velocity of housing and wall motions, or read it from the cache."""
    inputs = inputs_of(study, motions)
    return storage.cached(
        _CACHE,
        radiation.cache_key_material(*inputs),
        lambda: radiation.transfer_vectors(*inputs, progress),
    )


def inputs_of(study: Study, motions: Sequence[radiation.SurfaceMotion]) -> _Inputs:
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
        vectors, was_cached = source(chain.study, chain.progress, modes)
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


def _of_forces(sound: ForceSound) -> Radiation:
    """Transfer vectors of the nominal machine from measured forces, for tables and figures."""
    return given_radiation(sound(sound.frequency_hz), sound.frequency_hz)


def _silence(study: Study, path: ShellPath | None) -> Radiation:
    frequency, receivers = frequencies_hz(study.radiation), len(study.receivers)
    modes = 0 if path is None else len(path.modes)
    of_housing, of_modes = (np.zeros((receivers, n, frequency.size)) for n in (6, modes))
    return given_radiation(of_housing, frequency, None if path is None else of_modes)
