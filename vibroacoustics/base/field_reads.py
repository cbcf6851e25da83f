"""Values of tables that a computation reads, and so depends on, recorded while it runs."""

from collections.abc import Hashable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from types import new_class
from typing import Any, Final, TypeVar

from pydantic import BaseModel

Table = TypeVar("Table", bound=BaseModel)

_RECORDS: Final[dict[int, set[Hashable]]] = {}
"""Sets of labels that are being recorded, in any thread, by their identity."""
_IS_PAUSED: Final[ContextVar[bool]] = ContextVar("_IS_PAUSED", default=False)
_ALL_FIELDS: Final = "__dict__"
"""Attribute through which a table is compared, hashed, dumped and iterated over."""


@contextmanager
def recorded_reads() -> Iterator[set[Hashable]]:
    """Record the labels of the watched values that are read in the context."""
    reads: set[Hashable] = set()
    _RECORDS[id(reads)] = reads
    try:
        yield reads
    finally:
        del _RECORDS[id(reads)]


@contextmanager
def unrecorded_reads() -> Iterator[None]:
    """Record nothing in the context: a table is copied or checked there."""
    before = _IS_PAUSED.set(True)
    try:
        yield
    finally:
        _IS_PAUSED.reset(before)


def watched(table: Table, labels: Mapping[tuple[str, ...], Hashable]) -> Table:
    """Copy a table so that `recorded_reads` sees which of some values are read.

    Copies of the copy are watched too. What reads all fields, such as a hash, reads all of them.
    A value that a table keeps of its fields, in a private attribute, is not seen to be read.
    Watched tables cannot be pickled.

    Parameters
    ----------
    table : table that holds the values, itself or in its inner tables
    labels : by the names of the inner tables and of the field, such as ("mounts", "pitch_m")

    Examples
    --------
    >>> from vibroacoustics.base.field_reads import recorded_reads, watched
    >>> class Wheel(va.Parameters):
    ...     mass_kg: float
    ...     radius_m: float
    >>> wheel = watched(Wheel(mass_kg=0.3, radius_m=0.1), {("mass_kg",): "m", ("radius_m",): "r"})
    >>> with recorded_reads() as reads:
    ...     weight_n = 9.81 * wheel.mass_kg
    >>> reads
    {'m'}
    """
    direct = {path[0]: label for path, label in labels.items() if len(path) == 1}
    inner: dict[str, dict[tuple[str, ...], Hashable]] = {}
    for path, label in labels.items():
        if len(path) > 1:
            inner.setdefault(path[0], {})[path[1:]] = label
    with unrecorded_reads():
        fields = {name: watched(getattr(table, name), some) for name, some in inner.items()}
        copy = table.model_copy(update=fields)
        for name in set(vars(copy)) - set(type(table).model_fields):
            del vars(copy)[name]  # computed of fields before, and read no more
        if direct:
            kind = _watched_class(type(table), frozenset(direct.items()))
            object.__setattr__(copy, "__class__", kind)
    return copy


@cache
def _watched_class(
    table: type[BaseModel], labels: frozenset[tuple[str, Hashable]]
) -> type[BaseModel]:
    """Derive the class of watched tables; equal tables with equal labels are equal."""
    by_field = dict(labels)

    def read(self: BaseModel, name: str) -> Any:
        if _RECORDS and (name in by_field or name == _ALL_FIELDS) and not _IS_PAUSED.get():
            labels_read = by_field.values() if name == _ALL_FIELDS else (by_field[name],)
            for record in list(_RECORDS.values()):
                record.update(labels_read)
        return object.__getattribute__(self, name)

    def copied(self: BaseModel, **options: Any) -> BaseModel:
        with unrecorded_reads():
            return table.model_copy(self, **options)

    body = {"__getattribute__": read, "model_copy": copied, "__module__": table.__module__}
    return new_class(table.__name__, (table,), exec_body=lambda names: names.update(body))
