"""The cases of a study with drawn values, and all draws side by side."""

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import TypeVar

import numpy as np
import xarray as xr

from ..base.progress import Progress
from ..base.vocabulary import check, stamp
from ..machine.machine import Machine
from ..machine.source import Case, CaseKey, Shared
from ..radiation.machine_side import processors
from ..study.uncertainty import Range
from .draws import Draw, with_draw

Result = TypeVar("Result")


def drawn_cases(cases: Mapping[CaseKey, Case], given: Machine, draw: Draw) -> dict[CaseKey, Case]:
    """The cases with drawn values; they share no result with those of other draws.

    Parameters
    ----------
    cases : with the values as given
    given : machine of the study
    draw : values by table and field
    """
    shared = Shared()
    return {
        key: replace(case, machine=with_draw(case.machine, given, draw), shared=shared)
        for key, case in cases.items()
    }


def of_every_draw(
    draws: Sequence[Draw], compute: Callable[[Draw], Result], progress: Progress
) -> list[Result]:
    """What is computed of every draw, in their order.

    Parameters
    ----------
    draws : sets of values
    compute : called with one of them, in several threads at once
    progress : called with the advance
    """
    results = []
    with ThreadPoolExecutor(processors()) as pool:  # the keys run without the interpreter's lock
        for result in pool.map(compute, draws):
            results.append(result)
            progress("sources", len(results), len(draws))
    return results


def drawn_values(ranges: Sequence[Range], draws: Sequence[Draw]) -> xr.Dataset:
    """The values of all draws, labelled."""
    names = [f"{limits.table}.{limits.field}" for limits in ranges]
    values = [[draw[limits.table, limits.field] for limits in ranges] for draw in draws]
    coords = {"draw": np.arange(1, len(draws) + 1), "drawn_parameter": names}
    return check(xr.Dataset({"drawn_value": stamp("drawn_value", values, coords)}))
