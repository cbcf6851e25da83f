"""Analysis of a study: the report of a run."""

import xarray as xr

from ..base.fault import collected
from ..base.linear_algebra import one_thread_of_linear_algebra
from ..base.processes import side_by_side
from ..results.over_speed.avoid import avoided
from ..results.stored_study import parameters
from ..results.titles import titled
from .analysis import Analysis
from .avoid import avoid_data
from .blocks import Part, Text
from .columns import COLUMNS
from .kept_columns import columns_of
from .kept_sections import sections_of
from .kwave_words import kwave_line
from .left_out import with_lines
from .sections import SECTIONS
from .sections.comparison import terminal_blocks
from .sections.example import example_words
from .sections.verdict.words import sentences
from .shown_speeds import over_speed
from .tables import DataTable


def analysis_of_study(results: xr.Dataset) -> Analysis:
    """Return the analysis of a finished run."""
    with one_thread_of_linear_algebra():  # small products, which threads slow down
        return _analysis(results)


def _analysis(results: xr.Dataset) -> Analysis:
    named = titled(results)
    with collected() as lines:
        sections = sections_of(named)
        columns_of(named)
    named = with_lines(named, lines, (SECTIONS, COLUMNS))

    def blocks_of(number: int) -> Part:
        section = sections[number]
        return Part(section.name, section.title, tuple(section.blocks(named)), section.folded)

    of_study, notes = parameters(named), (kwave_line(results), example_words(results))
    return Analysis(
        "report",
        about="What each way of balancing does to the forces, to the feet and to the sound.",
        parts=tuple(side_by_side(blocks_of, range(len(sections)))),
        summary=sentences(named),
        shown=(*terminal_blocks(named), *map(Text, filter(None, notes))),
        tables=_tables(results),
        figures="figures/",
        in_markdown="comparison.md",
        title=of_study["title"],
        kind=of_study["machine"]["name"],
        created=named.attrs["created_utc"],
    )


def _tables(results: xr.Dataset) -> dict[str, DataTable]:
    """Return the tables that sections write beside the page, by the name of their file."""
    tables = [section.tables(results) for section in sections_of(results)]
    filled = {name: table for each in tables for name, table in each.items() if any(table.values())}
    return filled | ({"speeds.csv": avoid_data(avoided(results))} if over_speed(results) else {})
