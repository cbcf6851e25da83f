"""Heaps of a result file: whole ones pass, one in which HDF5 would go round for ever is refused."""

from pathlib import Path

import pytest
from support import TINY, made_up_radiation

from vibroacoustics import pipeline
from vibroacoustics.base.errors import StorageError
from vibroacoustics.base.heaps import check_heaps
from vibroacoustics.results import hashed
from vibroacoustics.results.storage import write_results
from vibroacoustics.study.loading import load_study


def test_damaged_heaps_of_results(tmp_path: Path) -> None:
    path = tmp_path / "results.nc"
    write_results(pipeline.run(load_study(TINY), radiation=made_up_radiation), path)
    content = hashed.read_checked(path).content
    check_heaps(content)
    heaps = [at for at in range(len(content)) if content.startswith(b"GCOL\1\0\0\0", at)]
    assert heaps
    for start in heaps:
        damaged = bytearray(content)
        damaged[start + 16 : start + 416] = bytes(400)
        with pytest.raises(StorageError, match="a heap in it is damaged"):
            check_heaps(bytes(damaged))


def test_a_heap_that_ends_early_is_none() -> None:
    check_heaps(b"GCOL\1\0\0\0" + (4096).to_bytes(8, "little") + b"\1\0\0\0\0\0\0\0")
