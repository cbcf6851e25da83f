"""A study without what fails in a plug-in: options and criteria go, a source must be named."""

from collections.abc import Callable, Iterable, Mapping
from copy import deepcopy
from typing import Any, TypeVar

from ..base.errors import ParameterError
from ..base.fault import FaultError, leave_out
from ..machine.combination import joined_names
from ..machine.option import OPTIONS
from ..machine.source import SOURCES
from .combinations import is_combination
from .criterion import CRITERIA
from .study import Study
from .toml_files import Written

Result = TypeVar("Result")
_Kinds = Mapping[str, set[Any]]
"""Kinds by the name of an option or a source."""


def surviving(study: Study, job: Callable[[Study], Result]) -> Result:
    """Do a job of a study; where an option of a plug-in fails, again without it.

    Raises
    ------
    FaultError
        Something else of a plug-in failed.
    ParameterError
        That of the job, with the study's file.
    """
    while True:
        try:
            return job(study)
        except FaultError as fault:
            study = _without_options(study, fault)
        except ParameterError as error:
            raise ParameterError(f"{study.source_file}: {error}") from None


def _without_options(study: Study, fault: FaultError) -> Study:
    kinds = {
        name: {member.kind for member in option.members} for name, option in study.options.items()
    }
    failing = _failing(fault, kinds, {name: {entry.kind} for name, entry in study.sources.items()})
    options = {name: entry for name, entry in study.options.items() if name not in failing}
    remaining = {name: values for name, values in study.given.items() if name not in failing}
    return study.model_copy(update={"options": options, "given": remaining})


def without_failing(written: Written, fault: FaultError) -> Written:
    """Take options and criteria that fail out of what a study's file says."""
    content = deepcopy(written.content)
    if fault.noun == CRITERIA.noun and fault.name in _table(content, "scoring", "criteria"):
        leave_out(fault)
        del content["scoring"]["criteria"][fault.name]
        return written._replace(content=content)
    options, sources = (_kinds(_table(content, name)) for name in ("options", "sources"))
    for name in _failing(fault, options, sources):
        del content["options"][name]
    return written._replace(content=content)


def without_source(written: Written, name: str) -> Written:
    """Take a source out of what a study's file says.

    Raises
    ------
    ParameterError
        There is no such source.
    """
    content = deepcopy(written.content)
    sources = _table(content, "sources")
    if name not in sources:
        raise ParameterError(
            f"{written.path}: --without {name}: there is no such source; "
            f"sources are {', '.join(sources) or 'none'}"
        )
    del sources[name]
    return written._replace(content=content)


def _failing(fault: FaultError, options: _Kinds, sources: _Kinds) -> list[str]:
    """Names of the options that a fault takes out; raised again where it takes out none.

    Parameters
    ----------
    fault : fault of a plug-in
    options, sources : kinds by name
    """
    failing = _of_kind(fault, OPTIONS.noun, options)
    if not failing:
        raise _hinted(fault, _of_kind(fault, SOURCES.noun, sources))
    for name in failing:
        leave_out(fault, f"option {name}")
    return failing


def _hinted(fault: FaultError, names: Iterable[str]) -> FaultError:
    """Return the fault of a source with how to run on without it."""
    words = " ".join(f"--without {name}" for name in names)
    return fault.with_hint(f"run with {words} omits it") if words else fault


def _of_kind(fault: FaultError, noun: str, kinds: _Kinds) -> list[str]:
    return [name for name, some in kinds.items() if fault.noun == noun and fault.name in some]


def _table(content: Any, *keys: str) -> dict[str, Any]:
    for key in keys:
        content = content.get(key) if isinstance(content, dict) else None
    return content if isinstance(content, dict) else {}


def _kinds(tables: dict[str, Any]) -> _Kinds:
    """Kinds of tables by name; of a combination, of all that it joins."""
    kinds: dict[str, set[Any]] = {
        name: {table.get("kind")} for name, table in tables.items() if isinstance(table, dict)
    }
    joined = [name for name, table in tables.items() if is_combination(name, table)]
    return kinds | {
        name: set().union(*(kinds.get(part, set()) for part in joined_names(name)))
        for name in joined
    }
