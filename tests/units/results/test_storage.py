"""Results on disk: exact, whole or not at all, and reusable."""

import os
from pathlib import Path

import netCDF4
import numpy as np
import pytest
import xarray as xr

from vibroacoustics.base.errors import StorageError
from vibroacoustics.base.vocabulary import stamp
from vibroacoustics.results import storage


@pytest.fixture
def results() -> xr.Dataset:
    """Complex, real, text and scalar variables with attributes."""
    generator = np.random.default_rng(7)
    vector = generator.standard_normal((2, 6, 5)) + 1j * generator.standard_normal((2, 6, 5))
    coords = {
        "receiver": ["front", "rear"],
        "dof": ["tx", "ty", "tz", "rx", "ry", "rz"],
        "frequency": np.linspace(0.0, 100.0, 5),
    }
    dataset = xr.Dataset(
        {
            "transfer_vector": stamp("transfer_vector", vector, coords, source="made up"),
            "natural_frequency": stamp(
                "natural_frequency", np.array([1 / 3, np.nan, np.inf, -0.0, 1e-310, 1e300])
            ),
            "level_remainder": stamp("level_remainder", 55.99),
        }
    )
    dataset.attrs = {"title": "test", "parameters": '{"a": [1, 2]}', "random_seed": 20061}
    return dataset


# --- round trip ----------------------------------------------------------------------------------


def test_round_trip_is_exact(results, tmp_path):
    path = storage.write_results(results, tmp_path / "results.nc")
    again = storage.open_results(path)
    assert set(again.variables) == set(results.variables)
    assert again.attrs == results.attrs
    for name, variable in results.variables.items():
        assert again[name].dims == variable.dims
        assert again[name].attrs == variable.attrs, name
        assert again[name].dtype.kind == variable.dtype.kind, name
        # Bit by bit: -0.0 and NaN too.
        if variable.dtype.kind in "fc":
            assert again[name].values.tobytes() == variable.values.tobytes(), name
        else:
            assert again[name].values.tolist() == variable.values.tolist()


def test_special_complex_values_are_exact(tmp_path):
    values = np.zeros((1, 6, 3), complex)
    values.real[0, 0], values.imag[0, 0] = [-0.0, 1.0, np.inf], [np.inf, -0.0, 1e-310]
    values[0, 1, 0] = complex(np.nan, 2.0)
    dataset = xr.Dataset({"transfer_vector": stamp("transfer_vector", values)})
    again = storage.open_results(storage.write_results(dataset, tmp_path / "r.nc"))
    assert again["transfer_vector"].values.tobytes() == values.tobytes()


def test_real_variable_with_a_telling_name(tmp_path):
    """`_re` at the end of a name does not make a pair."""
    dataset = xr.Dataset({"pressure_re": ("x", np.arange(3.0))})
    again = storage.open_results(storage.write_results(dataset, tmp_path / "r.nc"))
    assert list(again.data_vars) == ["pressure_re"]


def test_empty_dataset(tmp_path):
    path = storage.write_results(xr.Dataset(attrs={"title": "nothing"}), tmp_path / "r.nc")
    assert storage.open_results(path).attrs == {"title": "nothing"}


def test_writing_leaves_the_dataset_alone(results, tmp_path):
    kept = results.copy(deep=True)
    storage.write_results(results, tmp_path / "results.nc")
    xr.testing.assert_identical(results, kept)


def test_plain_netcdf4_reads_it(results, tmp_path):
    path = storage.write_results(results, tmp_path / "results.nc")
    with netCDF4.Dataset(path) as file:
        assert file.data_model == "NETCDF4"
        real, imaginary = file["transfer_vector_re"], file["transfer_vector_im"]
        np.testing.assert_array_equal(real[:], results["transfer_vector"].values.real)
        np.testing.assert_array_equal(imaginary[:], results["transfer_vector"].values.imag)
        assert real.units == "Pa s m-1"
        for variable in file.variables.values():
            if variable.dtype is not str and variable.ndim:
                assert variable.filters()["fletcher32"], variable.name


def test_gnu_octave_can_read_it(results, tmp_path):
    """Octave's netCDF knows no strings (type 12) in variables, and ASCII attributes only."""
    path = storage.write_results(results.assign_attrs(title="Größe"), tmp_path / "r.nc")
    with netCDF4.Dataset(path) as file:
        assert all(variable.dtype is not str for variable in file.variables.values())
        assert file.variables["receiver"].dtype == "S1"
        assert file.getncattr("title").isascii()


def test_folder_is_made(results, tmp_path):
    path = tmp_path / "a" / "b" / "results.nc"
    assert storage.write_results(results, path) == path
    assert path.is_file()


def test_hash_is_that_of_sha256sum(results, tmp_path):
    path = storage.write_results(results, tmp_path / "results.nc")
    line = (tmp_path / "results.nc.sha256").read_text()
    assert line == f"{storage.sha256(path.read_bytes())}  results.nc\n"


# --- damage --------------------------------------------------------------------------------------


def test_changed_content(results, tmp_path):
    path = storage.write_results(results, tmp_path / "results.nc")
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 1
    path.write_bytes(content)
    with pytest.raises(StorageError, match=r"results\.nc: .*hash"):
        storage.open_results(path)


@pytest.mark.parametrize("share", [0.0, 0.3, 0.999])
def test_truncated_file(results, tmp_path, share):
    path = storage.write_results(results, tmp_path / "results.nc")
    os.truncate(path, int(share * path.stat().st_size))
    with pytest.raises(StorageError, match="hash"):
        storage.open_results(path)


def test_missing_hash(results, tmp_path):
    path = storage.write_results(results, tmp_path / "results.nc")
    Path(f"{path}.sha256").unlink()
    with pytest.raises(StorageError, match=r"results\.nc\.sha256: no such file"):
        storage.open_results(path)


@pytest.mark.parametrize("content", [b"", b"\xff\xfe\n", b"  \n"])
def test_broken_hash(results, tmp_path, content):
    path = storage.write_results(results, tmp_path / "results.nc")
    Path(f"{path}.sha256").write_bytes(content)
    with pytest.raises(StorageError):
        storage.open_results(path)


def test_missing_file_and_folder(tmp_path):
    with pytest.raises(StorageError, match=r"absent\.nc: no such file"):
        storage.open_results(tmp_path / "absent.nc")
    with pytest.raises(StorageError, match="cannot be read"):
        storage.open_results(tmp_path)


@pytest.mark.parametrize("content", [b"", b"no netCDF at all", b"\x89HDF\r\n\x1a\n" + b"\0" * 100])
def test_file_of_another_kind(tmp_path, content):
    path = tmp_path / "results.nc"
    storage.write_bytes(path, content)
    storage.write_bytes(Path(f"{path}.sha256"), f"{storage.sha256(content)}  x\n".encode())
    with pytest.raises(StorageError, match="no result file"):
        storage.open_results(path)


# --- whole or not at all -------------------------------------------------------------------------


@pytest.mark.parametrize("step", ["fsync", "replace", "chmod"])
def test_failure_leaves_the_old_file_and_nothing_else(tmp_path, monkeypatch, step):
    path = tmp_path / "results.nc"
    storage.write_bytes(path, b"old")

    def fail(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, step, fail)
    with pytest.raises(StorageError, match=r"results\.nc: cannot be written: No space left"):
        storage.write_bytes(path, b"new and longer")
    assert path.read_bytes() == b"old"
    assert [item.name for item in tmp_path.iterdir()] == ["results.nc"]


def test_large_variables_come_back_like_small_ones(results, tmp_path, monkeypatch):
    small = storage.open_results(storage.write_results(results, tmp_path / "small.nc"))
    monkeypatch.setattr(storage, "LARGE_BYTES", 8)
    large = storage.open_results(storage.write_results(results, tmp_path / "large.nc"))
    xr.testing.assert_identical(large, small)


def test_full_disk_leaves_the_old_results_and_nothing_else(results, tmp_path, monkeypatch):
    path = storage.write_results(results, tmp_path / "results.nc")

    def fail(*_, **__):
        raise RuntimeError("NetCDF: HDF error")

    monkeypatch.setattr(xr.Dataset, "to_netcdf", fail)
    with pytest.raises(StorageError, match=r"results\.nc: cannot be written: NetCDF: HDF error"):
        storage.write_results(results.assign_attrs(title="another"), path)
    xr.testing.assert_identical(storage.open_results(path), results)
    assert {item.name for item in tmp_path.iterdir()} == {"results.nc", "results.nc.sha256"}


def test_interrupt_leaves_the_old_file_and_nothing_else(tmp_path, monkeypatch):
    path = tmp_path / "results.nc"
    storage.write_bytes(path, b"old")

    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "replace", interrupt)
    with pytest.raises(KeyboardInterrupt):
        storage.write_bytes(path, b"new")
    assert path.read_bytes() == b"old"
    assert [item.name for item in tmp_path.iterdir()] == ["results.nc"]


def test_no_reader_ever_sees_a_part(tmp_path, monkeypatch):
    """What takes the name is already synced and whole."""
    path = tmp_path / "results.nc"
    synced = []
    fsync, replace = os.fsync, os.replace

    def watch_sync(descriptor):
        synced.append(os.fstat(descriptor).st_size)
        fsync(descriptor)

    def watch_replace(temporary, target):
        assert synced == [Path(temporary).stat().st_size] == [100_000]
        assert Path(temporary).parent == path.parent
        replace(temporary, target)

    monkeypatch.setattr(os, "fsync", watch_sync)
    monkeypatch.setattr(os, "replace", watch_replace)
    storage.write_bytes(path, b"x" * 100_000)
    assert len(synced) == 2  # the folder too


def test_killed_between_content_and_hash_counts_as_not_done(results, tmp_path, monkeypatch):
    path = storage.write_results(results, tmp_path / "results.nc")
    changed = results.assign_attrs(title="another")
    other = storage.write_results(changed, tmp_path / "other.nc")
    storage.write_bytes(path, other.read_bytes())  # and no new hash
    with pytest.raises(StorageError, match="hash"):
        storage.open_results(path)


def test_folder_that_cannot_be_written(tmp_path):
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(StorageError, match="cannot be written"):
        storage.write_bytes(tmp_path / "file" / "results.nc", b"x")


# --- cache ---------------------------------------------------------------------------------------


@pytest.fixture
def cache(tmp_path, monkeypatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return storage.cache_folder()


def test_cache_is_in_the_folder_of_the_platform(cache, tmp_path):
    assert cache == tmp_path / "vibroacoustics"


def test_cache_hit_and_miss(results, cache):
    calls = []

    def compute():
        calls.append(1)
        return results

    first, first_cached = storage.cached("kind", {"a": 1}, compute)
    second, second_cached = storage.cached("kind", {"a": 1}, compute)
    storage.cached("kind", {"a": 2}, compute)
    storage.cached("other", {"a": 1}, compute)
    assert (first_cached, second_cached, len(calls)) == (False, True, 3)
    xr.testing.assert_identical(first, second)


def test_address_does_not_depend_on_the_order_of_keys(results, cache):
    storage.cached("kind", {"a": 1, "b": [2.0]}, lambda: results)
    _, was_cached = storage.cached("kind", {"b": [2.0], "a": 1}, lambda: results)
    assert was_cached


def test_damaged_cache_is_computed_again(results, cache):
    storage.cached("kind", {"a": 1}, lambda: results)
    (file,) = cache.glob("*.nc")
    os.truncate(file, 100)
    again, was_cached = storage.cached("kind", {"a": 1}, lambda: results)
    assert not was_cached
    assert storage.cached("kind", {"a": 1}, lambda: results)[1]
    xr.testing.assert_identical(again, results)


def test_failed_computation_leaves_nothing_in_the_cache(results, cache):
    def fail():
        raise RuntimeError("diverged")

    with pytest.raises(RuntimeError):
        storage.cached("kind", {"a": 1}, fail)
    assert not list(cache.glob("*.nc*[!k]"))  # nothing but the lock
    assert storage.cached("kind", {"a": 1}, lambda: results)[1] is False


def test_cache_that_cannot_be_written(results, tmp_path, monkeypatch):
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    with pytest.raises(StorageError, match="cannot be written"):
        storage.cached("kind", {"a": 1}, lambda: results)
