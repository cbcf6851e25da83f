"""Fixtures that all tests share."""

import os
from collections.abc import Iterator

# Workers of pytest share the cores already; threads of linear algebra beside them double its time.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import pytest
from support import PIPELINES

from vibroacoustics.study.loading import load_study
from vibroacoustics.study.study import Study


@pytest.fixture(autouse=True, scope="session")
def _own_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Keep the tests out of the user's cache; child processes inherit the setting."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        yield


@pytest.fixture(scope="session")
def thesis_study() -> Study:
    return load_study(PIPELINES / "copeland_thesis.toml")


@pytest.fixture(scope="session")
def derived_study() -> Study:
    return load_study(PIPELINES / "copeland_derived.toml")
