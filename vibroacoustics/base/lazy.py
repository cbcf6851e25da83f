"""Public names of a package that are imported when they are first asked for."""

import ast
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any


def public_names(
    package: str, file: str
) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """Make `__getattr__`, `__dir__` and `__all__` of a package from its stub.

    Parameters
    ----------
    package : its dotted name
    file : its `__init__.py`; the stub beside it, `__init__.pyi`, imports every public name
    """
    stub = ast.parse(Path(file).with_suffix(".pyi").read_text("utf-8"))
    home = {
        alias.name: "." * statement.level + (statement.module or "")
        for statement in stub.body
        if isinstance(statement, ast.ImportFrom)
        for alias in statement.names
    }
    names = sorted(home)

    def attribute(name: str) -> Any:
        if name not in home:
            raise AttributeError(f"module {package} has no attribute {name}")
        if home[name] == ".":
            return import_module(f"{package}.{name}")
        return getattr(import_module(home[name], package), name)

    return attribute, lambda: names, names
