"""A scoring criterion: its name, its words, and how results give its value."""

from typing import ClassVar, Final

import xarray as xr

from ..base.registry import LAST, Registry


class Criterion:
    """What options are scored by; a further one is one file of `scoring.criteria`.

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
    """

    name: ClassVar[str]
    """Key in study files; it ends in the unit."""
    label: ClassVar[str] = ""
    """Plain words, without the unit; those of the name where it is empty."""
    unit: ClassVar[str] = ""
    """Symbol of the unit; that of the name's suffix where it is empty."""
    position: ClassVar[float] = LAST
    """Place among the criteria, which the random weightings follow."""

    def value(self, results: xr.Dataset) -> xr.DataArray:
        """Value of each option, over the dimension `option`; worst over the speeds.

        Parameters
        ----------
        results : dataset of a run, without scores
        """
        raise NotImplementedError

    def by_sample(self, results: xr.Dataset) -> xr.DataArray | None:
        """Value of each option in each sample, over `sample`, `option`; none where it is the same.

        Parameters
        ----------
        results : dataset of a run with samples, without scores; not a number in samples that do not
            count
        """
        return None


CRITERIA: Final[Registry[type[Criterion]]] = Registry(
    "criterion", Criterion, "name", "scoring.criteria", "vibroacoustics.criteria"
)
"""Criteria that are computed from the results, by name."""
