"""What every parameter object has in common."""

from collections.abc import Callable
from typing import Any, ClassVar

from pydantic import (
    BaseModel,
    ConfigDict,
    GetJsonSchemaHandler,
    SerializerFunctionWrapHandler,
    model_serializer,
)
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema

from ..errors import ParameterError
from .registry import Registry


class Parameters(BaseModel):
    """A frozen, strictly validated set of parameters in SI units.

    Unknown keys, wrong types, NaN and infinity are refused. Field names carry the SI unit;
    files may use any unit that `vibroacoustics.units` knows, as the suffix of the key.
    """

    model_config = ConfigDict(
        frozen=True, strict=True, extra="forbid", allow_inf_nan=False, validate_default=True
    )


class KindOfParameters(Parameters):
    """Parameters whose class is named by the key `kind` of their table, through a registry.

    `kind` is no field: it is read before the table is validated, and written when the parameters
    are dumped, so that a dump gives them back.
    """

    kind: ClassVar[str]

    @model_serializer(mode="wrap")
    def _with_kind(self, dump: SerializerFunctionWrapHandler) -> dict[str, Any]:
        return {"kind": self.kind, **dump(self)}

    @classmethod
    def __get_pydantic_json_schema__(
        cls, core_schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        schema = handler.resolve_ref_schema(handler(core_schema))
        if "kind" in vars(cls):
            schema.setdefault("properties", {})["kind"] = {"const": cls.kind}
            schema["required"] = ["kind", *schema.get("required", [])]
        return schema


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

        return core_schema.no_info_before_validator_function(self._read, handler(source))

    def __get_pydantic_json_schema__(
        self, core_schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        schemas = (handler(kind.__pydantic_core_schema__) for kind in self._registry.values())
        return {"anyOf": list(schemas)}

    def _read(self, given: Any) -> Any:
        return of_kind(self._registry, given) if isinstance(given, dict) else given


def of_kind(registry: Registry[Any], table: dict[str, Any]) -> Any:
    """Parameters of a table by the class that its `kind` names, from values in SI.

    Raises
    ------
    ParameterError
        There is no such kind.
    pydantic.ValidationError
        The class refuses a value.
    """
    values = dict(table)
    kind = values.pop("kind", None)
    if not isinstance(kind, str):
        raise ParameterError(f"kind = {kind!r}: must name a {registry.noun}")
    return registry[kind].model_validate(values)
