"""Small studies with every kind of data file, and what a file may hold in place of its data."""

import copy
import shutil
import tomllib
from collections.abc import Callable, Iterator
from functools import partial
from itertools import islice
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr
from mutated_studies import leaves, toml
from sources_study import SOURCES_STUDY, made_up_modes
from support import MACHINE_FILE, ROOT, TINY

import vibroacoustics as va
from vibroacoustics import pipeline
from vibroacoustics.base.errors import VibroacousticsError
from vibroacoustics.pipeline.cost import run_cost
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.study import Study

FEET: Final = ("front_left", "front_right", "rear_left", "rear_right")
_HZ: Final = np.arange(10.0, 1301.0, 10.0)


class Inputs(NamedTuple):
    """A study and the data file that it names."""

    study: Path
    file: Path


def _tiny(folder: Path, before: str = "", scoring: str = "", machine: str = "") -> Path:
    text = TINY.read_text().replace("../../data", str(ROOT / "data"))
    if machine:
        (folder / "machine.toml").write_text(MACHINE_FILE.read_text() + machine)
        text = text.replace(str(MACHINE_FILE), "machine.toml")
    text = text.replace("[receivers.", f"{before}\n[receivers.", 1)
    (folder / "study.toml").write_text(text.replace("[scoring.", f"{scoring}\n[scoring.", 1))
    return folder / "study.toml"


def published_table(folder: Path) -> Inputs:
    """Published scores."""
    file = folder / "data.csv"
    file.write_text("# printed\ncriterion,none,half\nforces,1,2\nsound,3,4\nsum,4,6\n")
    return Inputs(_tiny(folder, scoring='[scoring]\npublished_table = "data.csv"'), file)


def forces(folder: Path) -> Inputs:
    """Published forces."""
    file = folder / "data.csv"
    shutil.copy(ROOT / "data" / "validation" / "copeland_forces.csv", file)
    return Inputs(_tiny(folder, '[evidence]\nforces = "data.csv"'), file)


def spectrum(folder: Path) -> Inputs:
    """Measured third octaves that weigh the samples."""
    file, study = folder / "data.csv", folder / "study.toml"
    file.write_text("frequency_hz,level_dba\n63,20.5\n80,30\n100,31\n")
    study.write_text(
        f'extends = "{SOURCES_STUDY}"\n[evidence.spectrum]\nfile = "data.csv"\n'
        'microphone = "front_1m"\nspeed_rpm = 2900.0\n'
    )
    return Inputs(study, file)


def thirds(folder: Path) -> Inputs:
    """Third octaves of a measured baseline."""
    file = folder / "data.csv"
    rows = "".join(f"front_1m,2900,{hz},{50 + n}\n" for n, hz in enumerate((63, 80, 100)))
    file.write_text(f"microphone,speed_rpm,band_hz,level_db\n{rows}")
    return Inputs(_tiny(folder, '[measured.baseline]\nfile = "data.csv"'), file)


def orders(folder: Path) -> Inputs:
    """Orders of a measured baseline."""
    file = folder / "data.csv"
    rows = "".join(f"front_1m,2900,{order},{50 - order},0\n" for order in (1, 2, 3))
    file.write_text(f"microphone,speed_rpm,order,level_db,phase_deg\n{rows}")
    return Inputs(_tiny(folder, '[measured.baseline]\nfile = "data.csv"'), file)


def mount_table(folder: Path) -> Inputs:
    """Stiffness of the mounts over frequency."""
    file = folder / "data.csv"
    shutil.copy(ROOT / "data" / "tables" / "reciprocating_mount.csv", file)
    table = '[mount_stiffness]\nfile = { value = "data.csv", source = "measured" }\n'
    return Inputs(_tiny(folder, machine=f"\n{table}"), file)


def floor_table(folder: Path) -> Inputs:
    """Mobility under the feet."""
    file = folder / "data.csv"
    rows = "".join(f"{hz:g},{1e-5 * hz:g},90\n" for hz in _HZ)
    file.write_text(f"frequency_hz,vertical_mobility_m_per_ns,vertical_phase_deg\n{rows}")
    table = '[floor_mobility]\nfile = { value = "data.csv", source = "measured" }\n'
    return Inputs(_tiny(folder, machine=f"\n{table}"), file)


def force_table(folder: Path) -> Inputs:
    """Forces of a machine by table."""
    for name in ("machines", "tables"):
        shutil.copytree(ROOT / "data" / name, folder / "data" / name)
    text = (ROOT / "pipelines" / "reciprocating_table.toml").read_text()
    (folder / "pipelines").mkdir()
    study = folder / "pipelines" / "study.toml"
    study.write_text(text)
    return Inputs(study, folder / "data" / "tables" / "reciprocating_forces.csv")


def _functions(axis: str, unit: str, at: int = 0) -> list[va.MeasuredFunction]:
    omega = 2.0 * np.pi * _HZ
    values = 1.0 / (4e5 * (1 + 0.05j) - omega**2 * 20.0) if unit == "m" else 0.01 + 0.01j * _HZ
    return [
        va.MeasuredFunction(
            "frequency response", _HZ, values, va.Node(at or 11 + number, "" if at else f"+{axis}"),
            va.Node(11 + number, f"+{axis}"), unit, "N",
        )
        for number in range(4)
    ]  # fmt: skip


def _points() -> str:
    return "".join(
        f'points.p{number} = {{ node = {11 + number}, direction = "+z", foot = "{foot}" }}\n'
        for number, foot in enumerate(FEET)
    )


def floor_functions(folder: Path, suffix: str = ".csv") -> Inputs:
    """Measured functions of the floor."""
    file = va.export_functions(_functions("z", "m"), folder / f"data{suffix}")
    table = f'[measured.floor]\nfrequency_responses = ["{file.name}"]\n{_points()}'
    return Inputs(_tiny(folder, table), file)


def sound_functions(folder: Path) -> Inputs:
    """Measured sound pressure per force at the feet."""
    file = va.export_functions(_functions("z", "Pa", at=101), folder / "data.csv")
    table = (
        f'[measured.sound]\nfrequency_responses = ["{file.name}"]\n{_points()}'
        "microphones.front_1m.node = 101\n"
    )
    return Inputs(_tiny(folder, table), file)


def floor_universal_file(folder: Path) -> Inputs:
    """Measured functions of the floor as universal file."""
    return floor_functions(folder, ".uff")


STUDIES: Final[dict[str, Callable[[Path], Inputs]]] = {
    each.__name__: each
    for each in (
        published_table, forces, spectrum, thirds, orders, mount_table, floor_table, force_table,
        floor_functions, floor_universal_file, sound_functions,
    )
}  # fmt: skip


def _cells(text: str) -> tuple[list[str], list[list[str]]]:
    lines = text.splitlines()
    comments = [line for line in lines if line.startswith("#")]
    return comments, [line.split(",") for line in lines if not line.startswith("#")]


def _with_cell(word: str, row: int, column: int) -> Callable[[str], str]:
    def changed(text: str) -> str:
        comments, rows = _cells(text)
        cells = rows[row]
        cells[column % len(cells)] = word
        return "\n".join([*comments, *map(",".join, rows)]) + "\n"

    return changed


def _with_rows(change: Callable[[list[list[str]]], list[list[str]]]) -> Callable[[str], str]:
    def changed(text: str) -> str:
        comments, (head, *rows) = _cells(text)
        return "\n".join([*comments, *map(",".join, [head, *change(rows)])]) + "\n"

    return changed


NUMBERS: Final = ("0", "-1", "1e9", "1e300", "-1e300", "1e-300", "nan", "inf", "word", "", "1e999")
CONTENTS: Final[dict[str, Callable[[str], str | bytes]]] = {
    "empty": lambda _: "",
    "a word": lambda _: "hello\n",
    "no text": lambda _: bytes(range(256)),
    "other columns": lambda _: "x,y,z\n1,2,3\n2,3,4\n",
    "TOML": lambda _: "[a]\nb = 1\n",
    "a column of numbers": lambda _: "1\n2\n3\n",
    "head alone": _with_rows(lambda _: []),
    "one row": _with_rows(lambda rows: rows[:1]),
    "last row": _with_rows(lambda rows: rows[-1:]),
    "rows twice": _with_rows(lambda rows: rows + rows),
    "rows in reverse": _with_rows(lambda rows: rows[::-1]),
    "a row short": _with_rows(lambda rows: [rows[0][:-1], *rows[1:]]),
    "half": lambda text: text[: len(text) // 2],
    "columns in reverse": lambda text: "\n".join(
        ",".join(row[::-1]) for row in _cells(text)[1]
    ) + "\n",
    "a name twice": lambda text: _with_cell(_cells(text)[1][0][0], 0, -1)(text),
    "rows of one name": _with_rows(
        lambda rows: [[rows[0][0], *row[1:]] for row in rows]
    ),
    **{
        f"{word or 'nothing'} in row {row}, column {column}": _with_cell(word, row, column)
        for word in NUMBERS
        for row in (1, -1)
        for column in (0, 1, -2, -1)
    },
}  # fmt: skip
"""Content of a file, from that of its data."""


def change(file: Path, name: str) -> None:
    """Put other content in the place of a file; a folder, or nothing, also."""
    if name in ("missing", "folder", "without rights"):
        file.unlink()
        if name == "folder":
            file.mkdir()
        return
    content = CONTENTS[name](file.read_text(encoding="latin-1"))
    file.write_bytes(content if isinstance(content, bytes) else content.encode("latin-1"))


VALUES: Final[tuple[Any, ...]] = (
    0, 0.0, -1.0, 1, 7, 1e-9, 0.5, 50.0, 1000.0, 1e6, 1e300, -1e300, float("nan"), float("inf"),
    "", "word", "none", True, [], [0.0], [1.0, 1.0], [3000.0, 60.0, 60000.0], ["none"], {},
)  # fmt: skip
"""In the place of any value of a study."""


def rigid(folder: Path) -> tuple[Path, Path]:
    """Study of two options, and the file whose values are changed: itself."""
    study = _tiny(folder)
    return study, study


def machine(folder: Path) -> tuple[Path, Path]:
    """Study of two options, and its machine's file."""
    return _tiny(folder, machine="\n"), folder / "machine.toml"


def with_sources(folder: Path) -> tuple[Path, Path]:
    """Study of several sources with samples, and itself."""
    study = folder / "study.toml"
    study.write_text(SOURCES_STUDY.read_text().replace("../../data", str(ROOT / "data")))
    return study, study


def by_table(folder: Path) -> tuple[Path, Path]:
    """Study of a machine by table, and itself."""
    study, _ = force_table(folder)
    return study, study


BASES: Final = {each.__name__: each for each in (rigid, machine, with_sources, by_table)}


def changed_values(file: Path, every: int, first: int) -> Iterator[str]:
    """Write a file with one value changed, or a value or table removed, at a time; give what.

    Only every n-th of all changes is made, from the first that is wanted on.
    """
    written = tomllib.loads(file.read_text(encoding="utf-8"))
    changes = ((keys, value) for keys in leaves(written) for value in (None, *VALUES))
    for keys, value in islice(changes, first, None, every):
        content = copy.deepcopy(written)
        table = content
        for key in keys[:-1]:
            table = table[key]
        table[keys[-1]] = value
        if value is None:
            del table[keys[-1]]
        file.write_text("\n".join(f"{key} = {toml(each)}" for key, each in content.items()))
        yield f"{'.'.join(keys)} = {value!r}"


LOUDER: Final = "the model alone gives"
"""Refusal that follows from the computed radiation: no input is wrong by itself."""


def refused_late(study: Path) -> str | None:
    """Return why a run refuses a study that `check` takes; None where both say the same.

    Both begin with the loading of the study.
    """
    try:
        loaded = load_study(study)
    except VibroacousticsError:
        return None
    try:
        with_sound = loaded.measured is not None and loaded.measured.sound is not None
        run = pipeline.run if with_sound else partial(pipeline.run, radiation=_made_up)
        run(loaded)
    except Exception as error:
        if LOUDER in str(error):
            return None
        try:
            run_cost(load_study(study))
        except VibroacousticsError:
            return None
        return f"{type(error).__name__}: {error}"
    return None


def _made_up(study: Study, *_: object) -> tuple[xr.Dataset, bool]:
    return made_up_modes(study), False
