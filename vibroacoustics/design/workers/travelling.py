"""Functions of any kind as bytes that go to the workers of a scheduler, and their call there.

They are never written to a file. A function takes along what it knows, such as transfer vectors.
"""

from collections.abc import Callable
from functools import cache, lru_cache
from io import BytesIO
from typing import Any

from ...base.linear_algebra import one_thread_of_linear_algebra
from .study_task import meet

_CACHED = type(cache(lambda: None))


def travelling(function: Callable[[Any], Any]) -> bytes:
    """Return a function with all that it knows; caches travel empty."""
    from cloudpickle import Pickler

    class Travelling(Pickler):  # type: ignore[misc]
        """Pickler that also takes caches of functions that no module holds."""

        def reducer_override(self, thing: Any) -> Any:
            """Return how something is made again."""
            if isinstance(thing, _CACHED) and "<locals>" in getattr(
                thing, "__qualname__", "<locals>"
            ):
                return _cached, (thing.__wrapped__, thing.cache_parameters()["maxsize"])
            return super().reducer_override(thing)

    content = BytesIO()
    Travelling(content).dump(function)
    return content.getvalue()


def apply(required: bytes, content: bytes, item: Any) -> Any:
    """Apply a function to an item on a worker.

    Parameters
    ----------
    required : requirement of the worker, from `requirement`
    content : bytes of the function, from `travelling`
    item : item of any kind
    """
    meet(required)
    with one_thread_of_linear_algebra():
        return _arrived(content)(item)


@lru_cache(maxsize=2)
def _arrived(content: bytes) -> Callable[[Any], Any]:
    import pickle

    function: Callable[[Any], Any] = pickle.loads(content)  # noqa: S301 - of who may run code here
    return function


def _cached(function: Callable[..., Any], most: int | None) -> Any:
    return lru_cache(maxsize=most)(function)
