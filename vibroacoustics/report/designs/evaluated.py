"""Designs of a search as the report shows them: labelled columns of what was varied and wanted."""

import json
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import xarray as xr

from ...base.arrays import Array, IndexArray
from ...base.units import split_key
from ..tables import DataTable, cell

Mask = npt.NDArray[np.bool_]


@dataclass(frozen=True)
class Column:
    """One quantity of all designs.

    Attributes
    ----------
    label : label of the variable
    unit : unit of its values; empty for a number or a choice
    values : shape (design,); of a choice the number among its words; not a number where a design
        has no such value
    words : words of a choice
    """

    label: str
    unit: str
    values: Array
    words: tuple[str, ...] = ()

    @property
    def heading(self) -> str:
        """Label with its unit."""
        return heading(self.label, self.unit)

    def cell(self, design: int) -> str:
        """One value in words."""
        value = float(self.values[design])
        if np.isnan(value):
            return "–"
        return self.words[round(value)] if self.words else f"{value:.4g}"


@dataclass(frozen=True)
class Evaluated:
    """Designs with what was asked of them.

    Attributes
    ----------
    variables, objectives : columns
    met : which designs meet every constraint, shape (design,)
    front : designs of these of which none is better in every objective, shape (design,)
    best : numbers of the best few, the first one first, shape (best,)
    """

    variables: tuple[Column, ...]
    objectives: tuple[Column, ...]
    met: Mask
    front: Mask
    best: IndexArray

    @property
    def count(self) -> int:
        """Number of designs."""
        return len(self.met)


def heading(name: str, unit: str) -> str:
    """A name with its unit."""
    return f"{name}, {unit}" if unit else name


def designs_data(search: xr.Dataset) -> DataTable:
    """A line a design: its values by dotted key, objectives and constraints, whether allowed."""
    choices = json.loads(search.attrs["choices"])
    generation = search["search_generation"].values.tolist()
    table = {"design": list(range(len(generation))), "generation": generation}
    for key, column in zip(
        search["design_variable"].values, search["design_value"].values.T, strict=True
    ):
        words = choices.get(str(key))
        table[str(key)] = [words[round(v)] if words else cell(v) for v in column.tolist()]
    for name, unit, column in zip(
        search["wanted"].values,
        search["wanted_unit"].values,
        search["wanted_value"].values.T,
        strict=True,
    ):
        table[f"{name} ({unit})" if unit else str(name)] = [*map(cell, column.tolist())]
    judged = ("meets_constraints", "on_front")
    return table | {name: search[name].values.tolist() for name in judged}


def evaluated(search: xr.Dataset) -> Evaluated:
    """Columns of the variables, objectives and constraints of a search of designs."""
    return Evaluated(
        variables_of(search, "design_value"),
        objectives_of(search, "wanted_value"),
        search["meets_constraints"].values == 1,
        search["on_front"].values == 1,
        search["best_design"].values.astype(np.intp),
    )


def variables_of(search: xr.Dataset, name: str) -> tuple[Column, ...]:
    """Columns of the variables of the designs in a variable of the dataset."""
    choices = json.loads(search.attrs["choices"])
    return tuple(
        Column(
            variable_label(str(key)),
            str(search["design_unit"].values[number]),
            search[name].values[:, number],
            tuple(map(str, choices.get(str(key), ()))),
        )
        for number, key in enumerate(search["design_variable"].values)
    )


def objectives_of(search: xr.Dataset, name: str) -> tuple[Column, ...]:
    """Columns of the objectives of the designs in a variable of the dataset."""
    return tuple(
        Column(
            str(search["wanted"].values[number]),
            str(search["wanted_unit"].values[number]),
            search[name].values[:, number],
        )
        for number, role in enumerate(search["wanted_role"].values)
        if role in ("least", "greatest")
    )


def variable_label(key: str) -> str:
    """A dotted key in words: `options.weight.mass_g` is `weight: mass`."""
    *tables, last = key.split(".")
    stem = split_key(last)[0].replace("_", " ")
    return f"{tables[-1].replace('_', ' ')}: {stem}" if len(tables) > 1 else stem
