"""Cases with the loads of all sources."""

from collections.abc import Iterable
from dataclasses import dataclass, fields

from ..mechanics.loads import Loads, PortLoads
from .source import Case, CaseKey


@dataclass(frozen=True)
class Cases:
    """Speeds and options of a study with the loads of all sources.

    Attributes
    ----------
    cases : by speed and option, without time series
    loads : by speed and option, then by source, without wrenches, which the results hold
    wrenches : lines of the wrenches over crank angle, by speed and option, then by source

    Examples
    --------
    A stage reads the loads of a speed and an option:

    >>> class GasTorque(va.Stage):
    ...     name = "gas-torque"
    ...     reads = (va.Cases,)
    ...     def run(self, chain):
    ...         by_source = chain[va.Cases].loads[2900.0, "none"]
    ...         print(by_source["gas"].shaft_torque_n_m)
    ...         return va.Given()
    """

    cases: dict[CaseKey, Case]
    loads: dict[CaseKey, dict[str, Loads]]
    wrenches: dict[CaseKey, dict[str, PortLoads]]

    def some(self, keys: Iterable[CaseKey]) -> "Cases":
        """Return the cases of some speeds and options, in the order of the keys."""
        keys = list(keys)
        parts = (getattr(self, part.name) for part in fields(self))
        return Cases(*({key: part[key] for key in keys} for part in parts))

    def joined(self, others: "Cases") -> "Cases":
        """Return these cases and others, which take the place of those with their keys."""
        return Cases(
            {**self.cases, **others.cases},
            {**self.loads, **others.loads},
            {**self.wrenches, **others.wrenches},
        )
