"""Claims: computed values beside references, each within its tolerance and as it is committed.

`pytest --evidence` writes the rows down; else a claim fails where its row has changed: another
verdict, reference, tolerance or source, or a share of the tolerance that moved by more than 0.1.
"""

import os
from collections.abc import Iterable
from typing import Final, Literal, NamedTuple

import numpy as np
from documents import Source
from numpy.typing import ArrayLike

from vibroacoustics.results.claims import MET, MISSED, Claim, claims

Kind = Literal["exact", "printed", "second code", "recording"]
DRIFT: Final = 0.1
"""Of the share of a tolerance."""
CLOSER: Final = 1.01
"""Tolerances by which a shifted reference is moved away from the computed value."""


class Settings:
    """What the command line asks of claims."""

    writes = False
    shifted: frozenset[str] = frozenset()


SETTINGS: Final = Settings()
MADE: Final[list[Claim]] = []
"""Claims of the running test."""


class Compared(NamedTuple):
    """The pair of values that is furthest apart, and its distance in tolerances."""

    computed: float
    reference: float
    tolerance: float
    share: float


def claim(
    what: str,
    *,
    computed: ArrayLike,
    reference: ArrayLike,
    tolerance: ArrayLike,
    unit: str,
    source: Source,
    kind: Kind,
    topics: Iterable[str],
    missed: str = "",
) -> None:
    """Check |computed - reference| <= tolerance; of arrays the worst element becomes the row.

    `what` names the row: no two claims share it. `missed` is the reason of a known miss, whose
    distance must be larger than the tolerance. `topics` are keys of tables and kinds of a study
    that leans on the claim.
    """
    pair = compared(computed, reference, tolerance, what in SETTINGS.shifted)
    single = np.ndim(computed) == np.ndim(reference) == 0
    met = pair.share <= 1.0
    if met == bool(missed):
        wanted = "is missed" if missed else "is met"
        raise AssertionError(f"{what}: {_numbers(pair, unit)}: not so that the claim {wanted}")
    row = Claim(
        what=what,
        kind=kind,
        document=source.document.name,
        passage=source.passage,
        reference=_to(pair.reference, pair.tolerance),
        computed=_to(pair.computed, pair.tolerance),
        unit=unit,
        tolerance=float(f"{pair.tolerance:.3g}"),
        share=round(pair.share, 1),
        verdict=MISSED if missed else MET,
        reason=missed,
        test=os.environ["PYTEST_CURRENT_TEST"].rpartition(" (")[0],
        topics=tuple(sorted(topics)),
    )
    if what in {made.what for made in MADE}:
        raise AssertionError(f"{what}: claimed twice")
    MADE.append(row)
    if not SETTINGS.writes:
        _check_drift(row, pair, single)


def compared(
    computed: ArrayLike, reference: ArrayLike, tolerance: ArrayLike, shifted: bool = False
) -> Compared:
    """Return the pair that is furthest apart; magnitudes of complex ones.

    A shifted reference is moved by `CLOSER` tolerances away from the computed value.
    """
    ours, theirs, allowed = np.broadcast_arrays(computed, reference, tolerance)
    if ours.size == 0 or not np.all(allowed > 0.0):
        raise AssertionError("a claim needs values and tolerances above zero")
    if shifted:
        away = np.where(ours == theirs, -1.0, theirs - ours)
        theirs = theirs + CLOSER * allowed * away / np.abs(away)
    shares = np.abs(ours - theirs) / allowed
    worst = np.unravel_index(np.argmax(shares), shares.shape)  # of NaN the first

    def real(values: np.ndarray) -> float:
        return float(np.abs(values[worst]) if np.iscomplexobj(values) else values[worst])

    return Compared(real(ours), real(theirs), real(allowed), real(shares))


def _to(value: float, tolerance: float) -> float:
    """A value to a hundredth of its tolerance."""
    return round(value, 2 - int(np.floor(np.log10(tolerance)))) + 0.0


def _numbers(pair: Compared, unit: str) -> str:
    return (
        f"computed {pair.computed:.9g}, reference {pair.reference:.9g}, tolerance "
        f"{pair.tolerance:.3g} {unit}, share {pair.share:.3g}"
    )


def _check_drift(row: Claim, pair: Compared, single: bool) -> None:
    """Fail where the committed row says something else.

    Which of many values is the worst may be rounding noise: their references are not compared.
    """
    committed = {each.what: each for each in claims()}.get(row.what)
    if committed is None:
        raise AssertionError(f"{row.what}: no such row in evidence.json; run make evidence")
    same = ("kind", "document", "passage", "unit", "verdict", "reason", "test", "topics")
    changed = [name for name in same if getattr(row, name) != getattr(committed, name)]
    if single and abs(pair.reference - committed.reference) > DRIFT * pair.tolerance:
        changed.append("reference")
    if single and abs(pair.tolerance / committed.tolerance - 1.0) > 0.01:
        changed.append("tolerance")
    if abs(pair.share - committed.share) > DRIFT:
        changed.append("share")
    if changed:
        raise AssertionError(
            f"{row.what}: {', '.join(changed)} differ from evidence.json, where the share is "
            f"{committed.share:g}: {_numbers(pair, row.unit)}; look why, then run make evidence"
        )
