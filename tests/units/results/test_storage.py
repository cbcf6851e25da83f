"""Results on disk: exact, whole or not at all, and reusable."""

import os
import subprocess
import sys
import textwrap
from pathlib import Path

import netCDF4
import numpy as np
import pytest
import xarray as xr
from support import append_hash, in_child

import vibroacoustics as va
from vibroacoustics.base.errors import StorageError
from vibroacoustics.base.plain_bytes import sha256
from vibroacoustics.base.vocabulary import stamp
from vibroacoustics.results import hashed, netcdf, storage


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
            "level_unmodelled": stamp("level_unmodelled", 55.99),
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


def test_last_line_is_the_hash_of_what_stands_before(results, tmp_path):
    path = storage.write_results(results, tmp_path / "results.nc")
    content, line = path.read_bytes()[:-88], path.read_bytes()[-88:]
    assert line == f"\nvibroacoustics sha256 {sha256(content)}\n".encode()
    assert storage.open_with_hash(path)[1] == hashed.stored_hash(path) == sha256(content)
    assert [item.name for item in tmp_path.iterdir()] == ["results.nc"]


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
    path.write_bytes(path.read_bytes()[:-88])
    with pytest.raises(StorageError, match=r"results\.nc: has no hash"):
        storage.open_results(path)


def test_rewritten_by_another_program(results, tmp_path):
    path = storage.write_results(results, tmp_path / "results.nc")
    with netCDF4.Dataset(path, "a") as file:
        file.title = "changed by hand, and made longer than it was before"
    with pytest.raises(StorageError, match="hash"):
        storage.open_results(path)


def test_missing_file_and_folder(tmp_path):
    with pytest.raises(StorageError, match=r"absent\.nc: no such file"):
        storage.open_results(tmp_path / "absent.nc")
    with pytest.raises(StorageError, match="cannot be read"):
        storage.open_results(tmp_path)


@pytest.mark.parametrize("content", [b"", b"no netCDF at all", b"\x89HDF\r\n\x1a\n" + b"\0" * 100])
def test_file_of_another_kind(tmp_path, content):
    path = tmp_path / "results.nc"
    path.write_bytes(content)
    append_hash(path)
    with pytest.raises(StorageError, match="no result file"):
        storage.open_results(path)


# --- whole or not at all -------------------------------------------------------------------------


def assert_only_the_old(results: xr.Dataset, folder: Path) -> None:
    """The old results are whole and nothing else lies there."""
    assert [item.name for item in folder.iterdir()] == ["results.nc"]
    xr.testing.assert_identical(storage.open_results(folder / "results.nc"), results)


@pytest.mark.parametrize("step", ["fsync", "replace"])
def test_failure_leaves_the_old_results_and_nothing_else(results, tmp_path, monkeypatch, step):
    path = storage.write_results(results, tmp_path / "results.nc")

    def fail(*_, **__):
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(os, step, fail)
        with pytest.raises(StorageError, match=r"results\.nc: cannot be written: No space left"):
            storage.write_results(results.assign_attrs(title="another"), path)
    assert_only_the_old(results, tmp_path)


@pytest.mark.parametrize(
    "limit", [50_000, *(pytest.param(one, marks=pytest.mark.long) for one in (1000, 120_000))]
)
def test_disk_that_fills_up(tmp_path, limit):
    """The limit of a file's size stands for a full disk; netCDF meets it where it will."""
    old = xr.Dataset({"level_unmodelled": stamp("level_unmodelled", 55.99)})
    path = storage.write_results(old, tmp_path / "results.nc")
    words = in_child(f"""
        import resource
        import numpy as np
        import xarray as xr
        from vibroacoustics.base.errors import StorageError
        from vibroacoustics.results import storage
        resource.setrlimit(resource.RLIMIT_FSIZE, ({limit}, {limit}))
        values = np.random.default_rng(1).standard_normal(20_000)
        try:
            storage.write_results(xr.Dataset({{"a": ("x", values)}}), {str(path)!r})
        except StorageError as error:
            print(str(error).startswith({str(path)!r} + ": cannot be written: "))
    """)
    assert words == ["True"]
    assert_only_the_old(old, tmp_path)


def test_large_variables_come_back_like_small_ones(results, tmp_path, monkeypatch):
    small = storage.open_results(storage.write_results(results, tmp_path / "small.nc"))
    monkeypatch.setattr(netcdf, "LARGE_BYTES", 8)
    large = storage.open_results(storage.write_results(results, tmp_path / "large.nc"))
    xr.testing.assert_identical(large, small)


def test_full_disk_leaves_the_old_results_and_nothing_else(results, tmp_path, monkeypatch):
    path = storage.write_results(results, tmp_path / "results.nc")

    def fail(*_, **__):
        raise RuntimeError("NetCDF: HDF error")

    monkeypatch.setattr(xr.Dataset, "to_netcdf", fail)
    with pytest.raises(StorageError, match=r"results\.nc: cannot be written: NetCDF: HDF error"):
        storage.write_results(results.assign_attrs(title="another"), path)
    assert_only_the_old(results, tmp_path)


def test_interrupt_leaves_the_old_results_and_nothing_else(results, tmp_path, monkeypatch):
    path = storage.write_results(results, tmp_path / "results.nc")

    def interrupt(*_, **__):
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", interrupt)
        with pytest.raises(KeyboardInterrupt):
            storage.write_results(results.assign_attrs(title="another"), path)
    assert_only_the_old(results, tmp_path)


def test_what_takes_the_name_is_synced_and_whole(results, tmp_path, monkeypatch):
    synced = []
    fsync, replace = os.fsync, os.replace

    def watch_sync(descriptor):
        synced.append(os.fstat(descriptor).st_size)
        fsync(descriptor)

    def watch_replace(name, target, **folders):
        temporary = tmp_path / ".writing" / name
        assert synced == [temporary.stat().st_size]
        assert hashed.stored_hash(temporary) is not None
        replace(name, target, **folders)

    monkeypatch.setattr(os, "fsync", watch_sync)
    monkeypatch.setattr(os, "replace", watch_replace)
    storage.write_results(results, tmp_path / "results.nc")
    assert len(synced) == 2  # the folder too


def test_what_a_killed_writer_left_goes_with_the_next(results, tmp_path):
    (tmp_path / ".writing" / "figures").mkdir(parents=True)
    (tmp_path / ".writing" / "results.nc").write_bytes(b"a part")
    (tmp_path / ".lock").write_bytes(b"")
    storage.write_results(results, tmp_path / "results.nc")
    assert_only_the_old(results, tmp_path)


@pytest.mark.parametrize(
    ("names", "rounds"), [("ab", 3), pytest.param("abcd", 6, marks=pytest.mark.long)]
)
@pytest.mark.long
def test_readers_beside_several_writers(names, rounds, results, tmp_path):
    """No reader is refused, and in the end one of the writers' results lies there."""
    path = storage.write_results(results, tmp_path / "results.nc")
    script = """
        import sys
        from vibroacoustics.results import storage
        path, rounds, title = sys.argv[1:]
        results = storage.open_results(path)
        for number in range(int(rounds)):
            storage.write_results(results.assign_attrs(title=title), path)
    """
    command = [sys.executable, "-W", "ignore", "-c", textwrap.dedent(script), path]
    command.append(str(rounds))
    writers = [subprocess.Popen([*command, name], stderr=subprocess.PIPE) for name in names]
    reads = 0
    while any(writer.poll() is None for writer in writers):
        storage.open_results(path)
        reads += 1
    assert [writer.communicate()[1] for writer in writers] == [b""] * len(names)
    assert reads > 10
    assert storage.open_results(path).attrs["title"] in names
    assert [item.name for item in tmp_path.iterdir()] == ["results.nc"]


def test_folder_that_cannot_be_written(tmp_path):
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(StorageError, match="cannot be written"):
        storage.write_results(xr.Dataset(), tmp_path / "file" / "results.nc")


def test_a_folder_made_for_results_that_fail_goes_again(results, tmp_path, monkeypatch):
    monkeypatch.setattr(xr.Dataset, "to_netcdf", lambda *_, **__: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        storage.write_results(results, tmp_path / "a" / "b" / "results.nc")
    assert not list(tmp_path.iterdir())


def test_attributes_are_read_as_they_were_written(results, tmp_path):
    """Escaped in the file for readers that know ASCII only; a backslash of ours is none of it."""
    words = {"title": "Größe, µm\nand \\n", "plain": "C:\\new", "plugins": '{"a": "\\u00b5"}'}
    written = results.assign_attrs(words)
    written["receiver"].attrs["long_name"] = "Estupiñan"
    storage.write_results(written, tmp_path / "r.nc")
    read = storage.open_results(tmp_path / "r.nc")
    assert {name: read.attrs[name] for name in words} == words
    assert read["receiver"].attrs["long_name"] == "Estupiñan"
    assert "escaped_attributes" not in read.attrs


# --- other versions ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("variable", "version", "again"),
    [
        ("criterion_value", "2", "this version, 3; make it again: vibroacoustics run STUDY.toml"),
        ("criterion_value", "1", "this version, 3; make it again: vibroacoustics run STUDY.toml"),
        ("criterion_value", 3, "this version, 3; make it again: vibroacoustics run STUDY.toml"),
        ("level", "4", "this version, 3; make it again: vibroacoustics run STUDY.toml"),
        ("channel_order", "2", "this version, 1; make it again: vibroacoustics orders RECORDING"),
    ],
)
def test_a_file_of_another_version_is_refused(tmp_path, variable, version, again):
    results = xr.Dataset({variable: 1.0}, attrs={"schema_version": version})
    path = storage.write_results(results, tmp_path / "results.nc")
    with pytest.raises(StorageError) as refused:
        va.open_results(path)
    assert str(refused.value) == f"{path}: schema_version = {version}: is no result of {again}"


@pytest.mark.parametrize(
    ("variable", "version"), [("criterion_value", "3"), ("channel_order", "1"), ("level", "1")]
)
def test_a_file_of_this_version_opens(tmp_path, variable, version):
    results = xr.Dataset({variable: 1.0}, attrs={"schema_version": version})
    path = storage.write_results(results, tmp_path / "results.nc")
    xr.testing.assert_identical(va.open_results(path), results)
