"""Recordings as programs of the trade write them; by their own libraries where those exist."""

from datetime import datetime, timedelta
from pathlib import Path

import h5py
import numpy as np
import openpyxl
import scipy.io

RATE_HZ = 1024.0
INTERVAL_S = 1.0 / RATE_HZ
SIGNALS = np.random.default_rng(11).standard_normal((2, 300))
"""Two channels, in Pa and m/s²."""

FILE_HEADER = """LabVIEW Measurement\t
Writer_Version\t2
Reader_Version\t2
Separator\tTab
Decimal_Separator\t{decimal}
Multi_Headings\tYes
X_Columns\t{columns}
Time_Pref\tRelative
Date\t2026/02/19
Time\t09:51:39{decimal}1970510
***End_of_Header***\t
\t
"""
SEGMENT_HEADER = """Channels\t2\t\t
Samples\t{samples}\t{samples}\t
Date\t2026/02/19\t2026/02/19\t
Time\t09:51:40{decimal}5\t09:51:40{decimal}5\t
Y_Unit_Label\tPa\tm/s^2\t
X_Dimension\t{axis}\t{axis}\t
X0\t{start}\t{start}\t
Delta_X\t{interval}\t{interval}\t
***End_of_Header***\t\t\t
X_Value\tmicrophone\tfoot\tComment
"""


def lvm(
    path: Path,
    decimal: str = ".",
    columns: str = "No",
    segments: int = 1,
    gap_s: float = 0.0,
    axis: str = "Time",
) -> Path:
    """Write a LabVIEW measurement file in the layout of data/recordings/labview_force.lvm."""
    content = FILE_HEADER.format(decimal=decimal, columns=columns)
    for number, part in enumerate(np.split(SIGNALS, segments, axis=1)):
        samples = part.shape[1]
        start = number * (samples * INTERVAL_S + gap_s)
        content += SEGMENT_HEADER.format(
            samples=samples,
            axis=axis,
            start=f"{start:.9f}",
            interval=f"{INTERVAL_S:.10f}",
            decimal=".",
        ).replace(".", decimal)
        for row, values in enumerate(part.T):
            time = "" if columns == "No" else f"{start + row * INTERVAL_S:.9f}"
            content += f"{time}\t{values[0]:.6f}\t{values[1]:.6f}\n".replace(".", decimal)
        content += "\n" if segments > 1 else ""
    path.write_text(content)
    return path


def xlsx(path: Path, time: str = "time [s]", above: tuple[tuple[object, ...], ...] = ()) -> Path:
    """Write a spreadsheet by openpyxl: a sheet of notes, then the table."""
    book = openpyxl.Workbook()
    book.active.title = "notes"
    book.active.append(["Measured by", "laboratory"])
    sheet = book.create_sheet("run")
    for row in above:
        sheet.append(row)
    sheet.append([*([time] if time else []), "microphone [Pa]", "foot [m/s²]"])
    for number, values in enumerate(SIGNALS.T.tolist()):
        sheet.append([*_times(time, number), *values])
    book.save(path)
    return path


def _times(time: str, number: int) -> list[object]:
    if not time:
        return []
    if time == "stamp":
        return [datetime(2026, 2, 19, 10) + timedelta(milliseconds=10 * number)]
    return [number * INTERVAL_S]


def simcenter_structs() -> dict[str, object]:
    """Two signals in the structs that Testlab exports: a microphone, and an accelerometer in g."""
    return {
        f"Signal_{number}": {
            "x_values": {
                "start_value": 0.0,
                "increment": INTERVAL_S,
                "number_of_values": 300.0,
                "quantity": {"label": "s"},
            },
            "y_values": {
                "values": SIGNALS[number][:, None],
                "quantity": {
                    "label": unit,
                    "unit_transformation": {"factor": factor, "offset": 0.0, "log_reference": 1.0},
                },
            },
            "function_record": {"name": name, "type": "Time"},
        }
        for number, (name, unit, factor) in enumerate(
            [("Mic:1:S", "Pa", 1.0), ("Foot:+Z", "g", 1.0 / 9.80665)]
        )
    }


def simcenter(path: Path, **options: bool) -> Path:
    """Write these structs by SciPy, as a MAT file 5."""
    scipy.io.savemat(path, simcenter_structs(), **options)
    return path


def simcenter_hdf5(path: Path) -> Path:
    """Write these structs as MATLAB stores them in a file 7.3."""
    with h5py.File(path, "w", userblock_size=512) as file:
        for name, struct in simcenter_structs().items():
            _group(file.create_group(name), struct)
    return path


def _group(group: h5py.Group, struct: object) -> None:
    for key, value in dict(struct).items():
        if isinstance(value, dict):
            _group(group.create_group(key), value)
        elif isinstance(value, str):
            group[key] = np.array([[ord(character)] for character in value], dtype=np.uint16)
            group[key].attrs["MATLAB_class"] = np.bytes_("char")
        else:
            group[key] = np.atleast_2d(value).T
            group[key].attrs["MATLAB_class"] = np.bytes_("double")


def mf4(path: Path, version: str = "4.10", compression: int = 0, is_slow: bool = True) -> Path:
    """Write a measurement data file by asammdf: two signals, and a slow one in another group."""
    from asammdf import MDF, Signal

    times = np.arange(300) * INTERVAL_S
    with MDF(version=version) as file:
        named = zip(SIGNALS, ("microphone", "foot"), ("Pa", "m/s²"), strict=True)
        file.append([Signal(x, times, name=name, unit=unit) for x, name, unit in named])
        slow = Signal(np.linspace(600.0, 900.0, 30), times[::10], name="speed", unit="rpm")
        if is_slow:
            file.append([slow])
        file.save(path, overwrite=True, compression=compression)
    return path
