"""The files of a data sheet."""

from pathlib import Path
from typing import TYPE_CHECKING, Final

from .. import report
from ..results.files import write_together

if TYPE_CHECKING:
    from ..results.data_sheet import DataSheet

SHEET_NAME: Final = "data_sheet"


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
    name = f"{SHEET_NAME}_{report.file_name(f'{sheet.option}_{sheet.speed_rpm:g}_rpm')}"
    files = {
        f"{name}.html": report.data_sheet_html(sheet),
        f"{name}.csv": report.data_sheet_csv(sheet),
        f"{name}.json": report.data_sheet_json(sheet),
    }
    write_together(Path(folder), files)
    return Path(folder) / f"{name}.html"
