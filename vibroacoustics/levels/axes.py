"""Axes of the levels of a study."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..machine.source import CaseKey
from ..study.study import Study
from .bands import Band
from .by_source import filled_thirds


@dataclass(frozen=True)
class LevelAxes:
    """Names along the axes of the levels.

    Attributes
    ----------
    speeds, options, sources, receivers : in the order of the arrays
    bands : third octaves
    measured_orders : orders that the baseline has at any microphone
    spreading : mean square of unmodelled noise relative to that at the published microphone, by
        microphone, shape (band of `UNMODELLED_BANDS`,); 1 where a microphone has none
    """

    speeds: Sequence[float]
    options: Sequence[str]
    sources: Sequence[str]
    receivers: Sequence[str]
    bands: Sequence[Band]
    measured_orders: Sequence[float] = ()
    spreading: Mapping[str, Array] = field(default_factory=dict)

    @classmethod
    def of(
        cls,
        study: Study,
        sources: Sequence[str],
        results: xr.Dataset,
        spreading: Mapping[str, Array],
    ) -> "LevelAxes":
        """Return the axes of a study's results with the sources and the spreading."""
        return cls(
            list(study.operation.speed_rpm),
            list(study.options),
            sources,
            [str(name) for name in results["receiver"].values],
            filled_thirds(study.radiation.maximum_frequency_hz),
            () if study.baseline is None else study.baseline.all_orders,
            spreading,
        )

    def spread(self, remaining: Array) -> Array:
        """Spread noise at the published microphone to all, shape (..., receiver, band), Pa².

        Parameters
        ----------
        remaining : in `UNMODELLED_BANDS`, shape (..., band), Pa²
        """
        alike = np.ones(remaining.shape[-1])
        factor = np.array([self.spreading.get(name, alike) for name in self.receivers])
        return np.asarray(remaining[..., None, :] * factor)

    def gathered(self, sound: Mapping[CaseKey, object], part: str) -> Array:
        """A part of the sound of all cases, shape (speed, option, ...)."""
        return np.array([[getattr(sound[s, o], part) for o in self.options] for s in self.speeds])

    @property
    def by_receiver(self) -> dict[str, list[float] | list[str]]:
        """Coordinates of levels of all sources together."""
        return {
            "speed": list(self.speeds),
            "option": list(self.options),
            "receiver": list(self.receivers),
        }

    @property
    def by_source(self) -> dict[str, list[float] | list[str]]:
        """Coordinates of levels of each source."""
        return {**self.by_receiver, "sound_source": list(self.sources)}
