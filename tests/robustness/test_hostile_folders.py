"""Hostile links and special files in a folder of results, its pieces, the cache and a log.

Each case plants one of them and writes or reads. Nothing outside the folder is changed, created or
removed; no pipe is waited for; what is refused is named with what to do.
"""

import json
import os
import signal
import socket
import stat
import warnings
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np
import pytest
import xarray as xr
from support import TINY, command_here, made_up_radiation
from test_design_kills import DESIGN

from vibroacoustics import pipeline
from vibroacoustics.base.errors import StorageError
from vibroacoustics.base.plain_bytes import sha256
from vibroacoustics.commands import messages, outputs
from vibroacoustics.design.evaluation import Evaluation
from vibroacoustics.design.store.pieces import opened_store
from vibroacoustics.pipeline.study import run as run_study
from vibroacoustics.report.analysis import Analysis
from vibroacoustics.report.blocks import Part, Pictures
from vibroacoustics.report.charts.svg import Picture
from vibroacoustics.results import cache, manifest, storage

LONGEST_S: Final = 100.0
PRECIOUS: Final = b"precious\n"
DATA: Final = xr.Dataset({"a": ("x", [1.0, 2.0])}, attrs={"title": "test"})
DESIGNS: Final = np.array([[1.0, 2.0]])


class WaitsForEver(BaseException):
    """A case does not end."""


class Ground(NamedTuple):
    """Where a case plays."""

    folder: Path
    """Of the results."""
    outside: Path
    """Beside it; nothing in it may change."""


# --- what is planted -----------------------------------------------------------------------------


def to_file(path: Path, outside: Path) -> None:
    path.symlink_to(outside / "precious")


def to_file_by_dots(path: Path, outside: Path) -> None:
    path.symlink_to(os.path.relpath(outside / "precious", path.parent))


def to_folder(path: Path, outside: Path) -> None:
    path.symlink_to(outside / "box", target_is_directory=True)


def to_folder_by_dots(path: Path, outside: Path) -> None:
    path.symlink_to(os.path.relpath(outside / "box", path.parent))


def to_nothing(path: Path, outside: Path) -> None:
    path.symlink_to(outside / "new")


def hard_link(path: Path, outside: Path) -> None:
    path.hardlink_to(outside / "precious")


def pipe(path: Path, _: Path) -> None:
    os.mkfifo(path)


def unix_socket(path: Path, _: Path) -> None:
    here = Path.cwd()
    os.chdir(path.parent)  # names of sockets are short
    with socket.socket(socket.AF_UNIX) as made:
        made.bind(path.name)
    os.chdir(here)


def device(path: Path, _: Path) -> None:
    try:
        os.mknod(path, stat.S_IFCHR | 0o600, os.makedev(1, 5))
    except PermissionError:
        pytest.skip("only root makes devices")


def full_of_links(path: Path, outside: Path) -> None:
    path.mkdir()
    to_folder(path / "box", outside)
    hard_link(path / "results.nc", outside)


Plant = Callable[[Path, Path], None]


# --- what is done --------------------------------------------------------------------------------


def write_run(ground: Ground) -> None:
    """A dataset, a table and a figure, as each command writes them."""
    picture = Picture("a", "a", "a figure", b"figure")
    part = Part("a", "A", (Pictures((picture,)),))
    table = {"a.csv": {"a": [1.0]}}
    analysis = Analysis("a", "A", "a", "", "", (part,), tables=table, figures="figures/")
    outputs.write_analysis(analysis, DATA, ground.folder, "results.nc")


def look(ground: Ground) -> None:
    manifest.mixed(ground.folder)
    outputs.older_files(ground.folder)
    command_here("doctor", ground.folder)


def put_piece(ground: Ground) -> None:
    with opened_store(ground.folder / "pieces", {"study": "a"}) as store:
        if "a" not in store:
            store.put("a", Evaluation(DESIGNS, np.empty((1, 0)), ("",)))


def use_cache(_: Ground) -> None:
    """A result comes; a warning says what to remove, where the cache cannot be used."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        assert storage.cached("kind", {"a": 1}, lambda: DATA)[0].equals(DATA)
    if caught:
        raise StorageError(str(caught[0].message))


def limit_cache(_: Ground) -> None:
    command("cache", "--limit", "1")


def clear_cache(_: Ground) -> None:
    command("cache", "--clear")


def write_log(ground: Ground) -> None:
    with messages.logged(ground.folder / "log.txt"):
        messages.note("a line")


def run(ground: Ground) -> None:
    command("run", TINY, "--out", ground.folder)


def sweep(ground: Ground) -> None:
    study = ground.folder.parent / "study.toml"
    study.write_text(TINY.read_text().replace("../../data", str(TINY.parents[2] / "data")) + DESIGN)
    command("sweep", study, "--out", ground.folder)


def new(ground: Ground) -> None:
    command("new", "reciprocating", "--out", ground.folder)


def command(*words: object) -> None:
    """A command line; a refusal as the error that it prints."""
    outcome = command_here(*words)
    if outcome.returncode:
        assert outcome.returncode == 2, outcome.stderr
        assert outcome.stderr.count("\n") == 1, outcome.stderr
        raise StorageError(outcome.stderr)


# --- files.json ----------------------------------------------------------------------------------


def listing(older: str, field: str = "older", dataset: str = "results.nc") -> Plant:
    """Plant a `files.json` whose results had a file besides, which has not been changed since."""

    def plant(path: Path, _: Path) -> None:
        entry = {"sha256": "0", "beside": True, "files": {}, "older": {}}
        entry[field] = {older: sha256(PRECIOUS)}
        path.write_text(json.dumps({dataset: entry}))

    return plant


def both(first: Plant, name: str, second: Plant) -> Plant:
    """Two plants; the second beside the first."""

    def plant(path: Path, outside: Path) -> None:
        first(path, outside)
        second(path.parent / name, outside)

    return plant


def absolute_entry(path: Path, outside: Path) -> None:
    listing(str(outside / "precious"))(path, outside)


# --- the cases -----------------------------------------------------------------------------------


class Case(NamedTuple):
    """What is planted where, what is done, and whether that is refused."""

    name: str
    plant: Plant
    act: Callable[[Ground], None]
    refused: bool


def cases(
    name: str, act: Callable[[Ground], None], refused: str, taken: str = ""
) -> Iterator[Case]:
    for plants, is_refused in ((refused, True), (taken, False)):
        yield from (Case(name, globals()[plant], act, is_refused) for plant in plants.split())


LINKS: Final = "to_file to_file_by_dots to_folder to_nothing"
SPECIAL: Final = "pipe unix_socket device"
CASES: Final = (
    *cases(".lock", write_run, f"{LINKS} {SPECIAL}", "hard_link"),
    *cases(".writing", write_run, f"{LINKS} {SPECIAL}", "full_of_links"),
    *cases("results.nc", write_run, f"{LINKS} {SPECIAL}", "hard_link"),
    *cases("a.csv", write_run, "to_file pipe", "hard_link"),
    *cases("figures", write_run, "to_folder to_folder_by_dots to_nothing to_file pipe"),
    *cases("figures/a.png", write_run, "to_file to_nothing pipe", "hard_link"),
    *cases("files.json", write_run, "to_file to_nothing pipe", "hard_link absolute_entry"),
    Case("files.json", listing("../outside/precious"), write_run, False),
    Case("files.json", listing("../outside/precious", "files"), write_run, False),
    Case("files.json", listing("b.csv", dataset="../outside/precious"), write_run, False),
    Case("files.json", both(listing("box/precious"), "box", to_folder), write_run, False),
    Case("files.json", both(listing("box/precious"), "box", to_folder_by_dots), write_run, False),
    Case("files.json", both(listing("old.csv", "files"), "old.csv", to_file), write_run, False),
    Case("files.json", both(listing("old.csv"), "old.csv", hard_link), write_run, False),
    Case("files.json", both(listing("old.csv"), "old.csv", pipe), write_run, False),
    *cases("pieces", put_piece, "to_folder to_folder_by_dots to_nothing pipe"),
    *cases("pieces/plan.json", put_piece, "to_file pipe"),
    *cases("pieces/pieces_00000000.bin", put_piece, "to_file to_nothing pipe", "hard_link"),
    *cases("pieces/.lock", put_piece, "to_file pipe", "hard_link"),
    *cases("pieces/.writing", put_piece, "to_folder"),
    *cases("cache/limit_bytes", limit_cache, "to_file to_nothing pipe", "hard_link"),
    *cases("cache/limit_bytes", use_cache, "", "to_file pipe hard_link"),
    *cases("cache/ENTRY", use_cache, "to_file to_nothing pipe", "hard_link"),
    *cases("cache/ENTRY.lock", use_cache, "to_file pipe device", "hard_link"),
    *cases("cache/.ENTRY.writing", use_cache, "to_folder to_nothing", "full_of_links"),
    *cases("cache/.old.nc.writing", clear_cache, "", "to_folder to_file full_of_links pipe"),
    *cases("cache/old.nc", clear_cache, "", "to_file to_folder hard_link pipe"),
    *cases("cache/old.nc.lock", clear_cache, "to_file pipe", "hard_link"),
    *cases("log.txt", write_log, "to_file to_nothing pipe device", "hard_link"),
    *cases(".lock", look, "", "to_file pipe"),
    *cases("files.json", look, "", "to_file pipe device"),
    *cases("results.nc", look, "", "to_file pipe device"),
    *cases("machine.toml", new, "to_nothing"),
    *cases("schemas", new, "to_folder"),
    *cases(".lock", run, "to_file pipe"),
    *cases("figures", run, "to_folder"),
    *cases("results.nc", run, "to_nothing", "hard_link"),
    *cases(".lock", sweep, "to_file"),
    *cases("sweep_pieces", sweep, "to_folder"),
)


@pytest.fixture(name="ground")
def _ground(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Ground]:
    """Folders, and an alarm for what waits for ever."""
    ground = Ground(tmp_path / "results", tmp_path / "outside")
    (ground.outside / "box").mkdir(parents=True)
    for name in ("precious", "box/precious", "box/a.png"):
        (ground.outside / name).write_bytes(PRECIOUS)
    ground.folder.mkdir()
    made_up = partial(run_study, radiation=made_up_radiation)
    monkeypatch.setattr(pipeline, "run", made_up, raising=False)
    monkeypatch.setattr(cache, "folder", lambda: ground.folder / "cache")
    (ground.folder / "cache").mkdir(mode=0o700)

    def wake(*_: object) -> None:
        raise WaitsForEver

    before = signal.signal(signal.SIGALRM, wake)
    signal.setitimer(signal.ITIMER_REAL, LONGEST_S)
    yield ground
    signal.setitimer(signal.ITIMER_REAL, 0.0)
    signal.signal(signal.SIGALRM, before)


def content(folder: Path) -> dict[str, tuple[object, ...]]:
    """Every name below a folder with kind, rights, owner, size, time and content."""
    found: dict[str, tuple[object, ...]] = {}
    for path in folder.rglob("*"):
        status = path.lstat()
        held = path.read_bytes() if path.is_file() else b""
        found[str(path)] = (
            status.st_mode, status.st_uid, status.st_mtime_ns, status.st_size, held
        )  # fmt: skip
    return found


def entry() -> str:
    """Name of the entry that `use_cache` asks for."""
    return storage._entry("kind", {"a": 1})


@pytest.mark.filterwarnings("ignore:.*its pieces are computed again")
@pytest.mark.parametrize(
    "case", CASES, ids=lambda case: f"{case.act.__name__}-{case.name}-{case.plant.__name__}"
)
def test_nothing_outside_is_touched(case: Case, ground: Ground) -> None:
    path = ground.folder / case.name.replace("ENTRY", entry())
    path.parent.mkdir(exist_ok=True)
    case.plant(path, ground.outside)
    before = content(ground.outside)
    error = None
    try:
        case.act(ground)
    except StorageError as refusal:
        error = str(refusal)
    assert content(ground.outside) == before
    assert (error is not None) is case.refused, error
    if error is not None:
        assert str(path) in error
        assert "remove it" in error or "is there already" in error


def test_there_are_forty_cases() -> None:
    assert len(CASES) >= 40


@pytest.mark.parametrize("act", [write_run, put_piece, use_cache, write_log])
def test_the_folder_itself_may_be_a_link(
    act: Callable[[Ground], None], ground: Ground, monkeypatch: pytest.MonkeyPatch
) -> None:
    link = ground.folder.with_name("link")
    link.symlink_to(ground.folder)
    monkeypatch.setattr(cache, "folder", lambda: link / "cache")
    act(Ground(link, ground.outside))
    made = {"write_run": "results.nc", "put_piece": "pieces/plan.json", "write_log": "log.txt"}
    assert (ground.folder / made.get(act.__name__, f"cache/{entry()}")).is_file()


def test_a_folder_that_is_a_link_to_nothing(ground: Ground) -> None:
    link = ground.folder.with_name("link")
    link.symlink_to(ground.outside / "new")
    with pytest.raises(StorageError, match="link: is a symbolic link to nothing: remove it"):
        write_run(Ground(link, ground.outside))
    assert not (ground.outside / "new").exists()


def test_a_log_with_several_links_is_copied(ground: Ground) -> None:
    """Its older lines stay in it, and the other name keeps its content."""
    hard_link(ground.folder / "log.txt", ground.outside)
    write_log(ground)
    lines = (ground.folder / "log.txt").read_text().splitlines()
    assert lines[0] == "precious"
    assert lines[1].endswith(" a line")
    assert (ground.outside / "precious").read_bytes() == PRECIOUS
