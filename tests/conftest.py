"""Fixtures that all tests share."""

import gc
import os
from collections.abc import Iterator

# Workers of pytest share the cores already; threads of linear algebra beside them double its time.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import evidence_plugin
import pytest
from kept_results import FOLDER
from reading_here import read_here
from support import PIPELINES

from vibroacoustics.base.registry import _REGISTRIES
from vibroacoustics.recordings import asked, blocks, modes
from vibroacoustics.recordings.child_process import read_in_child
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.study import Study

READING = (asked, blocks, modes)
LONGEST_FIRST = (
    "test_doctests.py", "test_wrong_results.py", "test_cli.py", "test_sources_in_chain.py",
    "test_small_things.py", "test_bad_recordings.py", "test_bad_studies.py", "test_samples.py",
    "test_oldham_keys.py", "test_run_flags.py",
)  # fmt: skip
"""Files of more than ten seconds: a worker that begins one last keeps all others waiting."""
SHARED = {"XDG_CACHE_HOME": "cache", "MPLCONFIGDIR": "matplotlib", FOLDER: "results"}


def pytest_addoption(pluginmanager: pytest.PytestPluginManager) -> None:
    """Have claims collected and checked."""
    pluginmanager.register(evidence_plugin)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Files that take long come first; the order is otherwise that of the folders."""
    place = {name: number for number, name in enumerate(LONGEST_FIRST)}
    items.sort(key=lambda item: place.get(item.path.name, len(place)))


def pytest_collection() -> None:
    """Collect no garbage while tests are collected: nothing of what is loaded is garbage."""
    gc.disable()


def pytest_collection_finish() -> None:
    """Collect the garbage of what comes after: modules and tests stay to the end."""
    gc.freeze()
    gc.enable()


@pytest.fixture(autouse=True, scope="session")
def _own_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Keep the tests out of the user's cache; child processes inherit the setting.

    All workers share one cache, one list of matplotlib's fonts, and results of unchanged studies:
    what one has computed is read by the others.
    """
    base = tmp_path_factory.getbasetemp()
    shared = base.parent if "PYTEST_XDIST_WORKER" in os.environ else base
    with pytest.MonkeyPatch.context() as patch:
        for name, folder in SHARED.items():
            (shared / folder).mkdir(exist_ok=True)
            patch.setenv(name, str(shared / folder))
        yield


@pytest.fixture(autouse=True, scope="session")
def _recordings_are_read_here() -> Iterator[None]:
    """Recordings need no process of their own, whose start takes up to a second.

    The fixture `own_process` gives it back; commands and scripts in processes have it anyway.
    """
    with pytest.MonkeyPatch.context() as patch:
        for module in READING:
            patch.setattr(module, "read_in_child", read_here)
        yield


@pytest.fixture(autouse=True)
def _plugins_are_forgotten() -> Iterator[None]:
    """What a test registers is unknown to the next: with a plug-in, runs store no pieces."""
    before = [set(registry._origins) for registry in _REGISTRIES]
    yield
    # A registry that the test imports is behind those known before.
    for registry, known in zip(_REGISTRIES, before, strict=False):
        for name in set(registry._origins) - known:
            del registry._things[name], registry._origins[name]


@pytest.fixture
def own_process(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every recording is read in a process of its own, as the user's are."""
    for module in READING:
        monkeypatch.setattr(module, "read_in_child", read_in_child)


@pytest.fixture(scope="session")
def thesis_study() -> Study:
    return load_study(PIPELINES / "copeland_thesis.toml")


@pytest.fixture(scope="session")
def derived_study() -> Study:
    return load_study(PIPELINES / "copeland_derived.toml")
