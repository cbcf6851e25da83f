"""The page of everything that has a kind or a name: machines, options, sources, criteria, …"""

import sys
from types import ModuleType
from typing import Final

from vibroacoustics.base.units import UNITS
from vibroacoustics.design.figure import FIGURES
from vibroacoustics.machine.machine import MACHINES
from vibroacoustics.machine.option import OPTIONS
from vibroacoustics.machine.source import SOURCES
from vibroacoustics.report.columns import COLUMNS
from vibroacoustics.report.sections import SECTIONS
from vibroacoustics.study.criterion import CRITERIA

from .tables import code, first_sentence, table

HEAD: Final = """# Kinds, criteria and units

Built-in kinds, from the registries of the code. One Python file adds a further one
([balancer](../add_a_balancer.md), [machine](../add_a_machine.md),
[source](../add_a_source.md), [criterion](../add_a_criterion.md),
[section](../add_a_section.md)). Fields are in SI; a file may use any of the units below.
"""


def page() -> str:
    """Markdown of the page."""
    parts = [
        HEAD,
        "## Kinds of machine\n\n`kind` of a machine file.",
        table(
            ("kind", "description"),
            [(code(n), first_sentence(package_of(m).__doc__)) for n, m in MACHINES.items()],
        ),
        "## Kinds of option\n\nTables `[options.NAME]` of a study.",
        table(
            ("kind", "effect", "needs", "fields"),
            [
                (code(n), first_sentence(o.__doc__), o.needs.words if o.needs else "", fields(o))
                for n, o in OPTIONS.items()
            ],
        ),
        "## Kinds of source\n\nTables `[sources.NAME]` of a study.",
        table(
            ("kind", "description", "tables of the machine", "fields"),
            [
                (code(n), first_sentence(s.__doc__), ", ".join(map(code, s.tables)), fields(s))
                for n, s in SOURCES.items()
            ],
        ),
        "## Criteria\n\nTables of `[scoring.criteria]`; less is better if `best` is below `worst`.",
        table(
            ("name", "description", "unit"),
            [(code(n), one.label, one.unit) for n, one in CRITERIA.items()],
        ),
        "## Figures of designs\n\nObjectives and constraints of `[design]`.",
        table(
            ("name", "description"),
            [(code(n), first_sentence(one.__doc__)) for n, one in FIGURES.items()],
        ),
        "## Sections of the report",
        table(("name", "title"), [(code(n), one.title) for n, one in SECTIONS.items()]),
        "## Columns of the comparison",
        table(("name", "head"), [(code(n), one.head or "") for n, one in COLUMNS.items()]),
        "## Units\n\nSuffix of a key in a file, and its conversion to SI.",
        table(
            ("suffix", "unit", "SI suffix", "factor"),
            [(code(n), u.symbol, code(u.si_suffix), f"{u.factor:.10g}") for n, u in UNITS.items()],
        ),
    ]
    return "\n\n".join(parts) + "\n"


def package_of(kind: type) -> ModuleType:
    """The folder that holds a kind."""
    return sys.modules[kind.__module__.rpartition(".")[0]]


def fields(kind) -> str:
    """Fields of a kind's table, with their allowed range."""
    return "; ".join(
        f"{code(name)}{limits(field)}"
        for name, field in kind.model_fields.items()
        if name != "machine"
    )


def limits(field) -> str:
    """Allowed range and default of a field, in words."""
    words = []
    for limit in field.metadata:
        for name, sign in (("gt", ">"), ("ge", "≥"), ("lt", "<"), ("le", "≤")):
            value = getattr(limit, name, None)
            if value is not None:
                words.append(f"{sign} {value:g}")
    if not field.is_required() and isinstance(field.default, int | float):
        words.append(f"default {field.default:g}")
    return f" ({', '.join(words)})" if words else ""
