"""The page of the claims that headlines of commands state, with their conditions."""

from typing import Final

import typer

from vibroacoustics.commands import cli
from vibroacoustics.results.claim_kinds import KINDS, UNCONDITIONAL
from vibroacoustics.results.conditional import ClaimKind

from .tables import code, table

HEAD: Final = """# Claims and their conditions

A claim holds under conditions. Where one is missing, terminal, page, CSV and JSON say the same:

- **no value**: the value is withdrawn, `no grade without 10 or 20 microphones`
- **at least**, **at most**: the value is a bound; **about** with errors of both signs
- **remark**: the value has the reason behind it
- **lower value**: the value is computed as a lower one

The section *Claims and their conditions* of a page, `NAME_conditions.csv` and `--json` list each
condition with its finding. A recording's netCDF has them as attribute `conditional_claims`.
"""


def page() -> str:
    """Markdown of the page: every condition of every kind, then commands without one."""
    commands = typer.main.get_command(cli.app).commands
    rows = [
        (_commands(kind), kind.name, each.name, each.needed, each.effect, kind.source)
        for kind in KINDS
        for each in kind.conditions
    ]
    others = [(code(name), UNCONDITIONAL[name]) for name in commands if name in UNCONDITIONAL]
    parts = [
        HEAD,
        table(("commands", "claim", "condition", "needs", "without it", "source"), rows),
        "## Commands without conditions",
        table(("command", "what it prints"), others),
    ]
    return "\n\n".join(parts) + "\n"


def _commands(kind: ClaimKind) -> str:
    return ", ".join(map(code, kind.commands))
