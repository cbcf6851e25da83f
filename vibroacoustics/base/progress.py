"""How long work reports its advance."""

from collections.abc import Callable

Progress = Callable[[str, int, int], None]
"""Called with what is being done, steps done and steps in all."""


def no_progress(task: str, done: int, total: int) -> None:
    """Report nothing."""
