"""Results beside data: error and its uncertainty, in the form of ASME V&V 20.

Simulation S, data D, error E = S - D; validation uncertainty u = √(u_num² + u_input² + u_D²), all
standard uncertainties (ASME V&V 20-2009, sections 1 and 6). With a tolerance T stated before, S
agrees with D within T where |E| + 1.64 u <= T (equivalence test: Schuirmann 1987, J.
Pharmacokinetics and Biopharmaceutics 15, 657); it differs where |E| > 2 u; else that is undecided.
A recording agrees with a study with samples where it lies in the 80 % interval, |E| <= 1.28 u.
"""

from dataclasses import dataclass, fields
from typing import Final

import numpy as np
import xarray as xr

from ..base.quantiles import NORMAL_90

COVERAGE: Final = 2.0
"""Factor of the standard uncertainty: about 95 % of a normal distribution."""
ONE_SIDED: Final = 1.64
"""95 % of a normal distribution lie below it."""
LEVEL_TOLERANCE_DB: Final = 5.0
FORCE_TOLERANCE: Final = 0.1
"""Relative to the published force."""
AGREES: Final = "agrees"
DIFFERS: Final = "differs"
UNDECIDED: Final = "undecided"


@dataclass(frozen=True)
class Validation:
    """Simulation beside data, with standard uncertainties, all in one unit.

    Attributes
    ----------
    quantity : in words
    unit : unit of all numbers
    simulation, data : S and D
    numerical, inputs, published : uncertainties of numerics, of inputs and of the data
    source : source of the data
    """

    quantity: str
    unit: str
    simulation: float
    data: float
    numerical: float
    inputs: float
    published: float
    source: str

    @property
    def error(self) -> float:
        """E = S - D."""
        return self.simulation - self.data

    @property
    def uncertainty(self) -> float:
        """Validation uncertainty u."""
        return float(np.hypot(np.hypot(self.numerical, self.inputs), self.published))

    @property
    def tolerance(self) -> float:
        """Tolerance T of the agreement."""
        is_level = self.unit.startswith("dB")
        return LEVEL_TOLERANCE_DB if is_level else FORCE_TOLERANCE * abs(self.data)

    @property
    def verdict(self) -> str:
        """`AGREES`, `DIFFERS` or `UNDECIDED`."""
        if abs(self.error) + ONE_SIDED * self.uncertainty <= self.tolerance:
            return AGREES
        return DIFFERS if abs(self.error) > COVERAGE * self.uncertainty else UNDECIDED


class OfInterval(Validation):
    """Recording beside a study, whose samples decide where it has some."""

    @property
    def verdict(self) -> str:
        """`AGREES` within the 80 % interval, else that of the tolerance."""
        if self.inputs > 0.0 and abs(self.error) <= NORMAL_90 * self.uncertainty:
            return AGREES
        return super().verdict


def validations(results: xr.Dataset) -> list[Validation]:
    """Return all that is published of what the results hold; none where nothing is."""
    if "evidence_data" not in results:
        return []
    columns = [results[f"evidence_{part.name}"].values.tolist() for part in fields(Validation)]
    return [Validation(*row) for row in zip(*columns, strict=True)]
