"""Counts by room of words and phrases that the project is leaving.

python tests/house/language.py          # print where they are
python tests/house/language.py --write  # write the counts down, where none has risen
"""

import ast
import json
import re
import sys
import tomllib
from collections import Counter
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import Final, NamedTuple

ROOT: Final = Path(__file__).resolve().parents[2]
COUNTS: Final = Path(__file__).with_name("language_counts.json")
LISTS: Final = tomllib.loads(Path(__file__).with_name("language.toml").read_text("utf-8"))
HOLDS: Final = {entry["word"] for entry in LISTS["holds"]}
IS: Final = {entry["word"] for entry in LISTS["is"]}
PHRASES: Final = [re.compile(entry["pattern"], re.MULTILINE) for entry in LISTS["phrase"]]
OPENINGS: Final = frozenset(LISTS["openings"])
EXEMPT: Final = {(entry["path"], entry["what"]) for entry in LISTS["exempt"]}
ANY_PHRASE: Final = re.compile("|".join(f"(?:{one.pattern})" for one in PHRASES), re.MULTILINE)
"""Most lines hold none: one search tells it."""
PROSE: Final = re.compile(r"[A-Za-z]+\s+[A-Za-z]+")
"""Strings without two words in a row are keys and formats."""
QUOTED: Final = re.compile(r'"[^"]*"|#.*')
TEXT: Final = re.compile(
    r"""#[^\n]*|[rbuf]*(?:"{3}(?:[^\\]|\\.)*?"{3}|'{3}(?:[^\\]|\\.)*?'{3}"""
    r"""|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*')""",
    re.DOTALL | re.IGNORECASE,
)
"""Comments and strings of Python code: `tokenize` takes seconds for the package."""


ARRAYS: Final = ("Array", "ComplexArray", "IndexArray", "Samples")
ENTRY: Final = re.compile(r"^([\w*, ]+?) : (.*?)(?=^\S|\Z)", re.DOTALL | re.MULTILINE)
"""Names and text of an entry of a section of a docstring."""
SHAPE: Final = re.compile(r"\bshapes?\b|\bsee `")
"""A shape in an entry, or where it is."""


class Fault(NamedTuple):
    """A word or phrase in a line of a file."""

    path: str
    line: int
    what: str


def bindings(nodes: Sequence[ast.AST]) -> Iterator[tuple[int, str]]:
    """Line and name of everything that the code names itself."""
    for node in nodes:
        line = getattr(node, "lineno", 0)
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield line, node.id
        elif isinstance(node, ast.FunctionDef | ast.ClassDef):
            yield line, node.name
        elif isinstance(node, ast.arg):
            yield line, node.arg


def openings(nodes: Sequence[ast.AST]) -> Iterator[tuple[int, str]]:
    """Line and first word of every docstring, also of those below fields and constants."""
    for node in nodes:
        body = getattr(node, "body", ())
        for statement in body if isinstance(body, list) else ():
            match statement:
                case ast.Expr(value=ast.Constant(value=str() as text)):
                    word = re.match(r"\s*([A-Za-z]+)", text)
                    yield statement.lineno, word[1] if word else ""


def shapeless(nodes: Sequence[ast.AST]) -> Iterator[tuple[int, str]]:
    """Line and name of every documented array whose docstring states no shape."""
    for node in nodes:
        if not isinstance(node, ast.FunctionDef | ast.ClassDef):
            continue
        section = "Parameters" if isinstance(node, ast.FunctionDef) else "Attributes"
        head, _, body = (ast.get_docstring(node) or "").partition(f"{section}\n---")
        if "shape" in head:
            continue
        arrays = {name for name, kind in annotations(node) if kind in ARRAYS}
        for names, text in ENTRY.findall(body):
            if not SHAPE.search(text):
                yield from ((node.lineno, name) for name in names.split(", ") if name in arrays)


def annotations(node: ast.FunctionDef | ast.ClassDef) -> Iterator[tuple[str, str]]:
    """Name and annotation of the parameters of a function or of the fields of a class."""
    if isinstance(node, ast.FunctionDef):
        for argument in (*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs):
            if argument.annotation:
                yield argument.arg, ast.unparse(argument.annotation)
    else:
        for item in node.body:
            if isinstance(item, ast.AnnAssign):
                yield ast.unparse(item.target), ast.unparse(item.annotation)


def prose(code: str) -> Iterator[tuple[int, str]]:
    """Line and text of every comment and every string of words."""
    line, end = 1, 0
    for found in TEXT.finditer(code):
        line, end = line + code.count("\n", end, found.start()), found.start()
        if found[0][0] == "#" or PROSE.search(found[0]):
            yield line, found[0].strip("#'\" rbf")


def faults_of_code(path: str, code: str) -> Iterator[Fault]:
    """Faults of a Python file."""
    nodes = list(ast.walk(ast.parse(code)))
    yield from (Fault(path, line, word) for line, word in openings(nodes) if word in OPENINGS)
    yield from (Fault(path, line, f"{name} without shape") for line, name in shapeless(nodes))
    for line, name in bindings(nodes):
        parts = set(name.strip("_").lower().split("_"))
        for word in sorted(parts & HOLDS) + [name] * (name in IS):
            yield Fault(path, line, word)
    for first, text in prose(code):
        yield from faults_of_text(path, text, first)


def faults_of_table(path: str, text: str) -> Iterator[Fault]:
    """Faults of a table of the package: of its comments and its strings of words."""
    for number, line in enumerate(text.splitlines(), 1):
        for part in filter(PROSE.search, QUOTED.findall(line)):
            yield from faults_of_text(path, part, number)


def faults_of_text(path: str, text: str, first: int = 1) -> Iterator[Fault]:
    """Faults of a text that begins at a line."""
    for number, line in enumerate(text.splitlines(), first):
        for phrase in PHRASES if ANY_PHRASE.search(line.strip()) else ():
            yield from (Fault(path, number, match[0]) for match in phrase.finditer(line.strip()))


@cache
def faults() -> tuple[Fault, ...]:
    """Faults of the package, the pages and the studies."""
    files = [*ROOT.glob("vibroacoustics/**/*.py"), *ROOT.glob("docs/**/*.md"), ROOT / "README.md"]
    files += [*ROOT.glob("pipelines/*.toml"), *ROOT.glob("data/machines/*.toml")]
    tables = [*ROOT.glob("vibroacoustics/**/*.toml")]
    built = ("docs/_build/", "docs/examples/", "docs/generated/")
    found: list[Fault] = []
    for file in sorted(files + tables):
        path = file.relative_to(ROOT).as_posix()
        if not path.startswith(built):
            reader = faults_of_code if file.suffix == ".py" else faults_of_text
            reader = faults_of_table if file in tables else reader
            found += reader(path, file.read_text(encoding="utf-8"))
    return tuple(fault for fault in found if (fault.path, fault.what) not in EXEMPT)


def room_of(path: str) -> str:
    """Room of a file: a folder of the package, or the first folder of the repository."""
    parts = path.split("/")
    return "/".join(parts[:2]) if parts[0] == "vibroacoustics" and len(parts) > 2 else parts[0]


def counts() -> dict[str, int]:
    """Number of faults by room."""
    return dict(sorted(Counter(room_of(fault.path) for fault in faults()).items()))


def committed() -> dict[str, int]:
    """Counts that were written down."""
    read: dict[str, int] = json.loads(COUNTS.read_text("utf-8"))
    return read


def risen(now: dict[str, int], before: dict[str, int]) -> dict[str, str]:
    """Rooms with more faults than written down."""
    return {
        room: f"{before.get(room, 0)} -> {number}"
        for room, number in now.items()
        if number > before.get(room, 0)
    }


def main() -> int:
    """Print the faults, or write their counts down."""
    if "--write" not in sys.argv:
        print("\n".join(f"{fault.path}:{fault.line}: {fault.what}" for fault in faults()))
        return 0
    if COUNTS.exists() and (more := risen(counts(), committed())):
        print(f"not written, more than before: {more}")
        return 1
    COUNTS.write_text(json.dumps(counts(), indent=2) + "\n", "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
