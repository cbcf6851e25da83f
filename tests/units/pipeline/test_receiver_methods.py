"""Method of each microphone, and why it is not k-Wave: of every study, and of a run."""

import re
from pathlib import Path

import pytest
import xarray as xr
from support import ROOT, TINY, made_up_radiation

from vibroacoustics import pipeline
from vibroacoustics.radiation.of_study import inputs_of
from vibroacoustics.radiation.receiver_methods import GIVEN
from vibroacoustics.radiation.receiver_methods import receiver_methods as methods_by_settings
from vibroacoustics.radiation.transfer_vectors import kwave_names
from vibroacoustics.report.kwave_words import (
    kwave_difference_db,
    kwave_line,
    kwave_sentence,
    receiver_methods,
)
from vibroacoustics.results import storage
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.study import Study

FOLDERS = ("pipelines", "docs/gallery/studies")
OUTDOORS = {"terrace.toml", "neighbour.toml"}
CUT_CELLS = {"copeland_corner.toml", "copeland_cabinet.toml"}


def _study(file: Path, folder: Path) -> Study:
    """The study, without the option whose kind a page of the gallery registers."""
    text = file.read_text(encoding="utf-8")
    if "back-turning-weight" not in text:
        return load_study(file)
    kept = [part for part in re.split(r"(?m)^(?=\[)", text) if "back-turning-weight" not in part]
    (folder / file.name).write_text("".join(kept).replace("../../..", str(ROOT)))
    return load_study(folder / file.name)


def methods_of(study: Study) -> dict[str, tuple[str, str]]:
    """Method and reason of each microphone, from the study alone."""
    _, receivers, settings, *_, asked = inputs_of(study, ())
    return methods_by_settings(receivers, settings, kwave_names(receivers, settings, asked))


@pytest.mark.parametrize("folder", FOLDERS)
def test_every_study_has_k_wave_at_the_published_microphone(folder: str, tmp_path: Path) -> None:
    """But outdoors; every other microphone has its reason."""
    files = sorted((ROOT / folder).glob("*.toml"))
    assert len(files) > 10
    for file in files:
        study = _study(file, tmp_path)
        machine = "cut cells" if file.name in CUT_CELLS else "boundary elements"
        methods = methods_of(study)
        assert list(methods) == list(study.receivers)
        for name, (method, reason) in methods.items():
            if file.name in OUTDOORS:
                expected = (f"{machine}, spherical waves over ground",
                            "k-Wave has no ground and no barrier")  # fmt: skip
            elif name == study.catalogue_receiver:
                expected = f"{machine}, k-Wave", ""
            else:
                expected = (f"{machine}, image sources",
                            'k-Wave computes front_1m (kwave_receivers = "catalogue")')  # fmt: skip
            assert (method, reason) == expected, (file.name, name)


def test_reasons_of_settings() -> None:
    study = load_study(TINY)
    high = study.replace(
        {"radiation.maximum_frequency_hz": 8000.0, "radiation.room_spacing_mm": None}
    )
    closed = study.replace({"radiation.room_solver": "closed-form"})
    assert methods_of(high)["front_1m"] == (
        "boundary elements, k-Wave to 4000 Hz, image sources above",
        "above, the grid of k-Wave would be too large",
    )
    assert methods_of(closed)["front_1m"] == (
        "boundary elements, image sources",
        'room_solver = "closed-form"',
    )


@pytest.fixture(scope="module")
def radiated(tmp_path_factory: pytest.TempPathFactory) -> xr.Dataset:
    """Radiation of the tiny study with the automatic spacing, written and read again."""
    study = load_study(TINY).replace(
        {"radiation.room_spacing_mm": None, "radiation.maximum_frequency_hz": 800.0}
    )
    path = tmp_path_factory.mktemp("radiated") / "transfer_vectors.nc"
    with storage.without_cache():
        return storage.open_results(storage.write_results(pipeline.radiate(study), path))


def test_results_hold_what_the_study_plans(radiated: xr.Dataset) -> None:
    assert receiver_methods(radiated) == {"front_1m": ("boundary elements, k-Wave", "")}
    for name in ("radiation_method", "radiation_method_reason"):
        assert radiated[name].dims == ("receiver",)
        assert radiated[name].attrs["long_name"]
        assert radiated[name].dtype.kind == "U"


def test_difference_is_one_line(radiated: xr.Dataset) -> None:
    """Both methods solve the same problem: some thousandths of a decibel, never exactly none."""
    difference = kwave_difference_db(radiated)
    assert difference is not None
    assert 1e-6 < difference < 0.05
    line = kwave_line(radiated)
    assert line == (
        f"k-Wave at front_1m to 800 Hz: pressure within {difference:.3f} dB of the closed form."
    )


def test_given_radiation_has_its_reason() -> None:
    results = pipeline.radiate(load_study(TINY), radiation=made_up_radiation)
    assert receiver_methods(results) == {"front_1m": GIVEN}
    assert kwave_difference_db(results) is None
    assert kwave_sentence(results) == f"k-Wave did not run: {GIVEN.reason}."
    assert kwave_line(results) == kwave_sentence(results)
