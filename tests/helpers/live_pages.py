"""Runs whose page moves, and what its sliders must show."""

import math
from pathlib import Path
from typing import Any, Final

import numpy as np
import xarray as xr
from selenium.webdriver import Chrome
from support import PIPELINES, labelled_vectors, made_up_transfer_vectors

import vibroacoustics as va
from vibroacoustics.levels.measured_points import BASELINE_BANDS
from vibroacoustics.machine.floor import Floor
from vibroacoustics.report.analysis import Analysis
from vibroacoustics.report.blocks import Part, Text
from vibroacoustics.report.sections import SECTIONS

WEIGHT: Final = {
    "kind": "counterweight",
    "mass_g": 12.0,
    "radius_mm": 25.0,
    "angle_deg": 200.0,
    "height_mm": 40.0,
}
MOUNTS: Final = {
    "lateral_stiffness_n_per_mm": 31.0,
    "vertical_stiffness_n_per_mm": 38.0,
    "loss_factor_ratio": 0.24,
}
TRIED: Final = {
    name: {"value": value, "source": "tried on the report's page"} for name, value in MOUNTS.items()
}
OTHERS: Final = (
    "pendulum-side", "spring-mass", "spring-mass-printed", "damping", "counterweight-half",
)  # fmt: skip
GAIN: Final = 30.0
"""Of the made-up radiation: the moving parts are heard beside the remainder."""


def thesis_study(values: dict[str, Any]) -> va.Study:
    """The thesis's machine with few options and other values."""
    study = va.load_study(PIPELINES / "copeland_thesis.toml")
    asked = {f"options.{name}": None for name in OTHERS} | {"operation.maximum_order": 6} | values
    return study.replace(asked)


def thesis_run(values: dict[str, Any]) -> xr.Dataset:
    """Of `thesis_study`, radiation made up."""
    return run_loudly(thesis_study(values))


def run_loudly(study: va.Study) -> xr.Dataset:
    """A run with made-up radiation of such a gain that lines are heard."""
    return va.run(study, radiation=lambda study, *_: (made_up_transfer_vectors(study, GAIN), False))


def sliders_run() -> xr.Dataset:
    """With what the sliders reach as options."""
    return thesis_run(
        {
            "options.weight": WEIGHT,
            "options.mounts": {"kind": "redesign", "change": {"mounts": TRIED}},
        }
    )


def both_run() -> xr.Dataset:
    """With weight and mounts at once: of the machine the mounts, as an option the weight."""
    mounts = {f"machine.mounts.{name}": value for name, value in TRIED.items()}
    return thesis_run(mounts | {"options.weight": WEIGHT})


def baseline_run(folder: Path) -> xr.Dataset:
    """With what the sliders reach as options, over orders with and without phase and bands."""
    orders = [
        f"front_1m,2900,{order},{level},{phase}"
        for order, level, phase in ((1, 74.0, 40), (2, 60.0, ""), (3, 50.0, -70), (9, 41.0, ""))
    ]
    quiet = {band.nominal_hz: 20.0 for band in BASELINE_BANDS if band.nominal_hz > 40.0}
    levels = quiet | {50.0: 74.5, 100.0: 62.0, 160.0: 51.0, 400.0: 42.0}
    bands = [f"front_1m,2900,{hertz:g},{level}" for hertz, level in levels.items()]
    heads = {"orders": "order,level_db,phase_deg", "thirds": "band_hz,level_db"}
    for (name, head), rows in zip(heads.items(), (orders, bands), strict=True):
        (folder / f"{name}.csv").write_text("\n".join([f"microphone,speed_rpm,{head}", *rows]))
    return thesis_run(
        {
            "options.weight": WEIGHT,
            "options.mounts": {"kind": "redesign", "change": {"mounts": TRIED}},
            "measured.baseline": {
                "file": [str(folder / "orders.csv"), str(folder / "thirds.csv")],
                "tacho_angle_deg": 0.0,
            },
        }
    )


def floor_run() -> xr.Dataset:
    """With a weight, on a floor that gives way."""
    study = thesis_study({"options.weight": WEIGHT})
    floor = Floor(mass_kg=20.0, stiffness_n_per_m=5e5, loss_factor_ratio=0.1)
    machine = study.machine.model_copy(update={"floor": floor})
    return run_loudly(study.model_copy(update={"machine": machine}))


def vectors_of_a_box(study: va.Study) -> xr.Dataset:
    """Pressure of a box of 216 monopoles in front of a hard floor and a wall, without diffraction.

    ρ jω exp(-jkr)/(4πr) of each and of its images, by the velocity along its normal: delays, growth
    and interference are those of a machine; the box is off the origin, so that nothing is equal.
    """
    size, offset = np.array([0.5, 0.4, 0.8]), np.array([0.03, -0.02, 0.05])
    across = (np.arange(6) + 0.5) / 6.0 - 0.5
    sides = [(axis, sign) for axis in range(3) for sign in (-0.5, 0.5)]
    unit = np.array(
        [np.insert([a, b], axis, sign) for axis, sign in sides for a in across for b in across]
    )
    normal = np.where(np.abs(unit) == 0.5, np.sign(unit), 0.0)
    point, area = unit * size + offset, size.prod() / (np.abs(normal) @ size) / 36.0
    flow = area[:, None] * np.hstack([normal, np.cross(point, normal)])
    floor, wall = point * [1, 1, -1] - [0, 0, 1.1], point * [-1, 1, 1] - [2.0, 0, 0]
    frequency = np.arange(25.0, study.radiation.maximum_frequency_hz + 1.0, 25.0)
    to = np.array([[r.x_m, r.y_m, r.height_m - 0.5] for r in study.receivers.values()])
    values = np.zeros((len(to), 6, frequency.size), dtype=complex)
    for source in (point, floor, wall):
        distance = np.linalg.norm(to[:, None] - source, axis=-1)[..., None]
        wave = np.exp(-2j * np.pi * frequency / 343.0 * distance) / (4.0 * np.pi * distance)
        values += np.einsum("rpf,pd->rdf", wave, flow) * 1.2 * 2j * np.pi * frequency
    return labelled_vectors(study, values, np.linalg.norm(to, axis=-1))


def largest_study() -> va.Study:
    """Five speeds, ten microphones, 40 orders, six options: the reciprocating machine.

    Its shaft's speed varies: every order is loaded.
    """
    around = {
        f"receivers.m{number}": {"x_mm": 1500.0, "y_mm": 100.0 * number, "height_mm": 500.0}
        for number in range(7)
    }
    changed = {
        "operation.speed_rpm": [600.0, 650.0, 700.0, 750.0, 800.0],
        "operation.maximum_order": 40,
        "radiation.maximum_frequency_hz": 1000.0,
        **around,
    }
    return va.load_study(PIPELINES / "mayekawa_wbhe.toml").replace(changed)


def page_of(results: xr.Dataset) -> bytes:
    """A page of the section that moves and one that does not."""
    still = Part("still", "Still", (Text("This stands still."),))
    section = SECTIONS["live"]
    live = Part(section.name, section.title, tuple(section.blocks(results)), section.folded)
    return Analysis("page", "Sliders", "machine", "2026-01-01", "About.", (still, live)).html()


READY: Final = """const done = arguments[0];
const wait = () => (window.vibroacoustics ? done() : setTimeout(wait, 5));
wait();"""


def open_page(browser: Chrome, page: Path) -> None:
    """Open a page and wait for its sliders."""
    browser.get(page.as_uri())
    browser.execute_async_script(READY)


OF_WEIGHT: Final = {"moment": 0.012 * 0.025, "angle": math.radians(200.0), "height": 0.04}
OF_MOUNTS: Final = {"lateral": 31e3, "vertical": 38e3, "loss": 0.24}
"""What sliders say, in SI, where they stand as `WEIGHT` and `MOUNTS`."""
