"""Writers of the kinds of files of docs/recordings.md, by other libraries."""

from pathlib import Path

import h5py
import numpy as np
import pandas as pd
import pyuff
import scipy.io
import soundfile
import xarray as xr
from nptdms import ChannelObject, TdmsWriter
from trade_files import RATE_HZ, SIGNALS, simcenter, simcenter_hdf5, xlsx

HALF = 0.1 * SIGNALS
UNITS = ("Pa", "m/s²")
NAMES = ("microphone", "foot")


def sound(subtype: str, scale: float = 1.0):
    """Writer of a sound file by libsndfile."""

    def write(path: Path) -> None:
        soundfile.write(path, scale * HALF.T, int(RATE_HZ), subtype=subtype)

    return write


def scipy_wav(path: Path) -> None:
    scipy.io.wavfile.write(path, int(RATE_HZ), HALF.T.astype(np.float32))


def mat(path: Path) -> None:
    scipy.io.savemat(path, {"microphone": HALF[0], "foot": HALF[1], "fs": RATE_HZ})


def mat_hdf5(path: Path) -> None:
    with h5py.File(path, "w", userblock_size=512) as file:
        for name, values in zip(("microphone", "foot", "fs"), [*HALF, RATE_HZ], strict=True):
            file[name] = np.atleast_2d(values).T
            file[name].attrs["MATLAB_class"] = np.bytes_("double")


def hdf5(path: Path) -> None:
    with h5py.File(path, "w") as file:
        file.attrs["sample_rate_hz"] = RATE_HZ
        for name, values, unit in zip(NAMES, HALF, UNITS, strict=True):
            file[name] = values
            file[name].attrs["units"] = unit


def netcdf(form: str):
    """Writer of netCDF by xarray."""

    def write(path: Path) -> None:
        named = zip(NAMES, HALF, UNITS, strict=True)
        variables = {name: ("time", x, {"units": unit}) for name, x, unit in named}
        dataset = xr.Dataset(variables, attrs={"fs": RATE_HZ})
        dataset.to_netcdf(path, format=form, engine="netcdf4")

    return write


def universal(binary: int):
    """Writer of dataset 58 by pyuff."""

    def write(path: Path) -> None:
        sets = [
            pyuff.prepare_58(
                binary=binary, func_type=1, rsp_node=number, rsp_dir=3, ref_node=1, ref_dir=3,
                data=values, x=np.arange(300) / RATE_HZ, id1=name, abscissa_spec_data_type=17,
                ordinate_spec_data_type=kind, ordinate_axis_units_lab=unit, ord_data_type=4,
                orddenom_spec_data_type=0, abscissa_spacing=1, abscissa_min=0.0,
                abscissa_inc=1.0 / RATE_HZ,
            )
            for number, (name, values, unit, kind) in enumerate(
                zip(NAMES, HALF, ("Pa", "m/s^2"), (15, 12), strict=True), 1
            )
        ]  # fmt: skip
        pyuff.UFF(str(path)).write_sets(sets, "add")

    return write


def table(path: Path) -> None:
    """Times and channels by pandas, with its digits."""
    columns = {"time [s]": np.arange(300) / RATE_HZ, "microphone [Pa]": HALF[0],
               "foot [m/s²]": HALF[1]}  # fmt: skip
    pd.DataFrame(columns).to_csv(path, index=False)


def stamped_table(path: Path) -> None:
    """Time stamps of pandas in nanoseconds."""
    times = pd.Timestamp("2026-02-19 09:51:39") + pd.to_timedelta(np.arange(300) / RATE_HZ, "s")
    columns = {"microphone [Pa]": HALF[0], "foot [m/s²]": HALF[1]}
    pd.DataFrame(columns, index=pd.Index(times, name="time")).to_csv(path)


def tdms(path: Path) -> None:
    with TdmsWriter(str(path)) as writer:
        named = zip(NAMES, HALF, UNITS, strict=True)
        writer.write_segment([
            ChannelObject("run", name, x, {"wf_increment": 1.0 / RATE_HZ, "unit_string": unit})
            for name, x, unit in named
        ])  # fmt: skip


ALL_PASCAL = {"units": {"*": "Pa"}}
FULL_SCALE = {**ALL_PASCAL, "calibration": {"*": 1.0}}
KINDS = {
    "float.wav": (scipy_wav, ALL_PASCAL, 1e-7),
    "pcm.wav": (sound("PCM_24"), FULL_SCALE, 2e-7),
    "packed.wav": (sound("ALAW"), FULL_SCALE, 0.04),
    "a.flac": (sound("PCM_24"), FULL_SCALE, 2e-7),
    "a.w64": (sound("PCM_32"), FULL_SCALE, 1e-9),
    "a.mat": (mat, ALL_PASCAL, 0.0),
    "seven.mat": (mat_hdf5, ALL_PASCAL, 0.0),
    "a.h5": (hdf5, {}, 0.0),
    "a.nc": (netcdf("NETCDF4"), {}, 0.0),
    "classic.nc": (netcdf("NETCDF3_64BIT"), {}, 0.0),
    "a.uff": (universal(0), {}, 1e-5),
    "binary.uff": (universal(1), {}, 1e-7),
    "a.tdms": (tdms, {}, 0.0),
    "times.csv": (table, {}, 1e-15),
    "stamps.csv": (stamped_table, {}, 1e-15),
}
"""Writer, options and tolerance by the name of a file."""
RESCALED = {"a.xlsx": xlsx, "testlab.mat": simcenter, "testlab_seven.mat": simcenter_hdf5}
"""Writers of the samples in full; all of their files need no option."""
