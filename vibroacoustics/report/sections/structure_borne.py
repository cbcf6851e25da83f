"""Structure-borne sound: a plate under the machine beside the airborne sound."""

from typing import Final

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.registry import register
from ...base.vocabulary import REFERENCE_OPTION
from ...results.estimates import estimate
from ...results.stored_study import (
    a_weighted,
    at_catalogue,
    balancers,
    catalogue_receiver,
    nearest_speed,
    options,
)
from ..blocks import Block, Text
from ..tables import DataTable, Table, long_table
from . import Section, hold

_LINES: Final = 6
_OF_LINES: Final = [
    *(f"structure_borne_line_{name}" for name in ("level", "low", "high")), "tone_frequency",
    "structure_borne_input_power", "structure_borne_power",
]  # fmt: skip
UNCERTAIN: Final = "uncertain"
_LEAST_DB: Final = 0.1
"""Smaller changes are none."""


def first_order_levels(
    results: xr.Dataset, receiver: str, option: str
) -> tuple[float, float, float, float]:
    """A-weighted level of 1×, airborne and structure-borne, with the 5 % and 95 % quantiles of
    plates."""
    by_air = _value(results, "order_level", receiver, option, order=1)
    by_plate, low, high = (
        _value(results, f"structure_borne_line_{name}", receiver, option, line="order 1")
        for name in ("level", "low", "high")
    )
    return by_air, by_plate, by_plate + low, by_plate + high


def carrier(by_air: float, low: float, high: float) -> str:
    """Name the path that dominates a level."""
    if by_air < low:
        return "structure-borne sound"
    return "airborne sound" if by_air > high else UNCERTAIN


def dominant_path_sentence(results: xr.Dataset, receiver: str) -> str:
    """Say how loud 1× is, airborne and structure-borne, which path dominates, which option changes
    it."""
    by_air, by_plate, low, high = first_order_levels(results, receiver, REFERENCE_OPTION)
    which = carrier(by_air, low, high)
    verdict = "it is uncertain which dominates" if which == UNCERTAIN else f"{which} dominates"
    return (
        f"At {receiver} and {nearest_speed(results):g} rpm without a balancer 1× is "
        f"{rounding.level(by_air)} dB(A) airborne and {rounding.level(by_plate)} dB(A) "
        f"({_span(low, high)} with 90 %) structure-borne: {verdict}."
        f"{_best(results, receiver, by_plate)}"
    )


def both_paths_table(results: xr.Dataset, receiver: str) -> Table:
    """Return 1× and all lines of every option, airborne and structure-borne."""
    rows = []
    for option in options(results):
        by_air, by_plate, low, high = first_order_levels(results, receiver, option)
        total = (
            _value(results, f"structure_borne_level{end}", receiver, option)
            for end in ("", "_low", "_high")
        )
        all_by_air, total_words = (
            rounding.level(_value(results, name, receiver, option))
            for name in ("level_total", "level_both_ways")
        )
        first = (rounding.level(by_air), ranged(by_plate, low, high), carrier(by_air, low, high))
        rows.append((option, *first, all_by_air, ranged(*total), total_words))
    head = (
        "Option", "1× airborne, dB(A)", "1× structure-borne, dB(A)", "1× dominated by",
        "All airborne, dB(A)", "All structure-borne, dB(A)", "Both, dB(A)",
    )  # fmt: skip
    caption = (
        f"{receiver}, {nearest_speed(results):g} rpm: airborne, and structure-borne under "
        "them with the span of 90 % of such plates"
    )
    return Table(caption, head, tuple(rows), frozenset({0, 3}))


def plate_lines_table(results: xr.Dataset, receiver: str) -> Table:
    """The loudest lines of the plate without a balancer, with the powers."""
    coordinates = at_catalogue(results, receiver=receiver, speed=nearest_speed(results))
    lines = a_weighted(results[_OF_LINES].sel(coordinates))
    level = lines["structure_borne_line_level"].values
    loudest = np.argsort(-level, kind="stable")[:_LINES]
    rows = []
    for number in sorted(row for row in loudest if level[row] >= rounding.LEVEL_FLOOR_DB):
        line = str(lines["line"].values[number])
        db, low, high, hertz, power_in, power = (
            float(lines[name].values[number]) for name in _OF_LINES
        )
        order = line.removeprefix("order ")
        rows.append(
            (
                f"{order}×" if order != line else line,
                rounding.fixed(hertz),
                rounding.three_digits(1e3 * power_in),
                rounding.three_digits(1e6 * power),
                ranged(db, db + low, db + high),
            )
        )
    head = ("Line", "Hz", "Into the plate, mW", "Sound power, µW", "Level, dB(A)")
    where = f"{receiver}, {nearest_speed(results):g} rpm, option {REFERENCE_OPTION}"
    return Table(f"{where}: lines of the plate", head, tuple(rows))


def _value(
    results: xr.Dataset, name: str, receiver: str, option: str, **coordinates: str | int
) -> float:
    at_speed = {"receiver": receiver, "option": option, "speed": nearest_speed(results)}
    return estimate(results, name, weighting="A", **at_speed, **coordinates).value


def _best(results: xr.Dataset, receiver: str, by_plate: float) -> str:
    """Option with the lowest structure-borne 1×."""
    each = {
        balancer: first_order_levels(results, receiver, balancer)[1]
        for balancer in balancers(results)
    }
    if not each or by_plate < rounding.LEVEL_FLOOR_DB:
        return ""
    least = min(each, key=lambda option: each[option])
    if each[least] > by_plate - _LEAST_DB:
        return " No option lowers it."
    change = rounding.level_change(each[least] - by_plate, each[least], by_plate)
    text = change if change == "silent" else f"{change} dB"
    return f" The lowest structure-borne 1× is that of {least}: {text}."


def _span(low: float, high: float) -> str:
    return f"{rounding.level(low)} to {rounding.level(high)}"


def ranged(level: float, low: float, high: float) -> str:
    """Structure-borne level with what its method leaves open; without it where it is silent."""
    if level < rounding.LEVEL_FLOOR_DB:
        return rounding.level(level)
    return f"{rounding.level(level)} ({_span(low, high)})"


def _blocks(results: xr.Dataset) -> list[Block]:
    receiver = catalogue_receiver(results)
    return [
        Text(dominant_path_sentence(results, receiver), "strong"),
        Text(
            "The feet excite a plate, whose near field and bending waves radiate. Levels of the "
            "plate are those of its mean power, with the interval of 90 % of such plates. They are "
            "not in airborne levels, shares and ranks. Neglected: forces along the plate, moments, "
            "transmission into the building.",
            "note",
        ),
        both_paths_table(results, receiver),
        plate_lines_table(results, receiver),
        Text("Other microphones and speeds are in structure_borne.csv.", "note"),
    ]


def _data(results: xr.Dataset) -> dict[str, DataTable]:
    names = [name for name in map(str, results.data_vars) if name.startswith("structure_borne_")]
    table = long_table(results, [*names, "level_both_ways"], weighting="A")
    return {"structure_borne.csv": table}


_applies = hold("structure_borne_level")
register(Section("structure-borne", "Structure-borne sound", _blocks, _applies, 33.0, tables=_data))
