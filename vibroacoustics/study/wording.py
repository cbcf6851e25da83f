"""The wording of refusals: pydantic's findings, a line each, in the file's own keys and units."""

import re
from functools import partial
from pathlib import Path
from typing import Any, Final, Protocol, TypeVar, get_args

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from ..base.errors import ParameterError
from ..base.refusal import Refusal, parts_of, refusal, reworded
from ..base.units import split_key
from .asked_keys import asked_key, meant_field, meant_key
from .radiation import RadiationSettings

Model = TypeVar("Model", bound=BaseModel)
MOST_LINES: Final = 40


class FileKeys(Protocol):
    """Content of the file that was read, as far as the wording needs it."""

    file_keys: dict[tuple[str, ...], tuple[str, Any]]
    """Key and value as written, by the path of the SI field."""

    problems: list[str]
    """Problems that the reader refuses."""

    def file(self, keys: tuple[str, ...]) -> Path:
        """File that gives the value of a path of keys."""

    def file_and_key(self, keys: tuple[str, ...]) -> str:
        """File and dotted key, as written, of a path of keys."""


def validated(
    model: type[Model], content: dict[str, Any], reader: FileKeys, table: tuple[str, ...] = ()
) -> Model:
    """Validate SI values; refusals are worded in the file's own keys and units.

    Parameters
    ----------
    model : class of the parameters
    content : values in SI by field
    reader : reader of the file
    table : keys of the table in the file that holds the content

    Raises
    ------
    ParameterError
        A line for each refusal and each problem of the reader, which names file, field, value,
        unit and allowed range.
    """
    try:
        valid = checked(model, content, reader, table)
    except ParameterError as error:
        raise ParameterError(*first_lines([*reader.problems, *error.args])) from None
    if reader.problems:
        raise ParameterError(*first_lines(reader.problems))
    return valid


def checked(
    model: type[Model], content: dict[str, Any], reader: FileKeys, table: tuple[str, ...] = ()
) -> Model:
    """Return what `validated` does, without the problems of the reader."""
    try:
        return model.model_validate(content)
    except ValidationError as error:
        lines = _lines(model, error.errors(), reader, table)
        raise ParameterError(*lines) from None


def first_lines(lines: list[str]) -> list[str]:
    """Lines, or the first of them and how many more there are."""
    different = list(dict.fromkeys(lines))
    more = len(different) - MOST_LINES
    return different if more <= 0 else [*different[:MOST_LINES], f"and {more} more"]


def _lines(
    model: type[BaseModel], errors: list[ErrorDetails], reader: FileKeys, table: tuple[str, ...]
) -> list[str]:
    """A line for each written value or missing key."""
    refused: dict[tuple[str, ...], ErrorDetails] = {}
    for details in errors:
        inner = _without_tags(tuple(str(part) for part in details["loc"]))
        refused.setdefault(_written(inner, reader, table), details)
    if not table and reader.problems:
        refused.pop((), None)  # what the values are together is not known without all of them
    missing = [inner for inner, details in refused.items() if details["type"] == "missing"]
    lines: dict[tuple[str, ...], list[str]] = {}
    for inner, details in refused.items():
        if details["type"] != "missing":
            words = ""
            if details["type"] == "extra_forbidden" and len(lines) < MOST_LINES:
                meant, words = _meant(model, inner, missing, reader, table)
                missing = [other for other in missing if other != meant]
            each = map(partial(_one_line, model, reader, table), _apart(details))
            lines[inner] = [reworded(line, line + words) for line in each]
    lines |= {inner: _asked(model, inner, reader, table) for inner in missing}
    return [line for inner in refused for line in lines.get(inner, ())]


def _written(inner: tuple[str, ...], reader: FileKeys, table: tuple[str, ...]) -> tuple[str, ...]:
    """Location of the value that the file writes, of which an error may concern an item."""
    ends = range(1, len(inner))
    return next((inner[:end] for end in ends if (*table, *inner[:end]) in reader.file_keys), inner)


def _meant(
    model: type[BaseModel],
    inner: tuple[str, ...],
    missing: list[tuple[str, ...]],
    reader: FileKeys,
    table: tuple[str, ...],
) -> tuple[tuple[str, ...], str]:
    """The field that a misspelt key means: one that is missing, or else an optional one."""
    key = reader.file_keys.get((*table, *inner), (inner[-1], None))[0]
    lacking = [other[-1] for other in missing if other[:-1] == inner[:-1]]
    fields = [
        field for inner_model in _models_at(model, inner[:-1]) for field in inner_model.model_fields
    ]
    field = meant_field(key, lacking) or meant_field(key, fields)
    if field is None:
        return (), ""
    return (*inner[:-1], field), f", did you mean {meant_key(key, field)}"


def _asked(
    model: type[BaseModel], inner: tuple[str, ...], reader: FileKeys, table: tuple[str, ...]
) -> list[str]:
    """A line for a missing value, or for each that a missing table needs."""
    models = _models_at(model, inner)
    fields = models[0].model_fields if len(models) == 1 and _is_table(model, inner) else {}
    lines_to_add = getattr(models[0], "lines_to_add", "") if fields else ""
    if lines_to_add:
        return [_refusal(reader, (*table, *inner), f"is missing; {lines_to_add}")]
    needed = [name for name, field in fields.items() if field.is_required()]
    if needed:
        return [line for name in needed for line in _asked(model, (*inner, name), reader, table)]
    key = asked_key(inner[-1])
    unit = split_key(key)[1]
    bounds = _allowed(model, inner, 1.0 if unit is None else unit.factor)
    return [_refusal(reader, (*table, *inner[:-1], key), "is missing", None, bounds)]


def _is_table(model: type[BaseModel], inner: tuple[str, ...]) -> bool:
    """Whether a field is a table of its own, not a list or table of such tables."""
    field = _find_field(model, inner)
    annotation = None if field is None else field.annotation
    return isinstance(annotation, type) and issubclass(annotation, BaseModel)


def _apart(details: ErrorDetails) -> list[ErrorDetails]:
    """Split a refusal with several arguments into one for each."""
    problems = details["ctx"]["error"].args if details["type"] == "value_error" else ()
    if len(problems) < 2:
        return [details]
    return [{**details, "ctx": {"error": problem}} for problem in problems]


def _one_line(
    model: type[BaseModel], reader: FileKeys, table: tuple[str, ...], details: ErrorDetails
) -> str:
    inner = _without_tags(tuple(str(part) for part in details["loc"]))
    location = (*table, *inner)
    key, value = reader.file_keys.get(location, (location[-1] if location else "", None))
    written = (*location[:-1], key) if location else ()
    plain = _PLAIN.get(details["type"])
    if plain is not None:
        return _refusal(reader, written, plain)
    if details["type"] == "value_error":
        return _contradiction(reader, written, str(details["ctx"]["error"]))
    if details["type"] == "union_tag_invalid":
        context = details["ctx"]
        return (
            f"{reader.file_and_key(written)}.kind = {context['tag']}: unknown; "
            f"allowed {context['expected_tags']}"
        )
    unit = split_key(key)[1]
    bounds = _allowed(model, inner, 1.0 if unit is None else unit.factor)
    reason = "out of range" if details["type"] in _LIMITS else _reason(details["msg"])
    shown = details["input"] if value is None else value
    return _refusal(reader, written, reason, shown, bounds)


def _refusal(
    reader: FileKeys, keys: tuple[str, ...], reason: str, value: Any = None, bounds: str = ""
) -> Refusal:
    """Refusal of the value, the key or the whole table at a path of keys, as written."""
    file = str(reader.file(keys))
    field = reader.file_and_key(keys).removeprefix(file).removeprefix(": ")
    unit = split_key(keys[-1])[1] if keys else None
    symbol = unit.symbol if unit else ""
    return refusal(file, field, reason, value, symbol, bounds)


def _contradiction(reader: FileKeys, keys: tuple[str, ...], words: str) -> Refusal:
    """Refusal of values that contradict each other; the words name them below the keys."""
    line, parts = _refusal(reader, keys, words), parts_of(words)
    table = line.parts.field
    inner = parts.field or ""
    field = inner if table is None or inner.startswith(table) else f"{table}.{inner}".rstrip(".")
    return Refusal(line, parts._replace(file=line.parts.file, field=field or None))


_PLAIN: Final = {
    "extra_forbidden": "unknown key",
    "union_tag_not_found": "kind is missing",
}
_KINDS: Final = {
    "list": "a list",
    "tuple": "a list",
    "string": "a text",
    "integer": "a whole number",
    "number": "a number",
    "boolean": "true or false",
}
"""Words for the types of Python that pydantic names."""
_LIMITS: Final = {"greater_than", "greater_than_equal", "less_than", "less_than_equal"}


def _without_tags(location: tuple[str, ...]) -> tuple[str, ...]:
    """Location without what pydantic adds: the kind of a body, and a key's mark."""
    number = location.index("body") + 1 if "body" in location else 0
    if 0 < number < len(location) and location[number] in _BODIES:
        location = (*location[:number], *location[number + 1 :])
    return tuple(part for part in location if part != "[key]")


def _reason(message: str) -> str:
    """Pydantic's words without types of Python."""
    message = re.sub(r"a valid (?:dictionary|.*instance of ).*", "a table", message)
    for python, words in _KINDS.items():
        message = message.replace(f"a valid {python}", words)
    return message.replace("Input should be", "must be").replace("tuple", "list")


def _allowed(model: type[BaseModel], location: tuple[str, ...], factor: float) -> str:
    """Range of a field in the file's unit, or nothing where the field has none."""
    field = _find_field(model, location)
    if field is None:
        return ""
    limits: dict[str, float] = {}
    for item in field.metadata:
        for name in ("ge", "gt", "le", "lt"):
            if getattr(item, name, None) is not None:
                limits[name] = getattr(item, name) / factor
    parts = [f"{word} {limits[name]:g}" for name, word in _LIMIT_WORDS if name in limits]
    return " ".join(parts)


_LIMIT_WORDS: Final = (("ge", "from"), ("gt", "above"), ("le", "to"), ("lt", "to below"))


def _find_field(model: type[BaseModel], location: tuple[str, ...]) -> FieldInfo | None:
    """Field that a location leads to, through nested parameter objects and tables of them."""
    return _follow(model, location)[0]


def _models_at(model: type[BaseModel], location: tuple[str, ...]) -> list[type[BaseModel]]:
    """Parameter objects that may stand at a location."""
    return _follow(model, location)[1]


def _follow(
    model: type[BaseModel], location: tuple[str, ...]
) -> tuple[FieldInfo | None, list[type[BaseModel]]]:
    models: list[type[BaseModel]] = [model]
    field: FieldInfo | None = None
    for part in location:
        named = [m.model_fields[part] for m in models if part in m.model_fields]
        if named:
            field = named[0]
            models = _models_in(field.annotation)
    return field, models


def _models_in(annotation: Any) -> list[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [model for argument in get_args(annotation) for model in _models_in(argument)]


_BODIES: Final = {
    kind
    for model in _models_in(RadiationSettings.model_fields["body"].annotation)
    for kind in get_args(model.model_fields["kind"].annotation)
}
