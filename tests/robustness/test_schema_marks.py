"""Errors of key, type, unit and range that an editor marks at their line."""

import re
from pathlib import Path
from random import Random

import pytest
from support import ROOT
from toml_language_server import marked_lines

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.base.units import UNITS, split_key
from vibroacoustics.study.loading import load_machine, load_study

COUNT = 100
FILES = {
    "study": sorted((ROOT / "pipelines").glob("*.toml")),
    "machine": sorted((ROOT / "data" / "machines").glob("*.toml")),
}
LINE = re.compile(r"^([a-z][a-z0-9_]*) = (.+)$")
_FREE_NAMES = ("[evidence]", "[scoring.criteria]")  # of files, and of criteria of the user's
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?![\w.])")


def misspelt(key: str, value: str, random: Random) -> str:
    """A letter twice."""
    place = random.randrange(1, len(key))
    return f"{key[:place]}{key[place - 1]}{key[place:]}x = {value}"


def of_another_type(key: str, value: str, random: Random) -> str:
    """Text for a number, a number for text."""
    if value.startswith("{"):
        return f"{key} = {{ value = true, source = 'Rossi 2020' }}"
    return f"{key} = {12.5 if value.startswith(chr(34)) else repr('much')}"


def in_another_unit(key: str, value: str, random: Random) -> str:
    """A unit of another quantity."""
    stem, unit = split_key(key)
    other = [one for one in UNITS.values() if unit is None or one.si_suffix != unit.si_suffix]
    return f"{stem}_{random.choice(other).suffix} = {value}"


def out_of_range(key: str, value: str, random: Random) -> str:
    """The first number far off, to one side or the other."""
    far = random.choice(["-9.9e14", "9.9e14"])
    without_range = re.sub(r", range = \[[^\]]*\]", "", value)
    return f"{key} = {NUMBER.sub(far, without_range, count=1)}"


WAYS = (misspelt, of_another_type, in_another_unit, out_of_range)


def seeded(kind: str, count: int, folder: Path) -> dict[Path, int]:
    """Files with one error each, that the package refuses, and the line of it."""
    random, made = Random(kind), {}
    while len(made) < count:
        source = random.choice(FILES[kind])
        lines = source.read_text(encoding="utf-8").splitlines()
        number = random.randrange(len(lines))
        way = WAYS[len(made) % len(WAYS)]
        if (changed := _changed(lines, number, way, random)) is None:
            continue
        file = folder / kind / source.name.replace(".toml", f"_{len(made)}.toml")
        lines[number] = changed
        text = "\n".join(lines[1:])
        for name in re.findall(r'"((?:\.\./|[\w]+/)*[\w]+\.(?:toml|csv))"', text):
            text = text.replace(f'"{name}"', f'"{(source.parent / name).resolve()}"')
        file.parent.mkdir(exist_ok=True)
        file.write_text(f"\n{text}\n", encoding="utf-8")
        if _is_refused(kind, file):
            made[file] = number + 1
    return made


def _changed(lines: list[str], number: int, way: object, random: Random) -> str | None:
    """The line with an error; None where it holds no value that this way can spoil."""
    table = next((line for line in reversed(lines[:number]) if line.startswith("[")), "")
    line = LINE.match(lines[number])
    if line is None or table.endswith(".given]") or lines[number].endswith(("[", "{")):
        return None
    key, value = line.groups()
    if key in ("extends", "file", "kind", "published_table") or table in _FREE_NAMES:
        return None
    numeric = NUMBER.search(re.sub(r'"[^"]*"', "", value)) is not None
    needs_number = way in (in_another_unit, out_of_range)
    if needs_number and (not numeric or split_key(key)[1] is None):
        return None
    return way(key, value, random)  # type: ignore[operator]


def _is_refused(kind: str, file: Path) -> bool:
    try:
        load_study(file) if kind == "study" else load_machine(file)
    except ParameterError:
        return True
    return False


@pytest.mark.parametrize("kind", FILES)
def test_each_seeded_error_is_marked_at_its_line(kind: str, tmp_path: Path) -> None:
    """Fifty of studies and fifty of machines, of four kinds, each refused by the package too."""
    seeds = seeded(kind, COUNT // 2, tmp_path)
    marks = marked_lines(kind, list(seeds))
    missed = [
        f"{file.name}:{line}: {file.read_text().splitlines()[line - 1]}"
        for file, line in seeds.items()
        if line not in marks.get(file, set())
    ]
    assert missed == []
