"""The verdict that opens the report: headline, reasons, best and worst."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.vocabulary import REFERENCE_OPTION
from . import labels
from .bands import quantiles
from .column_values import column
from .comparison import comparison
from .option_verdict import BETTER, MIXED, NO_CHANGE, WORSE, OptionVerdict
from .quantities import FOOT_FORCE, FORCE, HEARD_DB, JUDGED, LINE, MOMENT, TOTAL, Quantity
from .remainder import growth_sentence
from .scores import acceptability_words, criteria_of_advantage, scope_words
from .shifts import at_receiver, measurable, shift
from .source_changes import changes_sentence
from .source_words import carrier_sentence, left_out_sentence, shares_sentence
from .study import (
    balancers,
    catalogue_receiver,
    first_order_hz,
    has_draws,
    has_sources,
    many_speeds,
    options,
    overall_noise,
    speeds,
)
from .tables import Table

NONE_MEASURABLE: Final = "none that could be measured"


def headline(results: xr.Dataset) -> str:
    """What carries the level where that is modelled; else what balancing does to the level."""
    receiver, names = catalogue_receiver(results), balancers(results)
    if has_sources(results):
        return carrier_sentence(results)
    if not names:
        return f"This study has no balancing option beside {REFERENCE_OPTION}."
    line = np.concatenate([shift(results, LINE, name).gain_db for name in names])
    total = np.concatenate([shift(results, TOTAL, name).gain_db for name in names])
    change = rounding.span(line, rounding.signed)
    return (
        f"At {receiver} the balancing options change the 1× line by {change} dB, "
        f"{_total_words(results, float(abs(total).max()))}"
    )


def reasons(results: xr.Dataset, verdicts: Sequence[OptionVerdict]) -> list[str]:
    """Sentences that explain the headline, with the verdicts on the options."""
    with_sources = has_sources(results)
    texts = [_as_it_is(results)]
    if with_sources:
        texts += [shares_sentence(results), left_out_sentence(results)]
    else:
        texts.append(_remainder(results))
    if not verdicts:
        return texts
    if with_sources:
        texts.insert(0, changes_sentence(results))
    return [*texts, *_warnings(verdicts), _ranking(results, verdicts)]


def extremes_table(results: xr.Dataset) -> Table | None:
    """Best and worst option by each quantity, each the largest over the speeds."""
    if not balancers(results):
        return None
    rows = tuple(_extremes(results, quantity) for quantity in JUDGED)
    head = (
        "Quantity, largest over the speeds",
        "Without balancer",
        "Best of those measurably better",
        "Worst of those measurably worse",
    )
    values = "; the total is the middle of the draws" if has_draws(results) else ""
    return Table(
        f"Best and worst, levels at {catalogue_receiver(results)}{values}",
        head,
        rows,
        frozenset({0, 1, 2, 3}),
    )


def options_table(verdicts: Sequence[OptionVerdict]) -> Table | None:
    """The word on each option, with its reason beside it."""
    if not verdicts:
        return None
    rows = tuple((one.option, one.judgement, one.reason) for one in verdicts)
    head = ("Option", "Verdict", "Because")
    return Table("Each option against no balancer", head, rows, frozenset({0, 1, 2}))


def _total_words(results: xr.Dataset, change_db: float) -> str:
    total = f"the total of {_total_dba(results):g} dB(A)"
    if change_db < 0.0005:
        return f"and {total} by less than 0.001 dB: not at all."
    size = f"by at most {rounding.fixed(change_db, 3)} dB"
    if change_db < measurable(results).level_db:
        return f"but {total} hardly at all: {size}, which nobody can hear or measure."
    if change_db < HEARD_DB:
        return f"but {total} only {size}, which can be measured but hardly heard."
    return f"and {total} {size}, which can be heard."


def _as_it_is(results: xr.Dataset) -> str:
    """Forces and levels without a balancer."""
    reference = comparison(results).sel(
        {"option": REFERENCE_OPTION, "receiver": catalogue_receiver(results)}
    )
    shaken = (
        _shaken_over_the_speeds(results, reference)
        if many_speeds(results)
        else _shaken_by_speed(results, reference)
    )
    return (
        f"Without a balancer the moving parts shake the {_body(results)} at 1× with {shaken}; "
        f"at 2× with {_twice(float(reference['force_2x_n'].max()))}. A foot passes on at most "
        f"{FOOT_FORCE.write(float(reference['foot_force_1x_n'].max()))}; at "
        f"{reference['receiver'].item()} the 1× line has "
        f"{rounding.span(reference['level_1x_db'].values, rounding.level)} dB or "
        f"{rounding.span(reference['level_1x_dba'].values, rounding.level)} dB(A)."
    )


def _shaken_by_speed(results: xr.Dataset, reference: xr.Dataset) -> str:
    return ", ".join(
        f"{FORCE.write(force)} and {MOMENT.write(moment)} at {speed:g} rpm ({frequency:.1f} Hz)"
        for speed, frequency, force, moment in zip(
            speeds(results),
            first_order_hz(results),
            reference["force_1x_n"].values,
            reference["moment_1x_nm"].values,
            strict=True,
        )
    )


def _shaken_over_the_speeds(results: xr.Dataset, reference: xr.Dataset) -> str:
    """Ranges, where a list of all speeds would be long."""
    return (
        f"{rounding.span(reference['force_1x_n'].values, rounding.significant)} N and "
        f"{rounding.span(reference['moment_1x_nm'].values, rounding.significant)} N m at "
        f"{rounding.span(speeds(results), '{:g}'.format)} rpm "
        f"({rounding.span(first_order_hz(results), rounding.fixed)} Hz)"
    )


def _body(results: xr.Dataset) -> str:
    return "block on its springs" if "block_velocity_order" in results else "housing"


def _twice(force_n: float) -> str:
    return "nothing" if force_n < rounding.FORCE_FLOOR else f"up to {FORCE.write(force_n)}"


def _remainder(results: xr.Dataset) -> str:
    """Why the total hardly follows the line."""
    receiver = catalogue_receiver(results)
    modelled = float(column(results, "level_modelled_dba").sel(receiver=receiver).max())
    gap = _total_dba(results) - modelled
    carried = (
        f"all shaft orders together reach at most {rounding.level(modelled)} dB(A) at {receiver}, "
        f"whatever the option: {rounding.fixed(gap)} dB below the level of the whole machine"
        if gap > 0.0
        else f"the shaft orders reach {rounding.level(modelled)} dB(A) at {receiver} with some "
        "option, above the level of the whole machine"
    )
    return (
        f"In the model {carried}. The rest, {rounding.fixed(results['level_remainder'].item(), 2)} "
        f"dB(A) at {overall_noise(results)['speed_rpm']:g} rpm, comes from sources that balancing "
        f"does not touch. {growth_sentence(results)}"
    )


def _warnings(verdicts: Sequence[OptionVerdict]) -> list[str]:
    """Name the options that make something worse, and those that do nothing."""
    worse = [verdict.option for verdict in verdicts if verdict.judgement == WORSE]
    idle = [verdict.option for verdict in verdicts if verdict.judgement == NO_CHANGE]
    mixed = [
        f"{verdict.option} (worse: {', '.join(verdict.worse_in)})"
        for verdict in verdicts
        if verdict.judgement == MIXED
    ]
    texts = [
        f"Worse than no balancer: {', '.join(worse)}." if worse else "",
        f"Better in one respect, worse in another: {'; '.join(mixed)}." if mixed else "",
        f"With {NO_CHANGE} in force, feet and sound: {', '.join(idle)}." if idle else "",
        ""
        if worse or mixed
        else "No option makes the force, the feet or the sound measurably worse.",
    ]
    return [text for text in texts if text]


def _ranking(results: xr.Dataset, verdicts: Sequence[OptionVerdict]) -> str:
    """Which option the study's weights prefer, and how sure that is."""
    method = str(results["scoring_method"].values[0])
    of_method = results[["score", "rank"]].sel({"scoring_method": method})
    winners = [str(name) for name in of_method["option"].values[of_method["rank"].values == 1.0]]
    verb = "ranks" if len(winners) == 1 else "rank"
    score = rounding.fixed(float(of_method["score"].max()), 2)
    unlucky = [
        option.option
        for option in verdicts
        if option.judgement == BETTER
        and of_method["rank"].sel(option=option.option)
        > of_method["rank"].sel(option=REFERENCE_OPTION)
    ]
    behind = "".join(_behind(results, option) for option in unlucky)
    return (
        f"By the study's weights {' and '.join(winners)} {verb} first "
        f"({labels.name(method).lower()}, score {score} of 1)"
        f"{acceptability_words(results, winners)}.{behind}{scope_words(results)}"
    )


def _behind(results: xr.Dataset, option: str) -> str:
    """By which criteria an option that betters forces or sound falls behind the reference."""
    criteria = criteria_of_advantage(results, REFERENCE_OPTION, option)
    return (
        f" {option} ranks below {REFERENCE_OPTION} all the same: {REFERENCE_OPTION} scores better "
        f"in {'; '.join(criteria)}."
    )


def _extremes(results: xr.Dataset, quantity: Quantity) -> tuple[str, ...]:
    """Quantity, its reference, its best and its worst option with the largest over the speeds.

    Best and worst are of those alone that the verdicts call better or worse for it.
    """
    highest = _highest(results, quantity)
    shifts = {name: shift(results, quantity, name) for name in balancers(results)}
    better = [name for name, one in shifts.items() if one.improves and not one.worsens]
    worse = [name for name, one in shifts.items() if one.worsens]
    best = min(better, key=lambda name: highest[name], default="")
    worst = max(worse, key=lambda name: highest[name], default="")
    named = [
        f"{quantity.write(highest[name])}: {name}" if name else NONE_MEASURABLE
        for name in (best, worst)
    ]
    return (quantity.words, quantity.write(highest[REFERENCE_OPTION]), *named)


def _highest(results: xr.Dataset, quantity: Quantity) -> dict[str, float]:
    """Largest over the speeds by option, of the total its middle over the draws."""
    receiver = catalogue_receiver(results)
    if quantity == TOTAL:
        values = quantiles(results, "level_total").sel(quantile=0.5, receiver=receiver)
    else:
        values = at_receiver(column(results, quantity.column), receiver)
    return {name: float(values.sel(option=name).max()) for name in options(results)}


def _total_dba(results: xr.Dataset) -> float:
    return overall_noise(results)["level_dba"]
