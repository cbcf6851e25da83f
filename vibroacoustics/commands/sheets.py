"""The files of a data sheet."""

from pathlib import Path
from typing import TYPE_CHECKING

from .. import report
from .outputs import write_analysis

if TYPE_CHECKING:
    from ..results.data_sheet import DataSheet


def write_data_sheet(sheet: "DataSheet", folder: str | Path) -> Path:
    """Write page, CSV and JSON of a data sheet, together or not at all.

    Option and speed stand in their names: sheets of several fit one folder.

    Parameters
    ----------
    sheet : of `data_sheet`
    folder : made where it is missing

    Returns
    -------
    path of the page

    Raises
    ------
    StorageError
        The folder cannot be written; what was there before then stays.

    Examples
    --------
    >>> sheet = va.data_sheet(va.open_results("results.nc"), "none")
    >>> va.write_data_sheet(sheet, "sheets").name
    'data_sheet_none_2900_rpm.html'
    """
    return write_analysis(report.analysis_of_data_sheet(sheet), None, folder)["report"]
