"""Searches and sweeps that are killed resume to the same bits, here and with workers."""

import json
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path
from random import Random

import psutil
import pytest
from certificates import certified, needs_openssl
from design_studies import LEFT, WEIGHT
from support import ROOT, TINY

pytestmark = pytest.mark.long
DESIGN = """
[design]
option = "weight"
tolerance_samples = 4096  # pieces of four designs
[design.search]
population = 16
generations = 24
fresh_samples = 100
[design.objectives.quiet]
figure = "order_level_db"
order = 1
[design.objectives.mass]
figure = "added_mass_kg"
[design.variables]
"options.weight.mass_g" = { range = [1.0, 200.0] }
"options.weight.angle_deg" = { range = [-180.0, 180.0] }
[design.tolerances]
"options.weight.mass_g" = { ratio = 0.03 }
"""


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A study with a design space."""
    file = tmp_path_factory.mktemp("study") / "designs.toml"
    written = TINY.read_text().replace("../../data", str(ROOT / "data"))
    file.write_text(written + LEFT + WEIGHT + DESIGN)
    return file


@pytest.fixture(scope="module")
def undisturbed(study: Path, tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """All designs of a search that nothing ended."""
    return designs_of(study, tmp_path_factory.mktemp("undisturbed"))


def command(study: Path, out: Path, *options: str) -> list[str]:
    return [sys.executable, "-m", "vibroacoustics", "optimise", str(study), "--out", str(out),
            *options]  # fmt: skip


def designs_of(study: Path, out: Path, *options: str) -> bytes:
    """All designs of a search, as CSV."""
    subprocess.run(command(study, out, *options), check=True, capture_output=True)
    return (out / "designs.csv").read_bytes()


SMALL_FILES = """
import sys
from vibroacoustics.__main__ import main
from vibroacoustics.results import piece_files
piece_files.BATCH_S = 0.1
main()
"""
"""The command with a file of pieces every 0.1 s: a search as short as this one writes several."""


def killed_and_gone_on(study: Path, out: Path, seed: int) -> bytes:
    """SIGKILL at a random moment after the first stored pieces, then the same command again."""
    words = [sys.executable, "-c", SMALL_FILES, *command(study, out)[3:]]
    process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while not list(out.glob("search_pieces/pieces_*")) and process.poll() is None:
        time.sleep(0.01)
    time.sleep(Random(seed).uniform(0.0, 1.0))
    process.send_signal(signal.SIGKILL)
    process.wait()
    assert list(out.glob("search_pieces/pieces_*"))
    return designs_of(study, out)


@pytest.mark.parametrize("seed", range(30))
def test_search_killed_at_random(
    study: Path, undisturbed: bytes, tmp_path: Path, seed: int
) -> None:
    assert killed_and_gone_on(study, tmp_path, seed) == undisturbed


def test_two_workers_equal_serial_without_a_network(
    study: Path, undisturbed: bytes, tmp_path: Path
) -> None:
    """A worker is killed whenever there are two, twice; no process has a socket with a name."""
    search = subprocess.Popen(command(study, tmp_path, "--workers", "2"), stdout=subprocess.DEVNULL)
    deaths, most_workers = 0, 0
    while search.poll() is None:
        with suppress(psutil.NoSuchProcess):
            parent = psutil.Process(search.pid)
            children = parent.children(recursive=True)
            for process in (parent, *children):
                assert not [one for one in process.net_connections("all") if one.laddr]
            workers = [one for one in children if "spawn_main" in " ".join(one.cmdline())]
            most_workers = max(most_workers, len(workers))
            if len(workers) == 2 and deaths < 2:
                time.sleep(0.5)
                workers[0].kill()
                deaths += 1
        time.sleep(0.05)
    assert (search.returncode, deaths, most_workers) == (0, 2, 2)
    assert (tmp_path / "designs.csv").read_bytes() == undisturbed


@needs_openssl
def test_scheduler_by_tls_equals_serial(study: Path, undisturbed: bytes, tmp_path: Path) -> None:
    """With the commands that docs/designs.md names; without TLS the scheduler does not answer."""
    files = certified(tmp_path / "certificates")
    dask = str(Path(sys.executable).with_name("dask"))
    ours = [
        word for name, path in files.items() for word in (f"--{name.replace('_', '-')}", str(path))
    ]
    theirs = [word.replace("--tls-ca", "--tls-ca-file") for word in ours]
    local = ["--host", "127.0.0.1", "--no-dashboard", "--dashboard-address", "127.0.0.1:0"]
    listing = tmp_path / "scheduler.json"
    processes = [
        subprocess.Popen(
            [dask, role, *theirs, *local, "--scheduler-file", str(listing), *options],
            stderr=subprocess.DEVNULL,
        )
        for role, options in (
            ("scheduler", ["--protocol", "tls", "--port", "0"]),
            ("worker", ["--nthreads", "1", "--no-nanny"]),
        )
    ]
    try:
        while not listing.exists():
            time.sleep(0.1)
        address = json.loads(listing.read_text())["address"]
        out = tmp_path / "out"
        assert designs_of(study, out, "--scheduler", address, *ours) == undisturbed
        insecure = address.replace("tls:", "tcp:"), "--insecure"
        words = command(study, tmp_path / "refused", "--scheduler", *insecure)
        refused = subprocess.run(words, capture_output=True, text=True, check=False)
        assert refused.returncode == 2
        assert "no connection" in refused.stderr.splitlines()[-1]
    finally:
        for process in processes:
            process.kill()
            process.wait()


RUNS = """
[design]
option = "weight"
[design.objectives.foot]
figure = "foot_force_1x_n"
[design.variables]
"options.weight.mass_g" = { range = [1.0, 200.0], points = 40 }
"options.weight.angle_deg" = { range = [-180.0, 180.0], points = 20 }
"""
LONGEST_LOST_S = 15.0
"""A file is written every 10 s or after the piece in work, here of a second; 4 s for the host."""


def test_sweep_of_runs_killed_twenty_times(tmp_path: Path) -> None:
    """Each kill loses at most 15 s: a file of pieces is no older, or the sweep began since."""
    file = tmp_path / "runs.toml"
    written = TINY.read_text().replace("../../data", str(ROOT / "data"))
    file.write_text(written + WEIGHT + RUNS)
    killed, undisturbed = tmp_path / "killed", tmp_path / "undisturbed"
    lost_s = []
    for wait_s in Random(1).sample(range(1, 21), 20):
        process = subprocess.Popen(swept(file, killed), stderr=subprocess.DEVNULL)
        begin_s = begun_s(process, killed / "sweep_pieces" / ".lock")
        with suppress(subprocess.TimeoutExpired):
            process.wait(float(wait_s))
        files = [one.stat().st_mtime for one in killed.glob("sweep_pieces/pieces_*")]
        if process.poll() is None:
            lost_s.append(time.time() - max(begin_s, *files, 0.0))
        process.send_signal(signal.SIGKILL)
        process.wait()
    assert max(lost_s) <= LONGEST_LOST_S
    for out, options in ((killed, ()), (undisturbed, ("--workers", "2"))):
        subprocess.run(swept(file, out, *options), check=True, capture_output=True)
    assert (killed / "sweep.csv").read_bytes() == (undisturbed / "sweep.csv").read_bytes()


def swept(study: Path, out: Path, *options: str) -> list[str]:
    """Words of a sweep."""
    words = ["sweep" if word == "optimise" else word for word in command(study, out, *options)]
    return [*words, "--quiet"]


def begun_s(process: subprocess.Popen[bytes], lock: Path) -> float:
    """Wait until a process holds the lock of the store, or has ended; gives the time."""
    while process.poll() is None:
        with suppress(OSError, ValueError, KeyError):
            if json.loads(lock.read_text())["process"] == process.pid:
                break
        time.sleep(0.02)
    return time.time()


def test_folder_of_another_study_is_refused(study: Path, tmp_path: Path) -> None:
    (tmp_path / "search_pieces").mkdir()
    (tmp_path / "search_pieces" / "plan.json").write_text("{}")
    done = subprocess.run(command(study, tmp_path), capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "holds designs of another study" in done.stderr
    assert "Traceback" not in done.stderr
