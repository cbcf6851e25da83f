"""Validation of JSON values by the keywords of JSON schema that the package's schemas use."""

from collections.abc import Iterator
from typing import Any

_TYPES: dict[str, Any] = {
    "object": dict,
    "array": list,
    "string": str,
    "number": (int, float),
    "boolean": bool,
    "null": type(None),
}
_KEYWORDS = {
    "$schema", "title", "type", "properties", "required", "additionalProperties", "items",
}  # fmt: skip


def faults(value: Any, schema: dict[str, Any], path: str = "$") -> Iterator[str]:
    """Give a line for each place where a value does not fit a schema.

    Parameters
    ----------
    value : from `json.loads`
    schema : with no other keywords than those of `_KEYWORDS`
    path : of the value, for the lines
    """
    assert set(schema) <= _KEYWORDS, set(schema) - _KEYWORDS
    names = schema.get("type", list(_TYPES))
    names = [names] if isinstance(names, str) else names
    if not any(_is(value, name) for name in names):
        yield f"{path}: {value!r} is none of {names}"
        return
    if isinstance(value, list):
        for number, each in enumerate(value):
            yield from faults(each, schema.get("items", {}), f"{path}[{number}]")
    if isinstance(value, dict):
        properties, further = schema.get("properties", {}), schema.get("additionalProperties", {})
        yield from (
            f"{path}: lacks {name}" for name in schema.get("required", ()) if name not in value
        )
        for name, each in value.items():
            if name in properties or further is not False:
                yield from faults(each, properties.get(name, further or {}), f"{path}.{name}")
            else:
                yield f"{path}: has {name}"


def _is(value: Any, name: str) -> bool:
    if isinstance(value, bool):
        return name == "boolean"
    return isinstance(value, _TYPES[name])
