"""Levels around the machine in the loudest third octaves."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Final

import xarray as xr

from ..base.arrays import Array
from ..base.registry import register
from ..levels.bands import Band
from ..levels.polar import (
    frequencies_of,
    loudest_bands,
    points_around,
    polar_variables,
    shift_to_medians,
)
from ..radiation.cost import Cost
from ..radiation.field_points import key_at, vectors_at, within
from ..radiation.pressure import pressure_per_shell_velocity
from ..radiation.receiver_methods import machine_side
from ..radiation.scene import position_m
from ..radiation.transfer_vectors import pressure_per_velocity
from ..results.storage import cached
from ..study.study import Study
from ..transfer.contributions import Transmission
from ..transfer.observers import Observers
from ..transfer.path import ShellPath
from .chain import Chain
from .radiation import modes_of
from .shown import SHOWN, Shown
from .stage import Given, Stage, Trial

_CACHE: Final = "directivity-vectors"
_COST_S: Final = (0.3, 4.0)
"""Processor time, cached and computed."""


@register
class Directivity(Stage):
    """Levels in a horizontal and a vertical plane through the centre of mass.

    Where the machine radiates as a body of revolution whose radiation the run computes.
    """

    name = "directivity"
    reads = (*SHOWN, ShellPath, "sources_band_level")
    gives = ("polar_*",)

    def applies(self, study: Study) -> bool:
        return study.radiation.revolution and study.baseline is None

    def run(self, chain: Chain) -> Given:
        study, path = chain.study, chain[Transmission]
        method = chain.results["radiation_method"].sel(receiver=study.catalogue_receiver).item()
        if not method.startswith(machine_side(study.radiation)):
            return Given()
        shown = Shown.of(chain)
        received = shown.received(path)
        bands = loudest_bands(received[0], shown.receiver, study.radiation.maximum_frequency_hz)
        position = position_m(
            study.machine.shell, study.receivers[study.catalogue_receiver]
        ).tolist()
        points, frequency_hz = points_around(position), frequencies_of(bands, received)
        inputs = study, modes_of(chain), points, frequency_hz
        vectors, _ = cached(_CACHE, key_at(*inputs), lambda: vectors_at(*inputs))
        around = replace(path, microphones=_observers(vectors, bands, path.shell is not None))
        sound = shown.received(around, shown.receiver)
        names = vectors["receiver"].values.tolist()
        shift: Array | float = 0.0
        if shown.gain:  # of a sample
            case = {"speed": shown.speed_rpm, "option": list(shown.options)}
            shift = shift_to_medians(chain.results.sel(case), received, bands, shown.receiver)
        return Given(polar_variables(shown.options, bands, position, names, sound, shift))

    def tried(self, chain: Chain, study: Study) -> Trial:
        how = "not measured: up to 30 frequencies of boundary elements"
        return Trial(chain, (Cost(self.name, *_COST_S, how),))


def _observers(vectors: xr.Dataset, bands: Sequence[Band], bends: bool) -> Observers:
    """Observe the pressure at the points, in some bands."""
    edges = [(band.lower_hz, band.upper_hz) for band in bands]
    rigid = within(pressure_per_velocity(vectors["transfer_vector"]), edges)
    return Observers(rigid, within(pressure_per_shell_velocity(vectors), edges) if bends else None)
