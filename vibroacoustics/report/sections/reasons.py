"""Reasons for the verdict, and the effect of each option."""

from collections.abc import Sequence
from typing import Final

import xarray as xr

from ...base import rounding
from ...base.registry import register
from ...results.sample_words import not_sampled_sentence
from ...results.stored_study import (
    at_catalogue,
    catalogue_receiver,
    first_order_hz,
    has_sources,
    overall_noise,
    quoted_dba,
    quoted_speed,
    speeds,
)
from ..blocks import Block, Text
from ..columns import column
from ..option_verdict import OptionVerdict, option_verdicts
from ..quantities import FOOT_FORCE, FORCE, MOMENT
from ..remainder import growth_sentence, measured_rpm, unmodelled_level
from ..shown_speeds import many_speeds
from ..tables import Table
from . import Section
from .baseline import not_measured
from .comparison import comparison

_HALF: Final = 0.5
"""Share of the modelled energy in the total from which on the level is not called measured."""


def reasons(results: xr.Dataset) -> list[str]:
    """Return forces and level without an option, and what limits the effect of the options."""
    texts = [_as_it_is(results)]
    if not has_sources(results):
        texts += [_unmodelled(results), not_sampled_sentence(results)]
    return [*filter(None, texts)]


def options_table(verdicts: Sequence[OptionVerdict]) -> Table | None:
    """The word on each option, with its reason beside it."""
    if not verdicts:
        return None
    rows = tuple(
        (verdict.option, verdict.judgement, verdict.reason, " ".join(verdict.sentences))
        for verdict in verdicts
    )
    head = ("Option", "Verdict", "Because", "Remarks")
    return Table("Each option against no balancer", head, rows, frozenset({0, 1, 2, 3}))


def _as_it_is(results: xr.Dataset) -> str:
    """Forces and levels without a balancer."""
    reference = comparison(results).sel(at_catalogue(results))
    shaken = (
        _shaken_over_the_speeds(results, reference)
        if many_speeds(results)
        else _shaken_by_speed(results, reference)
    )
    force_n = float(reference["force_2x_n"].max())
    twice = "0 N" if force_n < rounding.FORCE_FLOOR else FORCE.write(force_n)
    body = "block on its springs" if "block_velocity_order" in results else "housing"
    return (
        f"Without a balancer the 1× force and moment on the {body} are {shaken}. "
        f"The largest 2× force is {twice}, the largest 1× "
        f"foot force {FOOT_FORCE.write(float(reference['foot_force_1x_n'].max()))}. At "
        f"{reference['receiver'].item()} the 1× line is "
        f"{rounding.span(reference['level_1x_dba'].values, rounding.level)} dB(A)."
    )


def _shaken_by_speed(results: xr.Dataset, reference: xr.Dataset) -> str:
    return "; ".join(
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


def _unmodelled(results: xr.Dataset) -> str:
    """Say why the total hardly follows the line, or that no level is published."""
    if overall_noise(results) is None and measured_rpm(results) is None:
        return growth_sentence(results)
    receiver = catalogue_receiver(results)
    modelled = float(column(results, "level_modelled_dba").sel(receiver=receiver).max())
    speed = measured_rpm(results)
    coordinates = at_catalogue(results, speed=speed)
    total = (
        quoted_dba(results)
        if speed is None
        else float(results["level_total"].sel(coordinates).round(1))
    )
    gap = total - modelled
    carried = (
        f"all shaft orders together reach at most {rounding.level(modelled)} dB(A) at {receiver}, "
        f"whatever the option: {rounding.fixed(gap)} dB below the level of the machine"
        if gap > 0.0
        else f"the shaft orders reach {rounding.level(modelled)} dB(A) at {receiver} with some "
        "option, above the level of the machine"
    )
    if speed is not None:
        unmodelled = unmodelled_level(results, speed).middle_text(rounding.fixed)
        assumed = not_measured(results) > _HALF
        how = "most of it assumed in bands that were not measured" if assumed else "as measured"
        what, growth = f"The rest, {how}, {unmodelled}", ""
    else:
        speed, growth = quoted_speed(results), f" {growth_sentence(results)}"
        what = f"The rest, {rounding.fixed(results['level_unmodelled'].item())}"
    return (
        f"In the model {carried}. {what} dB(A) at {speed:g} rpm, comes from sources that "
        f"balancing does not touch.{growth}"
    )


def _blocks(results: xr.Dataset) -> list[Block]:
    table = options_table(option_verdicts(results))
    return [*map(Text, reasons(results)), *([table] if table else [])]


register(Section("reasons", "Forces and options", _blocks, position=15.0))
