"""Results that the tests of sound share."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from sound_studies import result_with_baseline

from vibroacoustics.results import storage
from vibroacoustics.sound.ingredients import Ingredients, SoundBands, SoundLines


@pytest.fixture(scope="session")
def results(tmp_path_factory: pytest.TempPathFactory) -> xr.Dataset:
    return result_with_baseline(tmp_path_factory.mktemp("stand"))


@pytest.fixture(scope="session")
def results_file(tmp_path_factory: pytest.TempPathFactory, results: xr.Dataset) -> Path:
    return storage.write_results(results, tmp_path_factory.mktemp("run") / "results.nc")


@pytest.fixture(scope="session")
def compressor() -> Ingredients:
    """Orders of 2900 rpm, twice the frequency of its supply, and noise in all bands."""
    hertz = 2900.0 / 60.0 * np.arange(1.0, 41.0)
    size = 0.03 / np.arange(1.0, 41.0)
    turned = size * np.exp(2j * np.arange(40.0) ** 2)
    order = [f"order {number}" for number in range(1, 41)]
    lines = SoundLines(
        np.append(hertz, 100.0), np.append(turned, 0.01j), (*order, "motor: 2 x line")
    )
    centres = 10.0 ** (np.arange(10, 43) / 10.0)
    return Ingredients(lines, SoundBands(centres, 0.004 * (centres / 1000.0) ** -0.3))
