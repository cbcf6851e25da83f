"""Analysis of a machine's inner curves: tables with what the pictures show, in the same units."""

from itertools import product

import xarray as xr

from ..base.curves import axis_words, is_words, shown, shown_label
from .analysis import Analysis, origin
from .blocks import Bullets, Part, Pictures
from .figures.curves import curve_charts
from .tables import DataTable, columns_of


def analysis_of_curves(curves: xr.Dataset) -> Analysis:
    """Return the analysis of a machine's inner curves."""
    lines = [f"{name}: {curve.attrs['title']} ({curve.attrs['source']})" for name, curve in
             curves.items()]  # fmt: skip
    return Analysis(
        "curves",
        **origin(curves, str(curves.attrs["machine"])),
        about="Inner quantities of the machine.",
        parts=(
            Part("curves", "Curves", (Pictures(tuple(curve_charts(curves))),)),
            Part("sources", "Where they come from", (Bullets(tuple(lines)),)),
        ),
        shown=(Bullets(tuple(lines)),),
        tables={f"{name}.csv": _curve(curve) for name, curve in curves.items()},
    )


def _curve(curve: xr.DataArray) -> DataTable:
    """Return the abscissa, then a column for each line of each panel."""
    *parting, last = (curve[dim] for dim in curve.dims)
    columns = shown(curve).reshape(-1, last.size).T
    label = shown_label(curve)
    lines = [" ".join(words) for words in product(*map(axis_words, parting))]
    head = [f"{label}: {line}" if line else label for line in lines]
    abscissa = axis_words(last) if is_words(last) else shown(last).tolist()
    rows = ([first, *row.tolist()] for first, row in zip(abscissa, columns, strict=True))
    return columns_of((shown_label(last), *head), rows)
