"""A scoring criterion: its name, its words, and how results give its value."""

from typing import ClassVar, Final

import xarray as xr

from ..base.errors import ParameterError
from ..base.registry import LAST, Registry
from ..base.units import split_key


class Criterion:
    """Criterion by which options are scored; a further one is one file of `scoring.criteria`.

    Class and registry lie here, not in `scoring`: a study refuses the name of an unknown
    criterion when it is loaded, and parameters import no stage.

    Examples
    --------
    >>> class SecondForce(va.Criterion):
    ...     name = "force_2x_n"
    ...     label = "Largest force at twice the speed"
    ...     def value(self, results):
    ...         return results["force_amplitude"].sel(order=2).max("speed")
    >>> SecondForce().value(va.open_results("results.nc")).dims
    ('option',)
    >>> class LargestLevel(va.Criterion):
    ...     name = "level_total_dba"
    ...     variable = "level_total"
    >>> LargestLevel().value(va.open_results("results.nc")).dims
    ('option',)
    """

    name: ClassVar[str]
    """Key in study files; it ends in the unit."""
    label: ClassVar[str] = ""
    """Plain words, without the unit; those of the name where it is empty."""
    unit: ClassVar[str] = ""
    """Symbol of the unit; that of the name's suffix where it is empty."""
    position: ClassVar[float] = LAST
    """Place among the criteria, which the random weightings follow."""
    variable: ClassVar[str] = ""
    """Variable of results whose largest value of an option is the value, where `value` is not
    overridden."""
    table: ClassVar[str] = ""
    """Table of a study without which there is no value; empty where every study has one."""

    def value(self, results: xr.Dataset) -> xr.DataArray:
        """Value of each option, over the dimension `option`; worst over the speeds.

        Parameters
        ----------
        results : dataset of a run, without scores

        Raises
        ------
        ParameterError
            The results do not hold the variable.
        """
        if self.variable not in results:
            needed = f"; {self.needed}" if self.table else ""
            raise ParameterError(f"{self.name}: the results have no {self.variable}{needed}")
        return _largest(results[self.variable], "option")

    def by_sample(self, results: xr.Dataset) -> xr.DataArray | None:
        """Value of each option in each sample, over `sample`, `option`; none where it is the same.

        Parameters
        ----------
        results : dataset of a run with samples, without scores; not a number in samples that do not
            count
        """
        name = f"{self.variable}_by_sample"
        return _largest(results[name], "sample", "option") if name in results else None

    @property
    def needed(self) -> str:
        """Needs of a study without the table, in words."""
        return f"needs the table [{self.table}] in the study"


def _largest(values: xr.DataArray, *kept: str) -> xr.DataArray:
    """Largest of values over all dimensions but those that are kept."""
    largest: xr.DataArray = values.max([dim for dim in values.dims if dim not in kept])
    return largest


def label_and_unit(name: str, label: str = "", unit: str = "") -> tuple[str, str]:
    """Return label and unit of a criterion, those of its name where they are empty.

    Parameters
    ----------
    name : key in study files
    label, unit : label and unit of the criterion
    """
    stem, suffix = split_key(name)
    words = label or stem.replace("_", " ").capitalize()
    return words, unit or (suffix.symbol if suffix else "")


CRITERIA: Final[Registry[type[Criterion]]] = Registry(
    "criterion", Criterion, "name", "scoring.criteria", "vibroacoustics.criteria"
)
"""Criteria that are computed from the results, by name."""
