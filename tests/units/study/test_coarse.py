"""A study made coarser: what is changed, and the error that is told."""

import numpy as np
import pytest
from support import PIPELINES, ROOT, TINY

from vibroacoustics.study.coarse import LEAST_SAMPLES, MOST_SPEEDS, coarse, standard_error_of_end
from vibroacoustics.study.loading import load_study


@pytest.mark.parametrize("count", [20, 100])
def test_standard_error_of_the_ends_of_bands(count: int) -> None:
    """Against the scatter of 5 % quantiles of that many random numbers."""
    samples = np.random.default_rng(1).standard_normal((20_000, count))
    ends = np.quantile(samples, 0.05, axis=1, method="median_unbiased")
    assert standard_error_of_end(count) == pytest.approx(ends.std(), rel=0.1)


def test_fewer_samples_and_no_kwave() -> None:
    study = load_study(ROOT / "tests" / "studies" / "sources_made_up.toml")
    more = coarse(study.replace({"uncertainty.random_samples": 100}))
    assert more.uncertainty.random_samples == 20
    assert more.radiation.room_solver == "closed-form"
    assert any("standard error of 0.47 instead of 0.21" in words for words in more.coarsened)
    few = coarse(study)  # four samples are fewer than the least
    assert few.uncertainty.random_samples == study.uncertainty.random_samples < LEAST_SAMPLES
    assert len(few.coarsened) == 2
    assert few.coarsened[-1] == "no sliders of parameters"


def test_speeds_keep_their_supply_and_the_published_one() -> None:
    study = load_study(ROOT / "tests" / "studies" / "sources_made_up.toml")
    speeds = [2400.0 + 50.0 * number for number in range(20)]
    supplies = [speed / 58.0 for speed in speeds]
    given = {"operation.speed_rpm": speeds, "operation.supply_frequency_hz": supplies}
    looked = coarse(study.replace(given)).operation
    assert MOST_SPEEDS <= len(looked.speed_rpm) <= MOST_SPEEDS + 1
    assert {2400.0, 2900.0, 3350.0} <= set(looked.speed_rpm)
    assert looked.supply_frequency_hz == tuple(speed / 58.0 for speed in looked.speed_rpm)


def test_cut_cells_stay_fine_enough_for_the_wave() -> None:
    study = load_study(TINY).replace({"radiation.method": "cut-cells"})
    looked = coarse(study)
    assert looked.radiation.near_field_spacing_m == pytest.approx(0.0428)  # λ/8 at 1 kHz is 42.9 mm
    assert any("cut cells of 42.8 instead of 35 mm" in words for words in looked.coarsened)


@pytest.mark.parametrize(("highest_hz", "spacing_m"), [(4000.0, 0.0088), (1000.0, None)])
def test_automatic_cut_cells_are_coarsened_where_the_wave_decides(highest_hz, spacing_m) -> None:
    changes = {
        "radiation.method": "cut-cells",
        "radiation.near_field_spacing_mm": None,
        "radiation.room_spacing_mm": None,
        "radiation.maximum_frequency_hz": highest_hz,
    }
    looked = coarse(load_study(TINY).replace(changes))
    assert looked.radiation.near_field_spacing_m == spacing_m


def test_nothing_to_make_coarser() -> None:
    study = load_study(PIPELINES / "zhao_minicrank.toml")
    study = study.replace({"radiation.room_solver": "closed-form"})
    assert coarse(study) is study
