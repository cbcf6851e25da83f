"""Docstrings that list parameters or attributes list those of the code, in their order."""

import ast
import inspect
import re
from functools import cache
from pathlib import Path

from support import ROOT

PACKAGE = ROOT / "vibroacoustics"
FILES = sorted(PACKAGE.rglob("*.py"))
HOLDERS = (ast.mod, ast.stmt, ast.excepthandler, ast.match_case)
"""Nodes that a definition may be in."""


@cache
def _tree(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


@cache
def _nodes(path: Path) -> tuple[ast.AST, ...]:
    return tuple(ast.walk(_tree(path)))


def _section(docstring: str, title: str) -> list[str] | None:
    """Names that a section of a NumPy docstring describes."""
    lines = docstring.splitlines()
    heads = [
        number
        for number, line in enumerate(lines[:-1])
        if line.strip() == title and set(lines[number + 1].strip()) == {"-"}
    ]
    if not heads:
        return None
    names: list[str] = []
    start = heads[0] + 2
    indent = len(lines[heads[0]]) - len(lines[heads[0]].lstrip())
    for number, line in enumerate(lines[start:], start):
        underlined = number + 1 < len(lines) and set(lines[number + 1].strip()) == {"-"}
        if underlined:
            break
        if len(line) - len(line.lstrip()) == indent and (m := re.match(r"\s*([\w*, ]+?) :", line)):
            names += [name.strip().lstrip("*") for name in m[1].split(",")]
    return names


def _documented(node: ast.FunctionDef | ast.ClassDef, title: str) -> list[str] | None:
    """Names in a section of the docstring of a function or class."""
    text = ast.get_docstring(node, clean=False) or ""
    return _section(inspect.cleandoc(text), title) if title in text else None


def _functions(path: Path):
    """Public functions and methods with their first, implied argument taken off."""
    for node in _nodes(path):
        for child in ast.iter_child_nodes(node) if isinstance(node, HOLDERS) else ():
            if isinstance(child, ast.FunctionDef) and not child.name.startswith("_"):
                arguments = [*child.args.posonlyargs, *child.args.args, *child.args.kwonlyargs]
                names = [argument.arg for argument in arguments]
                names += [v.arg for v in (child.args.vararg, child.args.kwarg) if v]
                if isinstance(node, ast.ClassDef) and names[:1] in (["self"], ["cls"]):
                    names = names[1:]
                yield child, names


def _fields(node: ast.ClassDef) -> list[str]:
    return [
        item.target.id
        for item in node.body
        if isinstance(item, ast.AnnAssign)
        and isinstance(item.target, ast.Name)
        and not item.target.id.startswith("_")
        and "ClassVar" not in ast.dump(item.annotation)
    ]


def test_docstring_parameters_are_those_of_the_signature():
    faults = [
        f"{path.relative_to(ROOT)}: {function.name}: {documented}, has {names}"
        for path in FILES
        for function, names in _functions(path)
        if (documented := _documented(function, "Parameters")) not in (None, names)
    ]
    assert not faults, "\n".join(faults)


def test_docstring_attributes_are_the_fields():
    faults = [
        f"{path.relative_to(ROOT)}: {node.name}: {documented}, has {_fields(node)}"
        for path in FILES
        for node in _nodes(path)
        if isinstance(node, ast.ClassDef)
        and (documented := _documented(node, "Attributes")) not in (None, _fields(node))
    ]
    assert not faults, "\n".join(faults)


def test_every_module_and_public_function_says_what_it_is():
    faults = []
    for path in FILES:
        tree = _tree(path)
        if tree.body and not ast.get_docstring(tree):
            faults.append(f"{path.relative_to(ROOT)}: module")
        faults += [
            f"{path.relative_to(ROOT)}: {item.name}"
            for item in tree.body
            if isinstance(item, ast.FunctionDef) and not item.name.startswith("_")
            if not ast.get_docstring(item)
        ]
    assert not faults, "\n".join(faults)


def test_the_check_sees_a_stale_name():
    assert _section(
        "Sum.\n\nParameters\n----------\na, b : N\nc : m\n\nReturns\n-------\nd : N", "Parameters"
    ) == ["a", "b", "c"]
