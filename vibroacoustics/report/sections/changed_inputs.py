"""Inputs or laws that would change the headlines of the first screen."""

from collections.abc import Sequence
from typing import Final, NamedTuple

import xarray as xr

from ...base import rounding
from ...base.registry import register
from ...base.vocabulary import HIGH, LOW, SUFFIXES
from ...results.alternatives import (
    CHANGES,
    LEAST_EFFECTIVE,
    alternatives,
    at_published,
    effective_sizes,
    headline_variables,
    with_alternative,
)
from ...results.bands import FINEST_DB, INTERVAL, Band, written
from ...results.estimates import Estimate, effective_samples, estimate, sample_numbers
from ...results.sample_words import prior_words
from ...results.stored_study import (
    at_catalogue,
    balancers,
    catalogue_receiver,
    nearest_speed,
    source_name,
    speeds,
)
from ..blocks import Block, Definition, Definitions, Text
from ..tables import DataTable, Table, columns_of
from . import Section
from .sources.words import dominant_source
from .verdict.words import best_for_feet, by_effect

AS_REPORTED: Final = "as in this report"
SOURCE: Final = "dominant source"
LEVEL: Final = "level"
OPTIONS: Final = "options"
VIBRATION: Final = "vibration"
_NONE: Final = "none"
_EMPTY: Final = {_NONE, rounding.NOTHING}
"""Cells of columns that are not shown where all are such."""
_TERMS: Final = {
    LEVEL: "Level", SOURCE: "Dominant source", OPTIONS: "Options and level",
    VIBRATION: "Options and vibration",
}  # fmt: skip


class Row(NamedTuple):
    """Headlines with an input or law.

    Attributes
    ----------
    name : name of the alternative; `AS_REPORTED` for none
    sizes : effective sizes: samples of level and shares, and of changes by options
    level : level of the machine; None with too few samples
    source : dominant source
    share : share of the energy, of this source; None with too few samples
    changes : smallest and largest change by an option with its name; empty with too few samples
    claims : claims of the headlines, by headline, without numbers
    """

    name: str
    sizes: tuple[float, float]
    level: Estimate | None
    source: str
    share: Estimate | None
    changes: tuple[tuple[str, Estimate], ...]
    claims: dict[str, str]


def rows_of(results: xr.Dataset) -> list[Row]:
    """Return a row for the report itself, and one for each alternative."""
    sizes = effective_samples(results), float(sample_numbers(results).computed)
    headlines = headline_variables(results)
    reported = _row(headlines, AS_REPORTED, sizes)
    others = [
        _row(with_alternative(headlines, name), name, effective_sizes(headlines, name))
        for name in alternatives(results)
    ]
    claimed = [row._replace(claims=_level_claim(reported, row) | row.claims) for row in others]
    return [reported._replace(claims={LEVEL: "", **reported.claims}), *claimed]


def _row(results: xr.Dataset, name: str, sizes: tuple[float, float]) -> Row:
    reported = name == AS_REPORTED
    of_level, of_changes = (reported or size >= LEAST_EFFECTIVE for size in sizes)
    point = at_catalogue(results, speed=nearest_speed(results))
    level = share = None
    claims, source = {}, ""
    changes: tuple[tuple[str, Estimate], ...] = ()
    if of_level and (reported or at_published(results)):
        source, makes_most = dominant_source(results)
        level = estimate(results, "level_total", **point)
        share = estimate(results, "source_share", **point, sound_source=source)
        words = source_name(results, source)
        claims[SOURCE] = (
            f"the dominant source is {words}"
            if makes_most
            else f"the dominant source is not settled; {words} is the largest"
        )
    if of_changes and balancers(results):
        changes = _extremes(results)
        lower, higher = by_effect(results)
        claims[OPTIONS] = (
            f"{_names(lower)} is likely to lower the level, {_names(higher)} to raise it"
        )
        best, _ = best_for_feet(results)
        claims[VIBRATION] = f"{best or 'no option'} reduces the foot force most"
    return Row(name, sizes, level, source, share, changes, claims)


def _names(options: Sequence[str]) -> str:
    return " or ".join(sorted(options)) or "no option"


def _extremes(results: xr.Dataset) -> tuple[tuple[str, Estimate], ...]:
    """Options with the smallest and the largest median change of the level, at any speed."""
    receiver = catalogue_receiver(results)
    changes = [
        (
            option,
            estimate(
                results, CHANGES["level_total"], speed=speed, option=option, receiver=receiver
            ),
        )
        for option in balancers(results)
        for speed in speeds(results)
    ]
    ranked = sorted(changes, key=lambda named: named[1].value)
    return ranked[0], ranked[-1]


def _level_claim(reported: Row, row: Row) -> dict[str, str]:
    """Say that the level leaves the interval of the report; nothing without a level."""
    if row.level is None or reported.level is None:
        return {}
    low, _, high = reported.level
    written_level = _written_level(row.level, row).middle_text(rounding.level)
    return {LEVEL: "" if low <= row.level.value <= high else f"{written_level} dB(A)"}


def _written_level(level: Estimate, row: Row) -> Band:
    """Return a level with the digits that the samples of its row support."""
    return written(level, row.sizes[0], FINEST_DB)


def flips(reported: Row, row: Row) -> list[str]:
    """Return the headlines that say something else than in the report."""
    return [name for name, claim in row.claims.items() if claim != reported.claims.get(name)]


def alternative_words(results: xr.Dataset, name: str) -> str:
    """Return words for an alternative; a regime has them for a name."""
    measured = "spectrum_measured" in results
    priors = prior_words(results)
    other = f"unmodelled noise {priors[1]}" if len(priors) > 1 else name
    return {
        "level alone": "published level alone" if measured else "without published spectral share",
        "without the level": "without published level",
        "without the spectrum": "without measured spectrum",
        "no discrepancy": "model discrepancy of zero",
        "other prior": other,
    }.get(name, name)


def flip_list(results: xr.Dataset, rows: Sequence[Row]) -> Definitions:
    """Return each headline with the inputs and laws that flip it, and what it then says."""
    reported, *others = rows
    entries = []
    for name, term in _TERMS.items():
        if name not in reported.claims:
            continue
        changed: dict[str, list[str]] = {}
        tested = [row for row in others if name in row.claims]
        for row in tested:
            if name in flips(reported, row):
                inputs = changed.setdefault(row.claims[name], [])
                inputs.append(alternative_words(results, row.name))
        said = [f"{' or '.join(inputs)}: {claim}" for claim, inputs in changed.items()]
        verdict = "flips" if said else "holds" if tested else "not tested"
        untested = len(others) - len(tested)
        words = f"{_capital('; '.join(said))}." if said else ""
        words = words or (f"None of the {len(tested)} tested flips it." if tested else "")
        words += f" {untested} of {len(others)} cannot be tested." if untested else ""
        entries.append(Definition(term, verdict, words.strip()))
    return Definitions(tuple(entries))


def headline_table(results: xr.Dataset, rows: Sequence[Row]) -> Table:
    """Return level, dominant source and extreme changes with each input or law."""
    head = (
        "Input or law", "Level, dB(A)", "Dominant source, share of the energy",
        "Largest decrease by an option, dB", "Largest increase by an option, dB", "Flips",
    )  # fmt: skip
    caption = (
        f"One input or law changed; {catalogue_receiver(results)}, level and share at "
        f"{nearest_speed(results):g} rpm; {INTERVAL} in brackets"
    )
    cells = [_cells(results, rows[0], row) for row in rows]
    kept = [n for n in range(len(head)) if any(row[n] not in _EMPTY for row in cells)]
    shown = tuple(tuple(row[n] for n in kept) for row in cells)
    words = frozenset(range(len(kept))) - {1}
    return Table(caption, tuple(head[n] for n in kept), shown, words)


def _cells(results: xr.Dataset, reported: Row, row: Row) -> tuple[str, ...]:
    of_level, of_changes = row.sizes
    level = source = rounding.NOTHING
    if row.level is not None and row.share is not None:
        level = _written_level(row.level, row).middle_and_ends(rounding.level)
        share = written(row.share, of_level).in_percent()
        source = f"{source_name(results, row.source)} {share}"
    changes = [
        _change_words(option, change, of_changes, sign)
        for (option, change), sign in zip(row.changes, (-1.0, 1.0), strict=False)
    ] or [rounding.NOTHING] * 2
    if row is reported:
        return (AS_REPORTED, level, source, *changes, rounding.NOTHING)
    return (alternative_words(results, row.name), level, source, *changes, _verdict(reported, row))


def _change_words(option: str, change: Estimate, samples: float, sign: float) -> str:
    """Return an option with its change in dB; none where the change has the other sign."""
    if sign * change.value < 0.5 * FINEST_DB:
        return _NONE
    return f"{option} {written(change, samples, FINEST_DB).middle_and_ends(rounding.signed)}"


def _verdict(reported: Row, row: Row) -> str:
    """Headlines that flip, and what cannot be computed."""
    flipped = ", ".join(flips(reported, row))
    few = [size for size in row.sizes if size < LEAST_EFFECTIVE]
    if not few:
        return flipped or "no"
    effective = f"too few samples ({few[-1]:.0f} effective)"
    if len(few) == len(row.sizes):
        return _capital(effective)
    return f"{flipped or 'no'}; changes: {effective}"


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def _blocks(results: xr.Dataset) -> list[Block]:
    rows = rows_of(results)
    return [
        flip_list(results, rows),
        headline_table(results, rows),
        Text(
            "Each row reweights the samples of this run, at least "
            f"{LEAST_EFFECTIVE:g} effective. The level flips where its median leaves the "
            "interval of the report.",
            "note",
        ),
    ]


def _data(results: xr.Dataset) -> dict[str, DataTable]:
    """Return the table with all digits; a cell without a value is empty."""
    rows = rows_of(results)
    ends = ("", SUFFIXES[LOW], SUFFIXES[HIGH])
    head = [
        "input_or_law", "effective_samples", *(f"level_total{end}_dba" for end in ends),
        "dominant_source", *(f"share_of_energy{end}" for end in ends), "changes_effective_samples",
    ]  # fmt: skip
    for which in ("smallest", "largest"):
        head += [f"{which}_change_option", *(f"{which}_change_total{end}_db" for end in ends)]
    return {"alternatives.csv": columns_of([*head, "flips"], [_record(rows[0], r) for r in rows])}


def _record(reported: Row, row: Row) -> list[str | float]:
    changes = row.changes or (("", None), ("", None))
    of_options = [[option, *_numbers(change)] for option, change in changes]
    return [
        row.name, row.sizes[0], *_numbers(row.level), row.source, *_numbers(row.share),
        row.sizes[1], *of_options[0], *of_options[1], " ".join(flips(reported, row)),
    ]  # fmt: skip


def _numbers(value: Estimate | None) -> list[str | float]:
    """Value and ends of its interval; empty where it is missing."""
    return ["", "", ""] if value is None else [value.value, value.low, value.high]


register(
    Section(
        "alternatives",
        "What would change the answer",
        _blocks,
        lambda results: bool(alternatives(results)),
        32.0,
        tables=_data,
    )
)
