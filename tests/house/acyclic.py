"""Circles of imports in a package, of which Python itself sees only some.

    python tests/house/acyclic.py FOLDER OF THE PACKAGE

Every import counts: at the top of a file, inside a function, under `if TYPE_CHECKING`, and in a
stub, by which a package's face lists what it imports when first asked. Importing `a.b` runs
`a/__init__.py` too, unless the importer itself is inside `a`, where that file runs already. The
modules of a registry's folder are found by name and import nothing by that.
"""

import ast
import sys
from collections.abc import Iterator, Mapping
from graphlib import CycleError, TopologicalSorter
from importlib.util import resolve_name
from pathlib import Path


def circles(package: Path) -> list[list[str]]:
    """Circles of imports: modules from importer to imported, the first again at the end.

    Each is found without the last import of those before it; so none is left once these are gone.
    """
    files = dict(_modules(package))
    imports = {name: _imported(name, file, files) for name, file in sorted(files.items())}
    found: list[list[str]] = []
    while True:
        try:
            TopologicalSorter(imports).prepare()
        except CycleError as error:
            circle = error.args[1][::-1]
            imports[circle[-2]].remove(circle[-1])
            found.append(circle)
        else:
            return found


def _modules(package: Path) -> Iterator[tuple[str, Path]]:
    """Dotted name and file of each module; a package's name is that of its `__init__.py`."""
    for file in package.rglob("*.py"):
        parts = file.relative_to(package.parent).with_suffix("").parts
        yield ".".join(parts[:-1] if parts[-1] == "__init__" else parts), file


def _imported(name: str, file: Path, modules: Mapping[str, Path]) -> list[str]:
    """Modules of the package that a module's imports run, in the order of their names."""
    found: set[str] = set()
    for target in _targets(name if file.name == "__init__.py" else name.rpartition(".")[0], file):
        module = target if target in modules else target.rpartition(".")[0]
        found |= {module} | (_packages(module) - _packages(name) - {name})
    return sorted(found & set(modules))


def _targets(package: str, file: Path) -> Iterator[str]:
    """Dotted names of what a file of a package imports: modules, or names in modules."""
    sources = [source for source in (file, file.with_suffix(".pyi")) if source.exists()]
    trees = [ast.parse(source.read_bytes()) for source in sources]
    for node in (node for tree in trees for node in ast.walk(tree)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            home = resolve_name("." * node.level + (node.module or ""), package)
            yield from (f"{home}.{alias.name}" for alias in node.names)


def _packages(name: str) -> set[str]:
    """Packages that a module lies in, from the outermost."""
    parts = name.split(".")
    return {".".join(parts[:end]) for end in range(1, len(parts))}


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    if not (folder / "__init__.py").is_file():
        sys.exit(f"{folder}: is no package")
    all_circles = circles(folder)
    for one in all_circles:
        print("circle of imports:", " -> ".join(one))
    sys.exit(bool(all_circles))
