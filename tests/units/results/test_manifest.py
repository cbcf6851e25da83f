"""A folder whose files are of several runs is seen."""

import json
import os
from pathlib import Path

import pytest
import xarray as xr

from vibroacoustics.base.errors import StorageError
from vibroacoustics.base.folder import opened_folder
from vibroacoustics.results import lock, manifest, storage
from vibroacoustics.results.files import write


def results(title: str) -> xr.Dataset:
    return xr.Dataset({"a": ("x", [1.0, 2.0])}, attrs={"title": title})


def make(folder: Path, title: str, *names: str, dataset: str = "results.nc") -> None:
    """A run that writes these files."""
    with manifest.replacing(folder, dataset) as staged:
        storage.stage_results(results(title), staged, dataset)
        for name in names:
            write(staged, name, f"{name} of {title}".encode())


def names(folder: Path) -> set[str]:
    return {p.relative_to(folder).as_posix() for p in folder.rglob("*") if p.is_file()}


def test_all_files_are_listed_with_their_hash(tmp_path):
    make(tmp_path, "first", "a.csv", "figures/b.png")
    assert names(tmp_path) == {"results.nc", "a.csv", "figures/b.png", "files.json"}
    entry = json.loads((tmp_path / "files.json").read_text())["results.nc"]
    assert set(entry["files"]) == {"a.csv", "figures/b.png"}
    assert entry["sha256"] == storage.open_with_hash(tmp_path / "results.nc")[1]
    assert manifest.mixed(tmp_path) == []
    assert manifest.listed(tmp_path) == {"results.nc", "a.csv", "figures/b.png"}


def test_what_an_older_run_wrote_besides_is_removed(tmp_path):
    make(tmp_path, "first", "a.csv", "b.csv", "c.csv")
    (tmp_path / "c.csv").write_text("changed by the user")
    (tmp_path / "mine.csv").write_text("of the user")
    make(tmp_path, "second", "a.csv")
    assert names(tmp_path) == {"results.nc", "a.csv", "c.csv", "mine.csv", "files.json"}
    assert (tmp_path / "a.csv").read_text() == "a.csv of second"


def test_a_file_of_another_run_is_named(tmp_path):
    make(tmp_path, "first", "a.csv", "b.csv", "c.csv")
    old = (tmp_path / "a.csv").read_bytes()
    make(tmp_path, "second", "a.csv", "b.csv", "c.csv")
    (tmp_path / "a.csv").write_bytes(old)
    (tmp_path / "b.csv").unlink()
    storage.write_results(results("third"), tmp_path / "results.nc")
    assert manifest.mixed(tmp_path) == [
        f"{tmp_path}/results.nc: is not what the files beside it were made of",
        f"{tmp_path}/a.csv: is not that of results.nc",
        f"{tmp_path}/b.csv: is missing",
    ]


@pytest.mark.parametrize("has_list", [True, False])
@pytest.mark.parametrize("killed_at", range(4))
def test_killed_between_two_files_is_seen(tmp_path, monkeypatch, killed_at, has_list):
    """At every step: what lies there is the older run's, or it is named."""
    make(tmp_path, "first", "a.csv", "b.csv")
    if not has_list:
        (tmp_path / "files.json").unlink()
    moved, replace = [], os.replace

    def kill(source, target, **folders):
        if len(moved) == killed_at:
            raise KeyboardInterrupt
        moved.append(target)
        replace(source, target, **folders)

    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", kill)
        with pytest.raises(KeyboardInterrupt):
            make(tmp_path, "second", "a.csv", "b.csv")
    assert bool(manifest.mixed(tmp_path)) is (killed_at > 0)
    storage.open_results(tmp_path / "results.nc")
    make(tmp_path, "second", "a.csv", "b.csv")
    assert manifest.mixed(tmp_path) == []


def test_nothing_is_replaced_where_one_file_fails(tmp_path):
    make(tmp_path, "first", "a.csv")
    before = {name: (tmp_path / name).read_bytes() for name in names(tmp_path)}
    with pytest.raises(TypeError):
        make(tmp_path, "second", "a.csv", None)
    (tmp_path / "b.csv").mkdir()
    with pytest.raises(StorageError, match=r"b\.csv: is a folder, no regular file: remove it"):
        make(tmp_path, "second", "a.csv", "b.csv")
    assert {name: (tmp_path / name).read_bytes() for name in names(tmp_path)} == before


def test_two_datasets_in_a_folder(tmp_path):
    make(tmp_path, "run", "a.csv")
    make(tmp_path, "radiation", "map.png", dataset="transfer_vectors.nc")
    make(tmp_path, "again", "a.csv", "b.csv")
    assert manifest.mixed(tmp_path) == []
    assert "map.png" in names(tmp_path)
    (tmp_path / "results.nc").unlink()
    assert manifest.mixed(tmp_path) == [f"{tmp_path}/results.nc: is missing"]


def test_a_file_is_of_the_results_that_wrote_it_last(tmp_path):
    make(tmp_path, "run", "a.csv")
    make(tmp_path, "copy", "a.csv", dataset="copy.nc")
    assert manifest.mixed(tmp_path) == []


def test_files_of_results_elsewhere(tmp_path):
    with manifest.replacing(tmp_path, "results.nc", "0" * 64) as staged:
        write(staged, "a.csv", b"a")
    assert manifest.mixed(tmp_path) == []
    storage.write_results(results("other"), tmp_path / "results.nc")
    assert len(manifest.mixed(tmp_path)) == 1


def listing(dataset: str = "a", sha256: object = "0", files: object = None) -> bytes:
    entry = {"sha256": sha256, "beside": False, "files": {} if files is None else files}
    return json.dumps({dataset: entry}).encode()


@pytest.mark.parametrize(
    "content",
    [b"", b"[]", b"\xff", b'{"a": 1}', b"[" * 100_000, listing(sha256=1), listing(files=["b"]),
     listing(files={"../a": "0"}), listing(dataset="/a")],
)  # fmt: skip
def test_a_damaged_list_is_named_and_made_again(tmp_path, content):
    (tmp_path / "files.json").write_bytes(content)
    assert manifest.mixed(tmp_path) == [f"{tmp_path}/files.json: is damaged"]
    make(tmp_path, "run", "a.csv")
    assert manifest.mixed(tmp_path) == []


def test_a_folder_that_is_written_now_is_not_judged(tmp_path):
    make(tmp_path, "run", "a.csv")
    (tmp_path / "a.csv").unlink()
    with opened_folder(tmp_path) as folder, lock.locked(folder, ".lock", "it"):
        assert manifest.mixed(tmp_path) == []
    assert len(manifest.mixed(tmp_path)) == 1


def test_results_elsewhere_whose_name_is_no_utf_8(tmp_path):
    with manifest.replacing(tmp_path, os.fsdecode(b"caf\xe9.nc"), "0" * 64) as staged:
        write(staged, "a.csv", b"a")
    assert manifest.mixed(tmp_path) == []
    assert "a.csv" in manifest.listed(tmp_path)


def test_killed_before_what_an_older_run_wrote_is_removed(tmp_path, monkeypatch):
    """It is named, and the next run removes it; what the user has changed since stays."""
    make(tmp_path, "first", "a.csv", "b.csv", "c.csv")

    def kill(*_: object) -> None:
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(manifest, "_remove", kill)
        with pytest.raises(KeyboardInterrupt):
            make(tmp_path, "second", "a.csv")
    assert manifest.mixed(tmp_path) == [
        f"{tmp_path}/b.csv: is of older results than results.nc",
        f"{tmp_path}/c.csv: is of older results than results.nc",
    ]
    (tmp_path / "c.csv").write_text("changed by the user")
    make(tmp_path, "third", "a.csv")
    assert manifest.mixed(tmp_path) == []
    assert names(tmp_path) == {"results.nc", "a.csv", "c.csv", "files.json"}


def test_what_other_results_have_written_since_stays(tmp_path, monkeypatch):
    make(tmp_path, "first", "a.csv", "b.csv")
    with monkeypatch.context() as patch:
        patch.setattr(manifest, "_remove", lambda *_: None)
        make(tmp_path, "second", "a.csv")
    make(tmp_path, "first", "b.csv", dataset="other.nc")
    make(tmp_path, "third", "a.csv")
    assert manifest.mixed(tmp_path) == []
    assert "b.csv" in names(tmp_path)
