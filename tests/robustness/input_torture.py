"""Mutated studies and results, hostile files and names; see `torture`.

Each try is a process with a cap on its memory and on its time.
"""

import csv
import io
import json
import os
import random
import resource
import signal
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, Final

import h5py
import numpy as np
import xarray as xr
from torture import Trial, child, damage, ended

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "helpers"))
from mutated_studies import PATHS, make_tree, write_changed
from support import TINY, append_hash, made_up_radiation, tiny_run
from test_bad_recordings import GOOD

from vibroacoustics import pipeline, report, scoring
from vibroacoustics.base.csv_text import FORMULA_STARTS
from vibroacoustics.base.errors import LONGEST_LINE, SchemaError, VibroacousticsError
from vibroacoustics.commands import outputs
from vibroacoustics.recordings import child as reading
from vibroacoustics.recordings.reading import read_recording
from vibroacoustics.results.complete import check_run
from vibroacoustics.results.limits_file import read_limits
from vibroacoustics.study.loading import load_study

MEMORY_BYTES: Final = 3 * 2**30
"""What a try may take beyond what the process has: results of 2 GiB, and some more."""
SECONDS: Final = 60
VALUES: Final[tuple[Any, ...]] = (
    None, True, 0, -1, 1, 10**310, 0.0, -0.5, 1e300, float("nan"), float("inf"), "", "x", " ",
    "=1", "\n", "\ud7ff\u202e", [], [1.0], ["x", 2], {}, {"value": 1.0}, {"a": {"b": []}},
)  # fmt: skip


def limited(work: Callable[[], None]) -> list[str]:
    """What went wrong in a child that may be refused in short lines."""

    def in_bounds() -> None:
        pages = int(Path("/proc/self/statm").read_text().split()[0])
        most = pages * resource.getpagesize() + MEMORY_BYTES
        resource.setrlimit(resource.RLIMIT_AS, (most, most))
        signal.alarm(SECONDS)
        try:
            work()
        except VibroacousticsError as error:
            lines = str(error).splitlines()
            if any(len(line) > LONGEST_LINE or line != line.strip() for line in lines):
                raise AssertionError("a line is too long, or ends blank") from error

    code = ended(child(in_bounds))
    return [] if code == 0 else [f"traceback: code {code}"]


def mutate_a_study(folder: Path, chance: random.Random) -> list[str]:
    """Three changes one after the other, anywhere in the study or its machine."""
    make_tree(folder)
    bad = []
    for _ in range(3):
        change = chance.choice(PATHS), chance.choice(VALUES), chance.random() < 0.3
        path = write_changed(folder, *change)
        bad += [f"{reason} {change}" for reason in limited(lambda path=path: _load(path))]
    return bad


def _load(path: Path) -> None:
    load_study(path)


@cache
def results_of_a_run() -> xr.Dataset:
    return tiny_run()


def mutate_results(folder: Path, chance: random.Random) -> list[str]:
    """A variable, coordinate, attribute or key dropped or changed: refused, or a report."""
    results, what = mutated(results_of_a_run(), chance)

    def work() -> None:
        try:
            check_run(results)
            report.check_kept(results)
        except SchemaError:
            return
        scoring.ranking_text(scoring.score(results))
        report.render(results)

    return [f"{reason} {what}" for reason in limited(work)]


def mutated(results: xr.Dataset, chance: random.Random) -> tuple[xr.Dataset, object]:
    """Results with one change, and which."""
    kind = chance.choice(("drop", "fill", "cut", "attribute", "key"))
    if kind in ("drop", "fill"):
        name = chance.choice(sorted(map(str, results.variables)))
        if kind == "drop":
            return results.drop_vars(name), (kind, name)
        value = chance.choice((np.nan, np.inf, 0.0, -1.0, 999.0, 1e300, 1j, "x", True))
        old = results[name].variable
        new = xr.Variable(old.dims, np.full(old.shape, value), old.attrs)
        if name in results.data_vars:
            return results.assign({name: new}), (kind, name, value)
        return results.drop_vars(name).assign_coords({name: new}), (kind, name, value)
    if kind == "cut":
        dim = chance.choice(sorted(map(str, results.sizes)))
        chosen = chance.choice(([], [0], [-1], [0, 0], slice(None, None, -1)))
        return results.isel({dim: chosen}), (kind, dim, chosen)
    value = chance.choice(VALUES)
    if kind == "attribute":
        name = chance.choice(sorted(map(str, results.attrs)))
        return results.assign_attrs({name: value}), (kind, name, value)
    name = chance.choice(("parameters", "words"))
    content = json.loads(results.attrs[name])
    path = change_a_key(content, chance, value)
    changed = results.assign_attrs({name: json.dumps(content)})
    changed.attrs.pop("parameters_sha256")
    return changed, (kind, name, path, value)


def change_a_key(content: Any, chance: random.Random, value: object) -> list[object]:
    """Change a JSON value in place, somewhere; returns where."""
    path: list[object] = []
    while True:
        keys = sorted(content) if isinstance(content, dict) else range(len(content))
        key = chance.choice(keys)
        path.append(key)
        inner = content[key]
        if not isinstance(inner, dict | list) or not inner or chance.random() < 0.2:
            content[key] = value
            return path
        content = inner


def give_a_hostile_file(folder: Path, chance: random.Random) -> list[str]:
    """In place of a study, machine, table of limits, recording or results: refused."""
    make, read = chance.choice(HOSTILE), chance.choice(READERS)
    suffix = {read_limits: ".csv", _record: ".wav", outputs.open_run: ".nc"}.get(read, ".toml")
    path = folder / f"hostile{suffix}"
    make(path, chance)
    refused = folder / "refused"

    def work() -> None:
        try:
            read(path)
        except VibroacousticsError:
            refused.touch()
            raise

    bad = limited(work)
    bad += [] if bad or refused.exists() else ["wrong: read"]
    return [f"{reason} {make.__name__} {read.__name__}" for reason in bad]


def _pipe(path: Path, chance: random.Random) -> None:
    os.mkfifo(path)


def _device(path: Path, chance: random.Random) -> None:
    path.symlink_to("/dev/zero")


def _circle(path: Path, chance: random.Random) -> None:
    path.symlink_to(path.name)


def _noise(path: Path, chance: random.Random) -> None:
    path.write_bytes(chance.randbytes(chance.randrange(5000)))


def _huge(path: Path, chance: random.Random) -> None:
    with path.open("wb") as file:
        file.truncate(50_000_000_000)


def _long_key(path: Path, chance: random.Random) -> None:
    path.write_text(".".join(["a"] * 100_000) + " = 1\n")


def _deep(path: Path, chance: random.Random) -> None:
    path.write_text("a = " + "[" * 100_000)


def _claim(path: Path, chance: random.Random) -> None:
    with h5py.File(path, "w") as file:
        file.create_dataset("force", (2_000_000_000,), "f8", chunks=(1_000_000,))
    append_hash(path)


def _loop(path: Path, chance: random.Random) -> None:
    with h5py.File(path, "w") as file:
        file.create_group("a")["b"] = file["/"]
    append_hash(path)


def _machine(path: Path) -> None:
    text = TINY.read_text().replace("../../data/machines/copeland_zp41k3e.toml", path.name)
    study = path.with_name("study.toml")
    study.write_text(text)
    load_study(study)


def _record(path: Path) -> None:
    read_recording(path)


HOSTILE: Final = (
    _pipe, _device, _circle, _noise, _huge, _long_key, _deep, _claim, _loop
)  # fmt: skip
READERS: Final[tuple[Callable[[Path], object], ...]] = (
    _load, _machine, _record, read_limits, outputs.open_run
)  # fmt: skip


def give_a_hostile_name(folder: Path, chance: random.Random) -> list[str]:
    """Option and microphone that begin as formulas: no cell of a table does."""
    start = chance.choice(FORMULA_STARTS)
    name = start + "".join(chance.choices("=+-@a1'\"$<&;, |_", k=chance.randrange(1, 12))) + "z"
    text = TINY.read_text().replace("../../data", str(TINY.parents[2] / "data"))
    quoted = json.dumps(name)
    text = text.replace("[options.counterweight-half]", f"[options.{quoted}]")
    text = text.replace("[receivers.front_1m]", f"[receivers.{quoted}]")
    path = folder / "study.toml"
    path.write_text(text.replace('"front_1m"', quoted))

    def work() -> None:
        files = report.render(pipeline.run(load_study(path), radiation=made_up_radiation))
        tables = [content for name, content in files.items() if name.endswith(".csv")]
        assert tables
        for table in tables:
            for row in csv.reader(io.StringIO(table.decode())):
                assert not [cell for cell in row if is_formula(cell)], row

    return [f"{reason} {name!r}" for reason in limited(work)]


def is_formula(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return cell.startswith(FORMULA_STARTS)
    return False


def damage_a_recording(name: str) -> Trial:
    """One file of a format with a bit flipped or its end cut off: refused, or read.

    One of ten is read as a user reads it; the others without a new process of Python, where a
    parser may crash: what reads in place of the user does so too, and tells it.
    """

    def trial(folder: Path, chance: random.Random) -> list[str]:
        path = folder / name
        GOOD[name](path)
        damage(path, chance)
        if chance.random() < 0.1:
            return limited(lambda: _record(path))
        return [one for one in limited(lambda: _answered(path)) if "code -" not in one]

    def _answered(path: Path) -> None:
        header, _ = reading.answer(reading.Request(path))
        assert header.get("message", "") or header["samples"] >= 0, header

    trial.__name__ = f"damage_{name.replace('.', '_')}"
    return trial


INPUT_TRIALS: Final[tuple[Trial, ...]] = (
    mutate_a_study,
    mutate_results,
    give_a_hostile_file,
    give_a_hostile_name,
    *map(damage_a_recording, GOOD),
)
