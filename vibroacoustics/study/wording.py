"""The wording of a refusal: pydantic's finding as one line in the file's own keys and units."""

from typing import Any, Final, Protocol, TypeVar, get_args

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from ..base.errors import ParameterError
from ..base.units import split_key
from .radiation import RadiationSettings

Model = TypeVar("Model", bound=BaseModel)


class FileKeys(Protocol):
    """What the wording needs to know of the file that was read."""

    file_keys: dict[tuple[str, ...], tuple[str, Any]]
    """Key and value as written, by the path of the SI field."""

    def file_and_key(self, keys: tuple[str, ...]) -> str:
        """File and dotted key, as written, of a path of keys."""


def validated(
    model: type[Model], content: dict[str, Any], reader: FileKeys, table: tuple[str, ...] = ()
) -> Model:
    """Validate SI values; a refusal is worded in the file's own keys and units.

    Parameters
    ----------
    model : class of the parameters
    content : values in SI by field
    reader : of the file
    table : keys of the table in the file that holds the content

    Raises
    ------
    ParameterError
        One line that names file, field, value, unit and allowed range.
    """
    try:
        return model.model_validate(content)
    except ValidationError as error:
        raise ParameterError(_one_line(model, error.errors()[0], reader, table)) from None


def _one_line(
    model: type[BaseModel], details: ErrorDetails, reader: FileKeys, table: tuple[str, ...]
) -> str:
    inner = _without_tags(tuple(str(part) for part in details["loc"]))
    location = (*table, *inner)
    key, value = reader.file_keys.get(location, (location[-1] if location else "", None))
    where = reader.file_and_key((*location[:-1], key) if location else ())
    plain = _PLAIN.get(details["type"])
    if plain is not None:
        return f"{where}: {plain}"
    if details["type"] == "value_error":
        return f"{where}: {details['ctx']['error']}"
    if details["type"] == "union_tag_invalid":
        context = details["ctx"]
        return f"{where}.kind = {context['tag']}: unknown; allowed {context['expected_tags']}"
    unit = split_key(key)[1]
    symbol = f" {unit.symbol}" if unit and unit.symbol else ""
    bounds = _allowed(model, inner, 1.0 if unit is None else unit.factor)
    reason = "out of range" if details["type"] in _LIMITS else _reason(details["msg"])
    allowed = f"; allowed {bounds}{symbol}" if bounds else ""
    shown = details["input"] if value is None else value
    return f"{where} = {_short(shown)}{symbol}: {reason}{allowed}"


_PLAIN: Final = {
    "missing": "is missing",
    "extra_forbidden": "unknown key",
    "union_tag_not_found": "kind is missing",
}
_LIMITS: Final = {"greater_than", "greater_than_equal", "less_than", "less_than_equal"}


def _without_tags(location: tuple[str, ...]) -> tuple[str, ...]:
    """Location without what pydantic adds: the kind of a body, and a key's mark."""
    at = location.index("body") + 1 if "body" in location else 0
    if 0 < at < len(location) and location[at] in _BODIES:
        location = (*location[:at], *location[at + 1 :])
    return tuple(part for part in location if part != "[key]")


def _reason(message: str) -> str:
    """Pydantic's words, with a TOML list called a list."""
    return message.replace("Input should be", "must be").replace("tuple", "list")


def _short(value: Any) -> str:
    text = repr(list(value) if isinstance(value, tuple) else value)
    return text if len(text) <= 60 else text[:57] + "..."


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
    models: list[type[BaseModel]] = [model]
    field: FieldInfo | None = None
    for part in location:
        named = [m.model_fields[part] for m in models if part in m.model_fields]
        if named:
            field = named[0]
            models = _models_in(field.annotation)
    return field


def _models_in(annotation: Any) -> list[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [model for argument in get_args(annotation) for model in _models_in(argument)]


_BODIES: Final = {
    kind
    for model in _models_in(RadiationSettings.model_fields["body"].annotation)
    for kind in get_args(model.model_fields["kind"].annotation)
}
