"""What a figure needs of the dataset that it is drawn from."""

from collections.abc import Callable
from functools import wraps
from typing import Any, TypeVar, cast

import xarray as xr
from matplotlib.figure import Figure

from ...base.errors import ParameterError
from ...base.vocabulary import VARIABLES
from ..titles import titled

Maker = TypeVar("Maker", bound=Callable[..., Figure])


def needs(*variables: str, from_: str = "`run`", any_of: bool = False) -> Callable[[Maker], Maker]:
    """Refuse, in one line, a dataset without the variables that a figure is drawn from.

    Parameters
    ----------
    from_ : what gives results that have them
    any_of : one of the variables is enough
    variables : names of the vocabulary
    """

    def guarded(make: Maker) -> Maker:
        @wraps(make)
        def checked(results: xr.Dataset, *args: Any, **kwargs: Any) -> Figure:
            missing = [name for name in variables if name not in results]
            for name in missing:
                if not any_of or len(missing) == len(variables):
                    raise ParameterError(
                        f"plot.{make.__name__}: these results hold no {name} "
                        f"({VARIABLES[name].long_name}); it comes from {from_}"
                    )
            return make(titled(results), *args, **kwargs)

        return cast(Maker, checked)

    return guarded
