"""Best and worst option by each quantity, of those that the verdicts call better or worse."""

from typing import Final

import xarray as xr

from ....base.vocabulary import REFERENCE_OPTION
from ....results.estimates import has_samples
from ....results.stored_study import balancers, catalogue_receiver, options
from ...column_values import column
from ...quantities import JUDGED, Quantity
from ...shifts import at_receiver, shift
from ...tables import Table

NONE_MEASURABLE: Final = "none that could be measured"


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
    values = "; medians of the weighted samples" if has_samples(results) else ""
    return Table(
        f"Best and worst, levels at {catalogue_receiver(results)}{values}",
        head,
        rows,
        frozenset({0, 1, 2, 3}),
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
    """Largest value over the speeds by option."""
    values = at_receiver(column(results, quantity.column), catalogue_receiver(results))
    return {name: float(values.sel(option=name).max()) for name in options(results)}
