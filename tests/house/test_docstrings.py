"""Docstrings that list parameters or attributes list those of the code, in their order."""

import ast
import re
from functools import cache
from pathlib import Path

import pytest
from support import ROOT

PACKAGE = ROOT / "vibroacoustics"
FILES = sorted(PACKAGE.rglob("*.py"))


@cache
def _tree(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


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


def _functions(path: Path):
    """Public functions and methods with their first, implied argument taken off."""
    for node in ast.walk(_tree(path)):
        for child in ast.iter_child_nodes(node):
            if isinstance(child, ast.FunctionDef) and not child.name.startswith("_"):
                arguments = [*child.args.posonlyargs, *child.args.args, *child.args.kwonlyargs]
                names = [argument.arg for argument in arguments]
                names += [v.arg for v in (child.args.vararg, child.args.kwarg) if v]
                if isinstance(node, ast.ClassDef) and names[:1] in (["self"], ["cls"]):
                    names = names[1:]
                yield child, names


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_docstring_parameters_are_those_of_the_signature(path):
    for function, names in _functions(path):
        documented = _section(ast.get_docstring(function, clean=True) or "", "Parameters")
        if documented is not None:
            assert documented == names, function.name


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_docstring_attributes_are_the_fields(path):
    for node in ast.walk(_tree(path)):
        if isinstance(node, ast.ClassDef):
            documented = _section(ast.get_docstring(node, clean=True) or "", "Attributes")
            if documented is not None:
                fields = [
                    item.target.id
                    for item in node.body
                    if isinstance(item, ast.AnnAssign)
                    and isinstance(item.target, ast.Name)
                    and not item.target.id.startswith("_")
                    and "ClassVar" not in ast.dump(item.annotation)
                ]
                assert documented == fields, node.name


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_every_module_and_public_function_says_what_it_is(path):
    tree = _tree(path)
    assert not tree.body or ast.get_docstring(tree), "module"
    for item in tree.body:
        if isinstance(item, ast.FunctionDef) and not item.name.startswith("_"):
            assert ast.get_docstring(item), item.name


def test_the_check_sees_a_stale_name():
    assert _section(
        "Sum.\n\nParameters\n----------\na, b : N\nc : m\n\nReturns\n-------\nd : N", "Parameters"
    ) == ["a", "b", "c"]
