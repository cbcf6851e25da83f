"""Values of machines and studies that are a thousand times too large or too small, one at a time.

`python tests/robustness/thousandfold.py` counts what becomes of each number with a unit in the
machine files of the package and in the files that `new` writes, and lists those that pass. A value
goes with its range, as where somebody took the wrong unit for both; then it goes alone.
"""

import json
import shutil
import sys
import tempfile
import tomllib
import warnings
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final, NamedTuple

from vibroacoustics.base.errors import VibroacousticsError
from vibroacoustics.base.units import split_key
from vibroacoustics.commands.starter import WITH_SOURCES, starting_files
from vibroacoustics.machine.machine import MACHINES
from vibroacoustics.study.loading import load_study_or_machine

ROOT: Final = Path(__file__).parents[2]
FACTORS: Final = (1e3, 1e-3)
Keys = tuple[str, ...]


class Mistake(NamedTuple):
    """A number of a file and the factor by which it is wrong."""

    file: Path
    keys: Keys
    factor: float


def written_files(folder: Path) -> tuple[Path, ...]:
    """Write the machine files of the package, and machine and study by `new` of every kind."""
    shutil.copytree(ROOT / "data", folder / "data")
    templates = [*((kind, False) for kind in MACHINES), *((kind, True) for kind in WITH_SOURCES)]
    for kind, with_sources in templates:
        template = folder / (f"{kind}-sources" if with_sources else kind)
        template.mkdir()
        for name, content in starting_files(kind, with_sources).items():
            (template / name).write_bytes(content)
    return tuple(sorted((*folder.glob("data/machines/*.toml"), *folder.glob("*/*.toml"))))


def mistakes(file: Path) -> list[Mistake]:
    """Every number with a unit that is not zero, too large and too small."""
    content = tomllib.loads(file.read_text(encoding="utf-8"))
    return [Mistake(file, keys, factor) for keys in _numbers(content) for factor in FACTORS]


def wrong_file(mistake: Mistake, with_range: bool) -> str:
    """Content of the file with the mistake."""
    content = tomllib.loads(mistake.file.read_text(encoding="utf-8"))
    *tables, key = mistake.keys
    table: dict[str, Any] = content
    for name in tables:
        table = table[name]
    table[key] = _scaled(table[key], mistake.factor, with_range)
    return "".join(f"{json.dumps(name)} = {_toml(value)}\n" for name, value in content.items())


def outcome(mistake: Mistake, with_range: bool) -> str:
    """Whether a mistake is refused, warned of by its key or passes."""
    wrong = mistake.file.with_name("wrong.toml")
    wrong.write_text(wrong_file(mistake, with_range), encoding="utf-8")
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        try:
            load_study_or_machine(wrong)
        except VibroacousticsError:
            return "refused"
        finally:
            wrong.unlink()
    return "warned" if any(mistake.keys[-1] in str(one.message) for one in warned) else "passed"


def _numbers(content: dict[str, Any], prefix: Keys = ()) -> Iterator[Keys]:
    for key, value in content.items():
        bare = value.get("value") if isinstance(value, dict) else value
        if isinstance(value, dict) and bare is None:
            yield from _numbers(value, (*prefix, key))
        elif isinstance(bare, int | float) and bare and split_key(key)[1] is not None:
            yield (*prefix, key)


def _scaled(value: Any, factor: float, with_range: bool) -> Any:
    if not isinstance(value, dict):
        return value * factor
    changed = {**value, "value": value["value"] * factor}
    if with_range and "range" in value:
        changed["range"] = [end * factor for end in value["range"]]
    return changed


def _toml(value: Any) -> str:
    if isinstance(value, dict):
        pairs = (f"{json.dumps(key)} = {_toml(each)}" for key, each in value.items())
        return f"{{{', '.join(pairs)}}}"
    if isinstance(value, list):
        return f"[{', '.join(map(_toml, value))}]"
    return json.dumps(value)


def main() -> int:
    with tempfile.TemporaryDirectory() as folder:
        each = [one for file in written_files(Path(folder)) for one in mistakes(file)]
        for with_range in (True, False):
            found = {one: outcome(one, with_range) for one in each}
            print("value and range" if with_range else "value alone", dict(Counter(found.values())))
            for one in each:
                if found[one] == "passed":
                    file, keys = one.file.relative_to(folder), ".".join(one.keys)
                    print(f"  {file}: {keys} x {one.factor:g}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
