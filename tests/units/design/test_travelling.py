"""Functions that travel to workers with what they know."""

from functools import cache, partial

import numpy as np
import pytest

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.base.processes import distributing, side_by_side
from vibroacoustics.design.workers import study_task
from vibroacoustics.design.workers.scheduler import apply, travelling
from vibroacoustics.design.workers.study_task import requirement

pytest.importorskip("cloudpickle")


def test_function_with_a_cache_of_its_own_travels() -> None:
    """A cache of a partial function has no name that pickle could find."""
    values = np.linspace(0.0, 1.0, 7)
    kept = cache(partial(np.interp, xp=values, fp=values**2))

    def function(item: float) -> float:
        return float(kept(item)) + 1.0

    content = travelling(function)
    assert apply(requirement([]), content, 0.3) == function(0.3)


def test_worker_of_another_version_refuses(monkeypatch: pytest.MonkeyPatch) -> None:
    required = requirement([])
    monkeypatch.setattr(study_task, "software_version", lambda: "0.0")
    study_task.meet.cache_clear()
    with pytest.raises(ParameterError, match=r"has version 0\.0, not"):
        apply(required, travelling(abs), -1.0)
    study_task.meet.cache_clear()


def test_work_goes_to_the_workers_that_are_opened() -> None:
    """And back to this process afterwards."""
    seen = []

    def elsewhere(function, items, on_loss):  # type: ignore[no-untyped-def]
        for item in items:
            seen.append(item)
            yield function(item)

    with distributing(elsewhere):
        assert list(side_by_side(abs, [-1, -2])) == [1, 2]
    assert seen == [-1, -2]
    assert list(side_by_side(abs, [-3])) == [3]
    assert seen == [-1, -2]
