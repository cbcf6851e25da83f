"""The housing's radiation: transfer vectors, from the cache where they are there."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Final

import xarray as xr

from .. import radiation
from ..base.plain_bytes import canonical_json
from ..base.progress import Progress
from ..base.registry import register
from ..radiation import SurfaceMotion
from ..radiation.cost import Cost, cost_of
from ..radiation.given import given_radiation, radiated_by, silent_radiation
from ..radiation.of_study import Inputs, inputs_of
from ..radiation.receiver_methods import GIVEN, MEASURED
from ..radiation.transfer_vectors import method_of, task_of
from ..results.storage import cached, is_cached
from ..study.study import Study
from ..transfer.force_sound import ForceSound
from ..transfer.path import ShellPath
from .chain import Chain
from .stage import Given, Stage, Trial, advanced

_CACHE: Final = "transfer-vectors"


def transfer_vectors(
    study: Study, progress: Progress, motions: Sequence[SurfaceMotion] = ()
) -> tuple[xr.Dataset, bool]:
    """Compute pressure per velocity of housing and wall motions, or read it from the cache."""
    inputs = inputs_of(study, motions)
    key = radiation.cache_key_material(*inputs)
    computed = partial(radiation.transfer_vectors, *inputs, progress)
    return cached(_CACHE, key, computed, study.title)


@dataclass
class KeptRadiation:
    """Transfer vectors that are kept in memory, so that they go with work to other computers."""

    _known: dict[str, xr.Dataset] = field(default_factory=dict, repr=False)

    def __call__(
        self, study: Study, progress: Progress, motions: Sequence[SurfaceMotion] = ()
    ) -> tuple[xr.Dataset, bool]:
        """Return transfer vectors, and whether they were known; see `transfer_vectors`."""
        key = canonical_json(radiation.cache_key_material(*inputs_of(study, motions)))
        if key in self._known:
            return self._known[key].copy(), True
        self._known[key], was_cached = transfer_vectors(study, progress, motions)
        return self._known[key].copy(), was_cached


@dataclass(frozen=True)
class Radiated:
    """Origin of the transfer vectors.

    Attributes
    ----------
    attributes : attributes of method, grids and errors
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
        Radiated, "transfer_vector*", "pattern_transfer_vector*", "green_difference",
        "map_transfer_vector", "surface_transfer_vector", "directivity_transfer_vector",
    )  # fmt: skip

    def run(self, chain: Chain) -> Given:
        source, method, measured = chain.radiation, GIVEN, chain.get(ForceSound)
        if measured is not None:
            frequency_hz, method = measured.frequency_hz, MEASURED
            source = given_radiation(measured(frequency_hz), frequency_hz)
        modes = modes_of(chain)
        vectors, was_cached = radiated_by(source, chain.study, chain.progress, modes, method)
        return Given(vectors, (Radiated(vectors.attrs, was_cached),))

    def tried(self, chain: Chain, study: Study) -> Trial:
        """Take cached vectors, else silence of the same shape, with which levels cost as much."""
        if chain.get(ForceSound) is not None:
            return Trial(advanced(chain, self))
        inputs = inputs_of(study, modes_of(chain))
        if is_cached(_CACHE, radiation.cache_key_material(*inputs)):
            return Trial(advanced(replace(chain, radiation=transfer_vectors), self))
        silence = silent_radiation(study, modes_of(chain))
        return Trial(advanced(replace(chain, radiation=silence), self), radiation_costs(inputs))


def radiation_costs(inputs: Inputs) -> tuple[Cost, ...]:
    """Estimate what transfer vectors cost that are not in the cache."""
    task = task_of(*inputs)
    return tuple(cost_of(method_of(inputs[0], task), task))


def modes_of(chain: Chain) -> Sequence[SurfaceMotion]:
    """Return the modes of the shell, where a source drives it."""
    path = chain.get(ShellPath)
    return () if path is None else path.modes
