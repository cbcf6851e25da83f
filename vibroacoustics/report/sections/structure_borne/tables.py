"""What comes by air and what by the feet and the plate under them, in words and tables."""

from typing import Final

import numpy as np
import xarray as xr

from ....base import rounding
from ....base.vocabulary import REFERENCE_OPTION
from ....results.stored_study import balancers, nearest_speed, options
from ...tables import Table

_FIRST: Final = "order 1"
_LINES: Final = 6
_LEAST_DB: Final = 0.1
"""Smaller changes are none."""


def has_plate(results: xr.Dataset) -> bool:
    """Whether the sound of a plate under the feet was computed."""
    return "structure_borne_level" in results


def first_order_levels(
    results: xr.Dataset, receiver: str, option: str
) -> tuple[float, float, float, float]:
    """A-weighted level of 1× by air, by the plate, and what 5 % and 95 % of plates stay below."""
    there = _at(results, receiver, option)
    by_air = float(there["order_level"].sel(order=1))
    by_plate = float(there["structure_borne_line_level"].sel(line=_FIRST))
    low, high = (
        float(there[f"structure_borne_line_{end}"].sel(line=_FIRST)) for end in ("low", "high")
    )
    return by_air, by_plate, by_plate + low, by_plate + high


def carrier(by_air: float, low: float, high: float) -> str:
    """Which way carries a level."""
    if by_air < low:
        return "the plate"
    return "the air" if by_air > high else "not sure"


def way_sentence(results: xr.Dataset, receiver: str) -> str:
    """How loud 1× is by air and by the plate, which carries it, which option changes that."""
    by_air, by_plate, low, high = first_order_levels(results, receiver, REFERENCE_OPTION)
    which = carrier(by_air, low, high)
    verdict = (
        "which of them carries it is not sure" if which == "not sure" else f"{which} carries it"
    )
    return (
        f"At {receiver} and {nearest_speed(results):g} rpm without a balancer 1× is "
        f"{rounding.level(by_air)} dB(A) by air and {rounding.level(by_plate)} dB(A) "
        f"({_span(low, high)} with 90 %) by the feet and the plate: {verdict}."
        f"{_best(results, receiver, by_plate)}"
    )


def ways_table(results: xr.Dataset, receiver: str) -> Table:
    """Of every option 1× and all lines, by air and by the plate."""
    rows = []
    for option in options(results):
        by_air, by_plate, low, high = first_order_levels(results, receiver, option)
        there = _at(results, receiver, option)
        total = [float(there[f"structure_borne_level{end}"]) for end in ("", "_low", "_high")]
        rows.append(
            (
                option,
                rounding.level(by_air),
                _ranged(by_plate, low, high),
                carrier(by_air, low, high),
                rounding.level(float(there["level_total"])),
                _ranged(*total),
                rounding.level(float(there["level_both_ways"])),
            )
        )
    head = (
        "Option", "1× by air, dB(A)", "1× by the plate, dB(A)", "1× carried by",
        "All by air, dB(A)", "All by the plate, dB(A)", "Both, dB(A)",
    )  # fmt: skip
    caption = (
        f"{receiver}, {nearest_speed(results):g} rpm: by air, and by the feet and the plate under "
        "them with the span of 90 % of such plates"
    )
    return Table(caption, head, tuple(rows), frozenset({0, 3}))


def plate_lines_table(results: xr.Dataset, receiver: str) -> Table:
    """The loudest lines of the plate without a balancer, with the powers."""
    there = _at(results, receiver, REFERENCE_OPTION)
    level = there["structure_borne_line_level"].values
    loudest = np.argsort(-level, kind="stable")[:_LINES]
    rows = []
    for at in sorted(row for row in loudest if level[row] >= rounding.LEVEL_FLOOR_DB):
        line = there.isel(line=int(at))
        low, high = (float(line[f"structure_borne_line_{end}"]) for end in ("low", "high"))
        rows.append(
            (
                _line_name(str(line["line"].values)),
                rounding.fixed(float(line["tone_frequency"])),
                rounding.three_digits(1e3 * float(line["structure_borne_input_power"])),
                rounding.three_digits(1e6 * float(line["structure_borne_power"])),
                _ranged(float(level[at]), level[at] + low, level[at] + high),
            )
        )
    head = ("Line", "Hz", "Into the plate, mW", "Sound power, µW", "Level, dB(A)")
    where = f"{receiver}, {nearest_speed(results):g} rpm, option {REFERENCE_OPTION}"
    return Table(f"{where}: lines of the plate", head, tuple(rows))


def _at(results: xr.Dataset, receiver: str, option: str) -> xr.Dataset:
    names = [
        name
        for name in results.data_vars
        if str(name).startswith("structure_borne_") or name in ("level_both_ways", "level_total")
    ]
    chosen = results[[*names, "order_level"]].sel(speed=nearest_speed(results), option=option)
    return chosen.sel(receiver=receiver, weighting="A")


def _best(results: xr.Dataset, receiver: str, by_plate: float) -> str:
    """The option that leaves least of 1× by the plate."""
    each = {one: first_order_levels(results, receiver, one)[1] for one in balancers(results)}
    if not each or by_plate < rounding.LEVEL_FLOOR_DB:
        return ""
    least = min(each, key=lambda option: each[option])
    if each[least] > by_plate - _LEAST_DB:
        return " No option takes anything off it."
    change = rounding.level_change(each[least] - by_plate, each[least], by_plate)
    return f" By the plate {least} leaves least of it: {change}" + (
        "." if change == "silent" else " dB."
    )


def _line_name(name: str) -> str:
    order = name.removeprefix("order ")
    return f"{order}×" if order != name else name


def _span(low: float, high: float) -> str:
    return f"{rounding.level(low)} to {rounding.level(high)}"


def _ranged(level: float, low: float, high: float) -> str:
    if level < rounding.LEVEL_FLOOR_DB:
        return rounding.level(level)
    return f"{rounding.level(level)} ({_span(low, high)})"
