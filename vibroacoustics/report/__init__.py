"""The report: what finished results say, as pages, tables, text and JSON."""

import json

import xarray as xr

from ..base.fault import collected
from ..base.hashing import canonical_json
from ..base.registry import plugins
from .analysis import Analysis
from .campaign import analysis_of_campaign
from .columns import COLUMNS
from .compared.page import analysis_of_comparison
from .curve_tables import analysis_of_curves
from .data_sheet import analysis_of_data_sheet
from .designs.page import analysis_of_designs, analysis_of_no_designs, no_best
from .kept_columns import keep_columns
from .kept_columns import kept as kept_columns
from .kept_sections import keep_sections
from .kept_sections import kept as kept_sections
from .left_out import with_lines
from .limit_tables import broken_lines
from .measured_power import analysis_of_sound_power
from .measurements import analysis_of_blocked_forces, analysis_of_prediction
from .radiation_tables import analysis_of_impulse_responses, analysis_of_radiation
from .recordings import analysis_of_map, analysis_of_orders, analysis_of_tracks
from .replay import analysis_of_replay
from .sections import SECTIONS
from .study import analysis_of_study

__all__ = [
    "Analysis",
    "analysis_of_blocked_forces",
    "analysis_of_campaign",
    "analysis_of_comparison",
    "analysis_of_curves",
    "analysis_of_data_sheet",
    "analysis_of_designs",
    "analysis_of_impulse_responses",
    "analysis_of_map",
    "analysis_of_no_designs",
    "analysis_of_orders",
    "analysis_of_prediction",
    "analysis_of_radiation",
    "analysis_of_replay",
    "analysis_of_sound_power",
    "analysis_of_study",
    "analysis_of_tracks",
    "broken_lines",
    "check_kept",
    "keep",
    "no_best",
    "render",
]


def render(results: xr.Dataset, results_sha256: str = "") -> dict[str, bytes]:
    """All files of the report, by name; `/` in a name stands for a folder.

    The page names the hash of the results' file.
    """
    return analysis_of_study(results).files(results_sha256)


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
