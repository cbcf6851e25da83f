"""Dotted keys of values of a study."""

from collections.abc import Mapping, Sequence
from typing import Any

from ..base.errors import ParameterError
from ..base.units import si_key
from ..machine.combination import joined_names
from ..study.study import Study


def acts_on(key: str, option: str) -> bool:
    """Whether a key is a value of an option, of one that it joins, or of the machine."""
    prefixes = tuple(f"options.{name}." for name in {option, *joined_names(option)})
    return not key.startswith("options.") or key.startswith(prefixes)


def check_key(key: str, options: Sequence[str], where: str) -> None:
    """Refuse a key of no value of the machine, of a source or of an option of the designs."""
    first, _, subkey = key.partition(".")
    if first in ("machine", "sources") and subkey:
        return
    names = dict.fromkeys(name for option in options for name in (option, *joined_names(option)))
    if first == "options" and any(key.startswith(f"options.{name}.") for name in names):
        return
    allowed = ", ".join(["machine.…", "sources.…", *(f"options.{name}.…" for name in names)])
    raise ParameterError(f"{where}: no such value; allowed {allowed}")


def present_value(study: Study, key: str) -> float:
    """Return a number of the study in SI, by its dotted key; an integer stays one.

    Raises
    ------
    ParameterError
        There is none.
    """
    first, *tables, last = key.split(".")
    table: Any = getattr(study, first)
    for name in tables:
        table = table.get(name) if isinstance(table, Mapping) else getattr(table, name, None)
    value = getattr(table, si_key(last)[0], None)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ParameterError(f"{key}: there is no such number")
    return value
