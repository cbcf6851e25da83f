"""Values of one file in SI, with the record of where each comes from."""

import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Final, TypeVar

from ..base.errors import ParameterError
from ..base.units import si_key, split_key
from .example import unmarked
from .record import ParameterRecord
from .toml_files import is_quantity, shown_key

Result = TypeVar("Result")
QUANTITY_KEYS: Final = {"value", "source", "range"}


class Reader:
    """Turns the values of one file to SI and keeps the record of where each comes from."""

    def __init__(
        self, path: Path, origin: dict[tuple[str, ...], Path], sources_required: bool = False
    ) -> None:
        self.path = path
        self.origin = origin
        self.sources_required = sources_required
        self.overridden: dict[tuple[str, ...], tuple[str, ...]] = {}
        self.records: list[ParameterRecord] = []
        self.file_keys: dict[tuple[str, ...], tuple[str, Any]] = {}
        self.problems: list[str] = []

    def to_si(self, content: Mapping[str, Any], prefix: tuple[str, ...]) -> dict[str, Any]:
        """Bare values in SI, by field, of a table under a prefix; refusals go to `problems`."""
        result: dict[str, Any] = {}
        for key, value in content.items():
            keys = (*prefix, key)
            if isinstance(value, dict) and not is_quantity(value):
                result[key] = self.to_si(value, keys)
                continue
            name, factor = si_key(key)
            if name in result:
                self.problems.append(f"{self.file_and_key(keys)}: given twice, in two units")
            number = self._number_or_problem(keys, value)
            self.file_keys[(*prefix, name)] = (key, number)
            result[name] = _scale(number, factor)
        return result

    def _number_or_problem(self, keys: tuple[str, ...], value: Any) -> Any:
        """The bare value of a leaf; what is wrong with its source or range is reported later."""
        try:
            return self.number(keys, value)
        except ParameterError as error:
            self.problems += error.args
            return _frozen(value["value"] if is_quantity(value) else value)

    def tried(self, read: Callable[[], Result]) -> Result | None:
        """Return what a part of the reading gives; None where it is refused, with its problems."""
        try:
            return read()
        except ParameterError as error:
            self.problems += error.args
            return None

    def file(self, keys: tuple[str, ...]) -> Path:
        """The file that gives the value of these keys."""
        return self.origin.get(keys, self.path)

    def file_and_key(self, keys: tuple[str, ...]) -> str:
        """File and dotted key as written; a changed machine value stands in the study."""
        prefix = self.overridden.get(keys, ())
        dotted = ".".join(map(shown_key, (*prefix, *keys)))
        return f"{self.file(keys)}: {dotted}" if dotted else f"{self.file(keys)}"

    def number(self, keys: tuple[str, ...], value: Any, unit: str = "") -> Any:
        """The bare value of a leaf; records its source and checks it against its own range.

        Parameters
        ----------
        keys : keys of the leaf
        value : number, or table with value, source and range
        unit : unit where the key's suffix states none
        """
        where = self.file_and_key(keys)
        if not is_quantity(value):
            if self.sources_required and is_number(value):
                raise ParameterError(
                    f'{where} = {value}: needs a source: {{ value = {value}, source = "…" }}'
                )
            return _frozen(value)
        unknown = set(value) - QUANTITY_KEYS
        if unknown:
            raise ParameterError(f"{where}: unknown key {shown_key(min(unknown))}")
        source = value.get("source")
        if not isinstance(source, str) or not source.strip():
            raise ParameterError(f"{where}: source is missing")
        number = value["value"]
        source, is_example = unmarked(source, keys[-1], number, self.file(keys).parent)
        suffix = split_key(keys[-1])[1]
        symbol = unit or (suffix.symbol if suffix else "")
        lowest, highest = _limits(where, value.get("range"))
        if source.startswith("assumed") and lowest is None and not isinstance(number, str):
            raise ParameterError(f"{where}: an assumed value needs a range")
        if lowest is not None and is_number(number) and not lowest <= number <= highest:
            raise ParameterError(
                f"{where} = {number:g} {symbol}: outside its own range {lowest:g} to {highest:g}"
            )
        self.records.append(
            ParameterRecord(
                file=self.file(keys).name,
                field=".".join(keys),
                value=_shown(number),
                unit=symbol,
                source=source,
                lowest=lowest,
                highest=highest,
                example=is_example,
            )
        )
        return _frozen(number)


def _limits(where: str, limits: Any) -> tuple[float, float] | tuple[None, None]:
    if limits is None:
        return None, None
    if not isinstance(limits, list) or len(limits) != 2 or not all(map(is_number, limits)):
        raise ParameterError(f"{where}: range must be two numbers [lowest, highest]")
    return float(limits[0]), float(limits[1])


def is_number(value: Any) -> bool:
    """A finite number that a float can hold; TOML's integers have no limit."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    return abs(value) <= sys.float_info.max


def _frozen(value: Any) -> Any:
    """Lists, also lists of lists, as tuples."""
    return tuple(map(_frozen, value)) if isinstance(value, list) else value


def _shown(value: Any) -> str:
    """A value in words; points as how many they are."""
    if isinstance(value, list) and value and isinstance(value[0], list):
        return f"{len(value)} points"
    return f"{value:g}" if is_number(value) else str(value)


def _scale(value: Any, factor: float) -> Any:
    """Convert a number or a list of numbers; leave everything else to the validation."""
    if isinstance(value, tuple):
        return tuple(_scale(item, factor) for item in value)
    if factor == 1.0 or not is_number(value):
        return value
    return value * factor
