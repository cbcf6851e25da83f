"""Small files whose headers claim more than they hold: honest ones with bytes edited."""

import re
import struct
import zipfile
import zlib
from collections.abc import Callable
from pathlib import Path

import h5py
import netCDF4
import scipy.io
from kinds_of_files import HALF, KINDS, RESCALED
from trade_files import RATE_HZ, lvm, mf4

SAMPLES = HALF.shape[1]
BILLION = 2**30
TEN_BILLION = 10 * 2**30
Writer = Callable[[Path], object]

HONEST: dict[str, Writer] = {
    **{name: writer for name, (writer, *_) in KINDS.items()},
    **RESCALED,
    "a.lvm": lvm,
    "times.lvm": lambda path: lvm(path, ",", "One"),
    "a.mf4": lambda path: mf4(path, is_slow=False),
    "packed.mf4": lambda path: mf4(path, compression=2, is_slow=False),
    "a.mdf": lambda path: mf4(path, "3.30", is_slow=False),
}
"""Writers of honest files by their names: 22 kinds and more."""
MISSING = {"units": {"*": "Pa"}, "calibration": {"*": 1.0}}


def options_of(name: str) -> dict[str, object]:
    """What the user gives where the file states none."""
    if name.endswith((".wav", ".flac", ".w64")):
        return MISSING
    return {"units": {"*": "Pa"}} if name.endswith(".mat") and "testlab" not in name else {}


def honest(name: str, path: Path) -> bytes:
    """Content of an honest file."""
    HONEST[name](path)
    return path.read_bytes()


def edited(name: str, old: bytes, new: bytes, times: int | None = None) -> Writer:
    """Writer of an honest file in which some bytes are others."""

    def write(path: Path) -> None:
        content = honest(name, path)
        assert old in content
        path.write_bytes(content.replace(old, new, -1 if times is None else times))

    return write


def little(number: int, size: int = 8) -> bytes:
    return number.to_bytes(size, "little")


def claiming(name: str, claimed: int, size: int = 8) -> Writer:
    """Writer of a file that claims another number of samples; little-endian."""
    return edited(name, little(SAMPLES, size), little(claimed, size))


def at(name: str, place: int, new: bytes) -> Writer:
    """Writer of a file with other bytes at a place."""

    def write(path: Path) -> None:
        content = bytearray(honest(name, path))
        content[place : place + len(new)] = new
        path.write_bytes(content)

    return write


def behind(name: str, mark: bytes, distance: int, new: bytes) -> Writer:
    """Writer of a file with other bytes at a distance behind the first mark."""

    def write(path: Path) -> None:
        content = bytearray(honest(name, path))
        place = content.index(mark) + distance
        content[place : place + len(new)] = new
        path.write_bytes(content)

    return write


def rf64(samples: int) -> Writer:
    def write(path: Path) -> None:
        content = honest("float.wav", path)
        sizes = b"ds64" + struct.pack("<IQQQI", 28, 8 * samples, 8 * samples, samples, 0)
        at_data = content.index(b"data")
        long = b"\xff\xff\xff\xff"
        head = b"RF64" + long + content[8:12] + sizes + content[12:at_data]
        path.write_bytes(head + b"data" + long + content[at_data + 8 :])

    return write


def rifx(path: Path) -> None:
    """Big-endian PCM of 16 bits that claims a chunk of 2 GB."""
    head = b"RIFX" + struct.pack(">I", 2**31) + b"WAVEfmt "
    head += struct.pack(">IHHIIHH", 16, 1, 2, 1024, 4096, 4, 16)
    path.write_bytes(head + b"data" + struct.pack(">I", 2**31) + HALF.T.astype(">i2").tobytes())


def flac(samples: int, rate_hz: int = 1024, channels: int = 2, bits: int = 24) -> Writer:
    """STREAMINFO of other numbers: 20 bits of rate, 3 of channels, 5 of bits, 36 of samples."""
    packed = rate_hz << 44 | (channels - 1) << 41 | (bits - 1) << 36 | samples
    return at("a.flac", 18, packed.to_bytes(8, "big"))


def packed_mat(rows: int) -> Writer:
    """Compressed MAT file whose variables claim more rows than follow."""

    def write(path: Path) -> None:
        named = {"microphone": HALF[:1], "foot": HALF[1:], "fs": RATE_HZ}
        scipy.io.savemat(path, named, do_compression=True)
        content = path.read_bytes()
        parts, place = [content[:128]], 128
        while place < len(content):
            kind, size = struct.unpack("<II", content[place : place + 8])
            plain = zlib.decompress(content[place + 8 : place + 8 + size])
            plain = plain.replace(struct.pack("<ii", 1, SAMPLES), struct.pack("<ii", 1, rows))
            again = zlib.compress(plain)
            parts.append(struct.pack("<II", kind, len(again)) + again)
            place += 8 + size
        path.write_bytes(b"".join(parts))

    return write


def hdf5(shape: tuple[int, ...], stored: int = 0, **options: object) -> Writer:
    """Two datasets that claim a shape; `stored` samples at their ends are there."""

    def write(path: Path) -> None:
        with h5py.File(path, "w") as file:
            file.attrs["sample_rate_hz"] = RATE_HZ
            for name in ("a", "b"):
                file.create_dataset(name, shape, "f4", **options).attrs["units"] = "Pa"
                if stored:
                    file[name][-stored:] = 1.0

    return write


def hdf5_with_times(path: Path) -> None:
    """Channels and times that are claimed and not stored."""
    with h5py.File(path, "w") as file:
        for name, unit in (("a", "Pa"), ("time", "s")):
            options = {"chunks": (1024,), "fillvalue": 0.5}
            file.create_dataset(name, (BILLION,), "f4", **options).attrs["units"] = unit


def netcdf(path: Path) -> None:
    """NetCDF 4 with an unlimited time of a billion samples, of which the last is stored."""
    with netCDF4.Dataset(path, "w") as file:
        file.createDimension("time", None)
        variable = file.createVariable("a", "f4", ("time",), chunksizes=(1024,))
        variable.units = "Pa"
        variable[BILLION - 1] = 1.0
        file.sample_rate_hz = RATE_HZ


def netcdf_records(claimed: int) -> Writer:
    """Classic netCDF with an unlimited time; the number of records is at byte 4."""

    def write(path: Path) -> None:
        with netCDF4.Dataset(path, "w", format="NETCDF3_64BIT_OFFSET") as file:
            file.createDimension("time", None)
            for name, values in zip("ab", HALF, strict=True):
                variable = file.createVariable(name, "f8", ("time",))
                variable.units = "Pa"
                variable[:] = values
            file.sample_rate_hz = RATE_HZ
        content = path.read_bytes()
        path.write_bytes(content[:4] + claimed.to_bytes(4, "big") + content[8:])

    return write


def sheet_edited(change: Callable[[str], str], part: str = "xl/worksheets/sheet2.xml") -> Writer:
    """Writer of a spreadsheet of which one part is another text."""

    def write(path: Path) -> None:
        honest("a.xlsx", path)
        with zipfile.ZipFile(path) as book:
            parts = {name: book.read(name) for name in book.namelist()}
        parts[part] = change(parts.get(part, b"").decode()).encode()
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as book:
            for name, content in parts.items():
                book.writestr(name, content)

    return write


def many_cells(rows: int) -> Callable[[str], str]:
    def change(sheet: str) -> str:
        row = "<row><c><v>0.001</v></c><c><v>1</v></c><c><v>1</v></c></row>"
        return sheet.replace("</sheetData>", rows * row + "</sheetData>")

    return change


def far_cells(sheet: str) -> str:
    """Every row below the names has a cell in the last column that a spreadsheet can have."""
    return re.sub(
        r'(<row r="(?!1")(\d+)"[^>]*>.*?)</row>',
        r'\1<c r="XFD\2"><v>1</v></c></row>',
        sheet,
        flags=re.S,
    )


def far_row(sheet: str) -> str:
    """A row of a number that no spreadsheet can have."""
    row = '<row r="99999999999"><c r="A9"><v>1</v></c></row>'
    return sheet.replace("</sheetData>", row + "</sheetData>")


def last_row(sheet: str) -> str:
    row = '<row r="1048576"><c r="A1048576"><v>1</v></c></row>'
    return sheet.replace("</sheetData>", row + "</sheetData>")


def empty_rows(rows: int) -> Callable[[str], str]:
    def change(sheet: str) -> str:
        return sheet.replace("</sheetData>", rows * "<row/>" + "</sheetData>")

    return change


def shared_strings(_: str) -> str:
    """Shared strings of 200 MB of blanks and of a million items."""
    items = "<si><t>a</t></si>" * 1_000_000
    space = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
    return f'<sst xmlns="{space}" count="9" uniqueCount="9">{items}</sst>'


def text(name: str, old: str, new: str) -> Writer:
    return edited(name, old.encode(), new.encode())


def table(rows: str) -> Writer:
    return lambda path: path.write_text(rows)


LIES: dict[str, Writer] = {
    "data of 4 GB.wav": behind("float.wav", b"data", 4, little(2**32 - 1, 4)),
    "data of 240 kB.wav": behind("float.wav", b"data", 4, little(240_000, 4)),
    "65535 channels.wav": behind("float.wav", b"fmt ", 10, little(65535, 2)),
    "10 billion, long.wav": rf64(TEN_BILLION),
    "2 GB, big-endian.wav": rifx,
    "10 billion, packed.wav": behind("packed.wav", b"data", 4, little(2**32 - 1, 4)),
    "data of 10 GB.w64": at("a.w64", 0x60, little(TEN_BILLION)),
    "data of 300 MB.w64": at("a.w64", 0x60, little(300_000_000)),
    "rate of 4 GHz.w64": at("a.w64", 0x44, little(2**32 - 1, 4)),
    "68 billion.flac": flac(2**36 - 1),
    "50 million.flac": flac(50_000_000),
    "20 thousand.flac": flac(20_000),
    "8 channels.flac": flac(4_000_000, 1024, 8, 24),
    "a billion.mat": claiming("a.mat", BILLION, 4),
    "30 thousand.mat": claiming("a.mat", 30_000, 4),
    "a billion, packed.mat": packed_mat(BILLION),
    "a million, packed.mat": packed_mat(1_000_000),
    "10 billion, seven.mat": claiming("seven.mat", TEN_BILLION),
    "a billion, testlab.mat": claiming("testlab.mat", BILLION, 4),
    "10 billion, testlab_seven.mat": claiming("testlab_seven.mat", TEN_BILLION),
    "10 billion in one piece.h5": claiming("a.h5", TEN_BILLION),
    "100 million in one piece.h5": claiming("a.h5", 100_000_000),
    "10 billion in chunks.h5": hdf5((TEN_BILLION,), chunks=(1024,)),
    "a billion, the last stored.h5": hdf5((BILLION,), stored=1, chunks=(2**16,)),
    "100 million filled.h5": hdf5((100_000_000,), chunks=(2**12,), fillvalue=0.25),
    "packed chunks.h5": hdf5((TEN_BILLION,), stored=1, chunks=(2**12,), compression="gzip"),
    "9999 channels.h5": hdf5((BILLION, 9999), chunks=(1024, 1)),
    "times.h5": hdf5_with_times,
    "a billion records.nc": netcdf,
    "10 billion.nc": claiming("a.nc", TEN_BILLION),
    "a billion, classic.nc": edited("classic.nc", struct.pack(">I", 300), struct.pack(">I", 2**30)),
    "30 thousand, classic.nc": edited(
        "classic.nc", struct.pack(">I", 300), struct.pack(">I", 30_000)
    ),
    "2 billion records, classic.nc": netcdf_records(2**31 - 1),
    "30 thousand records, classic.nc": netcdf_records(30_000),
    "a billion.uff": text("a.uff", "       300", "1073741824"),
    "30 thousand.uff": text("a.uff", "       300", "     30000"),
    "a billion, binary.uff": text("binary.uff", "       300", "1073741824"),
    "30 thousand, binary.uff": text("binary.uff", "       300", "     30000"),
    "10 billion.tdms": claiming("a.tdms", TEN_BILLION),
    "30 thousand.tdms": claiming("a.tdms", 30_000),
    "10 billion.mf4": claiming("a.mf4", TEN_BILLION),
    "30 thousand.mf4": claiming("a.mf4", 30_000),
    "10 billion, packed.mf4": claiming("packed.mf4", TEN_BILLION),
    "4 billion.mdf": edited("a.mdf", little(300, 4), little(2**32 - 1, 4)),
    "200 thousand rows.xlsx": sheet_edited(many_cells(200_000)),
    "far columns.xlsx": sheet_edited(far_cells),
    "far row.xlsx": sheet_edited(far_row),
    "last row.xlsx": sheet_edited(last_row),
    "empty rows.xlsx": sheet_edited(empty_rows(1_000_000)),
    "shared strings.xlsx": sheet_edited(shared_strings, "xl/sharedStrings.xml"),
    "10 billion.lvm": text("a.lvm", "Samples\t300\t300", f"Samples\t{TEN_BILLION}\t{TEN_BILLION}"),
    "30 thousand.lvm": text("a.lvm", "Samples\t300\t300", "Samples\t30000\t30000"),
    "99999999 channels.lvm": text("a.lvm", "Channels\t2", "Channels\t99999999"),
}
"""Writers by the names of the files; each file has 20 kB, of XLSX and HDF5 up to 600 kB."""

RATES: dict[str, Writer] = {
    "rate of 4 GHz.wav": behind("float.wav", b"fmt ", 12, little(2**32 - 1, 4)),
    "1e-300 s.tdms": edited("a.tdms", struct.pack("<d", 1 / RATE_HZ), struct.pack("<d", 1e-300)),
    "1e300 s.tdms": edited("a.tdms", struct.pack("<d", 1 / RATE_HZ), struct.pack("<d", 1e300)),
    "1e-9 Hz.h5": edited("a.h5", struct.pack("<d", RATE_HZ), struct.pack("<d", 1e-9)),
    "1e15 Hz.h5": edited("a.h5", struct.pack("<d", RATE_HZ), struct.pack("<d", 1e15)),
    "1e-30 s.lvm": text("a.lvm", "0.0009765625\t0.0009765625", "1e-30\t1e-30"),
    "1e9 s.lvm": text("a.lvm", "0.0009765625\t0.0009765625", "1e9\t1e9"),
    "1e9 s.csv": table("time [s],a [Pa]\n" + "".join(f"{n}e9,{n % 7}\n" for n in range(300))),
    "1e-12 s.csv": table("time [s],a [Pa]\n" + "".join(f"{n}e-12,{n % 7}\n" for n in range(300))),
}
"""Files whose rate no recorder has."""
