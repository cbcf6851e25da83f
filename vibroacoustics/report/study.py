"""Analysis and files of a study's report, and what makes it again without plug-ins."""

import json

import xarray as xr

from ..base.fault import collected
from ..base.folder import Content
from ..base.linear_algebra import one_thread_of_linear_algebra
from ..base.plain_bytes import canonical_json
from ..base.processes import side_by_side
from ..base.registry import plugins
from ..results.over_speed.avoid import avoided
from ..results.stored_study import parameters
from ..results.titles import titled
from .analysis import Analysis
from .avoid import avoid_data
from .blocks import Part, Text
from .columns import COLUMNS
from .conditions import study_claims
from .kept_columns import columns_of, keep_columns
from .kept_columns import kept as kept_columns
from .kept_sections import keep_sections, sections_of
from .kept_sections import kept as kept_sections
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
        claims=study_claims(named),
    )


def _tables(results: xr.Dataset) -> dict[str, DataTable]:
    """Return the tables that sections write beside the page, by the name of their file."""
    tables = [section.tables(results) for section in sections_of(results)]
    filled = {name: table for each in tables for name, table in each.items() if any(table.values())}
    return filled | ({"speeds.csv": avoid_data(avoided(results))} if over_speed(results) else {})


def render(results: xr.Dataset, results_sha256: str = "") -> dict[str, Content]:
    """All files of the report, by name; `/` in a name stands for a folder.

    The page names the hash of the results' file.
    """
    return analysis_of_study(results).files(results_sha256)


def keep(results: xr.Dataset) -> xr.Dataset:
    """The results with what sections and columns of plug-ins show, and where these come from.

    The report can then be made again without them.
    """
    with collected() as lines:
        kept = keep_sections(keep_columns(results))
    kept = with_lines(kept, lines, (SECTIONS, COLUMNS))
    stated = json.loads(kept.attrs.get("plugins") or "{}")
    return kept.assign_attrs(plugins=canonical_json({**stated, **plugins()}))


def check_kept(results: xr.Dataset) -> None:
    """Refuse results whose kept sections or columns are none.

    Raises
    ------
    SchemaError
        Names the attribute.
    """
    kept_sections(results)
    kept_columns(results)
