"""What `doctor` tells of an installation."""

from importlib.metadata import PackageNotFoundError, version

import pytest

from vibroacoustics.commands import doctor
from vibroacoustics.results import provenance


@pytest.mark.parametrize(
    ("missing", "told"),
    [
        (
            (),
            "recordings: CSV (.csv .txt .tsv .prn), FLAC and Wave64 (.flac .w64), HDF5 and netCDF "
            "(.h5 .hdf5 .nc .nc4), LVM (LabVIEW measurement) (.lvm), MAT (.mat), MDF and MF4 "
            "(.mf4 .mdf), TDMS (.tdms), UFF (.uff .unv .ufb .bunv .uf), WAV (.wav .rf64 .bwf), "
            "XLSX (spreadsheet) (.xlsx .xlsm) can be read",
        ),
        (
            ("soundfile",),
            "recordings: FLAC and Wave64: needs soundfile: pip install vibroacoustics[io]",
        ),
        (("pyuff", "nptdms"), "recordings: TDMS: needs nptdms: pip install vibroacoustics[io]"),
    ],
)
def test_the_extra_for_recordings(monkeypatch, missing, told):
    packages = ("asammdf", "nptdms", "openpyxl", "pyuff", "soundfile")

    def installed(name: str) -> str:
        if name in missing:
            raise PackageNotFoundError(name)
        return version(name) if name not in packages else "1.0"

    monkeypatch.setattr(provenance, "version", installed)
    monkeypatch.setattr(provenance, "_version", provenance._version.__wrapped__)  # not kept
    lines = list(doctor.findings())
    assert told in lines
    for name in missing:
        assert f"{name} not installed" in lines
    assert any(line.startswith("h5py ") for line in lines)
