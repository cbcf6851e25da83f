"""Results that claim more than they hold, and HDF5 whose groups lead in circles."""

import h5py
import numpy as np
import pytest
import xarray as xr
from support import append_hash

from vibroacoustics.base.errors import StorageError
from vibroacoustics.recordings.readers.hdf5 import MAXIMUM_DATASETS, datasets
from vibroacoustics.results.hashed import read_checked
from vibroacoustics.results.netcdf import from_bytes, write_netcdf


def opened(path):
    append_hash(path)
    return from_bytes(read_checked(path).content, path)


def test_claimed_sixteen_gigabytes(tmp_path):
    path = tmp_path / "results.nc"
    with h5py.File(path, "w") as file:
        file.create_dataset("force", (2_000_000_000,), "f8", chunks=(1_000_000,))
    assert path.stat().st_size < 10_000
    with pytest.raises(StorageError, match=r"results\.nc: claims more than 2 GiB"):
        opened(path)


def test_groups_in_a_circle(tmp_path):
    path = tmp_path / "results.nc"
    with h5py.File(path, "w") as file:
        file.create_group("a")["b"] = file["/"]
    with pytest.raises(StorageError, match="'a' is not stored"):
        opened(path)


def test_results_are_read(tmp_path):
    path = tmp_path / "results.nc"
    coords = {"t": range(3), "s": ("t", ["a", "b", "c"])}
    written = xr.Dataset({"x": ("t", np.arange(3.0))}, coords)
    write_netcdf(written, path)
    xr.testing.assert_equal(opened(path), written)


def test_recording_with_groups_in_a_circle(tmp_path):
    with h5py.File(tmp_path / "loop.h5", "w") as file:
        file.create_group("a")["b"] = file["/"]
        file["a/x"] = [1.0, 2.0]
        assert [name for name, _ in datasets(file)] == ["a/x"]


def test_recording_with_many_groups(tmp_path):
    with h5py.File(tmp_path / "groups.h5", "w") as file:
        for number in range(MAXIMUM_DATASETS + 1):
            file.create_group(f"g{number}")
        with pytest.raises(StorageError, match="more than"):
            datasets(file)


def test_recording_with_deep_groups(tmp_path):
    with h5py.File(tmp_path / "deep.h5", "w") as file:
        group = file
        for _ in range(50):
            group = group.create_group("g" * 100)
        with pytest.raises(StorageError, match="too deep"):
            datasets(file)
