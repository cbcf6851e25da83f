"""The key `title` in the tables of machine and options."""

from collections.abc import Collection, Mapping
from typing import Any

from ..base.errors import ParameterError
from ..base.vocabulary import REFERENCE_OPTION
from .reader import Reader
from .titles import LONGEST


def take_titles(content: Mapping[str, Any], reader: Reader) -> dict[str, Any]:
    """Take the key `title` out of the tables of machine and options."""
    machine, options = content.get("machine"), content.get("options")
    titles: dict[str, Any] = {"machine": "", "options": {}}
    if isinstance(machine, dict) and "title" in machine:
        titles["machine"] = _checked(machine.pop("title"), ("machine",), reader)
    tables = options if isinstance(options, dict) else {}
    for name, table in tables.items():
        if isinstance(table, dict) and "title" in table:
            keys = ("options", name)
            title = _checked(table.pop("title"), keys, reader)
            taken = {*tables, *titles["options"].values()} - {name}
            _check_free(name, title, taken, reader.file_and_key((*keys, "title")))
            titles["options"][name] = title
    return titles


def _checked(title: Any, keys: tuple[str, ...], reader: Reader) -> str:
    where = f"{reader.file_and_key((*keys, 'title'))} = {title!r}"
    if not isinstance(title, str) or not title.strip() or not title.isprintable():
        raise ParameterError(f"{where}: must be a line of text")
    if len(title) > LONGEST:
        raise ParameterError(f"{where}: has {len(title)} letters; allowed 1 to {LONGEST}")
    return title


def _check_free(name: str, title: str, taken: Collection[str], where: str) -> None:
    if name == REFERENCE_OPTION:
        raise ParameterError(f"{where} = {title!r}: every report names it {REFERENCE_OPTION}")
    if title in taken:
        raise ParameterError(f"{where} = {title!r}: is name or title of another option")
