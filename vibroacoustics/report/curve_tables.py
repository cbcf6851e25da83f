"""A machine's inner curve as a table: what its picture shows, in the same units."""

from itertools import product

import xarray as xr

from ..base.curve_dataset import axis_words, is_words, shown, shown_label
from .tables import to_csv


def curve_csv(curves: xr.Dataset, name: str) -> bytes:
    """The abscissa, then a column for each line of each panel, in the unit of the picture.

    Parameters
    ----------
    curves : of `vibroacoustics.curves`
    name : of the variable
    """
    curve = curves[name]
    *parting, last = (curve[dim] for dim in curve.dims)
    columns = shown(curve).reshape(-1, last.size).T
    label = shown_label(curve)
    lines = [" ".join(words) for words in product(*map(axis_words, parting))]
    head = [f"{label}: {line}" if line else label for line in lines]
    abscissa = axis_words(last) if is_words(last) else shown(last).tolist()
    rows = ([first, *row.tolist()] for first, row in zip(abscissa, columns, strict=True))
    return to_csv((shown_label(last), *head), rows)
