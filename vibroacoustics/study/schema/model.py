"""Schema of a file from the schema of the model, in SI, that it fills."""

from typing import Any, Final

from pydantic.json_schema import GenerateJsonSchema

from ...base.file_table import FileTable
from .units import Schema, keys_of

_OBJECT: Final = ("properties", "additionalProperties")


class FileSchema(GenerateJsonSchema):
    """Schema of tables as files write them: keys in any unit, nothing that is filled in by the
    reader."""

    def model_schema(self, schema: Any) -> Schema:
        """A model without the fields that are read from a file, and without examples in Python."""
        made = super().model_schema(schema)
        model = schema["cls"]
        if "description" in made:
            made["description"] = made["description"].partition("\n\nExamples\n")[0]
        if issubclass(model, FileTable):
            filled = {name for name, of in model.model_fields.items() if of.default in ((), "")}
            made["properties"] = {
                name: value for name, value in made["properties"].items() if name not in filled
            }
        return made


def in_file(schema: Any) -> Any:
    """A schema of SI fields as one of files' keys.

    Nothing is required but `kind`: a file may extend another, and a table replace some values.

    Parameters
    ----------
    schema : schema that pydantic makes
    """
    if isinstance(schema, list):
        return [in_file(part) for part in schema]
    if not isinstance(schema, dict):
        return schema
    if "anyOf" in schema:
        return _choice(schema)
    made = {
        key: in_file(value)
        for key, value in schema.items()
        if key not in ("title", "default", "required", "discriminator", *_OBJECT)
        or (key == "additionalProperties" and value is not False)
    }
    if "properties" in schema:
        made |= _table(schema)
    return made


def _table(schema: Schema) -> Schema:
    """Properties by their keys in files."""
    properties: Schema = {}
    for field, value in schema["properties"].items():
        properties |= keys_of(field, in_file(value))
    made = {"properties": properties, "additionalProperties": False}
    return made | ({"required": ["kind"]} if "kind" in schema.get("required", []) else {})


def _choice(schema: Schema) -> Schema:
    """Tables of several kinds by their `kind`, so that a wrong key is reported at its line; else
    any.

    What may be absent in a model is absent in a file, never null.
    """
    parts = [part for part in schema["anyOf"] if part.get("type") != "null"]
    words = {"description": schema["description"]} if "description" in schema else {}
    if len(parts) == 1:
        return {**in_file(parts[0]), **words}
    if not all("const" in part.get("properties", {}).get("kind", {}) for part in parts):
        return {**words, "anyOf": in_file(parts)}
    return {**words, **by_kind({_kind(part): part for part in parts})}


def by_kind(kinds: dict[str, Schema]) -> Schema:
    """A table whose `kind` says which of some schemas holds."""
    return {
        "type": "object",
        "required": ["kind"],
        "properties": {"kind": {"enum": list(kinds)}},
        "allOf": [
            {
                "if": {"properties": {"kind": {"const": kind}}, "required": ["kind"]},
                "then": in_file(part),
            }
            for kind, part in kinds.items()
        ],
    }


def _kind(part: Schema) -> str:
    return str(part["properties"]["kind"]["const"])
