"""Array types and the progress callback shared by the package."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.floating[Any]]
ComplexArray = NDArray[np.complexfloating[Any, Any]]
IndexArray = NDArray[np.intp]

Progress = Callable[[str, int, int], None]
"""`progress(description, done, total)`, called every few time steps."""


def no_progress(description: str, done: int, total: int) -> None:
    """Report nothing."""
