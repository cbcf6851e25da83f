"""Statistics of the samples that go on: values, intervals and probabilities of change, labelled."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr

from ..base.arrays import Array, RoundedArray
from ..base.quantiles import stepped_quantiles, weighted_quantiles
from ..base.vocabulary import (
    HIGH,
    LOW,
    MEAN,
    MEDIAN_STEP,
    REFERENCE_OPTION,
    SUFFIXES,
    VARIABLES,
    WEIGHTINGS,
    stamp,
    stamped,
)
from ..levels.changes import AMPLITUDES, FORCES, JUDGED, TOTAL, changes_of
from ..levels.sample_levels import Levels
from ..results.estimates import QUANTILES
from ..sound.tone_spectra import tone_probabilities
from ..study.sampling import Sample
from ..study.study import Study
from .choices import choice_information
from .every_sample import sampled_values
from .evidence import PAIRS

_KEPT: Final = ("source_level", "level_modelled", "level_total", "level_unmodelled")
"""Levels that are kept by sample, the A-weighted ones."""
_RATED: Final = ("decisive_audibility", "rating_level")
"""Kept by sample where the study has them."""
_LARGE: Final = frozenset({
    "order_level", "order_change", "source_band_level", "noise_band_level", "unmodelled_band_level",
    "total_band_level", "sources_band_level", "tone_level", "tone_excess",
    "tone_audibility",
})  # fmt: skip
"""Kept in single precision, 1e-5 dB, until their statistics are computed."""

_SHARES: Final = ("limit_probability",)
"""1 or 0 in a sample; their weighted mean is a probability."""


class SampleValues(NamedTuple):
    """Levels, forces and weights of a sample.

    Attributes
    ----------
    levels : by variable, the first axis is the pair of a discrepancy and an unmodelled level
    forces : by variable, shape (speed, option, ...)
    weight : weights of the pairs, shape (prior, pair)
    mutual : A-weighted mean squares of pairs of sources at the published microphone without
        discrepancy, shape (speed, option, source, source, gain band), Pa²
    """

    levels: dict[str, RoundedArray]
    forces: Mapping[str, Array]
    weight: Array
    mutual: RoundedArray

    @classmethod
    def of(
        cls, levels: Levels, forces: Mapping[str, Array], weight: Array, mutual: Array
    ) -> "SampleValues":
        """Return the values with large ones in single precision; parameters as the attributes."""
        single = {name: np.asarray(levels[name], "f4") for name in _LARGE & levels.keys()}
        return cls({**levels, **single}, forces, weight, np.asarray(mutual, "f4"))


@dataclass(frozen=True)
class Weighted:
    """Rows with their weights: pairs of samples, or samples.

    Attributes
    ----------
    weight : weights that sum to one, shape (row,)
    """

    weight: Array

    def statistics(self, name: str, values: Array, coords: Mapping[str, Any]) -> xr.Dataset:
        """Label the value of a variable and the ends of its interval.

        Parameters
        ----------
        name : in the vocabulary, which says whether the value is a median or a mean
        values : shape (row, ...)
        coords : coordinates of its dimensions
        """
        is_stepped = VARIABLES[name].statistic == MEDIAN_STEP
        quantiles = stepped_quantiles if is_stepped else weighted_quantiles
        low, middle, high = quantiles(values, self.weight, (QUANTILES[0], 0.5, QUANTILES[1]))
        if VARIABLES[name].statistic == MEAN:
            counting = self.weight > 0.0
            middle = np.tensordot(self.weight[counting], values[counting], axes=1)
        parts = {
            name: middle, f"{name}{SUFFIXES[LOW]}": low, f"{name}{SUFFIXES[HIGH]}": high,
        }  # fmt: skip
        labels = {dim: coords[dim] for dim in VARIABLES[name].dims}
        return xr.Dataset(
            {part_name: stamp(part_name, part, labels) for part_name, part in parts.items()}
        )


def sample_variables(
    study: Study,
    samples: Sequence[Sample],
    values: Sequence[SampleValues],
    prior_names: Sequence[str],
    nominal: xr.Dataset,
) -> tuple[xr.Dataset, xr.Dataset]:
    """Label the statistics of the samples that go on, and what is kept of each.

    Parameters
    ----------
    study : options and smallest changes that could be measured
    samples : that go on
    values : values of them, each with `PAIRS` pairs
    prior_names : names of the priors of the unmodelled noise, that of the values first
    nominal : nominal values with their coordinates
    """
    weight = np.concatenate([sample.weight for sample in values], axis=1)
    weight = weight / weight.sum(axis=1, keepdims=True)
    levels = {
        name: np.concatenate([sample.levels[name] for sample in values])
        for name in values[0].levels
    }
    forces = {
        name: np.array([sample.forces[name] for sample in values]) for name in values[0].forces
    }
    of_pairs = Weighted(weight[0])
    coords = {str(name): array.values for name, array in nominal.coords.items()}
    parts = [
        of_pairs.statistics(name, array, coords)
        for name, array in levels.items()
        if name not in _SHARES
    ]
    parts += [
        of_pairs.statistics(name, np.repeat(array, PAIRS, axis=0), coords)
        for name, array in forces.items()
    ]
    parts += _changes(study, levels, forces, of_pairs, coords)
    kept = _by_sample(levels, forces, weight, {**coords, "prior": list(prior_names)})
    kept = kept.merge(_repeated(sampled_values(study.ranges, samples), kept))
    return xr.merge(parts), kept.merge(choice_information(study, kept, PAIRS))


def _changes(
    study: Study,
    levels: Levels,
    forces: Mapping[str, Array],
    of_pairs: Weighted,
    coords: Mapping[str, Any],
) -> list[xr.Dataset]:
    """Changes of forces at 1x; probabilities of measurable changes and of prominent tones."""
    reference = list(coords["option"]).index(REFERENCE_OPTION)
    changes = changes_of(
        np.repeat(_first_order(forces), PAIRS, axis=1),
        levels[TOTAL],
        levels["order_level"][..., 1, WEIGHTINGS.index("Z")],
        coords["order_frequency"][:, 1],
        reference,
        study.scoring.measurable,
    )
    statistics = [
        of_pairs.statistics(f"{name}_change_1x", change, coords)
        for name, change in zip(FORCES, changes.force_db, strict=True)
    ]
    labels = {**coords, "judged_quantity": list(JUDGED)}
    chances = {
        "increase_probability": np.tensordot(of_pairs.weight, changes.increased, axes=1),
        "decrease_probability": np.tensordot(of_pairs.weight, changes.decreased, axes=1),
    }
    shares = tone_probabilities(levels["tone_excess"]) | {
        name: levels[name] for name in _SHARES if name in levels
    }
    chances |= {
        name: np.tensordot(of_pairs.weight, values, axes=1) for name, values in shares.items()
    }
    return [*statistics, stamped(chances, labels)]


def _first_order(forces: Mapping[str, Array]) -> Array:
    """Amplitudes of `FORCES` at 1x, shape (force, sample, speed, option)."""
    return np.stack([forces[name][..., 1] for name in AMPLITUDES])


def _by_sample(
    levels: Levels, forces: Mapping[str, Array], weight: Array, coords: Mapping[str, Any]
) -> xr.Dataset:
    """Levels and forces at 1x that are kept by sample."""
    a = WEIGHTINGS.index("A")
    kept = {
        f"{name}_by_sample": levels[name][..., a] if name == "level_modelled" else levels[name]
        for name in (*_KEPT, *(name for name in _RATED if name in levels))
    }
    repeated = np.repeat(_first_order(forces), PAIRS, axis=1)
    kept |= {f"{name}_1x_by_sample": array for name, array in zip(FORCES, repeated, strict=True)}
    rows = np.arange(1, weight.shape[1] + 1)
    return stamped({**kept, "sample_weight": weight}, {**coords, "sample": rows})


def _repeated(of_samples: xr.Dataset, kept: xr.Dataset) -> xr.Dataset:
    """Values of samples for each of their pairs."""
    numbers = np.repeat(np.arange(of_samples.sizes["sample"]), PAIRS)
    return of_samples.isel(sample=numbers).assign_coords(sample=kept["sample"])
