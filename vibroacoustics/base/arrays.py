"""Names of the arrays that pass between functions."""

from typing import Annotated

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
IndexArray = NDArray[np.intp]
RoundedArray = Annotated[Array, np.floating]
"""Array that may be kept in single precision."""
