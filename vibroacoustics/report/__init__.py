"""The report: what a finished run says, as HTML, CSV, Markdown, plain text and figures."""

import xarray as xr

from .comparison import comparison_csv, comparison_text
from .figures import (
    force_figures,
    level_figures,
    line_map_figures,
    mount_figures,
    order_figures,
    score_figures,
    source_figures,
    transfer_figures,
)
from .figures.compared_orders import compared_order_figures
from .figures.recorded_orders import recorded_order_figures
from .figures.stopping import stopping_figures
from .html import html
from .markdown import comparison_markdown
from .order_tables import (
    comparison_of_orders_csv,
    comparison_of_orders_text,
    levels_csv,
    orders_csv,
    orders_text,
)
from .radiation_figures import radiation_figures
from .radiation_tables import radiation_text
from .scores import scores_csv
from .source_tables import sources_csv
from .study import has_inner_sources

__all__ = [
    "compared_order_figures",
    "comparison_of_orders_csv",
    "comparison_of_orders_text",
    "comparison_text",
    "levels_csv",
    "orders_csv",
    "orders_text",
    "radiation_figures",
    "radiation_text",
    "recorded_order_figures",
    "render",
]

_FIGURES = (
    order_figures,
    source_figures,
    force_figures,
    mount_figures,
    transfer_figures,
    level_figures,
    line_map_figures,
    stopping_figures,
    score_figures,
)


def render(results: xr.Dataset) -> dict[str, bytes]:
    """All files of the report, by name; `/` in a name stands for a folder.

    Parameters
    ----------
    results : dataset of a finished run, its attributes included
    """
    pictures = [picture for make in _FIGURES for picture in make(results)]
    return {
        "report.html": html(results, pictures),
        "comparison.csv": comparison_csv(results),
        "comparison.md": comparison_markdown(results),
        "scores.csv": scores_csv(results),
        **({"sources.csv": sources_csv(results)} if has_inner_sources(results) else {}),
        **{f"figures/{picture.name}.png": picture.png for picture in pictures},
    }
