"""Which way the sound comes: sources, where they act and in which direction, in words."""

from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.arrays import Array, ComplexArray
from ..base.decibel import amplitude_of_level
from ..base.vocabulary import REFERENCE_OPTION
from .bands import percent
from .labels import DOF_WORDS
from .source_words import source_name
from .study import quoted_speed

LEADING: Final = 10
"""Paths that are shown."""
_RELATIONS: Final = (
    (0.5, "works with it"),
    (0.1, "partly with it"),
    (-0.1, "across it"),
    (-0.5, "partly against it"),
    (-1.0, "works against it"),
)
"""Words from a cosine on."""
LEAST: Final = 0.005
"""Smaller shares are not told in words."""
_KINDS: Final = {"f": "force along", "m": "moment about"}


def has_paths(results: xr.Dataset) -> bool:
    """Whether the results tell paths apart and any of them sounds."""
    return "path_share" in results and bool(results["path_share"].any())


def has_motions(results: xr.Dataset) -> bool:
    """Whether what radiates tells more than the paths do: of several sources, or of modes."""
    sources = set(results["path_source"].values.tolist())
    return len(sources) > 1 or results.sizes["radiating_motion"] > len(DOF_WORDS)


def path_speed(results: xr.Dataset) -> float:
    """Speed at which paths are shown: of the published level, or the nearest to it."""
    speeds = results["path_speed"].values
    return float(speeds[np.argmin(np.abs(speeds - quoted_speed(results)))])


def at_path_speed(results: xr.Dataset, receiver: str, option: str = REFERENCE_OPTION) -> xr.Dataset:
    """Paths to a microphone at the speed that is shown."""
    names = [name for name in results.data_vars if "path_speed" in results[name].dims]
    return results[names].sel(path_speed=path_speed(results), option=option, receiver=receiver)


def path_words(results: xr.Dataset, row: int) -> tuple[str, str]:
    """Source of a path, and where it acts in which direction, in plain words."""
    source, port, direction = (
        str(results[f"path_{field}"].values[row]) for field in ("source", "port", "direction")
    )
    kind = _KINDS.get(direction[0]) if len(direction) == 2 else None
    words = DOF_WORDS.get(direction) or (f"{kind} {direction[1]}" if kind else direction)
    return source_name(results, source), f"{port.replace('_', ' ')} {words}"


def leading(share: Array, count: int = LEADING) -> list[int]:
    """Rows of the paths with the largest shares, of whatever sign; of those above nothing."""
    order = np.argsort(-np.abs(share), kind="stable")[:count]
    return [int(row) for row in order if abs(share[row]) >= 0.0005]


def relation(share: float, alone_db: float, total_db: float) -> str:
    """How a path lies to the sum: share √(total/alone) is the cosine between the two."""
    cosine = float(np.clip(share * amplitude_of_level(total_db - alone_db), -1.0, 1.0))
    words = next(text for least, text in _RELATIONS if cosine >= least)
    return f"{words} ({rounding.signed(cosine, 2)})"


def leading_sentence(results: xr.Dataset, receiver: str) -> str:
    """The two paths with the largest shares, and the one that works against most."""
    share = at_path_speed(results, receiver)["path_share"].values
    first = " and ".join(with_share(results, row, share) for row in leading(share, 2))
    against = int(np.argmin(share))
    less = (
        f" Against it works most: {with_share(results, against, share)}."
        if share[against] <= -LEAST
        else ""
    )
    return (
        f"Of the modelled A-weighted energy at {receiver} and {path_speed(results):g} rpm without "
        f"a balancer most comes by: {first}.{less}"
    )


def phasor_shares(pressure: ComplexArray) -> Array:
    """Re{p Σp*}/|Σp|² of the phasors (path,) of one line: they add up to one; 0 of silence."""
    total = pressure.sum()
    size = float(np.abs(total)) ** 2
    return np.asarray((pressure * np.conj(total)).real / size if size else pressure.real * 0.0)


def with_share(results: xr.Dataset, row: int, share: Array) -> str:
    """A path in one phrase, with its share."""
    return f"{': '.join(path_words(results, row))}, {signed_percent(float(share[row]))}"


def signed_percent(share: float) -> str:
    """A share with its sign, where it works against the others."""
    return f"−{percent(-share)}" if share < 0.0 else percent(share)


def modelled_level(results: xr.Dataset, receiver: str, option: str) -> float:
    """A-weighted level of all modelled sources at the speed that is shown, dB."""
    level = results["level_modelled"].sel(receiver=receiver, option=option, weighting="A")
    return float(level.sel(speed=path_speed(results)))


def loudest_order(results: xr.Dataset, receiver: str) -> float:
    """Of the orders at which paths are told apart, after weighting by A."""
    orders = results["path_order"].values
    there = results["order_level"].sel(receiver=receiver, option=REFERENCE_OPTION, weighting="A")
    level = there.sel(speed=path_speed(results), order=orders)
    return float(orders[int(np.argmax(level.values))])
