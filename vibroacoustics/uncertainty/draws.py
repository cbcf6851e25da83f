"""All draws side by side, and their values."""

import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

import numpy as np
import xarray as xr

from ..base.errors import ParameterError, SolverError
from ..base.fault import FaultError
from ..base.linear_algebra import one_thread_of_linear_algebra
from ..base.processes import side_by_side
from ..base.threads import processors
from ..base.vocabulary import stamped
from ..study.sampling import Draw
from ..study.uncertainty import Range

Result = TypeVar("Result")


def of_every_draw(
    draws: Sequence[Draw],
    compute: Callable[[Draw], Result],
    without_solution: Result,
    progress: Callable[[int], None],
) -> list[Result]:
    """Compute a result of every sample, in their order; one warning counts those without solution.

    Results do not depend on the number of processors: a sample shares nothing with others.

    Parameters
    ----------
    draws : sets of values
    compute : called with one of them, in several processes or threads at once; gives what pickle
        takes
    without_solution : in place of the result of a draw with which the machine cannot run
    progress : called with the number of draws that are done
    """

    def solved(draw: Draw) -> tuple[Result, str | None]:
        try:
            return compute(draw), None
        except (
            ParameterError,
            SolverError,
            FaultError,
        ) as error:  # whose frames would hold all it computed
            return without_solution, str(error)

    results: list[Result] = []
    failures: list[str] = []
    progress(0)
    for result, failure in _in_parallel(solved, draws):
        results.append(result)
        failures += [] if failure is None else [f"draw {len(results)}: {failure}"]
        progress(len(results))
    if failures:
        warnings.warn(
            f"{len(failures)} of {len(draws)} draws have no solution and are left out, such as: "
            f"{failures[0]}",
            stacklevel=2,
        )
    return results


def _in_parallel(compute: Callable[[Draw], Result], draws: Sequence[Draw]) -> Iterator[Result]:
    """Compute in processes, which share no interpreter's lock, or in threads."""
    with one_thread_of_linear_algebra(), ThreadPoolExecutor(processors()) as threads:
        yield from side_by_side(compute, draws, threads.map)


def drawn_values(ranges: Sequence[Range], draws: Sequence[Draw]) -> xr.Dataset:
    """The values of all draws, labelled."""
    names = [limits.name for limits in ranges]
    values = [[draw[limits.table, limits.field] for limits in ranges] for draw in draws]
    coords = {"draw": np.arange(1, len(draws) + 1), "drawn_parameter": names}
    return stamped({"drawn_value": values}, coords)


def errors_of_projection(ranges: Sequence[Range], errors: Mapping[str, float]) -> xr.Dataset:
    """Errors of the values that are drawn by projection on modes, empty for others, labelled."""
    names = [limits.name for limits in ranges]
    values = [errors.get(name, np.nan) for name in names]
    return stamped({"projection_error": values}, {"drawn_parameter": names})
