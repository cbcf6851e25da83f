"""All samples side by side, and their values."""

import warnings
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from types import GenericAlias
from typing import TypeVar

import numpy as np
import xarray as xr

from ..base.errors import ParameterError, SolverError
from ..base.fault import FaultError
from ..base.forms import returned
from ..base.linear_algebra import one_thread_of_linear_algebra
from ..base.pieces import following_from, stored
from ..base.processes import side_by_side
from ..base.threads import mapped_in_threads
from ..base.vocabulary import stamped
from ..study.sampling import Sample
from ..study.study import Study
from ..study.uncertainty import Range

Item = TypeVar("Item")
Result = TypeVar("Result")


def in_every_sample(
    samples: Sequence[Item],
    compute: Callable[[Item], Result],
    without_solution: Result,
    progress: Callable[[int], None],
    name: str = "",
    study: Study | None = None,
) -> list[Result]:
    """Compute a result of every sample, in their order; one warning counts those without solution.

    Results do not depend on the number of processors: a sample shares nothing with others.

    Parameters
    ----------
    samples : sets of values, or their numbers
    compute : called with one of them, in several processes or threads at once; gives what pickle
        takes
    without_solution : in place of the result of a sample with which the machine cannot run
    progress : called with the number of samples that are done
    name : name of the computation, which no other of the study has; see `stored`
    study : study from which, with a sample, the result follows; None: results are not stored
    """

    def solved(sample: Item) -> tuple[Result, str | None]:
        try:
            return compute(sample), None
        except (
            ParameterError,
            SolverError,
            FaultError,
        ) as error:  # whose frames would hold all it computed
            return without_solution, str(error)

    results: list[Result] = []
    failures: list[str] = []
    progress(0)
    solving = partial(side_by_side, solved, otherwise=mapped_in_threads)
    inputs = study.parameters if study else None
    form = GenericAlias(tuple, (returned(compute), str | None))
    with one_thread_of_linear_algebra(), following_from(inputs):
        for result, failure in stored(name, samples, solving, form):
            results.append(result)
            failures += [] if failure is None else [f"sample {len(results)}: {failure}"]
            progress(len(results))
    if failures:
        warnings.warn(
            f"{len(failures)} of {len(samples)} samples have no solution and are omitted, "
            f"such as: {failures[0]}",
            stacklevel=2,
        )
    return results


def sampled_values(ranges: Sequence[Range], samples: Sequence[Sample]) -> xr.Dataset:
    """The values of all samples, labelled."""
    names = [limits.name for limits in ranges]
    values = [[sample[limits.table, limits.field] for limits in ranges] for sample in samples]
    coords = {"sample": np.arange(1, len(samples) + 1), "uncertain_parameter": names}
    return stamped({"sampled_value": values}, coords)


def errors_of_projection(ranges: Sequence[Range], errors: Mapping[str, float]) -> xr.Dataset:
    """Errors of the values that are sampled by projection on modes, empty for others, labelled."""
    names = [limits.name for limits in ranges]
    values = [errors.get(name, np.nan) for name in names]
    return stamped({"projection_error": values}, {"uncertain_parameter": names})
