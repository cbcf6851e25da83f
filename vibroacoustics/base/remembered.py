"""Values of functions of a dataset, remembered as long as the dataset exists."""

import weakref
from collections.abc import Callable
from functools import wraps
from typing import Any, TypeVar, cast

import xarray as xr

Function = TypeVar("Function", bound=Callable[..., Any])


def remembered(function: Function) -> Function:
    """Compute a value once for the same dataset, the first argument, and hashable other ones.

    For datasets that nobody changes, such as the results of a run: they have no hash, so
    `functools.cache` refuses them. Values must not be changed either.
    """
    values: dict[int, dict[Any, Any]] = {}

    @wraps(function)
    def once(dataset: xr.Dataset, *further: Any, **named: Any) -> Any:
        if id(dataset) not in values:
            values[id(dataset)] = {}
            weakref.finalize(dataset, values.pop, id(dataset))
        of_dataset, key = values[id(dataset)], (further, tuple(named.items()))
        if key not in of_dataset:
            value = function(dataset, *further, **named)
            if value is dataset:  # kept, it would never be freed
                return value
            of_dataset[key] = value
        return of_dataset[key]

    return cast(Function, once)
