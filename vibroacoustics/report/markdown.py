"""The comparison as Markdown."""

import xarray as xr

from ..base.rounding import FORCE_FLOOR, LEVEL_FLOOR_DB, fixed
from . import source_tables, verdict
from .comparison import comparison_tables
from .study import catalogue_receiver, has_inner_sources, other_receivers, parameters
from .tables import escape_markdown, to_markdown


def comparison_markdown(results: xr.Dataset) -> bytes:
    """Verdict and tables, the catalogue's microphone first."""
    receivers = [catalogue_receiver(results), *other_receivers(results)]
    tables = [table for name in receivers for table in comparison_tables(results, name)]
    if has_inner_sources(results):
        inside = (source_tables.source_tables(results), source_tables.change_tables(results))
        tables = [*inside[0], *inside[1], *tables]
    parts = [
        f"# {escape_markdown(parameters(results)['title'])}",
        escape_markdown(verdict.headline(results)),
        "\n".join(f"- {escape_markdown(text)}" for text in verdict.reasons(results)),
        _legend(),
        *(to_markdown(table) for table in tables),
    ]
    return ("\n\n".join(parts) + "\n").encode()


def _legend() -> str:
    return escape_markdown(
        "1×, 2×: once and twice per shaft revolution. Forces (N) and moments (N m) are semi-major "
        "axes, peak, about the centre of mass; the foot force is the largest over the feet; below "
        f"{1e6 * FORCE_FLOOR:g} µN they are shown as 0. Levels are in dB re 20 µPa; below "
        f"{fixed(LEVEL_FLOOR_DB, 0)} dB they are silent. Δ is the change against none; – stands "
        "where the line without a balancer is silent."
    )
