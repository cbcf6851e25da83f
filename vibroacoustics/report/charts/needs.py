"""Needs of a chart of its dataset."""

from collections.abc import Callable
from functools import wraps
from inspect import cleandoc, signature
from typing import TYPE_CHECKING, Any, TypeVar, cast

import xarray as xr

from ...base.errors import ParameterError
from ...base.vocabulary import VARIABLES
from ...results.titles import titled
from .marks import Chart

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Maker = TypeVar("Maker", bound=Callable[..., Any])


def needs(*variables: str, from_: str = "`run`", any_of: bool = False) -> Callable[[Maker], Maker]:
    """Refuse, in one line, a dataset without all or any of the variables that a chart needs."""

    def guarded(make: Maker) -> Maker:
        @wraps(make)
        def checked(results: xr.Dataset, *args: Any, **kwargs: Any) -> Any:
            missing = [name for name in variables if name not in results]
            for name in missing:
                if not any_of or len(missing) == len(variables):
                    raise ParameterError(
                        f"plot.{make.__name__}: these results hold no {name} "
                        f"({VARIABLES[name].long_name}); it comes from {from_}"
                    )
            return make(titled(results), *args, **kwargs)

        return cast(Maker, checked)

    return guarded


def plotted(make: Callable[..., Chart], file: str = "results.nc") -> "Callable[..., Figure]":
    """Return a function that plots with matplotlib the chart that another returns for a dataset."""

    @wraps(make)
    def plot(*args: Any, **kwargs: Any) -> "Figure":
        from .figure import figure

        return figure(make(*args, **kwargs))

    plot.__signature__ = signature(make).replace(  # type: ignore[attr-defined]
        return_annotation="matplotlib.figure.Figure"
    )
    plot.__doc__ = f"""{cleandoc(make.__doc__ or "")}

Returns
-------
figure of matplotlib, which belongs to no window

Raises
------
ParameterError
    The dataset holds none of what is drawn, or a label is not among its own.

Examples
--------
>>> dataset = va.open_results("{file}")
>>> va.plot.{make.__name__}(dataset).savefig("{make.__name__}.png")
"""
    return plot
