"""The largest page that moves: five speeds, ten microphones, 40 orders; its size and agreement."""

import math
from pathlib import Path
from typing import Any, Final

import numpy as np
import pytest
import xarray as xr
from live_pages import largest_study, open_page, page_of, vectors_of_a_box
from selenium.webdriver import Chrome

import vibroacoustics as va
from vibroacoustics.live.section import live_data
from vibroacoustics.machine.floor import Floor
from vibroacoustics.report.live.assets import live_script, live_style, packed, unpacking_script

pytestmark = [pytest.mark.long, pytest.mark.filterwarnings("ignore:.*usual is")]

MOST_BYTES: Final = 200_000
WEIGHT: Final = {
    "kind": "counterweight", "mass_g": 400.0, "radius_mm": 60.0, "angle_deg": 200.0,
    "height_mm": 40.0,
}  # fmt: skip
MOUNTS: Final = {
    "lateral_stiffness_n_per_mm": 170.0,
    "vertical_stiffness_n_per_mm": 90.0,
    "loss_factor_ratio": 0.3,
}
TRIED: Final = {name: {"value": value, "source": "a test"} for name, value in MOUNTS.items()}
OF_WEIGHT: Final = {"moment": 0.4 * 0.06, "angle": math.radians(200.0), "height": 0.04}
OF_MOUNTS: Final = {"lateral": 170e3, "vertical": 90e3, "loss": 0.3}
EVERY: Final = """const model = vibroacoustics.panel.model;
return model.every({...model.given(0), ...arguments[0]})
  .map((speed) => speed.of.map((one) => [one.total, one.modelled]));"""


def run(floor: Floor | None = None) -> xr.Dataset:
    study = largest_study().replace({"options.weight": WEIGHT})
    if floor is None:
        table = {"kind": "redesign", "change": {"mounts": TRIED}}
        study = study.replace({"options.mounts": table})
    else:
        machine = study.machine.model_copy(update={"floor": floor})
        study = study.model_copy(update={"machine": machine})
    return va.run(study, radiation=lambda study, *_: (vectors_of_a_box(study), False))


def agrees(browser: Chrome, page: Path, results: xr.Dataset, moved: dict[str, Any]) -> None:
    page.write_bytes(page_of(results))
    open_page(browser, page)
    for option, values in moved.items():
        at = results.sel(option=option)
        both = at["level_total"], at["level_modelled"].sel(weighting="A")
        expected = np.stack([one.transpose("speed", "receiver").values for one in both], axis=-1)
        got = np.array(browser.execute_script(EVERY, values))
        np.testing.assert_allclose(got, expected, atol=1e-3)


def size(results: xr.Dataset) -> int:
    """Bytes that the section adds to a page."""
    scripts = unpacking_script() + packed(live_script().encode())
    return len(live_data(results).encode()) + len(scripts.encode()) + len(live_style().encode())


def test_it_is_small_and_agrees_with_the_pipeline(browser, tmp_path):
    results = run()
    assert [results.sizes[name] for name in ("speed", "receiver", "option")] == [5, 10, 8]
    assert size(results) < MOST_BYTES
    agrees(
        browser, tmp_path / "page.html", results,
        {"none": {}, "weight": OF_WEIGHT, "mounts": OF_MOUNTS},
    )  # fmt: skip


def test_so_it_is_on_a_floor_that_gives_way(browser, tmp_path):
    results = run(Floor(mass_kg=60.0, stiffness_n_per_m=5e5, loss_factor_ratio=0.1))
    assert size(results) < MOST_BYTES
    agrees(browser, tmp_path / "page.html", results, {"none": {}, "weight": OF_WEIGHT})
