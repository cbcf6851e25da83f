"""Fault of measured functions, and the refusal of faults that are not accepted."""

from collections.abc import Mapping, Sequence
from typing import Final, NamedTuple

from ..base.errors import ParameterError
from ..recordings import Node

FAULTS: Final = (
    "convention", "polarity", "swapped", "factor", "delay", "double-hit", "reciprocity", "mass",
    "operating",
)  # fmt: skip
"""Names of faults."""


class Fault(NamedTuple):
    """Fault of measured functions.

    Attributes
    ----------
    name : one of `FAULTS`
    nodes : sensors or points that have it; empty if all have
    words : description of the fault and its remedy
    """

    name: str
    nodes: tuple[Node, ...]
    words: str

    def line(self, names: Mapping[Node, str]) -> str:
        """Return the fault with the names of its points.

        Parameters
        ----------
        names : names of points by node
        """
        labels = [f"{names[node]} ({node})" if node in names else str(node) for node in self.nodes]
        return f"{self.name} at {' and '.join(labels) or 'all points'}: {self.words}"


def refuse(faults: Sequence[Fault], despite: Sequence[str], names: Mapping[Node, str]) -> None:
    """Stop at faults that are not accepted.

    Parameters
    ----------
    faults : faults found
    despite : names of faults that are accepted
    names : names of points by node

    Raises
    ------
    ParameterError
        A line for each fault whose name is not in `despite`, or a name is unknown.
    """
    for name in despite:
        if name not in FAULTS:
            raise ParameterError(f"--despite {name}: must be one of {', '.join(FAULTS)}")
    lines = [
        f"{fault.line(names)}; or accept it by --despite {fault.name}"
        for fault in faults
        if fault.name not in despite
    ]
    if lines:
        raise ParameterError(*lines)
