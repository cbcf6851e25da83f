"""A run that is killed leaves no half-written visible file, and a rerun gives the same values."""

import contextlib
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
import xarray as xr

from vibroacoustics import open_results

ROOT = Path(__file__).resolve().parent.parent
STUDY = ROOT / "tests" / "studies" / "tiny.toml"
KILLS = 20


def start(out: Path, cache: Path) -> subprocess.Popen[bytes]:
    return subprocess.Popen(
        [sys.executable, "-m", "vibroacoustics", "run", str(STUDY), "--out", str(out)],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        env={**os.environ, "XDG_CACHE_HOME": str(cache)},
        start_new_session=True,
    )


def visible(folder: Path) -> list[Path]:
    return [path for path in folder.rglob("*") if path.is_file() and not path.name.startswith(".")]


def assert_whole(folder: Path) -> None:
    """Every visible file is complete: netCDF by its hash, the rest by how it ends."""
    for path in visible(folder):
        if path.suffix == ".nc" and path.with_name(path.name + ".sha256").exists():
            open_results(path)
        elif path.suffix == ".html":
            assert path.read_text().rstrip().endswith("</html>")
        elif path.suffix == ".png":
            assert path.read_bytes().endswith(b"IEND\xaeB`\x82")
        elif path.suffix in {".csv", ".md"}:
            assert path.read_text().endswith("\n")


@pytest.mark.slow
def test_killed_twenty_times(tmp_path: Path) -> None:
    generator = random.Random(20061)
    begin = time.monotonic()
    reference = start(tmp_path / "reference", tmp_path / "reference-cache")
    assert reference.wait(timeout=300) == 0
    duration = time.monotonic() - begin
    expected = open_results(tmp_path / "reference" / "results.nc")
    out, cache = tmp_path / "out", tmp_path / "cache"
    killed = 0
    for number in range(KILLS):
        if number % 2 == 0:  # again from a cold cache
            cache = tmp_path / f"cache-{number}"
        process = start(out, cache)
        time.sleep(generator.uniform(0.05, 1.0) * duration)
        killed += process.poll() is None
        with contextlib.suppress(ProcessLookupError):  # it was faster
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        assert_whole(out)
        assert_whole(cache)
    assert killed >= KILLS // 2  # the test did what it says
    rerun = start(out, cache)
    assert rerun.wait(timeout=300) == 0, rerun.stderr and rerun.stderr.read()
    xr.testing.assert_identical(
        open_results(out / "results.nc").drop_attrs(), expected.drop_attrs()
    )
