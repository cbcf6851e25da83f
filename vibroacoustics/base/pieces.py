"""Pieces of work that an interrupted run has stored: they are read, the others are computed.

A piece is known by the hash of all that it follows from: `following_from` names the inputs.
"""

import os
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from pathlib import Path
from typing import Any, Final, TypeAlias, TypeVar

from .forms import has_form
from .plain_bytes import canonical_json, file_sha256, sha256, to_bytes
from .registry import plugins

Item = TypeVar("Item")
Result = TypeVar("Result")
Stream: TypeAlias = Callable[[Iterable[Item]], Iterable[Result]]
"""Function that computes the results of items, in their order."""
EachOnce: TypeAlias = Callable[..., Iterable[Any]]
"""Takes items, a stream and the key of an item; `PieceFiles.each_once` is one."""
_STORE: Final = ContextVar[tuple[EachOnce, int] | None]("_STORE", default=None)
"""Store of this run, and the process that may use it."""
_INPUTS: Final = ContextVar("_INPUTS", default="")
"""Hash of what the work follows from; empty where that is not known."""


@contextmanager
def storing(each_once: EachOnce) -> Iterator[None]:
    """Let `stored` use a store; other processes, copies of this one, do not."""
    before = _STORE.set((each_once, os.getpid()))
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


def stored(
    name: object,
    items: Iterable[Item],
    stream: Stream[Item, Result],
    form: Any = Any,
) -> Iterable[Result]:
    """Compute the results of items; those that an interrupted run has stored are read.

    Parameters
    ----------
    name : name of the work, and all that differs from other work of the same inputs; see
        `to_bytes`
    items : each determines its result, with the name and the inputs; see `to_bytes`
    stream : function that computes results
    form : type of a result; stored ones of another type are computed again
    """
    store, inputs = _STORE.get(), _INPUTS.get()
    # Results of a third party's code may follow from more than is known here.
    if store is None or store[1] != os.getpid() or not inputs or plugins():
        return stream(items)
    head = to_bytes((inputs, name))
    return store[0](
        items,
        stream,
        lambda item: sha256(head + to_bytes(item)),
        lambda _, piece: has_form(piece, form),
    )


def hash_of_inputs(inputs: Any) -> str:
    """Hash JSON values, with the content of each file that a text among them names."""
    return sha256(canonical_json([inputs, dict(_named_files(inputs))]).encode())


def _named_files(inputs: Any) -> Iterator[tuple[str, str]]:
    if isinstance(inputs, dict | list | tuple):
        for part in inputs.values() if isinstance(inputs, dict) else inputs:
            yield from _named_files(part)
    elif isinstance(inputs, str):
        with suppress(OSError, ValueError):
            if Path(inputs).is_file():
                with open(inputs, "rb") as file:
                    yield inputs, file_sha256(file)
