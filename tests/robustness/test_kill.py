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
from vibroacoustics.results.storage import from_bytes

ROOT = Path(__file__).resolve().parents[2]
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
    """Every visible file is complete: netCDF by its bytes and hash, the rest by how it ends."""
    for path in visible(folder):
        if path.suffix == ".nc":
            assert len(from_bytes(path.read_bytes(), path)) > 0
            if path.with_name(path.name + ".sha256").exists():
                open_results(path)
        elif path.suffix == ".html":
            assert path.read_text().rstrip().endswith("</html>")
        elif path.suffix == ".png":
            assert path.read_bytes().endswith(b"IEND\xaeB`\x82")
        elif path.suffix in {".csv", ".md"}:
            assert path.read_text().endswith("\n")


def timed(out: Path, cache: Path) -> float:
    """Seconds of a whole run."""
    begin = time.monotonic()
    assert start(out, cache).wait(timeout=300) == 0
    return time.monotonic() - begin


def kill_after(delay_s: float, out: Path, cache: Path) -> bool:
    """Whether the run was still going when it was killed."""
    process = start(out, cache)
    time.sleep(delay_s)
    running = process.poll() is None
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    return running


@pytest.mark.slow
def test_killed_twenty_times(tmp_path: Path) -> None:
    """Half of the kills hit a cold run anywhere, half the end of a warm one, where it writes."""
    generator = random.Random(20061)
    reference, reference_cache = tmp_path / "reference", tmp_path / "reference-cache"
    cold, warm = (timed(reference, reference_cache) for _ in range(2))
    expected = open_results(reference / "results.nc")
    out = tmp_path / "out"
    killed = tries = 0
    while killed < KILLS and tries < 3 * KILLS:
        tries += 1
        if killed % 2 == 0:
            cache, delay = tmp_path / f"cache-{tries}", generator.uniform(0.05, 0.95) * cold
        else:
            cache, delay = reference_cache, generator.uniform(0.5, 1.0) * warm
        killed += kill_after(delay, out, cache)
        assert_whole(out)
        assert_whole(cache)
    assert killed == KILLS
    timed(out, cache)
    xr.testing.assert_identical(
        open_results(out / "results.nc").drop_attrs(), expected.drop_attrs()
    )
