"""Analysis of a hammer test: hits, functions, and the files that other commands read."""

from typing import Final

import numpy as np

from ..measured.hammer_results import HammerFunction, HammerResults
from ..recordings import functions_csv, functions_uff
from ..report.analysis import Analysis
from ..report.blocks import Bullets, Part
from ..report.tables import DataTable, Table, columns_of
from ..results.claim_kinds import HAMMERED
from ..results.conditional import ConditionalClaim, Finding

GOOD_COHERENCE: Final = 0.95
_HITS: Final = ("file", "point", "time_s", "force_n", "omitted")
_METHOD: Final = (
    "functions.uff and functions.csv: H1 = S_yf / S_ff and coherence, for predict, "
    "blocked-forces and the test of the shell; functions_h2.uff: H2 = S_yy / S_fy.",
    "scatter.csv: standard deviation of the hits' own functions over H1.",
    "The force is zero after its pulse; responses have no window.",
)


def analysis_of_hammer(test: HammerResults) -> Analysis:
    """Return hits and functions of a hammer test, with their files."""
    used = sum(not hit.omitted for hit in test.hits)
    first = test.pairs[0].h1.frequency_hz
    summary = (
        f"{len(test.pairs)} functions from {used} of {len(test.hits)} hits, blocks of "
        f"{test.block_s:.3g} s, {first[0]:.3g} to {first[-1]:.4g} Hz.",
        *test.remarks,
    )
    functions, hits = _functions(test), _hits(test)
    further = {
        "functions.uff": functions_uff(test.functions),
        "functions.csv": functions_csv(test.functions),
        "functions_h2.uff": functions_uff([pair.h2 for pair in test.pairs]),
    }
    faults = Bullets(test.faults or ("No window is too short, and no recorder's window shows.",))
    return Analysis(
        name="hammer",
        title=test.title,
        kind="Hammer test",
        created="",
        about="Frequency responses from time records of force and response.",
        parts=(
            Part("functions", "Functions", (functions,)),
            Part("hits", "Hits", (hits,)),
            Part("faults", "Faults of the records", (faults,)),
            Part("method", "Method", (Bullets(_METHOD),)),
        ),
        summary=summary,
        shown=(functions, *((hits,) if used < len(test.hits) else ())),
        tables={"hits.csv": _rows(test), "scatter.csv": _scatter(test)},
        claims=(_claim(test, summary[0]),),
        further=further,
    )


def _claim(test: HammerResults, statement: str) -> ConditionalClaim:
    """Functions, which need several hits of each point and sound records."""
    single = [pair.h1.label for pair in test.pairs if pair.hits < 2]
    findings = {
        "hits": Finding(", ".join(single) or "every point", not single),
        "records": Finding(str(len(test.faults)), not test.faults),
    }
    return HAMMERED.claim(statement, findings)


def _rows(test: HammerResults) -> DataTable:
    rows = [
        (hit.file, str(hit.reference), hit.time_s, hit.force_n, hit.omitted) for hit in test.hits
    ]
    return columns_of(_HITS, rows)


def _scatter(test: HammerResults) -> DataTable:
    """Scatter of each function over frequency; empty of one hit."""
    heads = ("frequency_hz", *(pair.h1.label for pair in test.pairs))
    columns = [test.pairs[0].h1.frequency_hz, *(pair.scatter for pair in test.pairs)]
    table = np.column_stack(columns)
    rows = [tuple("" if np.isnan(each) else each for each in row) for row in table.tolist()]
    return columns_of(heads, rows)


def _functions(test: HammerResults) -> Table:
    head = ("Function", "hits", "coherence above 0.95, %", "scatter, median, %", "H2/H1, median")
    return Table("Functions", head, tuple(map(_function, test.pairs)), frozenset({0}))


def _function(pair: HammerFunction) -> tuple[str, ...]:
    ratio = f"{np.median(np.abs(pair.h2.values / pair.h1.values)):.3f}"
    if pair.hits == 1:
        return pair.h1.label, "1", "–", "–", ratio
    good = 100.0 * np.mean(pair.coherence > GOOD_COHERENCE)
    scatter = 100.0 * float(np.median(pair.scatter))
    return pair.h1.label, str(pair.hits), f"{good:.0f}", f"{scatter:.2g}", ratio


def _hits(test: HammerResults) -> Table:
    head = ("Hit", "point", "s", "N", "omitted")
    rows = tuple(
        (hit.file, str(hit.reference), f"{hit.time_s:.3f}", f"{hit.force_n:.3g}", hit.omitted)
        for hit in test.hits
    )
    return Table("Hits", head, rows, frozenset({0, 1, 4}))
