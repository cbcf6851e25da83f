"""A study with other numbers, validated by its classes without reading its files again."""

from collections.abc import Mapping
from typing import Any

from pydantic import BaseModel, ValidationError

from ..base.errors import ParameterError
from ..base.units import si_key
from ..study.study import Study


def is_plain(study: Study, keys: list[str]) -> bool:
    """Whether values of these dotted keys stand in fields of their own alone."""
    redesigned = any(option.changes_machine for option in study.options.values())
    return all(_is_field(study, key, redesigned) for key in keys)


def _is_field(study: Study, key: str, redesigned: bool) -> bool:
    first, *tables, last = key.split(".")
    thing: Any = getattr(study, first)
    for name in tables:
        thing = thing.get(name) if isinstance(thing, dict) else getattr(thing, name, None)
    if first == "machine" and redesigned:
        return False
    value = getattr(thing, si_key(last)[0], None)
    return isinstance(thing, BaseModel) and isinstance(value, int | float)


def changed(study: Study, values: Mapping[str, float | int]) -> Study:
    """The study with other numbers; see `is_plain`.

    Raises
    ------
    ParameterError
        A class refuses them, in its own words.
    """
    machine: dict[str, Any] = {}
    others: dict[str, dict[str, Any]] = {"options": {}, "sources": {}}
    for key, value in values.items():
        first, *tables, last = key.split(".")
        field, factor = si_key(last)
        in_si = value if factor == 1.0 else value * factor
        if first == "machine":
            _put(machine, [*tables, field], in_si)
        else:
            others[first].setdefault(tables[0], {})[field] = in_si
    try:
        update: dict[str, Any] = {
            name: {**(present := getattr(study, name)),
                   **{key: _validated(present[key], fields) for key, fields in new.items()}}
            for name, new in others.items()
        }  # fmt: skip
        update["machine"] = _validated(study.machine, machine) if machine else study.machine
        return Study.model_validate({**dict(iter(study)), **update})
    except ValidationError as error:
        raise ParameterError(str(error.errors()[0]["msg"])) from None


def _put(table: dict[str, Any], keys: list[str], value: Any) -> None:
    for key in keys[:-1]:
        table = table.setdefault(key, {})
    table[keys[-1]] = value


def _validated(table: BaseModel, fields: Mapping[str, Any]) -> BaseModel:
    """A table with other values, also in its tables."""
    inner = {
        name: _validated(getattr(table, name), value) if isinstance(value, dict) else value
        for name, value in fields.items()
    }
    return type(table).model_validate({**dict(iter(table)), **inner})
