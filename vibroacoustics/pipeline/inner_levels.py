"""Levels of inner sources and their sum, as assumed and as quantiles over the draws."""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from .. import levels
from ..constants import REFERENCE_PRESSURE_PA
from ..errors import SolverError
from ..mechanics.rotation import Array
from ..parameters.study import Study
from ..schema import REFERENCE_OPTION, check, stamp
from .inner_sound import SourceSound
from .radiating import even_losses_db

QUANTILES: Final = (0.1, 0.5, 0.9)
LEAST_DRAWS: Final = 3
"""Draws that must be left for a band."""

Heard = Mapping[tuple[float, str], tuple[SourceSound, dict[str, float]]]
"""Sound and figures by speed and option."""


def labelled_levels(
    study: Study,
    results: xr.Dataset,
    heard: Sequence[Heard],
    bands: tuple[levels.Band, ...],
) -> xr.Dataset:
    """Levels of the assumed values, and quantiles of the draws.

    A draw that alone is louder than the overall level contradicts it and is left out.
    """
    speeds, options = list(study.operation.speed_rpm), list(study.options)
    sources = list(heard[0][speeds[0], options[0]][0].sources)

    def gathered(part: str) -> Array:
        """Shape (draw, speed, option, ...)."""
        return np.array(
            [[[getattr(draw[s, o][0], part) for o in options] for s in speeds] for draw in heard]
        )

    by_case = {"speed": speeds, "option": options}
    by_source = {**by_case, "sound_source": sources, "receiver": results["receiver"].values}
    by_receiver = {**by_case, "receiver": results["receiver"].values}
    of_draws = {"quantile": list(QUANTILES)}
    alone, total = _level(gathered("weighted")), gathered("total")
    whole, remainder = _whole(study, results, total)
    kept = remainder[1:] > 0.0
    if np.count_nonzero(kept) < LEAST_DRAWS:
        raise SolverError(
            f"inside.random_samples: only {np.count_nonzero(kept)} of {kept.size} draws are below "
            f"the overall level, {LEAST_DRAWS} are needed; draw more, or look at the ranges"
        )
    reference = options.index(REFERENCE_OPTION)
    levels_of = {"level_all_sources": _level(total), "level_whole": _level(whole)}
    arrays = {
        "source_level": stamp("source_level", alone[0], by_source),
        "source_level_quantile": stamp(
            "source_level_quantile", _quantiles(alone, kept), {**of_draws, **by_source}
        ),
        "source_share": stamp(
            "source_share", gathered("part")[0] / total[0][:, :, None], by_source
        ),
        "source_band_level": stamp(
            "source_band_level",
            _level(gathered("band")[0]),
            {**by_source, "band": [band.nominal_hz for band in bands]},
        ),
        "inner_remainder_level": stamp(
            "inner_remainder_level", _quantiles(_level(remainder), kept), of_draws
        ),
    }
    for name, level in levels_of.items():
        change = level - level[:, :, [reference]]
        for label, values in ((name, level), (name.replace("level", "change"), change)):
            arrays[label] = stamp(label, values[0], by_receiver)
            arrays[f"{label}_quantile"] = stamp(
                f"{label}_quantile", _quantiles(values, kept), {**of_draws, **by_receiver}
            )
    arrays["inner_figure"] = _figures(heard[0], speeds, options)
    labelled = check(xr.Dataset(arrays))
    labelled["source_level_quantile"].attrs.update(
        draws=kept.size, draws_above_overall_level=int(np.count_nonzero(~kept))
    )
    return labelled


def _level(mean_square: Array) -> Array:
    return levels.mean_square_level(mean_square, REFERENCE_PRESSURE_PA)


def _quantiles(draws: Array, kept: NDArray[np.bool_]) -> Array:
    """Over the random draws that are kept; the first one is what is assumed."""
    return np.asarray(np.quantile(draws[1:][kept], QUANTILES, axis=0))


def _whole(study: Study, results: xr.Dataset, total: Array) -> tuple[Array, Array]:
    """Mean squares of modelled sources and remainder together, and of the remainder by draw, Pa².

    The remainder completes the overall level at its microphone, speed and without a balancer; a
    draw that is louder alone leaves none.
    """
    overall = study.machine.overall_noise
    receiver = list(results["receiver"].values).index(study.catalogue_receiver)
    speed = study.operation.speed_rpm.index(overall.speed_rpm)
    option = list(study.options).index(REFERENCE_OPTION)
    published = REFERENCE_PRESSURE_PA**2 * 10.0 ** (overall.level_dba / 10.0)
    remainder = np.maximum(published - total[:, speed, option, receiver], 0.0)
    left = 10.0 ** (-np.array(list(even_losses_db(study).values())) / 10.0)
    return total + remainder[:, None, None, None] * left[:, None], remainder


def _figures(
    heard: Heard,
    speeds: Sequence[float],
    options: Sequence[str],
) -> xr.DataArray:
    names = list(dict.fromkeys(name for _, facts in heard.values() for name in facts))
    values = [
        [[heard[s, o][1].get(name, np.nan) for name in names] for o in options] for s in speeds
    ]
    return stamp(
        "inner_figure",
        values,
        {"speed": list(speeds), "option": list(options), "inner_figure_name": names},
    )
