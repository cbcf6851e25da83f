"""Radiation that is interrupted resumes to the same bits: elements, cut cells, k-Wave, rooms."""

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from support import ROOT, TINY

import vibroacoustics as va
from vibroacoustics.results.run_pieces import RunPieces, resumable
from vibroacoustics.stages.radiation import transfer_vectors
from vibroacoustics.study.study import Study

Job = Callable[[Study], xr.Dataset]


class StoppedError(Exception):
    """In place of a signal."""


def tiny(values: dict[str, Any]) -> Study:
    return va.load_study(TINY).replace(values)


def radiated(study: Study) -> xr.Dataset:
    return transfer_vectors(study, lambda *_: None)[0]


def in_room(_: Study) -> xr.Dataset:
    study = va.load_study(ROOT / "pipelines" / "kitchen.toml")
    coarse = study.replace({"room.maximum_frequency_hz": 250.0})
    return va.impulse_responses(coarse).to_dataset(name="response")


CUT_CELLS = {
    "radiation.method": "cut-cells",
    "radiation.maximum_frequency_hz": 400.0,
    "operation.maximum_order": 4,
}


class Counted:
    """Runs with a store, each ended when so many pieces are computed."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.computed = 0
        self._patch, self._keep = monkeypatch, RunPieces.keep

    def run(self, job: Job, study: Study, most: float) -> xr.Dataset | None:
        self.computed = 0

        def keep(store: RunPieces, key: str, content: bytes) -> None:
            if self.computed == most:
                raise StoppedError
            self.computed += 1
            self._keep(store, key, content)

        with self._patch.context() as patch, suppress(StoppedError):
            patch.setattr(RunPieces, "keep", keep)
            with resumable("radiation", study.parameters(), lambda _: None):
                return job(study)
        return None


@pytest.mark.parametrize(
    ("job", "values", "least"),
    [
        (radiated, {"radiation.room_solver": "closed-form"}, 5),
        pytest.param(radiated, {"radiation.room_solver": "k-wave"}, 6, marks=pytest.mark.long),
        pytest.param(radiated, CUT_CELLS, 6, marks=pytest.mark.long),
        pytest.param(in_room, {}, 10, marks=pytest.mark.long),
    ],
)
def test_radiation_resumes(
    job: Job,
    values: dict[str, Any],
    least: int,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    study, counted = tiny(values), Counted(monkeypatch)
    whole = counted.run(job, study, np.inf)
    total = counted.computed
    assert total >= least
    for file in tmp_path.glob("vibroacoustics/*.nc"):
        file.unlink()
    for most in (total // 2, total - total // 2 - 1):
        assert counted.run(job, study, most) is None
        assert counted.computed == most
    again = counted.run(job, study, np.inf)
    assert counted.computed == 1
    xr.testing.assert_identical(again, whole)
    for name, variable in whole.variables.items():
        assert variable.values.tobytes() == again[name].values.tobytes()
