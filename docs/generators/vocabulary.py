"""The page of all variables of results: dimensions, unit, meaning, and who makes them."""

import re
import tomllib
from functools import cache
from pathlib import Path
from typing import Final

import vibroacoustics
from vibroacoustics.base.vocabulary import (
    COORDINATES,
    MEAN,
    MEDIAN,
    NOMINAL,
    REPRESENTATIVE,
    SUFFIXES,
    VARIABLES,
)

from .tables import code, table

PACKAGE: Final = Path(vibroacoustics.__file__).parent
SUBJECTS: Final = PACKAGE / "base" / "variables"
CHAIN: Final = (
    "study", "forces", "motion", "radiation", "sound_field", "levels", "sources", "samples",
    "stopping", "scores", "columns", "recordings", "orders", "comparison", "limits",
)  # fmt: skip
"""Subjects in the order of the chain; further ones stand behind."""
STATISTICS: Final = {
    MEDIAN: " (with samples their median)",
    MEAN: " (with samples their mean)",
    REPRESENTATIVE: " (with samples of the representative one)",
}
HEAD: Final = """# Vocabulary of results

All variables and coordinates of results, by subject. A variable that is not in this list, or has
other dimensions or another unit, is refused (`SchemaError`). Phasors are complex peaks,
x(t) = Re{X exp(jωt)}; for rotations the unit has rad in place of m. Conventions:
[](../conventions.md). In a run with samples a variable is nominal unless its meaning names another
[statistic](../results.md#values-intervals-and-nominal-values).
"""


def page() -> str:
    """Markdown of the page."""
    makers = {name: makers_of(name) for name in VARIABLES}
    parts = [HEAD.strip()]
    for title, names in by_subject().items():
        variables = [VARIABLES[name] for name in names if name in VARIABLES]
        coordinates = [COORDINATES[name] for name in names if name in COORDINATES]
        parts.append(f"## {title}")
        if variables:
            rows = [(*row(one), ", ".join(map(code, makers[one.name]))) for one in variables]
            parts.append(table(("variable", "dimensions", "unit", "meaning", "made by"), rows))
        if coordinates:
            rows = [row(one) for one in coordinates]
            parts.append(table(("coordinate", "dimensions", "unit", "meaning"), rows))
    return "\n\n".join(parts) + "\n"


def row(one) -> tuple[str, str, str, str]:
    """Name, dimensions, unit and meaning of a variable or a coordinate."""
    phasor = ", phasor" if getattr(one, "complex_peak", False) else ""
    statistic = STATISTICS.get(getattr(one, "statistic", NOMINAL), "")
    return code(one.name), ", ".join(one.dims), one.units, one.long_name + phasor + statistic


def by_subject() -> dict[str, list[str]]:
    """Names by the subject of the file that has them."""
    left = {*VARIABLES, *COORDINATES}
    subjects: dict[str, list[str]] = {}
    for file in sorted(SUBJECTS.glob("*.toml"), key=place):
        text = file.read_text(encoding="utf-8")
        listed = [name for tables in tomllib.loads(text).values() for name in tables]
        named = [name for one in listed for name in (one, *beside(one))]
        title = text.partition("\n")[0].removeprefix("# ").rstrip(".")
        subjects[title] = [name for name in named if name in left]
        left -= set(named)
    if left:
        subjects["Further"] = sorted(left)
    return subjects


def beside(name: str) -> list[str]:
    """Names of the ends of the interval and of the nominal value of a variable."""
    return [one.name for one in VARIABLES[name].of_samples()] if name in VARIABLES else []


def place(file: Path) -> tuple[int, str]:
    """Where the subject of a file stands on the page."""
    listed = file.stem in CHAIN
    return (CHAIN.index(file.stem) if listed else len(CHAIN)), file.stem


@cache
def sources() -> dict[str, str]:
    """Text of every file of the package but those of the base."""
    files = [file for file in sorted(PACKAGE.rglob("*.py")) if PACKAGE / "base" not in file.parents]
    texts = {file.relative_to(PACKAGE): file.read_text(encoding="utf-8") for file in files}
    return {
        file.as_posix(): re.sub(r"^ *>>> .*$", "", text, flags=re.MULTILINE)
        for file, text in texts.items()
    }


def makers_of(name: str) -> list[str]:
    """Files of the package that stamp a variable; else those below the report that name it.

    Statistics of a variable are made with it.
    """
    for suffix in SUFFIXES.values():
        if name.removesuffix(suffix) in VARIABLES:
            name = name.removesuffix(suffix)
    texts = sources()
    stamped = [file for file, text in texts.items() if re.search(rf'stamp\(\s*"{name}"', text)]
    named = [file for file, text in texts.items() if f'"{name}"' in text]
    beside = [file for file in named if re.search(r"\bstamp(ed)?\(", texts[file])]
    below = [file for file in named if not file.startswith(("report", "commands", "plot"))]
    return stamped or beside or below or composers_of(name)


def composers_of(name: str) -> list[str]:
    """Files that put a variable's name together: f"stopping_{what}" for stopping_force."""
    return [
        file
        for file, patterns in composed_names().items()
        if any(re.fullmatch(pattern, name) for pattern in patterns)
    ]


@cache
def composed_names() -> dict[str, list[str]]:
    """Patterns of the names that every file puts together, of more than five letters."""
    found = {file: re.findall(r'f"((?:\w*\{\w+\}\w*)+)"', text) for file, text in sources().items()}
    return {
        file: [
            re.sub(r"\{\w+\}", r"\\w+", pattern)
            for pattern in patterns
            if len(re.sub(r"\{\w+\}", "", pattern)) > 5
        ]
        for file, patterns in found.items()
    }
