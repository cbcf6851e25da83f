"""Files of a report, and what results keep so that it can be made again without plug-ins."""

import json

import xarray as xr

from ..base.fault import collected
from ..base.folder import Content
from ..base.plain_bytes import canonical_json
from ..base.registry import plugins
from .columns import COLUMNS
from .kept_columns import keep_columns
from .kept_columns import kept as kept_columns
from .kept_sections import keep_sections
from .kept_sections import kept as kept_sections
from .left_out import with_lines
from .sections import SECTIONS
from .study import analysis_of_study


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
