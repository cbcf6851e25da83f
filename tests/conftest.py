"""Fixtures that all tests share."""

import io
import os
from collections.abc import Iterator

# Workers of pytest share the cores already; threads of linear algebra beside them double its time.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import pytest
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from PIL import Image
from support import PIPELINES

from vibroacoustics.study.loading import load_study
from vibroacoustics.study.study import Study


@pytest.fixture(autouse=True, scope="session")
def _own_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Keep the tests out of the user's cache; child processes inherit the setting.

    matplotlib's list of fonts is made once, however many caches of their own tests have.
    """
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        patch.setenv("MPLCONFIGDIR", str(tmp_path_factory.mktemp("matplotlib")))
        yield


@pytest.fixture(scope="session")
def thesis_study() -> Study:
    return load_study(PIPELINES / "copeland_thesis.toml")


@pytest.fixture(scope="session")
def derived_study() -> Study:
    return load_study(PIPELINES / "copeland_derived.toml")


@pytest.fixture
def without_pixels(monkeypatch: pytest.MonkeyPatch) -> None:
    """Figures are painted; their file shows one white pixel."""
    pixel = io.BytesIO()
    Image.new("RGB", (1, 1), "white").save(pixel, "png")
    content = pixel.getvalue()
    monkeypatch.setattr(Figure, "savefig", lambda _, file, **__: file.write(content))


@pytest.fixture
def quick_figures(without_pixels: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """For tests that look at no picture: pixels and layout take most of a report's time."""
    monkeypatch.setattr(ConstrainedLayoutEngine, "execute", lambda *_: None)
