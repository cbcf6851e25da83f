"""A disk that is full while a run is written: the system's reason in a line, the old run whole."""

import os
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from support import tiny_run

from vibroacoustics.base.errors import StorageError
from vibroacoustics.commands import outputs
from vibroacoustics.results import manifest, storage

DISK_BYTES = 8 * 2**20


@pytest.fixture
def disk(tmp_path: Path) -> Iterator[Path]:
    """A file system of its own in memory, where the system lets one be mounted."""
    folder = tmp_path / "disk"
    folder.mkdir()
    mount = ("mount", "-t", "tmpfs", "-o", f"size={DISK_BYTES}", "none", str(folder))
    if os.geteuid() or subprocess.run(mount, capture_output=True, check=False).returncode:
        pytest.skip("no file system can be mounted")
    yield folder
    subprocess.run(("umount", "--lazy", str(folder)), check=True)


@pytest.mark.parametrize("moments", [3, pytest.param(10, marks=pytest.mark.long)])
def test_the_old_run_stays_at_every_moment(disk: Path, moments: int) -> None:
    """Less and less is left for a second run, from nothing to nearly all that it needs."""
    results = tiny_run()
    out = disk / "out"
    outputs.write_report(results, out)
    before = content(out)
    needed = sum(map(len, before.values()))
    refused = []
    for moment in range(moments):
        with (disk / "ballast").open("wb") as ballast:
            status = os.statvfs(disk)
            left = 4096 + needed * moment // moments
            ballast.write(bytes(max(status.f_bavail * status.f_bsize - left, 0)))
        with suppress_refusals(refused):
            outputs.write_report(results.assign_attrs(title="second"), out)
        (disk / "ballast").unlink()
        if len(refused) == moment + 1:
            assert content(out) == before
        assert not manifest.mixed(out)
        storage.open_results(out / "results.nc")
    assert len(refused) >= moments - 1
    for words in refused:
        assert "No space left" in words
        assert "\n" not in words


def content(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@contextmanager
def suppress_refusals(refused: list[str]) -> Iterator[None]:
    """Take down what is refused."""
    try:
        yield
    except StorageError as error:
        refused.append(str(error))
