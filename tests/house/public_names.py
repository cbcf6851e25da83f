"""What a page or an example takes from the package: imports, attributes, names in code style."""

import ast
import inspect
import re
from collections.abc import Iterator
from functools import cache
from types import ModuleType

from support import ROOT

import vibroacoustics as va
from vibroacoustics.base.vocabulary import COORDINATES, VARIABLES

PACKAGE = "vibroacoustics"
FENCED = re.compile(r"^```(\w*)[^\n]*\n(.*?)^```$", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"`+([^`\n]+)`+(?!\]\()")
"""Code style, but for the text of a link: that leads to the source or to a page."""
NAME = re.compile(r"((?:[A-Za-z_]\w*\.)*)([A-Za-z_]\w*)(\(.*\))?")
CLASS = re.compile(r"[A-Z][A-Z]*[a-z]\w*")
LISTS = ("__all__",)
ENDINGS = ("html",)
"""Of names of files that are names of functions, too."""


def faults_of_code(text: str) -> Iterator[str]:
    """Private imports, attributes and names of Python code."""
    tree = ast.parse(text)
    own = {node.id for node in ast.walk(tree) if _is_bound(node)}
    own |= {alias.asname or alias.name for alias in _aliases(tree)} | _defined(tree)
    for node in ast.walk(tree):
        match node:
            case ast.Import(names=names):
                yield from (name.name for name in names if name.name.startswith(f"{PACKAGE}."))
            case ast.ImportFrom(module=module, names=names) if _root(module) == PACKAGE:
                private = [name.name for name in names if name.name not in va.__all__]
                yield from [module] if module != PACKAGE else private
            case ast.Attribute(value=ast.Name(id="va" | "vibroacoustics"), attr=name):
                yield from [] if name in va.__all__ else [f"{PACKAGE}.{name}"]
            case ast.Name(id=name) if not name.islower() and name not in own:
                yield from [name] if _is_private("", name, "") else []
            case ast.Call(func=ast.Name(id=name)) if name.islower() and name not in own:
                yield from [name] if _is_private("", name, "()") else []


def faults_of_text(text: str) -> Iterator[str]:
    """Names in code style that are of the package, and neither public nor words of its files."""
    for code in CODE.findall(text):
        found = NAME.fullmatch(code)
        if found is not None and _is_private(*found.groups(default="")):
            yield code
        elif found is None:
            yield from (name for name in CLASS.findall(code) if _is_private("", name, ""))


def faults_of_page(text: str) -> Iterator[str]:
    """Faults of a page in Markdown: of its Python, and of names in its text."""
    python = [block for language, block in FENCED.findall(text) if language == "python"]
    yield from faults_of_code("\n".join(python))
    yield from faults_of_text(FENCED.sub("", text))


def faults_of_script(text: str) -> Iterator[str]:
    """Faults of a script or plug-in: of its code, and of names in its docstrings and comments."""
    yield from faults_of_code(text)
    yield from faults_of_text(text)


def _is_private(head: str, name: str, call: str) -> bool:
    """Whether a dotted name is in the package and not public."""
    if name in public() or name not in definitions() or (name.islower() and name in words()):
        return False
    if head and name not in ENDINGS:
        return head.partition(".")[0] in (PACKAGE, "va", *_rooms())
    return not head and (not name.islower() or "_" in name or bool(call))


def _is_bound(node: ast.AST) -> bool:
    return isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Load)


def _aliases(tree: ast.AST) -> Iterator[ast.alias]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Import | ast.ImportFrom):
            yield from node.names


def _defined(tree: ast.AST) -> set[str]:
    kinds = ast.FunctionDef | ast.ClassDef
    names = {node.name for node in ast.walk(tree) if isinstance(node, kinds)}
    return names | {node.arg for node in ast.walk(tree) if isinstance(node, ast.arg)}


def _root(module: str | None) -> str:
    return (module or "").partition(".")[0]


@cache
def public() -> frozenset[str]:
    """Public names, with those of the public modules and the members of the public classes."""
    names = set(va.__all__)
    for thing in [getattr(va, name) for name in va.__all__]:
        if isinstance(thing, ModuleType):
            names |= set(getattr(thing, "__all__", vars(thing)))
        names |= _members(thing)
    return frozenset(name for name in names if not name.startswith("_"))


def _members(thing: object) -> set[str]:
    """Members of a class with the parameters of its methods; parameters of a function."""
    if inspect.isclass(thing):
        held = [getattr(thing, name, None) for name in dir(thing)]
        fields = set(getattr(thing, "model_fields", ())) | set(
            getattr(thing, "__dataclass_fields__", ())
        )
        return fields.union(dir(thing), *(_members(one) for one in held if inspect.isroutine(one)))
    return set(inspect.signature(thing).parameters) if inspect.isfunction(thing) else set()


@cache
def _trees() -> tuple[ast.Module, ...]:
    files = sorted((ROOT / PACKAGE).rglob("*.py"))
    return tuple(ast.parse(file.read_text(encoding="utf-8")) for file in files)


@cache
def _rooms() -> frozenset[str]:
    return frozenset(path.stem for path in (ROOT / PACKAGE).iterdir())


@cache
def definitions() -> frozenset[str]:
    """Classes, functions and constants of all modules of the package."""
    names = set()
    for node in (node for tree in _trees() for node in tree.body):
        if isinstance(node, ast.ClassDef | ast.FunctionDef):
            names.add(node.name)
        elif isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            names |= {target.id for target in targets if isinstance(target, ast.Name)}
    return frozenset(name for name in names if not name.startswith("_"))


@cache
def words() -> frozenset[str]:
    """Words of files and results: texts of the package, and fields of its tables."""
    found = {*VARIABLES, *COORDINATES}
    for node in (node for tree in _trees() for node in tree.body if not _is_list(node)):
        for inner in ast.walk(node):
            if isinstance(inner, ast.Constant) and isinstance(inner.value, str):
                found.add(inner.value)
            elif isinstance(inner, ast.ClassDef):
                found |= {own.target.id for own in inner.body if isinstance(own, ast.AnnAssign)}
    return frozenset(found)


def _is_list(node: ast.AST) -> bool:
    """Whether a statement lists the names of a package."""
    targets = node.targets if isinstance(node, ast.Assign) else []
    return any(isinstance(target, ast.Name) and target.id in LISTS for target in targets)
