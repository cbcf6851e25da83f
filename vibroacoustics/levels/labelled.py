"""Levels of a study at the receivers: by source, of all modelled sources, of the whole machine."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import mean_square_level, sound_pressure_level
from ..base.vocabulary import (
    REFERENCE_OPTION,
    WEIGHTINGS,
    check,
    stamp,
)
from .bands import Band
from .by_source import SourceSound
from .weighting import WEIGHTING

At = tuple[float, str]
"""Speed in rpm and option."""


@dataclass(frozen=True)
class Places:
    """Names along the axes of the levels.

    Attributes
    ----------
    speeds, options, sources, receivers : in the order of the arrays
    bands : third octaves
    """

    speeds: Sequence[float]
    options: Sequence[str]
    sources: Sequence[str]
    receivers: Sequence[str]
    bands: Sequence[Band]

    def gathered(self, sound: Mapping[At, SourceSound], part: str) -> Array:
        """A part of the sound of all cases, shape (speed, option, ...)."""
        return np.array([[getattr(sound[s, o], part) for o in self.options] for s in self.speeds])


def level(mean_square: Array) -> Array:
    """Level of mean squares of pressure, dB re 20 µPa."""
    return mean_square_level(mean_square, REFERENCE_PRESSURE_PA)


def level_variables(
    places: Places,
    sound: Mapping[At, SourceSound],
    weightings: Sequence[str],
    line_pressure: ComplexArray,
    order_frequency: xr.DataArray,
    remainder: Array,
) -> xr.Dataset:
    """Levels with the values as given.

    Parameters
    ----------
    places : axes
    sound : of every case
    weightings : of its totals
    line_pressure : of all sources together at the orders, (speed, option, receiver, order), Pa
    order_frequency : (speed, order), Hz
    remainder : mean square that the model does not explain, by option, Pa²; the first is bare
    """
    by_case = {"speed": list(places.speeds), "option": list(places.options)}
    by_receiver = {**by_case, "receiver": list(places.receivers)}
    by_source = {
        **by_case,
        "sound_source": list(places.sources),
        "receiver": list(places.receivers),
    }
    part = places.gathered(sound, "part")
    totals = part.sum(axis=3)  # (speed, option, weighting, receiver)
    a_total = totals[:, :, weightings.index("A")]
    modelled = np.stack(
        [level(totals[:, :, weightings.index(name)]) for name in WEIGHTINGS], axis=-1
    )
    order_level = _order_level(line_pressure, order_frequency.values)
    total = level(a_total + remainder[:, None])
    shares = part[:, :, weightings.index("A")]
    whole = np.where(a_total > 0.0, a_total, 1.0)[:, :, None]
    reference = list(places.options).index(REFERENCE_OPTION)
    changes = {
        "change_1x": order_level[..., 1, WEIGHTINGS.index("Z")],
        "change_modelled": level(a_total),
        "change_total": total,
    }
    weighted = {**by_receiver, "weighting": list(WEIGHTINGS)}
    ordered = {**weighted, "order": order_frequency["order"].values}
    bands = {**by_source, "band": [band.nominal_hz for band in places.bands]}
    arrays = {
        "order_level": stamp("order_level", order_level, ordered),
        "level_modelled": stamp("level_modelled", modelled, weighted),
        "level_total": stamp("level_total", total, by_receiver),
        "level_remainder": stamp("level_remainder", level(remainder[reference])),
        "source_level": stamp("source_level", level(places.gathered(sound, "alone")), by_source),
        "source_share": stamp("source_share", shares / whole, by_source),
        "source_band_level": stamp(
            "source_band_level", level(places.gathered(sound, "band")), bands
        ),
    }
    for name, values in changes.items():
        arrays[name] = stamp(name, values - values[:, [reference]], by_receiver)
    return check(xr.Dataset(arrays))


def draw_variables(
    places: Places,
    sounds: Sequence[Mapping[At, SourceSound]],
    remainder: Array,
    left: Array,
) -> xr.Dataset:
    """A-weighted levels of every draw.

    A draw that alone is louder than the published level contradicts it and has weight 0.

    Parameters
    ----------
    places : axes
    sounds : of every case, by draw
    remainder : mean square that each draw leaves unexplained, shape (draw,), Pa²
    left : share of it that each option leaves, shape (option,)
    """
    draws = {"draw": np.arange(1, len(sounds) + 1)}
    by_receiver = {
        **draws,
        "speed": list(places.speeds),
        "option": list(places.options),
        "receiver": list(places.receivers),
    }
    by_source = {**by_receiver, "sound_source": list(places.sources)}
    alone = np.array([places.gathered(sound, "alone") for sound in sounds])
    total = np.array([places.gathered(sound, "part")[:, :, 0].sum(axis=2) for sound in sounds])
    whole = total + remainder[:, None, None, None] * left[:, None]
    arrays = {
        "source_level_by_draw": stamp("source_level_by_draw", level(alone), by_source),
        "level_modelled_by_draw": stamp("level_modelled_by_draw", level(total), by_receiver),
        "level_total_by_draw": stamp("level_total_by_draw", level(whole), by_receiver),
        "level_remainder_by_draw": stamp("level_remainder_by_draw", level(remainder), draws),
        "draw_weight": stamp("draw_weight", (remainder > 0.0).astype(float), draws),
    }
    return check(xr.Dataset(arrays))


def _order_level(pressure: ComplexArray, frequency: Array) -> Array:
    """Levels of the orders, (speed, option, receiver, order, weighting)."""
    unweighted = sound_pressure_level(pressure)
    hertz = frequency[:, None, None, :]
    return np.stack([unweighted + WEIGHTING[name](hertz) for name in WEIGHTINGS], axis=-1)
