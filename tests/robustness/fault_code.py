"""Other code for the functions of this process, without a change of a file."""

import ast
import gc
import sys
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import CodeType, FunctionType
from typing import Final

EXECUTED: Final = "executed_line_"


def put_in(tree: Path, file: str, content: bytes, calls: Mapping[int, Callable[[], None]]) -> None:
    """Give the living functions of a module other code.

    Parameters
    ----------
    tree : from which the package is imported
    file : of the module, from the root of the tree
    content : of the file with other code
    calls : what runs each time before the statement that begins in a line
    """
    path = str(tree / file)
    module = sys.modules[file.removesuffix(".py").removesuffix("/__init__").replace("/", ".")]
    changed = ast.parse(content)
    for line, call in calls.items():
        _insert_call(changed, line)
        vars(module)[f"{EXECUTED}{line}"] = call
    codes = defaultdict(list)
    for code in _codes(compile(changed, path, "exec")):
        codes[_key(code)].append(code)
    for function in gc.get_objects():
        if type(function) is FunctionType and function.__code__.co_filename == path:
            same = codes[_key(function.__code__)]
            if len(same) == 1:  # not several lambdas of one line
                function.__code__ = same[0]


def _insert_call(tree: ast.AST, line: int) -> None:
    for node in ast.walk(tree):
        for _, body in ast.iter_fields(node):
            if isinstance(body, list):
                for index, statement in enumerate(body):
                    if isinstance(statement, ast.stmt) and statement.lineno == line:
                        call = ast.parse(f"{EXECUTED}{line}()").body[0]
                        body.insert(index, ast.copy_location(call, statement))
                        return
    raise ValueError(f"no statement begins in line {line}")


def _codes(code: CodeType) -> Iterator[CodeType]:
    yield code
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _codes(constant)


def _key(code: CodeType) -> tuple[str, int, tuple[str, ...]]:
    return code.co_qualname, code.co_firstlineno, code.co_freevars
