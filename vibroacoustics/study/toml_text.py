"""Plain tables as the text of a TOML file."""

import json
from collections.abc import Iterator, Mapping
from typing import Any

from .toml_files import is_quantity


def toml_text(content: Mapping[str, Any]) -> str:
    """Text of which a TOML parser makes the same content.

    Parameters
    ----------
    content : text, numbers, truth values, lists and tables of these; a value with its source
        stands in one line
    """
    return "\n".join(_lines(content, ())) + "\n"


def _lines(table: Mapping[str, Any], keys: tuple[str, ...]) -> Iterator[str]:
    inner = {name: value for name, value in table.items() if _is_table(value)}
    for name, value in table.items():
        if name not in inner:
            yield f"{_key(name)} = {_value(value)}"
    for name, value in inner.items():
        deeper = (*keys, name)
        if not value or not all(map(_is_table, value.values())):
            yield ""
            yield f"[{'.'.join(map(_key, deeper))}]"
        yield from _lines(value, deeper)


def _is_table(value: Any) -> bool:
    return isinstance(value, Mapping) and not is_quantity(value)


def _key(name: str) -> str:
    plain = name.isascii() and name.replace("_", "a").replace("-", "a").isalnum()
    return name if plain else _text(name)


def _value(value: Any) -> str:
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(k)} = {_value(v)}" for k, v in value.items()) + " }"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(_value, value)) + "]"
    return json.dumps(value)  # numbers and truth values are written alike


def _text(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
