"""Criteria, scores, ranks and how robust the ranks are against the choice of weights."""

import json
from collections.abc import Callable
from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from .errors import ParameterError
from .parameters.study import PublishedTable, Scoring
from .schema import REFERENCE_OPTION, check, stamp

Real = NDArray[np.float64]


def foot_force_1x(results: xr.Dataset) -> xr.DataArray:
    """Largest 1x force into a foot, N, worst over the speeds."""
    return results["foot_force_amplitude"].sel(order=1).max(("speed", "foot"))


def residual_moment(results: xr.Dataset) -> xr.DataArray:
    """1x moment about the centre of mass, N m, worst over the speeds."""
    return results["moment_amplitude"].sel(order=1).max("speed")


def level_change(results: xr.Dataset) -> xr.DataArray:
    """Change of the modelled A-weighted level, energy mean over the microphones, dB.

    Of all modelled sources where the study has inner ones, else of the shaft's orders. Worst over
    the speeds. The mean keeps a microphone near a node of the sound field from deciding the score.
    """
    inner = "level_all_sources" in results
    level = results["level_all_sources" if inner else "level_modelled"]
    power = 10.0 ** ((level if inner else level.sel(weighting="A")) / 10.0)
    mean_level = 10.0 * xr.apply_ufunc(np.log10, power.mean("receiver"))
    change: xr.DataArray = mean_level - mean_level.sel(option=REFERENCE_OPTION, drop=True)
    return change.max("speed")


def speed_sensitivity(results: xr.Dataset) -> xr.DataArray:
    """Spread over the speeds of the change of the 1x foot force against `none`, dB."""
    foot = results["foot_force_amplitude"].sel(order=1).max("foot")
    ratio = (foot / foot.sel(option=REFERENCE_OPTION, drop=True)).clip(
        min=1e-6
    )  # below -120 dB is rounding
    change: xr.DataArray = 20.0 * xr.apply_ufunc(np.log10, ratio)
    return change.max("speed") - change.min("speed")


def added_mass(results: xr.Dataset) -> xr.DataArray:
    """Mass added to the machine, kg, worst over the speeds."""
    return results["option_fact"].sel(fact="added_mass_kg", drop=True).max("speed")


CRITERIA: Final[dict[str, Callable[[xr.Dataset], xr.DataArray]]] = {
    "foot_force_1x_n": foot_force_1x,
    "residual_moment_nm": residual_moment,
    "level_change_db": level_change,
    "speed_sensitivity_db": speed_sensitivity,
    "added_mass_kg": added_mass,
}
"""Criteria by the name used in study files; the smaller the better for each."""


def score(results: xr.Dataset, settings: Scoring | None = None) -> xr.Dataset:
    """Score and rank the options.

    Parameters
    ----------
    results : dataset of a run
    settings : scale and weight of each criterion, number and seed of the random weightings;
        those that the results were made with if none are given

    Returns
    -------
    dataset with criterion_value and its scale, weight (sum 1), score and rank by method, and
    first_place_share
    """
    settings = settings or _stored_settings(results)
    # In the order of the registry: a seed then means the same weightings from any file.
    names = [name for name in CRITERIA if name in settings.criteria]
    scales = [settings.criteria[name] for name in names]
    best = np.array([scale.best for scale in scales])
    worst = np.array([scale.worst for scale in scales])
    shares = np.array([scale.weight for scale in scales])
    shares /= shares.sum()
    values = np.stack([CRITERIA[name](results).values for name in names], axis=1)
    utility = utilities(values, best, worst)
    scores = np.stack([method(utility, shares) for method in METHODS.values()], axis=1)
    # Rounded, so that options that differ by rounding errors share their rank.
    ranks = 1 + (scores.round(9) > scores.round(9)[:, None]).sum(axis=1)
    first = first_place_share(utility, settings.random_weightings, settings.seed)
    option, criterion = {"option": results["option"].values}, {"criterion": names}
    by_method = {**option, "scoring_method": list(METHODS)}
    return check(
        xr.Dataset(
            {
                "criterion_value": stamp("criterion_value", values, {**option, **criterion}),
                "criterion_best": stamp("criterion_best", best, criterion),
                "criterion_worst": stamp("criterion_worst", worst, criterion),
                "weight": stamp("weight", shares, criterion),
                "score": stamp("score", scores, by_method),
                "rank": stamp("rank", ranks.astype(float), by_method),
                "first_place_share": stamp("first_place_share", first, option),
            }
        )
    )


def utilities(values: Real, best: Real, worst: Real) -> Real:
    """Utility of each option and criterion: 1 at `best`, 0 at `worst`, linear, within 0 to 1.

    The scale does not depend on the options at hand: adding one cannot reorder the others.
    """
    return np.clip((worst - values) / (worst - best), 0.0, 1.0)


def weighted_sum(utility: Real, shares: Real) -> Real:
    """Sum of the utilities times their weights."""
    return utility @ shares


def topsis(utility: Real, shares: Real) -> Real:
    """Closeness to the ideal option (Hwang & Yoon 1981): d⁻ / (d⁺ + d⁻)."""
    to_ideal = np.linalg.norm((1.0 - utility) * shares, axis=1)
    to_worst = np.linalg.norm(utility * shares, axis=1)
    total = to_ideal + to_worst
    return np.where(total > 0.0, to_worst / np.where(total > 0.0, total, 1.0), 1.0)


METHODS: Final[dict[str, Callable[[Real, Real], Real]]] = {
    "weighted_sum": weighted_sum,
    "topsis": topsis,
}


def first_place_share(utility: Real, random_weightings: int, seed: int) -> Real:
    """Share of uniformly random weightings in which each option has the best weighted sum.

    Options that tie for the first place share it.
    """
    generator = np.random.default_rng(seed)
    shares = generator.dirichlet(np.ones(utility.shape[1]), size=random_weightings)
    sums = utility @ shares.T
    winners = sums >= sums.max(axis=0) - 1e-9
    return np.asarray((winners / winners.sum(axis=0)).mean(axis=1))


def published_table(table: PublishedTable) -> xr.Dataset:
    """A published table of scores as printed, with its sums added up again."""
    options = {"published_option": list(table.options)}
    scores = np.array(table.scores, dtype=float)
    return check(
        xr.Dataset(
            {
                "published_score": stamp(
                    "published_score",
                    scores,
                    {**options, "published_criterion": list(table.criteria)},
                    source=table.source,
                ),
                "published_sum": stamp("published_sum", table.sums, options, source=table.source),
                "recomputed_sum": stamp("recomputed_sum", scores.sum(axis=1), options),
            }
        )
    )


def ranking_text(scores: xr.Dataset) -> str:
    """The options from best to worst as plain text, one line each."""
    first = scores["score"].isel(scoring_method=0)
    order = np.argsort(-first.values, kind="stable")
    head = "  ".join(f"{name:>12}" for name in scores["scoring_method"].values)
    lines = [f"{'rank':>4}  {'option':<24}  {head}  {'first place':>11}"]
    for option in scores["option"].values[order]:
        row = scores.sel(option=option)
        values = "  ".join(f"{value:12.3f}" for value in row["score"].values)
        rank = int(row["rank"].isel(scoring_method=0))
        share = 100.0 * row["first_place_share"].item()
        lines.append(f"{rank:>4}  {option:<24}  {values}  {share:>9.0f} %")
    return "\n".join(lines)


def _stored_settings(results: xr.Dataset) -> Scoring:
    try:
        stored = json.loads(results.attrs["parameters"])["scoring"]
        return Scoring.model_validate_json(json.dumps(stored))
    except (KeyError, ValueError) as error:
        raise ParameterError(f"results hold no scoring settings: {error}") from None
