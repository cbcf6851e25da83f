"""Results that follow from some values of a design, each computed once for these values."""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Final, Generic, Protocol, TypeVar

import numpy as np

from ...base.arrays import Array, IndexArray
from ...base.errors import ParameterError, SolverError
from ...base.field_reads import recorded_reads
from ...study.study import Study

MOST_BYTES: Final = 1_000_000_000
"""Memory of all results of a space with all samples of its machine."""


class Sized(Protocol):
    """A result that knows the memory that it takes."""

    @property
    def nbytes(self) -> int:
        """Bytes of its arrays."""
        ...


Result = TypeVar("Result", bound=Sized)


@dataclass
class Budget:
    """Memory of the results of several memos: the oldest ones are let go.

    Attributes
    ----------
    most_bytes : largest memory of all results together, bytes
    kept_bytes : memory of the results that are kept now, bytes
    """

    most_bytes: int = MOST_BYTES
    kept_bytes: int = 0
    _entries: deque[tuple[dict[bytes, Any], bytes, int]] = field(default_factory=deque, repr=False)

    def keep(self, results: dict[bytes, Any], key: bytes, result: Any) -> None:
        """Keep a result by its key among others."""
        results[key], size = result, getattr(result, "nbytes", 0)
        self._entries.append((results, key, size))
        self.kept_bytes += size
        while self.kept_bytes > self.most_bytes and len(self._entries) > 1:
            others, oldest, freed = self._entries.popleft()
            others.pop(oldest, None)
            self.kept_bytes -= freed


@dataclass
class Memo(Generic[Result]):
    """Results of designs, computed once for all designs with the same values of what is read.

    Attributes
    ----------
    names : keys of the variables
    study_of : makes the study of a design, its values watched by the keys of the variables
    compute : makes the result of a study
    budget : budget of memory, shared with other memos
    unwatched : numbers of variables that count as read
    computed : number of results that were computed
    """

    names: list[str]
    study_of: Callable[[Array], Study]
    compute: Callable[[Study], Result]
    budget: Budget = field(default_factory=Budget, repr=False)
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
        for reads, results in self._known.items():
            result = results.get(design[list(reads)].tobytes())
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
            result = error.with_traceback(None)  # a frame would keep its arrays
        self.computed += 1
        reads = tuple(sorted(numbers))
        results = self._known.setdefault(reads, {})
        self.budget.keep(results, design[list(reads)].tobytes(), result)
        return result
