"""Schema of one value in a file: under a key for each unit, bare or with source and range."""

from collections.abc import Iterator
from typing import Any, Final

from ...base.units import UNITS, split_key

Schema = dict[str, Any]

_LIMITS: Final[tuple[str, ...]] = ("minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum")
_INNER: Final[tuple[str, ...]] = ("anyOf", "prefixItems")
_DIGITS: Final = 12


def keys_of(field: str, schema: Schema) -> Iterator[tuple[str, Schema]]:
    """Keys that fill a field of the model, each with the schema of its value in that unit.

    Parameters
    ----------
    field : such as `stroke_m`
    schema : schema of the field's value in SI
    """
    stem, unit = split_key(field)
    if unit is None or not _is_numeric(schema):
        yield field, sourced(schema)
        return
    for other in UNITS.values():
        if other.si_suffix == unit.si_suffix:
            yield f"{stem}_{other.suffix}", sourced(scaled(schema, other.factor))


def scaled(schema: Schema, factor: float) -> Schema:
    """Schema of a number, or of numbers in a list, in another unit.

    Parameters
    ----------
    schema : in SI
    factor : to SI
    """
    limits = {key: float(f"{schema[key] / factor:.{_DIGITS}g}") for key in _LIMITS if key in schema}
    inner: Schema = {
        key: [scaled(inner, factor) for inner in schema[key]] for key in _INNER if key in schema
    }
    items = {"items": scaled(schema["items"], factor)} if "items" in schema else {}
    return {**schema, **limits, **inner, **items}


def sourced(schema: Schema) -> Schema:
    """A value, bare or as a table with value, source and range."""
    if not _is_value(schema):
        return schema
    schema, kind = _of_like_items(schema), schema.get("type")
    table: Schema = {
        "required": ["value", "source"],
        "additionalProperties": False,
        "properties": {
            "value": {key: value for key, value in schema.items() if key != "description"},
            "source": {"$ref": "#/$defs/source"},
            "range": {"$ref": "#/$defs/range"},
        },
    }
    if (
        isinstance(kind, str) and "enum" not in schema
    ):  # limits of a number do not touch a table, nor the other way round
        return {**schema, "type": [kind, "object"], **table}
    words = {"description": schema["description"]} if "description" in schema else {}
    return {**words, "if": {"type": "object"}, "then": table, "else": table["properties"]["value"]}


def _of_like_items(schema: Schema) -> Schema:
    """A list of a few like items by `items`, which older language servers know, too."""
    first, *others = schema.get("prefixItems", [None])
    if first is None or any(other_schema != first for other_schema in others):
        return schema
    return {**{key: value for key, value in schema.items() if key != "prefixItems"}, "items": first}


SOURCE: Final[Schema] = {"type": "string", "minLength": 1, "description": "Document, or assumed"}
RANGE: Final[Schema] = {
    "type": "array",
    "items": {"type": "number"},
    "minItems": 2,
    "maxItems": 2,
    "description": "From, to, in the unit of the key",
}


def _is_numeric(schema: Schema) -> bool:
    """A number, or a list of them."""
    inner = [*schema.get("anyOf", []), *schema.get("prefixItems", [])]
    if "items" in schema:
        inner.append(schema["items"])
    return schema.get("type") in ("number", "integer") or any(map(_is_numeric, inner))


def _is_value(schema: Schema) -> bool:
    """Whether it is no table and no reference to one."""
    if "anyOf" in schema:
        return all(map(_is_value, schema["anyOf"]))
    return "$ref" not in schema and schema.get("type", "object") != "object"
