"""Results that follow from some values of a design, each computed once for these values."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Final, Generic, TypeVar

import numpy as np

from ...base.arrays import Array, IndexArray
from ...base.errors import ParameterError, SolverError
from ...base.field_reads import recorded_reads
from ...study.study import Study

Result = TypeVar("Result")
KEPT: Final = 8192
"""Results of a memo, the latest ones."""


@dataclass
class Memo(Generic[Result]):
    """Results of designs, computed once for all designs with the same values of what is read.

    Attributes
    ----------
    names : keys of the variables
    study_of : makes the study of a design, its values watched by the keys of the variables
    compute : makes the result of a study
    unwatched : numbers of variables that count as read
    computed : number of results that were computed
    """

    names: list[str]
    study_of: Callable[[Array], Study]
    compute: Callable[[Study], Result]
    unwatched: frozenset[int] = frozenset()
    computed: int = 0
    _known: dict[tuple[int, ...], dict[bytes, Result | Exception]] = field(
        default_factory=dict, repr=False
    )

    @property
    def reads(self) -> list[int]:
        """Numbers of the variables that any result so far has read."""
        return sorted(set().union(*self._known))

    def __call__(self, design: Array) -> Result:
        """Return the result of a design, shape (variable,).

        Raises
        ------
        ParameterError, SolverError
            It cannot be computed.
        """
        result = self._of(design)
        if isinstance(result, Exception):
            raise result.with_traceback(None)
        return result

    def of_each(self, designs: Array) -> tuple[list[Result | Exception], IndexArray]:
        """Return the different results of designs, or why there is none, and which is whose.

        Parameters
        ----------
        designs : shape (design, variable)
        """
        while True:
            reads = self.reads
            _, first, number = np.unique(
                designs[:, reads], axis=0, return_index=True, return_inverse=True
            )
            results = [self._of(designs[row]) for row in first]
            if self.reads == reads:  # designs alike in all that is read have one result
                return results, number.ravel()

    def _of(self, design: Array) -> Result | Exception:
        for reads, known in self._known.items():
            result = known.get(design[list(reads)].tobytes())
            if result is not None:
                return result
        numbers = set(range(design.size))
        try:
            study = self.study_of(design)
            with recorded_reads() as labels:
                numbers = set(self.unwatched)
                try:
                    result = self.compute(study)
                finally:
                    numbers |= {n for n, name in enumerate(self.names) if name in labels}
        except (ParameterError, SolverError) as error:
            result = error
        self.computed += 1
        reads = tuple(sorted(numbers))
        known = self._known.setdefault(reads, {})
        known[design[list(reads)].tobytes()] = result
        if len(known) > KEPT:
            del known[next(iter(known))]
        return result
