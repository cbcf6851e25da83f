"""The report: what a finished run says, as HTML, CSV, Markdown, plain text and figures."""

import json

import xarray as xr

from ..base.fault import collected
from ..base.hashing import canonical_json
from ..base.linear_algebra import one_thread_of_linear_algebra
from ..base.registry import plugins
from ..results.over_speed.avoid import avoided
from ..results.stored_study import has_sources
from .avoid import avoid_csv
from .blocked_forces import (
    blocked_csv,
    blocked_markdown,
    blocked_text,
    validation_csv,
)
from .columns import COLUMNS
from .compared.limits import broken_lines, figure_limits_csv
from .compared.order_rows import comparison_of_orders_csv, comparison_of_orders_text
from .compared.page import comparison_html
from .curve_tables import curve_csv
from .data_sheet import data_sheet_csv, data_sheet_html, data_sheet_json
from .data_sheet import headline as data_sheet_headline
from .designs.best import no_best
from .designs.page import designs_json, designs_text, render_designs
from .figures.blocked_forces import blocked_charts
from .figures.compared_orders import compared_order_charts
from .figures.curves import curve_charts
from .figures.prediction import predicted_charts
from .figures.recorded_orders import (
    recorded_order_charts,
    speed_map_charts,
    tracked_order_charts,
)
from .file_names import file_name
from .html import html
from .kept_columns import keep_columns
from .kept_columns import kept as kept_columns
from .kept_sections import keep_sections
from .kept_sections import kept as kept_sections
from .left_out import with_lines
from .limit_tables import limits_csv, limits_text
from .markdown import markdown
from .measured_power import measured_power_csv, measured_power_html, measured_power_text
from .order_tables import (
    levels_csv,
    orders_csv,
    orders_text,
    tracked_csv,
    tracked_text,
)
from .page import page_of
from .prediction import prediction_csv, prediction_markdown, prediction_text
from .radiation_tables import kwave_text, radiation_figures, radiation_text
from .recording_pages import orders_html, speed_map_html
from .sections import SECTIONS
from .sections.comparison.tables import comparison_csv, comparison_text
from .sections.paths.tables import has_paths, paths_csv
from .sections.scores.tables import scores_csv
from .sections.sources.tables import sources_csv
from .shown_speeds import over_speed
from .side_tables import side_files

__all__ = [
    "blocked_charts",
    "blocked_csv",
    "blocked_markdown",
    "blocked_text",
    "broken_lines",
    "check_kept",
    "compared_order_charts",
    "comparison_html",
    "comparison_of_orders_csv",
    "comparison_of_orders_text",
    "comparison_text",
    "curve_charts",
    "curve_csv",
    "data_sheet_csv",
    "data_sheet_headline",
    "data_sheet_html",
    "data_sheet_json",
    "designs_json",
    "designs_text",
    "figure_limits_csv",
    "file_name",
    "keep",
    "kwave_text",
    "levels_csv",
    "limits_csv",
    "limits_text",
    "measured_power_csv",
    "measured_power_html",
    "measured_power_text",
    "no_best",
    "orders_csv",
    "orders_html",
    "orders_text",
    "predicted_charts",
    "prediction_csv",
    "prediction_markdown",
    "prediction_text",
    "radiation_figures",
    "radiation_text",
    "recorded_order_charts",
    "render",
    "render_designs",
    "speed_map_charts",
    "speed_map_html",
    "tracked_csv",
    "tracked_order_charts",
    "tracked_text",
    "validation_csv",
]


def render(results: xr.Dataset, results_sha256: str = "") -> dict[str, bytes]:
    """All files of the report, by name; `/` in a name stands for a folder.

    Parameters
    ----------
    results : dataset of a finished run, its attributes included
    results_sha256 : hash of its file, which the page then names
    """
    with one_thread_of_linear_algebra():  # small products, which threads slow down
        return _rendered(results, results_sha256)


def _rendered(results: xr.Dataset, results_sha256: str) -> dict[str, bytes]:
    page = page_of(results)
    return {
        "report.html": html(page, results_sha256),
        "comparison.csv": comparison_csv(results),
        "comparison.md": markdown(page),
        "scores.csv": scores_csv(results),
        **({"sources.csv": sources_csv(results)} if has_sources(results) else {}),
        **({"paths.csv": paths_csv(results)} if has_paths(results) else {}),
        **({"speeds.csv": avoid_csv(avoided(results))} if over_speed(results) else {}),
        **side_files(results),
        **{file: picture.content for file, picture in page.pictures().items()},
    }


def keep(results: xr.Dataset) -> xr.Dataset:
    """The results with what strangers' sections and columns show, and where these come from.

    The report can then be made again without them.
    """
    with collected() as lines:
        kept = keep_sections(keep_columns(results))
    kept = with_lines(kept, lines, (SECTIONS, COLUMNS))
    known = json.loads(kept.attrs.get("plugins") or "{}")
    return kept.assign_attrs(plugins=canonical_json({**known, **plugins()}))


def check_kept(results: xr.Dataset) -> None:
    """Refuse results whose kept sections or columns are none.

    Raises
    ------
    SchemaError
        Names the attribute.
    """
    kept_sections(results)
    kept_columns(results)
