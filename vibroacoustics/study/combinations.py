"""Options that a study joins by their names: `[options."twin + weight"]`."""

from collections.abc import Callable, Collection, Mapping
from itertools import combinations
from typing import Any

from ..base.errors import ParameterError
from ..base.vocabulary import REFERENCE_OPTION
from ..machine.combination import SEPARATOR, Combination, joined_names
from ..machine.machine import Machine
from ..machine.option import OPTIONS, Option
from .kinds import validate_kinds
from .machine_file import change_of
from .reader import Reader
from .record import ParameterRecord
from .toml_files import leaves

BESIDE = frozenset({"title", "given"})
"""Keys of the table of a combination."""


def is_combination(name: str, table: Any) -> bool:
    """Return whether a table of the options joins others: by its name, and without a kind.

    Parameters
    ----------
    name : name of the option
    table : table in the study's file
    """
    return SEPARATOR in name and isinstance(table, dict) and "kind" not in table


def take_combinations(content: Mapping[str, Any], reader: Reader) -> dict[str, tuple[str, ...]]:
    """Return the names that each combination joins; what is refused is taken out.

    Parameters
    ----------
    content : content of the study
    reader : gets the problems
    """
    options = content.get("options")
    tables = options if isinstance(options, dict) else {}
    joined = {}
    for name in [name for name, table in tables.items() if is_combination(name, table)]:
        names, single = joined_names(name), _singles(tables)
        if problem := _problem(names, single, tables[name]):
            reader.problems.append(f"{reader.file_and_key(('options', name))}{problem}")
            del tables[name]
        else:
            joined[name] = names
    return joined


def _singles(tables: Mapping[str, Any]) -> list[str]:
    return [
        name
        for name, table in tables.items()
        if name != REFERENCE_OPTION and not is_combination(name, table)
    ]


def _problem(names: tuple[str, ...], single: Collection[str], table: dict[str, Any]) -> str | None:
    for name in names:
        if name not in single:
            return f": joins {name}, which is no option; allowed {', '.join(single)}"
    if len(set(names)) < len(names):
        return ": joins an option twice"
    further = [key for key in table if key not in BESIDE]
    return f".{further[0]}: unknown key" if further else None


def joined_changes(
    names: tuple[str, ...], changes: Mapping[str, dict[str, Any]], where: str
) -> dict[str, dict[str, Any]]:
    """Return the changes of the machine by the redesigns of a combination, in their order.

    Parameters
    ----------
    names : names of the options that are joined
    changes : changes of each redesign of the study
    where : file and key of the combination

    Raises
    ------
    ParameterError
        Two redesigns change one value.
    """
    ordered = {name: changes[name] for name in names if name in changes}
    for item, other in combinations(ordered, 2):
        shared = set(leaves(ordered[item])) & set(leaves(ordered[other]))
        if shared:
            key = ".".join(min(shared))
            raise ParameterError(
                f"{where}: {item} and {other} both change machine.{key}; join one of them"
            )
    return ordered


def with_combinations(
    options: Mapping[str, Option],
    joined: Mapping[str, tuple[str, ...]],
    machines: Mapping[str, Machine],
    reader: Reader,
) -> dict[str, Option]:
    """Return the options of a study with its combinations.

    Parameters
    ----------
    options : those of a kind, by name; refused ones are missing
    joined : names that each combination joins
    machines : with the changes of combinations that have redesigns
    reader : gets the problems
    """
    result = dict(options)
    for name, names in joined.items():
        parts = [options[part] for part in names if part in options]
        if len(parts) < len(names):
            continue  # the part is refused already
        losses = [
            part
            for part, item in zip(names, parts, strict=True)
            if item.insertion_loss() is not None
        ]
        if len(losses) > 1:
            reader.problems.append(
                f"{reader.file_and_key(('options', name))}: {losses[0]} and {losses[1]} both have "
                "an insertion loss; give that of both together as one hood"
            )
            continue
        result[name] = Combination(names=names, parts=tuple(parts), machine=machines.get(name))
    return result


def joined_machine(
    where: str,
    names: tuple[str, ...],
    changes: Mapping[str, dict[str, Any]],
    read: Callable[[dict[tuple[str, ...], Any]], tuple[Machine, Reader, list[ParameterRecord]]],
) -> Machine | None:
    """Return the machine with the changes of all redesigns of a combination; None without one.

    Parameters
    ----------
    where : file and key of the combination
    names : names of the options that are joined
    changes : changes of each redesign of the study
    read : the machine with further tables of changes, by their keys
    """
    ordered = joined_changes(names, changes, where)
    if not ordered:
        return None
    machine, _, _ = read({change_of(name): change for name, change in ordered.items()})
    return machine


def validate_options(
    content: dict[str, Any],
    joined: Mapping[str, tuple[str, ...]],
    machines: Mapping[str, Machine],
    reader: Reader,
) -> None:
    """Turn the tables of the options into options, combinations among them, in their order.

    Parameters
    ----------
    content : content of the study
    joined, machines, reader : see `with_combinations`
    """
    tables = content.get("options")
    if not isinstance(tables, dict):  # refused by the study
        return
    order = list(tables)
    content["options"] = {name: table for name, table in tables.items() if name not in joined}
    validate_kinds(content, "options", OPTIONS, reader)
    options = with_combinations(content["options"], joined, machines, reader)
    content["options"] = {name: options[name] for name in order if name in options}
