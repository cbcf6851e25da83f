"""One small valid command line of every command, with its files, for tests over all commands."""

from pathlib import Path
from typing import Final

import numpy as np
import pytest
from design_studies import WEIGHT
from hammer_records import write as write_hammer
from in_situ_bench import BELOW
from in_situ_bench import write as write_blocked
from measured_bench import AS_MEASURED, FREQUENCY, state
from measured_bench import write as write_bench
from pictures import draw_nothing
from rooms_made_up import made_up_vectors
from support import MACHINE_FILE, TINY, made_up_radiation, made_up_transfer_vectors, tiny_run

import vibroacoustics as va
from vibroacoustics import pipeline
from vibroacoustics.base.progress import no_progress
from vibroacoustics.commands.balancing.template import TEMPLATE
from vibroacoustics.commands.permits.template import TEMPLATE as PERMIT
from vibroacoustics.pipeline.study import run as run_study
from vibroacoustics.results.storage import write_results
from vibroacoustics.stages import room

SPEED: Final = ("--rpm", "2900")
CASES: Final = {
    "run": ("study.toml",),
    "check": ("study.toml",),
    "radiation": ("study.toml",),
    "curves": (str(MACHINE_FILE), "--speed", "2900"),
    "new": ("reciprocating",),
    "report": ("results.nc",),
    "score": ("results.nc",),
    "compare": ("results.nc", "results.nc", "--other-option", "counterweight-half"),
    "datasheet": ("results.nc", "--option", "counterweight-half", "--speed", "2900"),
    "listen": ("results.nc", "--option", "none", "--speed", "2900", "--seconds", "1"),
    "impulse-responses": ("kitchen.toml", "--microphone", "table"),
    "sweep": ("designs.toml",),
    "optimise": ("designs.toml",),
    "orders": ("recording.csv", *SPEED, "--orders", "1,2", "--maximum-order", "5"),
    "track": ("recording.csv", *SPEED, "--orders", "1", "--bandwidth", "2"),
    "map": ("recording.csv", *SPEED),
    "tones": ("recording.csv",),
    "export": ("recording.csv",),
    "sound-power": ("recording.csv", "--hemisphere", "1"),
    "replay": (
        "recording.csv", *SPEED, "--results", "results.nc", "--option", "counterweight-half",
        "--pair", "front=front_1m",
    ),
    "predict": ("bench.toml",),
    "balance": ("balancing.toml",),
    "permit": ("permit.toml",),
    "blocked-forces": ("in_situ/in_situ.toml",),
    "check-functions": ("bench.toml",),
    "hammer": ("hammer/hammer.toml",),
    "cache": (),
    "doctor": (),
    "schema": (),
}  # fmt: skip
"""Arguments of each command; a name with an ending is a file of `write_inputs`."""
PRINTS_ONLY: Final = {"check", "check-functions", "cache", "doctor"}
"""Commands that write no file; all others have `--out`."""
FILE_OUT: Final = {"export": "copy.csv"}
"""Names of the files of the commands whose `--out` is a file."""
DESIGN = """
[design]
option = "weight"
[design.variables]
"options.weight.mass_g" = { list = [10, 50] }
[design.objectives.light]
figure = "added_mass_kg"
"""
ROOM = """
[room]
size_mm = [4000.0, 3000.0, 2500.0]
foot_mm = [3500.0, 400.0]
maximum_frequency_hz = 800.0
walls = { floor = "tiles", "-x" = "plaster", ceiling = "acoustic_ceiling" }
listeners.table = { x_mm = 2000.0, y_mm = 2200.0, height_mm = 1200.0 }
"""
HALVED = "[changes.halved.mounts.one]\nstiffness_n_per_mm = 100.0\nloss_factor_percent = 10.0\n"


def command_lines(folder: Path) -> dict[str, list[str]]:
    """Write the inputs, and return one valid command line of every command by its name.

    The words begin with the name of the command: `command_here(*words)` runs them in this process,
    `command(*words, cache=…)` in another. All results go to `folder/out/NAME`. Radiation and rooms
    take minutes; `made_up_fields` replaces them in this process.

    Parameters
    ----------
    folder : of the files; inputs that a former call has written there are used again
    """
    inputs = folder / "inputs"
    if not inputs.exists():
        inputs.mkdir(parents=True)
        write_inputs(inputs)
    return {name: words_of(name, inputs, folder / "out" / name) for name in CASES}


def words_of(name: str, inputs: Path, out: Path) -> list[str]:
    """Words of a command, its files within the inputs and its results in the folder `out`."""
    words = [str(inputs / word) if (inputs / word).is_file() else word for word in CASES[name]]
    target = out / FILE_OUT.get(name, "")
    return [name, *words, *(() if name in PRINTS_ONLY else ("--out", str(target)))]


def write_inputs(folder: Path) -> None:
    """Write a small input of every kind."""
    text = TINY.read_text().replace("../../data", str(MACHINE_FILE.parents[1]))
    (folder / "study.toml").write_text(text)
    (folder / "kitchen.toml").write_text(text + ROOM)
    (folder / "designs.toml").write_text(f"{text}\n{WEIGHT}\n{DESIGN}")
    write_results(tiny_run(), folder / "results.nc")
    time_s = np.arange(4 * 8000) / 8000.0
    noise = 0.01 * np.random.default_rng(1).standard_normal(time_s.size)
    sound = noise + np.cos(2.0 * np.pi * 2900.0 / 60.0 * time_s) + np.cos(5000.0 * time_s)
    va.export_recording(
        va.label_recording([sound], 8000.0, ["front"], ["Pa"]), folder / "recording.csv"
    )
    write_bench(folder, HALVED, state(FREQUENCY, AS_MEASURED))
    (folder / "balancing.toml").write_text(TEMPLATE)
    (folder / "permit.toml").write_text(PERMIT)
    (folder / "in_situ").mkdir()
    write_blocked(folder / "in_situ", BELOW)
    write_hammer(folder / "hammer")


def made_up_fields(patch: pytest.MonkeyPatch) -> None:
    """Replace radiation, rooms and pixels of figures, which take most of the time."""
    patch.setattr(
        pipeline,
        "run",
        lambda study, progress=no_progress, radiation=made_up_radiation: run_study(
            study, progress, radiation
        ),
        raising=False,
    )
    radiated = made_up_transfer_vectors(va.load_study(TINY))
    patch.setattr(pipeline, "radiate", lambda *_: radiated, raising=False)
    vectors = made_up_vectors(["table"], highest_hz=2000.0)
    patch.setattr(room, "vectors_of", lambda *_: (vectors, False))
    draw_nothing(patch)
