"""The cache is a help and never a condition: full, read-only, locked or damaged, a run goes on."""

import os
import stat
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from support import assert_refused, command_here
from test_lock import hold

from vibroacoustics.base.folder import Folder
from vibroacoustics.results import cache, storage

RESULTS = xr.Dataset(
    {"a": ("x", np.random.default_rng(7).standard_normal(1000))}, attrs={"title": "test"}
)


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return cache.folder()


@pytest.fixture
def opened(folder) -> Iterator[Folder]:
    with cache.opened() as at:
        yield at


def compute() -> xr.Dataset:
    return RESULTS


def never() -> xr.Dataset:
    raise AssertionError("computed though it is there")


def keep(material: int, age_s: float = 0.0) -> Path:
    """An entry that was used so long ago."""
    before = set(cache.folder().glob("*.nc"))
    storage.cached("kind", {"a": material}, compute)
    (path,) = set(cache.folder().glob("*.nc")) - before
    os.utime(path, (time.time() - age_s,) * 2)
    return path


def test_folder_is_that_of_the_platform(folder, tmp_path):
    assert folder == tmp_path / "vibroacoustics"


def test_hit_and_miss(folder):
    calls = []

    def count():
        calls.append(1)
        return RESULTS

    first, first_cached = storage.cached("kind", {"a": 1}, count)
    second, second_cached = storage.cached("kind", {"a": 1}, count)
    storage.cached("kind", {"a": 2}, count)
    storage.cached("other", {"a": 1}, count)
    assert (first_cached, second_cached, len(calls)) == (False, True, 3)
    xr.testing.assert_identical(first, second)
    assert {path.suffix for path in folder.iterdir()} == {".nc"}


def test_address_does_not_depend_on_the_order_of_keys(folder):
    storage.cached("kind", {"a": 1, "b": [2.0]}, compute)
    assert storage.cached("kind", {"b": [2.0], "a": 1}, never)[1]


def test_damaged_entry_is_computed_again(folder):
    os.truncate(keep(1), 100)
    again, was_cached = storage.cached("kind", {"a": 1}, compute)
    assert not was_cached
    assert storage.cached("kind", {"a": 1}, never)[1]
    xr.testing.assert_identical(again, RESULTS)


def test_results_of_something_else_are_computed_again(folder):
    """Their hash is right: a copy under another name."""
    storage.write_results(RESULTS.assign_attrs(cache_entry="another"), keep(1))
    with pytest.warns(UserWarning, match=r"kind-.*\.nc: is no result of this entry; the run goes"):
        again, was_cached = storage.cached("kind", {"a": 1}, compute)
    assert not was_cached
    xr.testing.assert_identical(again, RESULTS)
    xr.testing.assert_identical(storage.cached("kind", {"a": 1}, never)[0], RESULTS)


def test_results_of_an_earlier_version_are_computed_again(folder):
    storage.write_results(RESULTS, keep(1))
    again, was_cached = storage.cached("kind", {"a": 1}, compute)
    assert not was_cached
    xr.testing.assert_identical(again, RESULTS)
    xr.testing.assert_identical(storage.cached("kind", {"a": 1}, never)[0], RESULTS)


def test_failed_computation_leaves_nothing(folder):
    def fail():
        raise RuntimeError("diverged")

    with pytest.raises(RuntimeError):
        storage.cached("kind", {"a": 1}, fail)
    assert not list(folder.iterdir())
    assert storage.cached("kind", {"a": 1}, compute)[1] is False


def test_without_the_cache_nothing_is_read_or_written(folder):
    with storage.without_cache():
        assert storage.cached("kind", {"a": 1}, compute)[1] is False
    assert not folder.exists()
    keep(1)
    with storage.without_cache():
        assert storage.cached("kind", {"a": 1}, compute)[1] is False
    assert storage.cached("kind", {"a": 1}, never)[1]


# --- a help, never a condition -------------------------------------------------------------------


def test_folder_that_cannot_be_made(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    with pytest.warns(UserWarning, match=r"cannot be written: Not a directory.*goes on") as told:
        assert storage.cached("kind", {"a": 1}, compute) == (RESULTS, False)
    assert len(told) == 1


def test_full_disk(folder, monkeypatch):
    """Of what was computed nothing is lost."""

    def fail(*_, **__):
        raise RuntimeError("NetCDF: HDF error")

    monkeypatch.setattr(xr.Dataset, "to_netcdf", fail)
    with pytest.warns(UserWarning, match=r"cannot be written: NetCDF: HDF error; the run") as told:
        assert storage.cached("kind", {"a": 1}, compute) == (RESULTS, False)
    assert len(told) == 1
    assert not list(folder.iterdir())


def test_no_lock_can_be_made_but_the_result_is_there(folder, monkeypatch):
    """As in a folder that may only be read."""
    keep(1)

    def refuse(*_, **__):
        raise PermissionError(13, "Permission denied")

    def read_only(path, flags, *rest, opened=os.open, **options):
        return refuse() if flags & os.O_CREAT else opened(path, flags, *rest, **options)

    monkeypatch.setattr(os, "open", read_only)
    monkeypatch.setattr(os, "utime", refuse)
    assert storage.cached("kind", {"a": 1}, never)[1]


def test_what_is_there_is_read_although_another_holds_the_lock(folder):
    path = keep(1)
    process = hold(folder / cache.lock_of(path.name), 60)
    try:
        assert storage.cached("kind", {"a": 1}, never)[1]
    finally:
        process.kill()
        process.wait()


def test_who_computes_the_same_is_waited_for_and_named(folder):
    path = keep(1)
    path.unlink()
    process = hold(folder / cache.lock_of(path.name), 1.5)
    with pytest.warns(UserWarning, match=rf"--no-cache.*waiting for process {process.pid} on"):
        assert storage.cached("kind", {"a": 1}, compute)[1] is False
    process.wait()


# --- size and leftovers --------------------------------------------------------------------------


def test_least_recently_used_go_first(opened):
    oldest, middle, newest = (keep(n, age_s=100.0 * (3 - n)) for n in range(3))
    names = [path.name for path in (oldest, middle, newest)]
    assert [entry.name for entry in cache.entries(opened)] == names
    storage.cached("kind", {"a": 0}, never)  # used again
    cache.set_limit(opened, 2 * oldest.stat().st_size + 10)
    assert [entry.name for entry in cache.tidy(opened)] == [middle.name]
    assert {entry.name for entry in cache.entries(opened)} == {oldest.name, newest.name}


def test_limit_is_kept_by_every_entry_that_comes(opened):
    first = keep(0, age_s=100.0)
    cache.set_limit(opened, round(2.5 * first.stat().st_size))
    for n in range(1, 4):
        keep(n, age_s=50.0 - n)
    sizes = [entry.size_bytes for entry in cache.entries(opened)]
    assert len(sizes) == 2
    assert sum(sizes) <= cache.limit_bytes(opened)
    assert not first.exists()


def test_an_entry_above_the_limit_is_not_kept(opened):
    cache.set_limit(opened, 10)
    with pytest.warns(UserWarning, match="is not kept"):
        assert storage.cached("kind", {"a": 1}, compute) == (RESULTS, False)
    assert not cache.entries(opened)


@pytest.mark.parametrize("text", ["", "many", "-5"])
def test_limit_that_is_no_size(folder, opened, text):
    (folder / cache.LIMIT_NAME).write_text(text)
    assert cache.limit_bytes(opened) in (0, cache.DEFAULT_LIMIT_BYTES)


def test_leftovers_of_the_dead_go_and_the_living_stay(folder, opened):
    keep(1)
    (folder / "kind-dead.nc.lock").write_text("")
    (folder / ".kind-dead.nc.writing").mkdir()
    (folder / ".kind-dead.nc.writing" / "kind-dead.nc").write_text("a part")
    (folder / ".kind-old.nc.x8gh21ab").write_text("a part")
    (folder / "kind-gone.nc.study").write_text("gone")
    (folder / ".kind-busy.nc.writing").mkdir()
    process = hold(folder / "kind-busy.nc.lock", 60)
    try:
        cache.tidy(opened)
        names = {path.name for path in folder.iterdir() if path.suffix != ".nc"}
        assert names == {".kind-busy.nc.writing", "kind-busy.nc.lock"}
        assert len(cache.clear(opened)) == 1
        assert {path.name for path in folder.iterdir()} == names
    finally:
        process.kill()
        process.wait()


# --- who else can write it -----------------------------------------------------------------------


def test_folders_are_made_for_their_owner_alone(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "a" / "b"))
    keep(1)
    made = [tmp_path / "a", tmp_path / "a" / "b", cache.folder()]
    assert [stat.S_IMODE(path.stat().st_mode) for path in made] == [0o700] * 3


@pytest.mark.parametrize("mode", [0o775, 0o770, 0o2720])
def test_a_folder_that_the_group_can_write_becomes_private(folder, mode):
    folder.mkdir()
    folder.chmod(mode)
    keep(1)
    assert stat.S_IMODE(folder.stat().st_mode) == 0o700


def test_a_folder_that_others_can_only_read_stays(folder):
    folder.mkdir(0o755)
    keep(1)
    assert stat.S_IMODE(folder.stat().st_mode) == 0o755


def test_a_folder_that_all_can_write_is_not_used(folder):
    folder.mkdir()
    folder.chmod(0o1777)
    not_used("is writable by all users: remove it")


def test_a_folder_of_another_user_is_not_used(folder, monkeypatch):
    keep(1)
    other = os.geteuid() + 1
    monkeypatch.setattr(os, "geteuid", lambda: other)
    not_used("belongs to another user: set XDG_CACHE_HOME, or remove it")


def not_used(reason: str) -> None:
    """One warning, whatever is asked of it; nothing in it is read, made or changed."""
    before = sorted(cache.folder().iterdir())
    words = f"cache {cache.folder()}: {reason}; the run goes on without it"
    with pytest.warns(UserWarning, match=f"^{words}$") as warned:
        assert storage.cached("kind", {"a": 1}, compute) == (RESULTS, False)
    assert len(warned) == 1
    assert not storage.is_cached("kind", {"a": 1})
    assert sorted(cache.folder().iterdir()) == before
    outcome = command_here("cache", "--clear")
    assert_refused(outcome, str(cache.folder()), reason)
    assert f"cache: not used: {cache.folder()}: {reason}" in command_here("doctor").stdout
    assert sorted(cache.folder().iterdir()) == before


# --- the limit -----------------------------------------------------------------------------------


def total(folder: Path) -> int:
    """Size of all files of the cache but that of its limit."""
    files = (file for file in folder.rglob("*") if file.is_file())
    return sum(file.stat().st_size for file in files if file.name != cache.LIMIT_NAME)


def sized(opened: Folder, limit: int, materials: int = 4) -> int:
    """Size of the cache after some results with a limit, each with the title of a study."""
    cache.set_limit(opened, limit)
    for material in range(materials):
        storage.cached("kind", {"a": material}, compute, "A study")
        assert total(opened.path) <= limit
    return total(opened.path)


def test_limits_to_the_byte(opened):
    """Titles of studies count; at the exact size of two results two are kept, below it one."""
    one = sized(opened, 10**9, 1)
    assert sized(opened, 2 * one) == 2 * one
    assert sized(opened, 2 * one - 1) == one
    assert sized(opened, one) == one
    with pytest.warns(UserWarning, match=r"does not fit its limit of .* and is not kept") as warned:
        assert sized(opened, one - 1) == 0
    assert len({str(each.message) for each in warned}) == 1
    assert sized(opened, 0) == 0  # which is no remark: the cache is switched off


def test_a_result_above_the_limit_leaves_the_others(opened):
    first = keep(0)
    cache.set_limit(opened, first.stat().st_size + 10)
    large = xr.concat([RESULTS] * 3, "y")
    with pytest.warns(UserWarning, match="is not kept"):
        storage.cached("kind", {"a": 1}, lambda: large)
    assert [entry.name for entry in cache.entries(opened)] == [first.name]


def test_unfinished_files_of_others_count(folder, opened):
    """They cannot be removed; older entries go for them."""
    keep(0, age_s=100.0)
    last = keep(1)
    (folder / ".kind-busy.nc.writing").mkdir()
    (folder / ".kind-busy.nc.writing" / "kind-busy.nc").write_bytes(bytes(100))
    process = hold(folder / "kind-busy.nc.lock", 60)
    try:
        cache.set_limit(opened, 2 * last.stat().st_size + 99)
        cache.tidy(opened)
        assert [entry.name for entry in cache.entries(opened)] == [last.name]
    finally:
        process.kill()
        process.wait()


def test_command_lists_a_cache_within_its_limit(folder, opened):
    """Also after a process that was killed."""
    size = keep(0, age_s=100.0).stat().st_size
    last = keep(1)
    cache.set_limit(opened, 2 * size - 1)
    lines = command_here("cache").stdout.splitlines()
    assert lines[0].startswith("removed 1 results")
    assert [path.name for path in folder.glob("*.nc")] == [last.name]
