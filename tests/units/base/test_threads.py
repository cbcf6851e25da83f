"""Work in threads: results in order, errors, and one thread of linear algebra for each."""

import numpy as np
import pytest
from support import in_child

from vibroacoustics.base.linear_algebra import OPENBLAS
from vibroacoustics.base.threads import in_threads


def test_results_come_in_the_order_of_the_tasks():
    assert in_threads([lambda n=n: n**2 for n in range(50)], workers=4) == [n**2 for n in range(50)]


def test_the_first_error_ends_what_has_not_begun():
    begun = []

    def task(number):
        begun.append(number)
        if number == 0:
            raise ValueError("first")

    with pytest.raises(ValueError, match="first"):
        in_threads([lambda n=n: task(n) for n in range(1000)], workers=1)
    assert len(begun) < 1000


def test_linear_algebra_takes_one_thread_and_gets_its_own_back():
    """In a process that has two; callers within callers, the inner one in a thread."""
    assert in_child("""
        import os
        os.environ["OPENBLAS_NUM_THREADS"] = "2"
        os.environ.pop("OMP_NUM_THREADS", None)
        from vibroacoustics.base.linear_algebra import OPENBLAS
        from vibroacoustics.base.threads import in_threads
        before = OPENBLAS.threads
        inner, outer = in_threads([lambda: in_threads([lambda: OPENBLAS.threads])[0],
                                   lambda: OPENBLAS.threads])
        ones = [1] * len(before)
        print(inner == outer == ones, OPENBLAS.threads == before, *before)
    """)[:2] == ["True", "True"]


def test_an_error_gives_the_threads_back():
    before = OPENBLAS.threads

    def wrong():
        raise ValueError(f"within: {set(OPENBLAS.threads) <= {1}}")

    with pytest.raises(ValueError, match="within: True"):
        in_threads([wrong])
    assert OPENBLAS.threads == before


def test_products_are_the_same():
    matrix = np.random.default_rng(1).standard_normal((60, 60))
    alone = matrix @ matrix
    (inside,) = in_threads([lambda: matrix @ matrix])
    np.testing.assert_allclose(inside, alone, rtol=1e-12)
