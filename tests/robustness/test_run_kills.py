"""Runs that are killed resume to the same bits, and compute less."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from random import Random

import pytest
import xarray as xr
from support import ROOT

from vibroacoustics.results import storage

pytestmark = pytest.mark.long
STUDY = ROOT / "tests" / "studies" / "sources_small.toml"
COUNTING = """
import atexit, os, sys
from vibroacoustics.__main__ import main
from vibroacoustics.results import piece_files
from vibroacoustics.results.run_pieces import RunPieces
piece_files.BATCH_S = 0.1
computed, keep = [], RunPieces.keep
RunPieces.keep = lambda store, key, content: (computed.append(key), keep(store, key, content))[1]
parent = os.getpid()
atexit.register(lambda: os.getpid() == parent and print("computed:", len(computed)))
main()
"""
"""The command with a file of pieces every 0.1 s; it prints how many pieces it has computed."""
OF_THE_RUN = ("created_utc", "history", "transfer_vectors")
"""Attributes of the moment, and of whether radiation was in the cache."""


def started(out: Path, cache: Path, study: Path = STUDY) -> subprocess.Popen[str]:
    words = [sys.executable, "-c", COUNTING, "run", str(study), "--out", str(out)]
    environment = {**os.environ, "XDG_CACHE_HOME": str(cache)}
    pipe = subprocess.PIPE
    return subprocess.Popen(words, stdout=pipe, stderr=pipe, text=True, env=environment)


def ended(process: subprocess.Popen[str]) -> tuple[int, int]:
    """Numbers of pieces that a run has read and computed."""
    output, errors = process.communicate(timeout=300)
    assert process.returncode == 0, errors
    read = [line.split()[4] for line in errors.splitlines() if line.startswith("continues")]
    return int(read[0]) if read else 0, int(output.rpartition("computed: ")[2])


def killed(out: Path, cache: Path, wait_s: float) -> None:
    """SIGKILL some time after the first file of pieces."""
    process = started(out, cache)
    while not list(cache.glob("*/run-*/pieces_*")) and process.poll() is None:
        time.sleep(0.01)
    time.sleep(wait_s)
    process.send_signal(signal.SIGKILL)
    process.communicate()


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory: pytest.TempPathFactory) -> tuple[xr.Dataset, int]:
    """Results and the number of pieces of a run that nothing ended."""
    folder = tmp_path_factory.mktemp("undisturbed")
    read, computed = ended(started(folder / "out", folder / "cache"))
    assert read == 0
    assert not list(folder.glob("cache/*/run-*"))
    return storage.open_results(folder / "out" / "results.nc"), computed


def assert_same(first: xr.Dataset, second: xr.Dataset) -> None:
    """Every bit of every variable, and the attributes."""
    assert first.variables.keys() == second.variables.keys()
    for name, variable in first.variables.items():
        assert variable.dtype == second[name].dtype
        assert variable.values.tobytes() == second[name].values.tobytes(), name
        assert variable.attrs == second[name].attrs
    for attribute in first.attrs.keys() | second.attrs.keys():
        if attribute not in OF_THE_RUN:
            assert first.attrs[attribute] == second.attrs[attribute], attribute


@pytest.mark.parametrize("seed", range(6))
def test_run_killed_at_random_resumes_to_the_same_bits(
    undisturbed: tuple[xr.Dataset, int], tmp_path: Path, seed: int
) -> None:
    """Killed once to three times; no piece on the disk is computed again."""
    chance, cache, out = Random(seed), tmp_path / "cache", tmp_path / "out"
    for _ in range(1 + seed % 3):
        killed(out, cache, chance.uniform(0.0, 12.0))
    read, computed = ended(started(out, cache))
    print(f"read {read}, computed {computed} of {undisturbed[1]}")
    assert read > 0
    assert computed <= undisturbed[1] - read
    assert_same(storage.open_results(out / "results.nc"), undisturbed[0])
    assert not list(cache.glob("*/run-*"))


def test_changed_study_reads_nothing(undisturbed: tuple[xr.Dataset, int], tmp_path: Path) -> None:
    killed(tmp_path / "out", tmp_path / "cache", 5.0)
    text = STUDY.read_text().replace("../../pipelines", str(ROOT / "pipelines"))
    changed = tmp_path / "sources_small.toml"
    changed.write_text(text.replace("range = [3.0, 6.75]", "range = [3.0, 6.7]"))
    read, computed = ended(started(tmp_path / "changed", tmp_path / "cache", changed))
    assert read == 0
    assert computed > 0
    assert list(tmp_path.glob("cache/*/run-*/pieces_*"))  # those of the first study
