"""Page of `permit`: verdicts, and calculations that a clerk can repeat line by line."""

from collections.abc import Iterator, Mapping
from datetime import UTC, datetime
from typing import Final

import numpy as np

from ...base import rounding
from ...permits.file import LabelLimit, PermitFile, label_limits
from ...permits.rule import PermitRule
from ...permits.verdict import FARTHEST_M, PermitVerdict, judged
from ...report.analysis import Analysis
from ...report.blocks import Bullets, Part
from ...report.tables import DataTable, Table, columns_of
from ...results.claim_kinds import LEAST_DISTANCE, PROBABILITY
from ...results.conditional import ConditionalClaim, Finding, stated

_ABOUT: Final = "Units at windows, judged by the rules of authorities."
_HEAD: Final = (
    "Window", "Rule", "Level, dB(A)", "Limit, dB(A)", "Spare, dB", "Met", "Probability",
    "Least distance, m", "Of it by tones, m",
)  # fmt: skip
_VERDICTS: Final = (
    "window", "rule", "level_dba", "limit_dba", "spare_db", "met", "probability",
    "least_distance_m", "tone_m",
)  # fmt: skip
_LINES: Final = ("window", "line", "text", "value", "unit")
_LABELS: Final = ("unit", "law", "limit_dba", "met", "probability")


def analysis_of_permit(file: PermitFile) -> Analysis:
    """Return verdicts, their calculations, and limits of the sound power by law.

    Parameters
    ----------
    file : units and windows
    """
    verdicts = {name: judged(file.units, window) for name, window in file.windows.items()}
    rules = {name: next(iter(window.values())) for name, window in file.windows.items()}
    labels = {name: label_limits(unit) for name, unit in file.units.items()}
    deviation_db = max(unit.deviation_db for unit in file.units.values())
    table = _verdict_table(verdicts, rules)
    blocks = [table, *([_label_table(labels)] if any(labels.values()) else [])]
    parts = (
        Part("verdicts", "Verdicts", tuple(blocks)),
        *(
            Part(f"calculation_{number}", f"Calculation: {name}", (_calculation(verdict),))
            for number, (name, verdict) in enumerate(verdicts.items(), start=1)
        ),
        Part("rules", "Rules and editions", (Bullets(tuple(_editions(rules))),)),
    )
    return Analysis(
        "permit",
        file.title,
        "Permit",
        f"{datetime.now(UTC):%Y-%m-%d %H:%M} UTC",
        _ABOUT,
        parts,
        summary=tuple(_headlines(verdicts, deviation_db)),
        claims=tuple(_claims(verdicts, deviation_db)),
        shown=tuple(blocks),
        tables=_data_tables(verdicts, rules, labels),
    )


def _claims(
    verdicts: Mapping[str, PermitVerdict], deviation_db: float
) -> Iterator[ConditionalClaim]:
    """Probability and least distance of every window."""
    deviation = Finding(f"{deviation_db:g} dB", deviation_db > 0.0)
    for name, verdict in verdicts.items():
        chance = f"met with a probability of {100.0 * verdict.probability:.0f} %"
        yield PROBABILITY.claim(chance, {"deviation": deviation}, name)
        is_near = not np.isnan(verdict.least_distance_m)
        words = "within" if is_near else "not within"
        distance = Finding(f"{words} {FARTHEST_M / 1000.0:g} km", is_near)
        metres = f"met from {_metres(verdict.least_distance_m)} m on"
        yield LEAST_DISTANCE.claim(metres, {"distance": distance}, name)


def _headlines(verdicts: Mapping[str, PermitVerdict], deviation_db: float) -> Iterator[str]:
    """The window with the least to spare, then how many meet their limits."""
    name, worst = min(verdicts.items(), key=lambda each: each[1].spare_db)
    chance, distance = _claims({name: worst}, deviation_db)
    is_met = "" if chance.is_withdrawn else "the limit is "
    words = "to spare" if worst.is_met else "too much"
    yield (
        f"{name}: {rounding.fixed(worst.level_dba)} dB(A) for a limit of "
        f"{rounding.fixed(worst.limit_dba)}, {rounding.fixed(abs(worst.spare_db))} dB {words}; "
        f"{is_met}{stated(chance)}."
    )
    met = sum(verdict.is_met for verdict in verdicts.values())
    is_near = "That one has " if distance.is_withdrawn else "That one is "
    yield f"{met} of {len(verdicts)} windows meet their limits. {is_near}{stated(distance)}."


def _verdict_table(verdicts: Mapping[str, PermitVerdict], rules: Mapping[str, PermitRule]) -> Table:
    rows = tuple(
        (
            name,
            rules[name].title,
            rounding.fixed(verdict.level_dba),
            rounding.fixed(verdict.limit_dba),
            rounding.fixed(verdict.spare_db),
            _met(verdict.is_met),
            f"{verdict.probability:.2f}",
            _metres(verdict.least_distance_m),
            _metres(verdict.tone_m),
        )
        for name, verdict in verdicts.items()
    )
    return Table("Level at each window", _HEAD, rows, frozenset({0, 1}))


def _metres(distance_m: float) -> str:
    return rounding.NOTHING if np.isnan(distance_m) else f"{distance_m:.1f}"


def _met(is_met: bool) -> str:
    return "yes" if is_met else "no"


def _label_table(labels: Mapping[str, list[LabelLimit]]) -> Table:
    rows = tuple(
        (name, each.law, rounding.fixed(each.limit_dba), _met(each.is_met),
         f"{each.probability:.2f}")
        for name, limits in labels.items()
        for each in limits
    )  # fmt: skip
    head = ("Unit", "Law", "Limit of L_WA, dB(A)", "Met", "Probability")
    return Table("Sound power by law", head, rows, frozenset({0, 1}))


def _calculation(verdict: PermitVerdict) -> Table:
    rows = tuple(
        (f"{number}. {line.text}", rounding.fixed(line.value, 2), line.unit)
        for number, line in enumerate(verdict.lines, start=1)
    )
    return Table("Line by line", ("Quantity", "Value", "Unit"), rows)


def _editions(rules: Mapping[str, PermitRule]) -> Iterator[str]:
    for rule in {rule.kind: rule for rule in rules.values()}.values():
        yield f"{rule.title}: {rule.edition}. {rule.limits}".strip()
    yield "Probabilities: the level is normal with the stated deviation of the units."


def _data_tables(
    verdicts: Mapping[str, PermitVerdict],
    rules: Mapping[str, PermitRule],
    labels: Mapping[str, list[LabelLimit]],
) -> dict[str, DataTable]:
    of_windows = [
        (name, rules[name].kind, each.level_dba, each.limit_dba, each.spare_db, _met(each.is_met),
         each.probability, each.least_distance_m, each.tone_m)
        for name, each in verdicts.items()
    ]  # fmt: skip
    lines = [
        (name, float(number), line.text, line.value, line.unit)
        for name, verdict in verdicts.items()
        for number, line in enumerate(verdict.lines, start=1)
    ]
    of_units = [
        (name, each.law, each.limit_dba, _met(each.is_met), each.probability)
        for name, limits in labels.items()
        for each in limits
    ]
    return {
        "verdicts.csv": columns_of(_VERDICTS, of_windows),
        "calculation.csv": columns_of(_LINES, lines),
        **({"sound_power.csv": columns_of(_LABELS, of_units)} if of_units else {}),
    }
