"""Files both ways with other programs: cells of the table on the page `peers`.

python tests/helpers/peers.py   # write docs/peers.csv
"""

import csv
import re
import tempfile
import warnings
from collections.abc import Callable, Iterator
from importlib.metadata import version
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
TABLE = ROOT / "docs" / "peers.csv"
PACKAGES = (
    "asammdf", "h5netcdf", "h5py", "netCDF4", "nptdms", "numpy", "openpyxl", "pandas", "pyuff",
    "scipy", "soundfile", "xarray",
)  # fmt: skip
RATE_HZ = 1024.0
TIME_S = np.arange(300) / RATE_HZ
SIGNALS = 0.1 * np.random.default_rng(11).standard_normal((2, 300))
NAMES, UNITS = ["microphone", "foot"], ["Pa", "m/s²"]
START = "2026-11-28T10:00:00"


class Cell(NamedTuple):
    """A file from one program to another.

    Attributes
    ----------
    writer, reader : programs
    content : what is in the file
    check : function that writes it in a folder, reads it, and gives what is wrong; empty if right
    """

    writer: str
    reader: str
    content: str
    check: Callable[[Path], str]

    def outcome(self) -> str:
        """What came of it: right, refused in words, or what is wrong."""
        from vibroacoustics.base.errors import VibroacousticsError

        with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                return self.check(Path(folder)) or "right"
            except VibroacousticsError as error:
                words = re.sub(r"^\S*/", "", str(error))
                return f"refused: {words.partition(': ')[2]}"[:110].replace("|", "/")


OURS = "vibroacoustics"


def differs(name: str, given: Any, right: Any, atol: float = 0.0) -> str:
    """Words on an array or text that is not the right one; empty where it is."""
    if isinstance(right, str | list):
        return "" if given == right else f"{name} {given!r} for {right!r}"
    given, right = np.asarray(given), np.asarray(right)
    if given.shape != right.shape:
        return f"{name} of shape {given.shape} for {right.shape}"
    return "" if np.allclose(given, right, rtol=0.0, atol=atol) else f"{name} differ"


def first(*words: str) -> str:
    """The first words that are not empty."""
    return next(filter(None, words), "")


def by_us(
    path: Path, atol: float = 0.0, *, names: list[str] = NAMES, start: str = "",
    signals: Any = SIGNALS, rate_hz: float = RATE_HZ, units: dict[str, str] | None = None,
    calibration: dict[str, float] | None = None, rate_digits: float = 1e-6,
) -> str:  # fmt: skip
    """Read a file by this package and compare it."""
    from vibroacoustics.recordings import read_recording

    read = read_recording(path, units=units, calibration=calibration)
    if sorted(read["channel"].values.tolist()) != sorted(names):
        return differs("names", read["channel"].values.tolist(), names)
    read = read.sel(channel=names)
    return first(
        differs("values", read["signal"].values, signals, atol),
        differs("units", read["channel_unit"].values.tolist(), UNITS[: len(signals)]),
        differs("rate", read.attrs["sample_rate_hz"], rate_hz, rate_digits * rate_hz),
        differs("start", read.attrs.get("start_time", "")[: len(start)], start),
    )


WAV = {"channel 1": "Pa", "channel 2": "m/s²"}
CHANNELS = ["channel 1", "channel 2"]


def wav_cells() -> Iterator[Cell]:
    from scipy.io import wavfile

    kinds = {"uint8": 2.0**-7, "int16": 2.0**-15, "int32": 2.0**-31, "float32": 1e-7, "float64": 0}

    def by_scipy(folder: Path, kind: str, step: float) -> str:
        values = SIGNALS.T
        if kind.startswith("float"):
            wavfile.write(folder / "a.wav", 1024, values.astype(kind))
            return by_us(folder / "a.wav", step, names=CHANNELS, units=WAV)
        whole = np.rint(values / step).astype(int) + (128 if kind == "uint8" else 0)
        wavfile.write(folder / "a.wav", 1024, whole.astype(kind))
        scale = {"*": 1.0}
        return by_us(folder / "a.wav", step, names=CHANNELS, units=WAV, calibration=scale)

    for kind, step in kinds.items():
        yield Cell("scipy", OURS, f"WAV of {kind}", lambda f, k=kind, s=step: by_scipy(f, k, s))

    def by_soundfile(folder: Path, suffix: str, subtype: str, form: str | None) -> str:
        import soundfile

        soundfile.write(folder / f"a.{suffix}", SIGNALS.T, 1024, subtype=subtype, format=form)
        bits = {"PCM_16": 2.0**-15, "PCM_24": 2.0**-23, "PCM_32": 2.0**-31, "FLOAT": 1e-7}
        scale = None if subtype in ("FLOAT", "DOUBLE") else {"*": 1.0}
        step = bits.get(subtype, 0.02 if subtype == "ULAW" else 0.0)
        path = folder / f"a.{suffix}"
        return by_us(path, step, names=CHANNELS, units=WAV, calibration=scale)

    for suffix, subtype, form in (
        ("wav", "PCM_16", None), ("wav", "PCM_24", None), ("wav", "PCM_32", None),
        ("wav", "FLOAT", None), ("wav", "DOUBLE", None), ("wav", "ULAW", None),
        ("wav", "PCM_24", "RF64"), ("wav", "PCM_24", "WAVEX"), ("flac", "PCM_16", None),
        ("flac", "PCM_24", None), ("w64", "PCM_24", None), ("w64", "DOUBLE", None),
    ):  # fmt: skip
        words = f"{form or suffix.upper()} of {subtype}"
        yield Cell(
            "soundfile",
            OURS,
            words,
            lambda f, a=suffix, b=subtype, c=form: by_soundfile(f, a, b, c),
        )

    def exported(folder: Path, suffix: str, scale: float = 1.0) -> Path:
        return export(folder, suffix, scale)

    def read_by_scipy(folder: Path, scale: float) -> str:
        rate_hz, values = wavfile.read(exported(folder, "wav", scale))
        return first(differs("values", values.T, scale * SIGNALS), differs("rate", rate_hz, 1024))

    def read_by_soundfile(folder: Path, scale: float) -> str:
        import soundfile

        with soundfile.SoundFile(exported(folder, "wav", scale)) as file:
            values, rate_hz, comment = file.read(), file.samplerate, file.comment
        unit = "" if "Pa, 1.0 m/s²" in comment else f"comment {comment!r}"
        return first(
            differs("values", values.T, scale * SIGNALS), differs("rate", rate_hz, 1024), unit
        )

    for words, scale in (("WAV of 64 bits", 1.0), ("WAV above full scale", 50.0)):
        yield Cell(OURS, "scipy", words, lambda f, s=scale: read_by_scipy(f, s))
        yield Cell(OURS, "soundfile", words, lambda f, s=scale: read_by_soundfile(f, s))


def recording(scale: float = 1.0) -> Any:
    import vibroacoustics as va

    return va.label_recording(scale * SIGNALS, RATE_HZ, NAMES, UNITS)


def export(folder: Path, suffix: str, scale: float = 1.0) -> Path:
    import vibroacoustics as va

    return Path(va.export_recording(recording(scale), folder / f"a.{suffix}"))


def table_cells() -> Iterator[Cell]:
    def csv_by_numpy(folder: Path) -> str:
        table = np.genfromtxt(export(folder, "csv"), delimiter=",", names=True)
        values = [table[name] for name in table.dtype.names]
        names = list(table.dtype.names)
        lines = first(differs("values", values[1:], SIGNALS), differs("time", values[0], TIME_S))
        return first(lines, differs("names", names, ["time_s", "microphone_Pa", "foot_ms²"]))

    def csv_by_pandas(folder: Path) -> str:
        import pandas as pd

        table = pd.read_csv(export(folder, "csv"))
        names = ["time [s]", "microphone [Pa]", "foot [m/s²]"]
        return first(
            differs("values", table.values.T[1:], SIGNALS, 1e-16),
            differs("names", list(table.columns), names),
        )

    def csv_of_pandas(folder: Path) -> str:
        import pandas as pd

        columns = {"time [s]": TIME_S, "microphone [Pa]": SIGNALS[0], "foot [m/s²]": SIGNALS[1]}
        pd.DataFrame(columns).to_csv(folder / "a.csv", index=False)
        return by_us(folder / "a.csv")

    def xlsx_of_openpyxl(folder: Path) -> str:
        import openpyxl

        book = openpyxl.Workbook()
        book.active.append(["time [s]", "microphone [Pa]", "foot [m/s²]"])
        for row in zip(TIME_S.tolist(), *SIGNALS.tolist(), strict=True):
            book.active.append(row)
        book.save(folder / "a.xlsx")
        return by_us(folder / "a.xlsx", 1e-16)  # it writes 16 digits

    yield Cell(OURS, "numpy", "CSV", csv_by_numpy)
    yield Cell(OURS, "pandas", "CSV", csv_by_pandas)
    yield Cell("pandas", OURS, "CSV", csv_of_pandas)
    yield Cell("openpyxl", OURS, "XLSX", xlsx_of_openpyxl)


def mat_cells() -> Iterator[Cell]:
    def by_scipy(folder: Path, what: dict[str, Any], names: list[str], **how: Any) -> str:
        import scipy.io

        scipy.io.savemat(folder / "a.mat", what, **how)
        given = dict(zip(names, UNITS, strict=False))
        return by_us(folder / "a.mat", names=names, units=given)

    plain = dict(zip(NAMES, SIGNALS, strict=True)) | {"fs": RATE_HZ}
    struct = {"run": plain}
    timed = dict(zip(NAMES, SIGNALS, strict=True)) | {"t": TIME_S}
    table = {"data": SIGNALS.T, "fs": RATE_HZ}
    dotted = [f"run.{name}" for name in NAMES]
    kinds: dict[str, tuple[dict[str, Any], list[str], dict[str, Any]]] = {
        "MAT 5": (plain, NAMES, {}),
        "MAT 5, compressed": (plain, NAMES, {"do_compression": True}),
        "MAT 4": (plain, NAMES, {"format": "4"}),
        "MAT 5, struct": (struct, dotted, {}),
        "MAT 5, time vector": (timed, NAMES, {}),
        "MAT 5, table": (table, ["data 1", "data 2"], {}),
        "MAT 5, complex": ({"microphone": SIGNALS[0] + 1j, "fs": RATE_HZ}, ["microphone"], {}),
    }
    for words, (what, names, how) in kinds.items():
        yield Cell(
            "scipy", OURS, words, lambda f, w=what, n=names, h=how: by_scipy(f, w, n[:2], **h)
        )


FREQUENCY_HZ = 2.5 * np.arange(2, 42)
RESPONSE = (np.arange(40) + 1.0) * np.exp(0.3j * np.arange(40))


def uff_cells() -> Iterator[Cell]:
    def response(folder: Path, binary: int, double: bool, even: int, start_s: float = 0.0) -> str:
        import pyuff

        times = start_s + TIME_S * (1.0 if even else 1.0 + 1e-6 * np.arange(300))
        for name, x, unit, kind in zip(NAMES, SIGNALS, ("Pa", "m/s^2"), (15, 12), strict=True):
            fields = pyuff.prepare_58(
                binary=binary, func_type=1, rsp_node=1, rsp_dir=1, ref_node=1, ref_dir=1, data=x,
                x=times, id1=name, id3="2026-11-28T10:00:00", abscissa_spec_data_type=17,
                ordinate_spec_data_type=kind, ordinate_axis_units_lab=unit, abscissa_spacing=even,
                orddenom_spec_data_type=0,
                abscissa_min=start_s, abscissa_inc=1.0 / RATE_HZ,
                ord_data_type=4 if double else 2, abscissa_axis_units_lab="s",
            )  # fmt: skip
            pyuff.UFF(str(folder / "a.uff")).write_sets([fields], "add", force_double=double)
        rate_hz = RATE_HZ if even else 299 / (times[-1] - times[0])
        digits = 1e-6 if even or binary else 2e-5  # times have six digits
        return by_us(
            folder / "a.uff", 1e-12 if double else 1e-6, start="2026-11-28T10:00:0",
            rate_hz=rate_hz, rate_digits=digits,
        )  # fmt: skip

    for binary in (0, 1):
        for double in (True, False):
            for even in (1, 0):
                words = (
                    f"UFF 58{'b' * binary}, {'double' if double else 'single'} precision, "
                    f"{'even' if even else 'own'} times"
                )
                how = (binary, double, even)
                yield Cell("pyuff", OURS, words, lambda f, h=how: response(f, *h))
    yield Cell("pyuff", OURS, "UFF 58b, start 0.25 s", lambda f: response(f, 1, True, 1, 0.25))

    def function_of_pyuff(folder: Path, binary: int) -> str:
        import pyuff

        import vibroacoustics as va

        fields = pyuff.prepare_58(
            binary=binary, func_type=4, rsp_node=11, rsp_dir=-3, ref_node=3, ref_dir=1,
            data=RESPONSE, x=FREQUENCY_HZ, abscissa_spec_data_type=18, ordinate_spec_data_type=12,
            ordinate_axis_units_lab="m/s^2", orddenom_spec_data_type=13,
            orddenom_axis_units_lab="N", ord_data_type=6, abscissa_spacing=1, abscissa_min=5.0,
            abscissa_inc=2.5,
        )  # fmt: skip
        pyuff.UFF(str(folder / "a.uff")).write_sets([fields], "add", force_double=True)
        read = va.read_functions(folder / "a.uff")[0]
        return first(
            differs("values", read.values, RESPONSE, 1e-9),
            differs("frequencies", read.frequency_hz, FREQUENCY_HZ, 1e-9),
            differs("nodes", f"{read.response}/{read.reference}", "11-z/3+x"),
        )

    for binary in (0, 1):
        words = f"UFF 58{'b' * binary}, complex frequency response"
        yield Cell("pyuff", OURS, words, lambda f, b=binary: function_of_pyuff(f, b))

    def read_by_pyuff(folder: Path, single: bool, text: bool, power: float) -> str:
        import pyuff

        import vibroacoustics as va
        from vibroacoustics.recordings.measured_function import MeasuredFunction, Node

        frequency = FREQUENCY_HZ**power
        nodes = (Node(11, "-z"), Node(3, "+x"))
        one = MeasuredFunction("frequency response", frequency, RESPONSE, *nodes, "m/s²", "N")
        file = va.export_functions([one], folder / "a.uff", single=single, text=text)
        read = pyuff.UFF(str(file)).read_sets()
        read = read[0] if isinstance(read, list) else read
        return first(
            differs("values", read["data"], RESPONSE, 1e-4 if single else 1e-9),
            differs("frequencies", read["x"], frequency, 1e-3 if single or text else 1e-9),
            differs("nodes", [read["rsp_node"], read["rsp_dir"], read["ref_node"]], [11, -3, 3]),
            differs("unit", read["ordinate_axis_units_lab"].strip(), "m/s^2"),
        )

    for text in (True, False):
        for single in (False, True):
            for power in (1.0, 1.1):
                words = (
                    f"UFF 58{'' if text else 'b'}, {'single' if single else 'double'} precision, "
                    f"{'even' if power == 1.0 else 'own'} frequencies, complex"
                )
                how = (single, text, power)
                yield Cell(OURS, "pyuff", words, lambda f, h=how: read_by_pyuff(f, *h))


def tdms_cells() -> Iterator[Cell]:
    epoch = np.datetime64(START, "us")
    scale = {
        "NI_Scaling_Status": "unscaled", "NI_Number_Of_Scales": 1,
        "NI_Scale[0]_Scale_Type": "Linear", "NI_Scale[0]_Linear_Y_Intercept": 0.0,
    }  # fmt: skip

    def write(folder: Path, *segments: tuple[Any, dict[str, Any]], late_s: float = 0.0) -> Path:
        from nptdms import ChannelObject, TdmsWriter

        with TdmsWriter(str(folder / "a.tdms")) as writer:
            for values, about in segments:
                common = {"wf_increment": 1.0 / RATE_HZ, "wf_start_time": epoch, **about}
                later = common | {"wf_start_offset": late_s}
                writer.write_segment([
                    ChannelObject("g", name, x, properties=properties | {"unit_string": unit})
                    for name, x, unit, properties in zip(
                        NAMES, values, ("Pa", "m/s^2"), (common, later), strict=True
                    )
                ])  # fmt: skip
        return folder / "a.tdms"

    def scaled(folder: Path, factors: tuple[float, ...]) -> str:
        parts = np.split(SIGNALS, len(factors), axis=1)
        segments = [
            (np.rint(part / factor).astype("int16"), scale | {"NI_Scale[0]_Linear_Slope": factor})
            for part, factor in zip(parts, factors, strict=True)
        ]
        return by_us(write(folder, *segments), max(factors), start=START)

    def missing(folder: Path) -> str:
        values = SIGNALS.copy()
        values[0, 9] = np.nan
        return by_us(write(folder, (values, {})))

    single = SIGNALS.astype("f4")
    yield Cell("nptdms", OURS, "TDMS", lambda f: by_us(write(f, (SIGNALS, {})), start=START))
    yield Cell(
        "nptdms", OURS, "TDMS, single precision",
        lambda f: by_us(write(f, (single, {})), signals=single.astype(float), start=START),
    )  # fmt: skip
    yield Cell("nptdms", OURS, "TDMS, three segments", lambda f: by_us(
        write(f, *((part, {}) for part in np.split(SIGNALS, 3, axis=1))), start=START
    ))  # fmt: skip
    yield Cell("nptdms", OURS, "TDMS, scaled counts", lambda f: scaled(f, (5e-5,)))
    yield Cell("nptdms", OURS, "TDMS, scale changes", lambda f: scaled(f, (5e-5, 5e-4)))
    yield Cell("nptdms", OURS, "TDMS, counts without scale", lambda f: by_us(
        write(f, (np.rint(1e3 * SIGNALS).astype("int16"), {}))
    ))  # fmt: skip
    yield Cell("nptdms", OURS, "TDMS, NaN", missing)
    yield Cell("nptdms", OURS, "TDMS, start offset 4 samples", lambda f: by_us(
        write(f, (SIGNALS, {}), late_s=4.0 / RATE_HZ), start=START[:-1],
        signals=np.stack([SIGNALS[0, 4:], SIGNALS[1, :-4]]),
    ))  # fmt: skip


def mdf_cells() -> Iterator[Cell]:
    def write(folder: Path, name: str, edition: str, **how: Any) -> Path:
        from asammdf import MDF, Signal

        with MDF(version=edition) as file:
            file.append([
                Signal(x, TIME_S, name=n, unit=u)
                for x, n, u in zip(SIGNALS, NAMES, UNITS, strict=True)
            ])  # fmt: skip
            file.save(folder / name, overwrite=True, **how)
        return folder / name

    def special(folder: Path, samples: Any, right: Any, names: list[str], **how: Any) -> str:
        from asammdf import MDF, Signal

        with MDF(version="4.10") as file:
            file.append([Signal(samples, TIME_S, name="microphone", unit="Pa", **how)])
            file.save(folder / "a.mf4")
        units = dict(zip(names, UNITS, strict=False))
        return by_us(folder / "a.mf4", 1e-5, signals=right, names=names, units=units)

    def counts(folder: Path) -> str:
        conversion = {"a": 1e-5, "b": 0.0}
        samples = np.rint(SIGNALS[0] / 1e-5).astype("int32")
        return special(folder, samples, SIGNALS[:1], NAMES[:1], conversion=conversion)

    def columns(folder: Path) -> str:
        """Whether a plain array of two dimensions is named in a remark."""
        from asammdf import MDF, Signal

        from vibroacoustics.recordings import read_recording

        sine = np.sin(0.1 * np.arange(300))
        with MDF(version="4.10") as file:
            file.append([Signal(np.c_[sine, 2.0 * sine], TIME_S, name="m", unit="Pa")])
            file.save(folder / "a.mf4")
        remarks = read_recording(folder / "a.mf4").attrs.get("reading_remarks", "")
        named = "look like 2 columns" in remarks
        return "asammdf wrote half of the numbers; a remark says so" if named else "values differ"

    for name, edition in (
        ("a.mdf", "3.30"),
        ("a.mf4", "4.00"),
        ("b.mf4", "4.10"),
        ("c.mf4", "4.20"),
    ):
        yield Cell(
            "asammdf", OURS, f"MDF {edition}", lambda f, n=name, e=edition: by_us(write(f, n, e))
        )
    yield Cell("asammdf", OURS, "MDF 4.11, compressed", lambda f: by_us(
        write(f, "a.mf4", "4.11", compression=2)
    ))  # fmt: skip
    yield Cell("asammdf", OURS, "MDF 4.10, counts with a conversion", counts)
    structure = np.rec.fromarrays(list(SIGNALS), names="left,right")
    yield Cell("asammdf", OURS, "MDF 4.10, structure", lambda f: special(
        f, structure, SIGNALS, ["left", "right"]
    ))  # fmt: skip
    array = np.rec.fromarrays([SIGNALS.T], dtype=np.dtype([("microphone", "(2,)<f8")]))
    yield Cell("asammdf", OURS, "MDF 4.10, array", lambda f: special(
        f, array, SIGNALS, ["microphone[0]", "microphone[1]"]
    ))  # fmt: skip
    yield Cell("asammdf", OURS, "MDF 4.10, numpy array of two dimensions", columns)
    invalid = np.arange(300) == 7
    yield Cell("asammdf", OURS, "MDF 4.10, invalid sample", lambda f: special(
        f, SIGNALS[0], SIGNALS[:1], NAMES[:1], invalidation_bits=invalid
    ))  # fmt: skip


def netcdf_cells() -> Iterator[Cell]:
    def dataset(times: Any = None, values: Any = SIGNALS) -> Any:
        import xarray as xr

        named = zip(NAMES, values, ("Pa", "m/s^2"), strict=True)
        data = {name: ("time", x, {"units": unit}) for name, x, unit in named}
        if times is None:
            return xr.Dataset(data, attrs={"fs": RATE_HZ})
        return xr.Dataset(data, coords={"time": ("time", times)})

    def by_xarray(folder: Path, engine: str, content: Any, **how: Any) -> str:
        start, atol = how.pop("start", ""), how.pop("atol", 0.0)
        content.to_netcdf(folder / "a.nc", engine=engine, **how)
        return by_us(folder / "a.nc", atol, start=start)

    nanoseconds = np.rint(1e9 * TIME_S).astype("timedelta64[ns]")
    date = np.datetime64(START, "ns")
    seconds = ("time", TIME_S, {"units": "s"})
    missing = SIGNALS.copy()
    missing[1, 3] = np.nan
    packing = {n: {"dtype": "int16", "scale_factor": 2e-5, "_FillValue": -32768} for n in NAMES}
    contents: dict[str, tuple[Callable[[], Any], dict[str, Any]]] = {
        "rate as attribute": (dataset, {}),
        "time in s": (lambda: dataset().drop_attrs(deep=False).assign_coords(time=seconds), {}),
        "datetime64": (lambda: dataset(date + nanoseconds), {"start": START}),
        "timedelta64": (lambda: dataset(nanoseconds), {}),
        "packed": (dataset, {"encoding": packing, "atol": 2e-5}),
        "packed, one missing": (lambda: dataset(values=missing), {"encoding": packing}),
        "NaN": (lambda: dataset(values=missing), {}),
    }
    for engine in ("netcdf4", "h5netcdf"):
        for words, (make, how) in contents.items():
            yield Cell(
                f"xarray, {engine}", OURS, f"netCDF, {words}",
                lambda f, e=engine, m=make, h=how: by_xarray(f, e, m(), **h),
            )  # fmt: skip
    yield Cell("xarray, scipy", OURS, "netCDF 3, packed", lambda f: by_xarray(
        f, "scipy", dataset(), encoding=packing, atol=2e-5
    ))  # fmt: skip

    def never_written(folder: Path) -> str:
        import netCDF4

        with netCDF4.Dataset(folder / "a.nc", "w") as file:
            file.createDimension("time", 300)
            file.fs = RATE_HZ
            for name, unit in zip(NAMES, ("Pa", "m/s^2"), strict=True):
                file.createVariable(name, "f8", ("time",)).units = unit
            file["microphone"][:] = SIGNALS[0]
            file["foot"][:200] = SIGNALS[1, :200]
        return by_us(folder / "a.nc")

    yield Cell("netCDF4", OURS, "netCDF, a part that was never written", never_written)

    def hdf5_in_order(folder: Path, **how: Any) -> str:
        import h5py

        with h5py.File(folder / "a.h5", "w") as file:
            for name, x, unit in zip("ab", SIGNALS, UNITS, strict=True):
                about = {"units": unit, "fs": RATE_HZ}
                file.create_dataset(name, data=x, **how).attrs.update(about)
        return by_us(folder / "a.h5", names=["a", "b"])

    yield Cell("h5py", OURS, "HDF5", hdf5_in_order)
    yield Cell("h5py", OURS, "HDF5, compressed", lambda f: hdf5_in_order(f, compression="gzip"))
    yield Cell("h5py", OURS, "HDF5, big-endian", lambda f: hdf5_in_order(f, dtype=">f8"))


def written_netcdf_cells() -> Iterator[Cell]:
    def recording_by_xarray(folder: Path, engine: str) -> str:
        import xarray as xr

        with xr.open_dataset(export(folder, "nc"), engine=engine) as read:
            return first(
                differs("values", read["signal"].values, SIGNALS),
                differs("names", read["channel"].values.tolist(), NAMES),
                differs("units", read["channel_unit"].values.tolist(), UNITS),
                differs("time", read["time"].values, TIME_S),
                differs("rate", read.attrs["sample_rate_hz"], RATE_HZ),
            )

    def recording_by_netcdf4(folder: Path) -> str:
        import netCDF4

        with netCDF4.Dataset(export(folder, "nc")) as read:
            return first(
                differs("values", np.asarray(read["signal"][:]), SIGNALS),
                differs("time", np.asarray(read["time"][:]), TIME_S),
            )

    def recording_by_h5py(folder: Path) -> str:
        import h5py

        with h5py.File(export(folder, "nc")) as read:
            return differs("values", read["signal"][:], SIGNALS)

    def results(folder: Path, engine: str) -> str:
        """Complex orders of a recording, as another program reads the file of results."""
        import xarray as xr

        import vibroacoustics as va
        from vibroacoustics.results.storage import write_results

        wave = np.cos(2.0 * np.pi * 50.0 * np.arange(4096) / 1024.0 + 0.3)
        one = va.label_recording([3.0 * wave], 1024.0, ["ring"], ["m/s²"])
        found = va.analyse_orders(one, va.OrderAnalysis(va.NominalSpeed(3000.0), (1.0,)))
        path = write_results(found, folder / "orders.nc")
        with xr.open_dataset(path, engine=engine) as read:
            ours, theirs = found["channel_order"].values, complex_of(read, "channel_order")
            return first(
                differs("complex numbers", theirs, ours, 1e-12),
                differs("names", read["channel"].values.tolist(), ["ring"]),
            )

    for engine in ("netcdf4", "h5netcdf"):
        reader = f"xarray, {engine}"
        yield Cell(
            OURS, reader, "recording as netCDF", lambda f, e=engine: recording_by_xarray(f, e)
        )
        yield Cell(OURS, reader, "results as netCDF, complex", lambda f, e=engine: results(f, e))
    yield Cell(OURS, "netCDF4", "recording as netCDF", recording_by_netcdf4)
    yield Cell(OURS, "h5py", "recording as netCDF", recording_by_h5py)


def complex_of(read: Any, name: str) -> Any:
    """Complex numbers of a file of results, which are a pair of real and imaginary parts."""
    return read[f"{name}_re"].values + 1j * read[f"{name}_im"].values


def cells() -> list[Cell]:
    """All cells of the table."""
    makers = (
        wav_cells, table_cells, mat_cells, uff_cells, tdms_cells, mdf_cells, netcdf_cells,
        written_netcdf_cells,
    )  # fmt: skip
    return [cell for maker in makers for cell in maker()]


def rows(outcomes: dict[Cell, str]) -> list[list[str]]:
    """Rows of the table."""
    listed = [[c.writer, c.reader, c.content, outcome] for c, outcome in outcomes.items()]
    return [["written by", "read by", "content", "outcome"], *listed]


def versions() -> list[list[str]]:
    """Rows of the versions of the programs."""
    return [[name, version(name), "version", ""] for name in PACKAGES]


def committed() -> list[list[str]]:
    """Rows of the table in the documentation."""
    with TABLE.open(encoding="utf-8", newline="") as file:
        return list(csv.reader(file))


def main() -> None:
    """Write the table of the documentation."""
    table = [*rows({cell: cell.outcome() for cell in cells()}), *versions()]
    with TABLE.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(table)


if __name__ == "__main__":
    main()
