"""Pieces of work that are computed once: those that a store holds are read there.

A piece is known by the hash of all that it follows from. A store of a run is used within `storing`,
by the process that opened it, and for work whose inputs `following_from` names.
"""

import os
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from pathlib import Path
from typing import Any, Final, Protocol, TypeAlias, TypeVar

from .hashing import canonical_json, file_sha256, sha256
from .plain_bytes import to_bytes
from .registry import plugins

Item = TypeVar("Item")
Result = TypeVar("Result")
Stream: TypeAlias = Callable[[Iterable[Item]], Iterable[Result]]
"""Function that computes the results of items, in their order."""


class Store(Protocol[Result]):
    """Pieces by their keys."""

    def __contains__(self, key: object) -> bool:
        """Whether a piece can be read."""

    def get(self, key: str) -> Result:
        """Return a piece that the store contains."""

    def put(self, key: str, piece: Result) -> None:
        """Keep a piece."""


_STORE: Final = ContextVar[tuple[Store[Any], int] | None]("_STORE", default=None)
"""Store of this run, and the process that may use it."""
_INPUTS: Final = ContextVar("_INPUTS", default="")
"""Hash of what the work follows from; empty where that is not known."""


@contextmanager
def storing(store: Store[Any]) -> Iterator[None]:
    """Let `stored` read and keep pieces in a store."""
    before = _STORE.set((store, os.getpid()))
    try:
        yield
    finally:
        _STORE.reset(before)


@contextmanager
def following_from(inputs: Callable[[], Any] | None) -> Iterator[None]:
    """Name what the results of `stored` follow from.

    Parameters
    ----------
    inputs : function that gives all inputs as JSON values, called where a store is used; None where
        they are unknown, and no result is stored
    """
    before = _INPUTS.set(hash_of_inputs(inputs()) if inputs and _STORE.get() else "")
    try:
        yield
    finally:
        _INPUTS.reset(before)


def hash_of_inputs(inputs: Any) -> str:
    """Hash inputs, JSON values, with the content of each file that a text among them names."""
    return sha256(canonical_json([inputs, dict(_named_files(inputs))]).encode())


def _named_files(inputs: Any) -> Iterator[tuple[str, str]]:
    """Names and hashes of files."""
    if isinstance(inputs, dict | list | tuple):
        for part in inputs.values() if isinstance(inputs, dict) else inputs:
            yield from _named_files(part)
    elif isinstance(inputs, str):
        with suppress(OSError, ValueError):
            if Path(inputs).is_file():
                with open(inputs, "rb") as file:
                    yield inputs, file_sha256(file)


def stored(name: object, items: Iterable[Item], stream: Stream[Item, Result]) -> Iterable[Result]:
    """Compute the results of items; those of an interrupted run are read from its store.

    Parameters
    ----------
    name : name of the work, and all that tells it from other work that follows from the same
        inputs; see `to_bytes`
    items : each with the name and the inputs determines its result; see `to_bytes`
    stream : computes the results of those that the store does not hold
    """
    store, inputs = _STORE.get(), _INPUTS.get()
    # Code of a third party may follow from more than is known here.
    if store is None or store[1] != os.getpid() or not inputs or plugins():
        return stream(items)
    head = to_bytes((inputs, name))
    return each_once(items, stream, store[0], lambda item: sha256(head + to_bytes(item)))


def each_once(
    items: Iterable[Item],
    stream: Stream[Item, Result],
    store: Store[Result],
    key_of: Callable[[Item], str],
) -> Iterator[Result]:
    """Compute the results of items that a store does not hold; the others are read there.

    Parameters
    ----------
    items : in the order of the results
    stream : function that computes results of items
    store : keeps what is computed
    key_of : function that gives the key of an item
    """
    waiting: deque[tuple[str, bool]] = deque()

    def missing() -> Iterator[Item]:
        for item in items:
            key = key_of(item)
            waiting.append((key, key in store))
            if not waiting[-1][1]:
                yield item

    def stored_next() -> Iterator[Result]:
        while waiting and waiting[0][1]:
            yield store.get(waiting.popleft()[0])

    for result in stream(missing()):
        yield from stored_next()
        store.put(waiting.popleft()[0], result)
        yield result
    yield from stored_next()
