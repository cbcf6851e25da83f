"""Two studies, or two options of one: key figures, and what differs in their inputs."""

import json
from collections.abc import Iterator
from typing import Any, Final

import numpy as np
import xarray as xr

from ...base import rounding
from ...results import labels
from ...results.figure_limits import Compared
from ...results.stored_study import parameters
from ..operating_points import shown_speeds
from ..tables import Table

Figure = tuple[str, str, float, float]
"""Words, unit and the values of both."""
MOST_ROWS: Final = 60
_NO_INPUT: Final = ("records", "source_file", "title", "options")
"""Attributes among the parameters that are no input."""
_AMPLITUDES: Final = {
    "force_amplitude": ("Force", "N"),
    "moment_amplitude": ("Moment", "N m"),
    "foot_force_amplitude": ("Largest force into a foot", "N"),
}


def key_figures(compared: Compared) -> Table:
    """Forces, levels and criteria of both, and their difference."""
    rows = [(name, unit, *_cells(first, second, unit)) for name, unit, first, second in
            _figures(compared)]  # fmt: skip
    head = ("Figure", "Unit", "A", "B", "B − A", "B over A")
    return Table("Key figures of both", head, tuple(rows), frozenset({0, 1}))


def inputs_table(compared: Compared) -> Table:
    """Inputs that are not the same in both, in SI."""
    first, second = (_inputs(result, option) for _, result, option, _ in compared.sides())
    names = [name for name in (first | second) if first.get(name) != second.get(name)]
    rows = [(name, _shown(first.get(name)), _shown(second.get(name))) for name in names[:MOST_ROWS]]
    caption = f"Inputs that differ: {len(names)}"
    if len(names) > MOST_ROWS:
        caption += f", of which {MOST_ROWS} are shown"
    return Table(caption, ("Input", "A", "B"), tuple(rows), frozenset({0, 1, 2}))


def _figures(compared: Compared) -> Iterator[Figure]:
    (_, first, option, _), (_, second, other, _) = compared.sides()
    speeds = (compared.orders[name].values for name in ("speed", "compared_speed"))
    shown = shown_speeds(compared.orders)
    for speed, other_speed in zip(*speeds, strict=True):
        if speed not in shown:
            continue
        reference = first.sel(speed=speed, option=option)
        two = second.sel(speed=other_speed, option=other)
        yield from _amplitudes(reference, two, f"{speed:.0f} rpm")
        yield from _levels(reference, two, f"{speed:.0f} rpm")
    yield from _criteria(first, option, second, other)


def _amplitudes(first: xr.Dataset, second: xr.Dataset, where: str) -> Iterator[Figure]:
    for name, (words, unit) in _AMPLITUDES.items():
        for order in (1, 2):
            first_n, two = (float(side[name].sel(order=order).max()) for side in (first, second))
            if max(first_n, two) > rounding.FORCE_FLOOR:
                yield f"{words}, {order}×, {where}", unit, first_n, two


def _levels(first: xr.Dataset, second: xr.Dataset, where: str) -> Iterator[Figure]:
    for receiver in map(str, first["receiver"].values):
        if receiver not in second["receiver"].values:
            continue
        reference, two = first.sel(receiver=receiver), second.sel(receiver=receiver)
        total = float(reference["level_total"]), float(two["level_total"])
        yield f"Level at {receiver}, {where}", "dB(A)", total[0], total[1]
        level, other = (
            float(side["level_modelled"].sel(weighting="A")) for side in (reference, two)
        )
        yield f"Modelled level at {receiver}, {where}", "dB(A)", level, other


def _criteria(first: xr.Dataset, option: str, second: xr.Dataset, other: str) -> Iterator[Figure]:
    names = [name for name in first["criterion"].values if name in second["criterion"].values]
    for name in names:
        reference = first["criterion_value"].sel(criterion=name, option=option)
        value = float(second["criterion_value"].sel(criterion=name, option=other))
        words = str(reference["criterion_label"].item()) or labels.name(str(name))
        yield (
            f"Criterion: {words}",
            str(reference["criterion_unit"].item()),
            float(reference),
            value,
        )


def _cells(first: float, second: float, unit: str) -> tuple[str, ...]:
    is_level = unit.startswith("dB")
    write = rounding.fixed if is_level else rounding.significant
    digits = 1 if is_level else 12
    difference = round(second, digits) - round(first, digits)  # of the levels that are shown
    signed = write(difference)
    if difference > 0.0 and signed.strip("0.") != "":
        signed = f"+{signed}"
    ratio = second / first if not is_level and abs(first) > rounding.FORCE_FLOOR else np.nan
    return write(first), write(second), signed, rounding.fixed(float(ratio), 3)


def _inputs(result: xr.Dataset, option: str) -> dict[str, Any]:
    """All parameters of a study with the chosen option's, by their names joined by dots."""
    content = parameters(result)
    of_option = {"name": option, **(content["options"].get(option) or {})}
    others = {name: value for name, value in content.items() if name not in _NO_INPUT}
    return dict(_flat({**others, "option": of_option}))


def _flat(table: Any, name: str = "") -> Iterator[tuple[str, Any]]:
    if isinstance(table, dict) and table:
        for key, value in table.items():
            yield from _flat(value, f"{name}.{key}" if name else str(key))
    else:
        yield name, table


def _shown(value: Any) -> str:
    if value is None:
        return rounding.NOTHING
    text = f"{value:.6g}" if isinstance(value, float) else json.dumps(value, ensure_ascii=False)
    text = text.strip('"')
    return text if len(text) <= 80 else f"{text[:79]}…"
