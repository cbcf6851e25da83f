"""Results beside published values, in words and tables."""

from collections.abc import Callable, Iterable
from typing import Final

import xarray as xr

from ...base import rounding
from ...base.registry import register
from ...base.vocabulary import PUBLISHED_SHARE
from ...results.bands import Band, percent
from ...results.stored_study import parameters
from ...results.validation import (
    AGREES,
    COVERAGE,
    DIFFERS,
    FORCE_TOLERANCE,
    LEVEL_TOLERANCE_DB,
    ONE_SIDED,
    UNDECIDED,
    Validation,
    validations,
)
from ..blocks import Block, Text
from ..tables import DataTable, Table, long_table
from . import Section, text


def agreement_sentence(results: xr.Dataset) -> str:
    """Whether the modelled level agrees with the published one; empty where none is published."""
    levels = [each for each in validations(results) if each.unit == "dB(A)"]
    if not levels:
        return ""
    level = levels[0]
    published, tolerance = f"{rounding.fixed(level.data)} dB(A)", f"{level.tolerance:g} dB"
    words = {
        AGREES: f"agrees with the published {published} within {tolerance}",
        DIFFERS: f"differs from the published {published}",
        UNDECIDED: f"is too uncertain to be compared with the published {published}",
    }[level.verdict]
    return (
        f"The modelled level with nominal values {words}. Error E = "
        f"{rounding.signed(level.error)} dB, u = {rounding.fixed(level.uncertainty)} dB."
    )


def evidence_table(results: xr.Dataset) -> Table:
    """All that is published of what the results hold."""
    return validation_table("Results beside published values", validations(results))


def validation_table(caption: str, shown: Iterable[Validation]) -> Table:
    """Return a table with a row for each validation."""
    head = (
        "Quantity", "Unit", "Simulation S", "Data D", "E = S − D", "u_num", "u_input", "u_D",
        "u", "Verdict", "Data from",
    )  # fmt: skip
    return Table(caption, head, tuple(map(_row, shown)), frozenset({0, 1, 9, 10}))


def _row(shown: Validation) -> tuple[str, ...]:
    spreads = (shown.numerical, shown.inputs, shown.published, shown.uncertainty)
    is_level = shown.unit.startswith("dB")
    write = rounding.fixed if is_level else rounding.significant
    tolerance = f"{write(shown.tolerance)} {shown.unit.removesuffix('(A)')}"
    verdict = f"{AGREES} within {tolerance}" if shown.verdict == AGREES else shown.verdict
    return (
        shown.quantity,
        shown.unit,
        *map(write, (shown.simulation, shown.data)),
        rounding.signed(shown.error) if is_level else _with_sign(shown.error),
        *(rounding.significant(spread, 2) for spread in spreads),
        verdict,
        shown.source,
    )


def _with_sign(value: float) -> str:
    text = rounding.significant(value)
    return f"+{text}" if value > 0.0 else text


CONFLICT: Final = 0.05
"""Tail of the prior predictive below which published data are in conflict with the model."""
_ALL: Final = "all together"


def conflict_table(results: xr.Dataset) -> Table:
    """A row for each published datum, and one for all together."""
    rows = []
    names = map(str, results["datum"].values)
    tails = dict(zip(names, results["datum_tail"].values.tolist(), strict=True))
    if len(tails) > 1:
        tails[_ALL] = results["conflict_tail"].item()
    for name, tail in tails.items():
        expected = published = ""
        if name != _ALL:
            published = _published(results, name)
            quantiles = results["datum_expected"].sel(datum=name).transpose("datum_quantile")
            expected = Band(*quantiles.values.tolist()).middle_and_ends(_number(name))
        word = "conflict" if tail < CONFLICT else "no conflict"
        rows.append((name, published, expected, rounding.fixed(tail, 3), word))
    head = ("Datum", "Published or measured", "Expected by the model", "Tail of the prior", "")
    caption = "Data beside the prior predictive without discrepancy, median (80 % interval)"
    return Table(caption, head, tuple(rows), frozenset({0, 4}))


def _published(results: xr.Dataset, name: str) -> str:
    value, deviation = (
        float(results[of].sel(datum=name)) for of in ("datum_value", "datum_deviation")
    )
    return f"{_number(name)(value)} ± {_number(name)(deviation)}{_unit(results, name)}"


def _number(name: str) -> Callable[[float], str]:
    return percent if name == PUBLISHED_SHARE else rounding.fixed


def _unit(results: xr.Dataset, name: str) -> str:
    if name != PUBLISHED_SHARE:
        return " dB(A)"
    below_hz = parameters(results)["machine"]["overall_noise"]["spectral_share"]["below_hz"]
    return f" of the energy below {below_hz:g} Hz"


def _blocks(results: xr.Dataset) -> list[Block]:
    return [
        *text(agreement_sentence(results), "strong"),
        evidence_table(results),
        Text(
            "E is simulation minus data, u the root of the sum of squared standard uncertainties "
            "of numerics, inputs and data (ASME V&V 20). Both agree where "
            f"|E| + {ONE_SIDED:g} u ≤ T, and differ where |E| > {COVERAGE:g} u. The tolerance T is "
            f"{LEVEL_TOLERANCE_DB:g} dB or {percent(FORCE_TOLERANCE)} of a force.",
            "note",
        ),
        *([conflict_table(results)] if "datum_tail" in results else []),
    ]


def _data(results: xr.Dataset) -> dict[str, DataTable]:
    """Every validation, and published data beside what the model expects before them."""
    shown = validations(results)
    names = ("quantity", "unit", "simulation", "data", "error", "numerical", "inputs",
             "published", "uncertainty", "tolerance", "verdict", "source")  # fmt: skip
    conflicts = ("datum_value", "datum_deviation", "datum_expected", "datum_tail", "conflict_tail")
    return {
        "evidence.csv": {name: [getattr(each, name) for each in shown] for name in names},
        "conflict.csv": long_table(results, conflicts),
    }


def _applies(results: xr.Dataset) -> bool:
    return bool(validations(results))


register(Section("evidence", "Evidence", _blocks, _applies, 95.0, tables=_data))
