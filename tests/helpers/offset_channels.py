"""Two channels of one sine whose starts differ, in every format that states a start."""

from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import scipy.io
import xarray as xr
from nptdms import ChannelObject, TdmsWriter

RATE_HZ = 2048.0
FREQUENCY_HZ = 50.0
SAMPLES = 1024
EPOCH = np.datetime64("2026-11-28T10:00:00", "us")


def sine(start_s: float, samples: int = SAMPLES, rate_hz: float = RATE_HZ) -> np.ndarray:
    """Sine from a time on, shape (time,)."""
    return np.sin(2.0 * np.pi * FREQUENCY_HZ * (start_s + np.arange(samples) / rate_hz))


def dataset_58(name: str, values: np.ndarray, start: float, unit: str = "s", kind: int = 17) -> str:
    """A dataset 58 of double precision with the minimum of its abscissa."""
    scale = {"ms": 1e3}.get(unit, 1.0)
    records = [
        "    -1", "    58", name, "NONE", "NONE", "NONE", "NONE",
        f"{1:5d}{1:10d}{1:5d}{0:10d} {'NONE':10}{1:10d}{3:4d} {'NONE':10}{0:10d}{0:4d}",
        f"{4:10d}{values.size:10d}{1:10d}{scale * start:13.5e}{scale / RATE_HZ:13.5e}{0.0:13.5e}",
        f"{kind:10d}{0:5d}{0:5d}{0:5d} {'NONE':20} {unit:20}",
        f"{15:10d}{0:5d}{0:5d}{0:5d} {'NONE':20} {'Pa':20}",
        f"{0:10d}{0:5d}{0:5d}{0:5d} {'NONE':20} {'NONE':20}",
        f"{0:10d}{0:5d}{0:5d}{0:5d} {'NONE':20} {'NONE':20}",
    ]  # fmt: skip
    texts = [f"{value:20.12e}" for value in values]
    lines = ["".join(texts[n : n + 4]) for n in range(0, len(texts), 4)]
    return "\n".join([*records, *lines, "    -1"]) + "\n"


def uff(path: Path, offset_s: float) -> Path:
    path = path / "a.uff"
    path.write_text(dataset_58("a", sine(0.0), 0.0) + dataset_58("b", sine(offset_s), offset_s))
    return path


def uff_ms(path: Path, offset_s: float) -> Path:
    path = path / "ms.uff"
    parts = [dataset_58("a", sine(0.0), 0.0, "ms"), dataset_58("b", sine(offset_s), offset_s, "ms")]
    path.write_text("".join(parts))
    return path


def tdms(path: Path, offset_s: float, start: str = "offset") -> Path:
    """Channels with `wf_start_offset`, or with a `wf_start_time` to the microsecond."""
    path = path / "a.tdms"
    common = {"wf_increment": 1.0 / RATE_HZ, "unit_string": "Pa", "wf_start_time": EPOCH}
    other = common | {"wf_start_offset": offset_s}
    if start == "time":
        other = common | {"wf_start_time": EPOCH + np.timedelta64(round(1e6 * offset_s), "us")}
    with TdmsWriter(str(path)) as writer:
        a = ChannelObject("g", "a", sine(0.0), properties=common)
        b = ChannelObject("g", "b", sine(offset_s), properties=other)
        writer.write_segment([a, b])
    return path


def tdms_time(path: Path, offset_s: float) -> Path:
    return tdms(path, offset_s, "time")


def mf4(path: Path, offset_s: float) -> Path:
    from asammdf import MDF, Signal

    times = np.arange(SAMPLES) / RATE_HZ
    with MDF(version="4.10") as file:
        file.append([Signal(sine(0.0), times, name="a", unit="Pa")])
        file.append([Signal(sine(offset_s), times + offset_s, name="b", unit="Pa")])
        file.save(path / "a.mf4", overwrite=True)
    return path / "a.mf4"


def testlab(path: Path, offset_s: float) -> Path:
    structs = {
        f"Signal_{number}": {
            "x_values": {
                "start_value": start, "increment": 1.0 / RATE_HZ, "quantity": {"label": "s"},
            },
            "y_values": {"values": sine(start)[:, None], "quantity": {"label": "Pa"}},
            "function_record": {"name": name},
        }
        for number, (name, start) in enumerate([("a", 0.0), ("b", offset_s)])
    }  # fmt: skip
    scipy.io.savemat(path / "testlab.mat", structs)
    return path / "testlab.mat"


def lvm(path: Path, offset_s: float) -> Path:
    """Channels with an `X0` each."""
    head = f"""LabVIEW Measurement\t
Writer_Version\t2
Separator\tTab
Decimal_Separator\t.
Multi_Headings\tYes
X_Columns\tNo
***End_of_Header***\t
\t
Channels\t2\t\t
Samples\t{SAMPLES}\t{SAMPLES}\t
Y_Unit_Label\tPa\tPa\t
X_Dimension\tTime\tTime\t
X0\t0.0\t{offset_s:.12f}\t
Delta_X\t{1 / RATE_HZ:.12f}\t{1 / RATE_HZ:.12f}\t
***End_of_Header***\t\t\t
X_Value\ta\tb\tComment
"""
    rows = [f"\t{x:.9f}\t{y:.9f}\n" for x, y in zip(sine(0.0), sine(offset_s), strict=True)]
    (path / "a.lvm").write_text(head + "".join(rows))
    return path / "a.lvm"


def mat_structs(path: Path, offset_s: float) -> Path:
    times = np.arange(SAMPLES) / RATE_HZ
    run = {"a": {"y": sine(0.0), "t": times}, "b": {"y": sine(offset_s), "t": times + offset_s}}
    scipy.io.savemat(path / "structs.mat", run)
    return path / "structs.mat"


def mat_names(path: Path, offset_s: float) -> Path:
    """Vectors `a`, `b` with `t_a` and `t_b`."""
    times = np.arange(SAMPLES) / RATE_HZ
    named = {"a": sine(0.0), "b": sine(offset_s), "t_a": times, "t_b": times + offset_s}
    scipy.io.savemat(path / "names.mat", named)
    return path / "names.mat"


def mat_tables(path: Path, offset_s: float) -> Path:
    """Tables with the time in the first column."""
    times = np.arange(SAMPLES) / RATE_HZ
    tables = {"a": np.c_[times, sine(0.0)], "b": np.c_[times + offset_s, sine(offset_s)]}
    scipy.io.savemat(path / "tables.mat", tables)
    return path / "tables.mat"


def hdf5(path: Path, offset_s: float) -> Path:
    """Datasets in groups with a time each."""
    with h5py.File(path / "a.h5", "w") as file:
        for name, start in (("a", 0.0), ("b", offset_s)):
            file[f"{name}/y"] = sine(start)
            file[f"{name}/y"].attrs["units"] = "Pa"
            file[f"{name}/time"] = start + np.arange(SAMPLES) / RATE_HZ
    return path / "a.h5"


def hdf5_attributes(path: Path, offset_s: float) -> Path:
    """Datasets with increment and start offset, as npTDMS writes them to HDF5."""
    with h5py.File(path / "b.h5", "w") as file:
        for name, start in (("a", 0.0), ("b", offset_s)):
            file[name] = sine(start)
            about = {"unit_string": "Pa", "wf_increment": 1 / RATE_HZ, "wf_start_offset": start}
            file[name].attrs.update(about)
    return path / "b.h5"


def netcdf(path: Path, offset_s: float) -> Path:
    """Variables with a time each, of whole nanoseconds since a date."""
    nanoseconds = np.rint(1e9 * np.arange(SAMPLES) / RATE_HZ).astype("timedelta64[ns]")
    later = np.timedelta64(round(1e9 * offset_s), "ns")
    epoch = EPOCH.astype("datetime64[ns]")
    named = {"a": ("time_a", sine(0.0), {"units": "Pa"})}
    named["b"] = ("time_b", sine(offset_s), {"units": "Pa"})
    times = {"time_a": epoch + nanoseconds, "time_b": epoch + later + nanoseconds}
    xr.Dataset(named, coords=times).to_netcdf(path / "a.nc")
    return path / "a.nc"


WRITERS: dict[str, Callable[[Path, float], Path]] = {
    writer.__name__: writer
    for writer in (
        uff, uff_ms, tdms, tdms_time, mf4, testlab, lvm, mat_structs, mat_names, mat_tables, hdf5,
        hdf5_attributes, netcdf,
    )
}  # fmt: skip
