"""A number with its meaning: what tables and sentences print, and JSON gives to programs."""

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, field
from typing import Any, Final

import xarray as xr

from ..base.vocabulary import NOMINAL, VARIABLES
from .estimates import Estimate, estimate, has_samples, is_sampled
from .titles import option_names

VALUE: Final = "value"
"""Statistic of what no samples were computed of: measured and derived values."""


@dataclass(frozen=True)
class Number:
    """A value with its unit, what it is of, and the text that is printed.

    Attributes
    ----------
    value : in the unit
    unit : empty for a pure number
    variable : name in the vocabulary
    selection : label of each dimension of the variable; of options their names, not titles
    statistic : value, nominal, or the median or mean of samples
    low, high : ends of its interval; None for none
    text : rounded, with the interval where it is printed
    """

    value: float
    unit: str
    variable: str
    selection: Mapping[str, Any] = field(default_factory=dict, hash=False)
    statistic: str = VALUE
    low: float | None = None
    high: float | None = None
    text: str = ""

    def __str__(self) -> str:
        return self.text

    def data(self) -> dict[str, Any]:
        """Return the number as plain values for JSON."""
        return asdict(self)


def number(
    results: xr.Dataset,
    variable: str,
    write: Callable[[Estimate], str],
    unit: str = "",
    **selection: Any,
) -> Number:
    """Return the estimate of a variable as a number.

    Parameters
    ----------
    results : results of a run or of an analysis
    variable : name in the vocabulary
    write : gives the text of an estimate
    unit : that of the vocabulary where none is given
    selection : a label of each of its dimensions; those of others are not used
    """
    value_with_ends = estimate(results, variable, **selection)
    sampled = is_sampled(results, variable)
    unsampled = NOMINAL if has_samples(results) else VALUE
    labels = {str(dim): _plain(selection[str(dim)]) for dim in results[variable].dims}
    if "option" in labels:
        option = labels["option"]
        labels["option"] = option_names(results).get(str(option), option)
    return Number(
        value=value_with_ends.value,
        unit=unit or str(results[variable].attrs.get("units", "")),
        variable=variable,
        selection=labels,
        statistic=VARIABLES[variable].statistic if sampled else unsampled,
        low=value_with_ends.low if sampled else None,
        high=value_with_ends.high if sampled else None,
        text=write(value_with_ends),
    )


def _plain(label: Any) -> str | float:
    plain: str | float = label.item() if hasattr(label, "item") else label
    return plain
