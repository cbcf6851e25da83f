"""Base class of all parameter objects."""

import json
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any, ClassVar, Final, Self, TypeVar

from pydantic import (
    BaseModel,
    ConfigDict,
    GetJsonSchemaHandler,
    SerializerFunctionWrapHandler,
    ValidationInfo,
    create_model,
    model_serializer,
    model_validator,
)
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema

from .errors import ParameterError
from .field_reads import unrecorded_reads
from .registry import Registry

FURTHER: Final = "others by --plugin"
Contradictions = Iterable[str]
_OF_PYDANTIC: Final = set(dir(create_model("Plain"))) - set(dir(object))


class Parameters(BaseModel):
    """A frozen, strictly validated set of parameters in SI units.

    Unknown keys, wrong types, NaN and infinity are refused. Field names carry the SI unit;
    files may use any unit of the same quantity, as the suffix of the key.

    Examples
    --------
    >>> class Wheel(va.Parameters):
    ...     mass_kg: float
    >>> Wheel(mass_kg=0.3)
    Wheel(mass_kg=0.3)
    """

    model_config = ConfigDict(
        frozen=True, strict=True, extra="forbid", allow_inf_nan=False, validate_default=True
    )
    lines_to_add: ClassVar[str] = ""
    """Help in the refusal of a missing table, where its required keys alone do not say enough."""

    def __dir__(self) -> list[str]:
        return [name for name in super().__dir__() if name not in _OF_PYDANTIC]

    def contradictions(self) -> Contradictions:
        """Give what is wrong between values each of which is allowed; the first is reported.

        Those of a parent class are asked first, without a call of this one's.
        """
        yield from ()

    @model_validator(mode="after")
    def _without_contradictions(self) -> Self:
        if methods := _contradictions_of(type(self)):
            with unrecorded_reads():
                for method in methods:
                    for problem in method(self):
                        raise ValueError(problem)
        return self


@cache
def _contradictions_of(
    kind: type[Parameters],
) -> tuple[Callable[[Parameters], Contradictions], ...]:
    """Own methods `contradictions` of a class and of those that it is made from, theirs first."""
    owners = [owner for owner in reversed(kind.__mro__) if owner is not Parameters]
    return tuple(vars(each)["contradictions"] for each in owners if "contradictions" in vars(each))


@dataclass(frozen=True)
class Held:
    """Annotation of a value that is never sampled from its range.

    Attributes
    ----------
    reason : why not, after "it" or "they"

    Examples
    --------
    >>> from typing import Annotated
    >>> class Hood(va.Parameters):
    ...     thickness_m: Annotated[float, va.Held("needs a radiation of its own")]
    >>> Hood(thickness_m=0.002).thickness_m
    0.002
    """

    reason: str


@dataclass(frozen=True)
class Regime:
    """Annotation of a value with a part of its range in which another law of the machine holds.

    The report shows what its headlines would be with samples of this part alone.

    Attributes
    ----------
    name : words for the law, with the limits in the unit of files
    lowest, highest : limits of the value, SI

    Examples
    --------
    >>> from typing import Annotated
    >>> class Slot(va.Parameters):
    ...     oil_m: Annotated[float, va.Regime("slot with at most 2 µm of oil", 0.0, 2e-6)]
    >>> Slot(oil_m=1e-6).oil_m
    1e-06
    """

    name: str
    lowest: float
    highest: float


class KindOfParameters(Parameters):
    """Parameters whose class is named by the key `kind` of their table, through a registry.

    `kind` is no field: it is read before the table is validated, and written when the parameters
    are dumped, so that a dump gives them back.
    """

    kind: ClassVar[str]

    @model_serializer(mode="wrap")
    def _with_kind(self, dump: SerializerFunctionWrapHandler) -> dict[str, Any]:
        return {"kind": self.kind, **dump(self)}


Kind = TypeVar("Kind", bound=KindOfParameters)


class AnyOf:
    """Annotation of a field that holds parameters of any kind of a registry.

    A table is validated by the class that its `kind` names; the JSON schema is the union of all
    kinds that are registered.
    """

    def __init__(self, registry: Registry[Any]) -> None:
        self._registry = registry

    def __get_pydantic_core_schema__(
        self, source: Any, handler: Callable[[Any], CoreSchema]
    ) -> CoreSchema:
        from pydantic_core import core_schema

        return core_schema.with_info_before_validator_function(self._read, handler(source))

    def __get_pydantic_json_schema__(
        self, core_schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        return {"anyOf": [self._schema(kind, handler) for kind in self._registry.values()]}

    def _schema(
        self, kind: type[KindOfParameters], handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        schema = handler.resolve_ref_schema(handler(kind.__pydantic_core_schema__))
        properties = {"kind": {"const": kind.kind}, **schema.get("properties", {})}
        required = ["kind", *schema.get("required", [])]
        return {**schema, "properties": properties, "required": required}

    def _read(self, content: Any, info: ValidationInfo) -> Any:
        if not isinstance(content, dict):
            return content
        kind, values = split_kind(self._registry, content)
        if info.mode == "json":  # where a list stands for a tuple
            return kind.model_validate_json(json.dumps(values))
        return kind.model_validate(values)


def split_kind(
    registry: Registry[type[Kind]], table: Mapping[str, Any]
) -> tuple[type[Kind], dict[str, Any]]:
    """The class that the `kind` of a table names, and the other values of the table.

    Raises
    ------
    ParameterError
        There is no such kind.
    """
    values = dict(table)
    kind = values.pop("kind", None)
    if kind is None:
        raise ParameterError(f"kind is missing; allowed {', '.join(registry)}")
    if not isinstance(kind, str) or kind not in registry:
        raise ParameterError(f"kind = {kind}: {registry.unknown(str(kind))}; {FURTHER}")
    return registry[kind], values
