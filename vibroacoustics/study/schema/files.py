"""Schemas of the two kinds of file: a study, and a machine."""

from collections.abc import Iterable
from typing import Final

from ...machine.machine import MACHINES
from ...machine.option import OPTIONS
from ..automatic import AUTO, COMPUTED, OPTIONAL
from ..loading import FILLED_IN
from ..machine_file import POINTS
from ..study import Study
from ..titles import LONGEST
from .model import FileSchema, by_kind, in_file
from .units import RANGE, SOURCE, Schema, keys_of, sourced

DRAFT: Final = "http://json-schema.org/draft-07/schema#"
_FILE: Final[Schema] = {"type": "string", "minLength": 1, "description": "Name, from this file's"}
_TITLE: Final[Schema] = {
    "type": "string",
    "minLength": 1,
    "maxLength": LONGEST,
    "description": "What reports show in place of the name",
}
_JOINED: Final = r" \+ "
"""Pattern of the name of a combination of options."""
_IN_PART: Final = "machine_in_part"
_PART: Final[Schema] = {"$ref": f"#/$defs/{_IN_PART}"}
_REMOVABLE: Final = ("options", "receivers", "sources")
"""Tables of tables: `false` removes one that an extended study has."""
_STEPS: Final[Schema] = {
    "type": "object",
    "additionalProperties": False,
    "required": ["start", "stop", "step"],
    "properties": {key: {"type": "number"} for key in ("start", "stop", "step")},
}


def study_schema() -> Schema:
    """Return the schema of a study's file, which may extend another."""
    raw = Study.model_json_schema(schema_generator=FileSchema)
    machine = raw["properties"]["machine"]
    for name in FILLED_IN:
        del raw["properties"][name]
    made = in_file(raw)
    definitions, properties = made["$defs"], made["properties"]
    definitions[_IN_PART] = _any_machine(machine)
    properties |= {
        "extends": _FILE,
        "machine": _table(
            {
                "file": _FILE,
                "title": _TITLE,
                "override": _PART,
                "without": {"type": "array", "items": {"type": "string"}},
            }
        ),
    }
    _with_judgements(properties["options"]["additionalProperties"])
    for name in _REMOVABLE:
        table = properties[name]["additionalProperties"]
        properties[name]["additionalProperties"] = {"anyOf": [{"const": False}, table]}
    properties["options"]["patternProperties"] = {
        _JOINED: _table({"given": _JUDGED, "title": _TITLE})
    }
    definitions["Evidence"]["properties"]["forces"] = _FILE
    scoring = definitions["Scoring"]["properties"]
    del scoring["published"]
    scoring["published_table"] = _FILE
    baseline = definitions["Baseline"]["properties"]
    for name in ("third_octaves", "orders"):
        del baseline[name]
    baseline["file"] = {"anyOf": [_FILE, {"type": "array", "items": _FILE, "minItems": 1}]}
    baseline["recorded_speed_rpm"] = {"anyOf": [{"type": "number"}, baseline["recorded_speed_rpm"]]}
    speeds = definitions["Operation"]["properties"]
    speeds["speed_rpm"] = {"anyOf": [speeds["speed_rpm"], _STEPS]}
    for table, name in (("operation", "Operation"), ("radiation", "RadiationSettings")):
        _with_automatic(definitions[name]["properties"], (*OPTIONAL[table], *COMPUTED[table]))
    return _finished("Study of vibroacoustics", made)


def _with_automatic(properties: Schema, fields: Iterable[str]) -> None:
    """Allow the word `auto` for some fields, in every unit."""
    for field in fields:
        for key, _ in keys_of(field, {"type": "number"}):
            properties[key] = {"anyOf": [{"const": AUTO}, properties[key]]}


def machine_schema() -> Schema:
    """Return the schema of a machine's file."""
    raw = Study.model_json_schema(schema_generator=FileSchema)
    machine = raw["properties"]["machine"]
    made = by_kind(_kinds(machine))
    for choice in made["allOf"]:
        choice["then"]["properties"][POINTS] = {"additionalProperties": _PART}
    made["$defs"] = {**in_file(raw["$defs"]), _IN_PART: _any_machine(machine)}
    return _finished("Machine of vibroacoustics", made)


def _kinds(machine: Schema) -> dict[str, Schema]:
    """Schemas of the kinds of machine, in SI."""
    return dict(zip(MACHINES, machine["anyOf"], strict=True))


def _any_machine(machine: Schema) -> Schema:
    """Values of a machine of any kind, which stand in place of its own."""
    of_kinds: dict[str, list[Schema]] = {}
    for part in machine["anyOf"]:
        for name, schema in in_file(part)["properties"].items():
            schemas = of_kinds.setdefault(name, [])
            if name != "kind" and schema not in schemas:
                schemas.append(schema)
    alternatives = {name: ones for name, ones in of_kinds.items() if ones}
    return _table(
        {
            name: ones[0] if len(ones) == 1 else {"anyOf": ones}
            for name, ones in alternatives.items()
        }
    )


def _table(properties: Schema) -> Schema:
    """A table of these keys and no other."""
    return {"type": "object", "additionalProperties": False, "properties": properties}


_JUDGED: Final[Schema] = {
    "type": "object",
    "additionalProperties": sourced({"type": "number"}),
}
"""Values of criteria that an option gives."""


def _with_judgements(options: Schema) -> None:
    """Add to each kind of option what its file may say beside its parameters."""
    for choice in options["allOf"]:
        kind = choice["if"]["properties"]["kind"]["const"]
        properties = choice["then"]["properties"]
        properties |= {"given": _JUDGED, "title": _TITLE}
        if OPTIONS[kind].changes_machine:
            properties.pop("machine", None)
            properties["change"] = _PART


def _finished(title: str, schema: Schema) -> Schema:
    """Schema with title and draft in front, and what every value may carry."""
    definitions = {**schema["$defs"], "source": SOURCE, "range": RANGE}
    return {"$schema": DRAFT, "title": title, "type": "object", **schema, "$defs": definitions}
