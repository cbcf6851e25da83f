"""Functions of an option's values in which its loads and figures are linear."""

from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import ClassVar, Final

import numpy as np

from ...base.arrays import Array
from ...base.errors import ParameterError, SolverError
from ...base.registry import Registry
from ...machine.machine import Machine


class ClosedForm:
    """Closed form of the loads of a kind of option; every form is tested before it is used.

    A further one is one file of `design.engine.closed_forms`, or of a plug-in. Options without
    one are computed run by run where they are not linear by themselves.
    """

    kind: ClassVar[str]
    """Kind of the option."""
    fields: ClassVar[tuple[str, ...]]
    """Values of the option, in SI, on which the functions depend."""
    size: ClassVar[int]
    """Number of functions."""

    def functions(self, values: Mapping[str, float], machine: Machine, speed_rpm: float) -> Array:
        """Functions of one design, shape (size,).

        Raises
        ------
        ParameterError
            It cannot be built so.
        """
        raise NotImplementedError


CLOSED_FORMS: Final[Registry[type[ClosedForm]]] = Registry(
    "closed form", ClosedForm, "kind", "design.engine.closed_forms", "vibroacoustics.closed_forms"
)


def of_many(function: Callable[[Array], Array], values: Array, size: int) -> Array:
    """Evaluate a function for many designs, shape (design, function); each different one once.

    The result is not a number where a design cannot be built.

    Parameters
    ----------
    function : function of the values of one design, shape (variable,)
    values : values of the designs, shape (design, variable), SI
    size : number of results of the function
    """
    different, rows = np.unique(values, axis=0, return_inverse=True)
    results = np.full((len(different), size), np.nan)
    for row, design in zip(results, different, strict=True):
        with suppress(ParameterError, SolverError):
            row[:] = function(design)
    return results[rows.ravel()]
