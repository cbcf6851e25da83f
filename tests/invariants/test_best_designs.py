"""Searches find what closed forms say, and the best design keeps what it promises."""

import numpy as np
import pytest
import xarray as xr
from design_studies import study_with
from scipy.optimize import minimize_scalar
from support import made_up_radiation

from vibroacoustics import pipeline
from vibroacoustics.balancers.spring_mass import sprung_mass_response, tuned_mass
from vibroacoustics.base.arrays import ComplexArray
from vibroacoustics.base.constants import REFERENCE_PRESSURE_PA
from vibroacoustics.design.evaluation import evaluating
from vibroacoustics.design.optimising import searched_designs
from vibroacoustics.design.problem import Problem
from vibroacoustics.design.total_change import promise
from vibroacoustics.mechanics.capabilities import OldhamRing

CLOSE_DB = 1e-3
SPEED_RPM = 2900.0
LEFT = "[receivers.left_1m]\nx_mm = -541.3\ny_mm = 937.5\nheight_mm = 230.0\n"
WEIGHT = """
[options.weight]
kind = "counterweight"
mass_g = {mass}
radius_mm = 20.0
angle_deg = {angle}
height_mm = 30.0
"""
SEARCH = """
[design]
option = "weight"
[design.search]
population = 32
generations = 60
fresh_samples = 400
[design.objectives.quiet]
figure = "order_level_db"
order = 1
[design.variables]
"options.weight.mass_g" = { range = [0.001, 200.0] }
"options.weight.angle_deg" = { range = [-180.0, 180.0] }
"""


@pytest.mark.filterwarnings("ignore:.*usual is")  # a weight of nearly nothing
def test_best_counterweight_is_that_of_least_squares() -> None:
    """Pressure at each microphone is linear in the two components of mass times radius."""
    study = study_with(LEFT + WEIGHT.format(mass=50.0, angle=0.0) + SEARCH)
    problem = Problem(study, made_up_radiation)
    found = searched_designs(problem, evaluating(problem))
    level = float(found["wanted_value"].values[int(found["best_design"].values[0]), 0])
    assert level == pytest.approx(_least_squares_level(), abs=CLOSE_DB)


def _least_squares_level() -> float:
    """From three plain runs: without, and with a weight at 0° and at 90°."""
    runs = [
        pipeline.run(
            study_with(LEFT + WEIGHT.format(mass=mass, angle=angle)), radiation=made_up_radiation
        ).sel(option="weight", speed=SPEED_RPM)
        for mass, angle in ((1e-6, 0.0), (100.0, 0.0), (100.0, 90.0))
    ]
    without, *both = (_first_order(run) for run in runs)
    change = np.stack([pressure - without for pressure in both], axis=1)
    rows = np.concatenate([change.real, change.imag])
    given = np.concatenate([without.real, without.imag])
    solution = np.linalg.lstsq(rows, -given, rcond=None)[0]
    left = without + change @ solution
    return float(10.0 * np.log10(np.mean(np.abs(left) ** 2 / 2.0) / REFERENCE_PRESSURE_PA**2))


def _first_order(run: xr.Dataset) -> ComplexArray:
    """Pressure of the 1x line at each microphone, Pa."""
    pressure = run["pressure_line"].sum("sound_source")
    return np.asarray(pressure.isel(line=1).values)


SPRUNG = """
[options.sprung]
kind = "spring-mass"
stiffness_n_per_mm = 3.255
tuned_speed_rpm = 3500.0
damping_ratio = 0.01
height_below_ring_mm = 0.0

[design]
option = "sprung"
[design.search]
population = 24
generations = 40
fresh_samples = 100
[design.objectives.change]
figure = "order_change_db"
order = 1
[design.variables]
"options.sprung.tuned_speed_rpm" = { range = [2500.0, 3500.0] }
"""


@pytest.mark.long
def test_best_sprung_mass_is_tuned_as_its_closed_form() -> None:
    """At the ring's height momentum m_ring + m X2/X1 is all that is left of the 1x line."""
    study = study_with(SPRUNG)
    problem = Problem(study, made_up_radiation)
    found = searched_designs(problem, evaluating(problem))
    row = int(found["best_design"].values[0])
    ring = study.machine.require(OldhamRing).mass_kg
    turning = 2.0 * np.pi * SPEED_RPM / 60.0

    def left(tuned_rpm: float) -> float:
        mass = tuned_mass(3255.0, ring, 2.0 * np.pi * tuned_rpm / 60.0)
        return abs(1.0 + mass / ring * sprung_mass_response(mass, 3255.0, 0.01, turning))

    best = minimize_scalar(left, bounds=(2860.0, 3500.0), method="bounded",
                           options={"xatol": 1e-6})  # fmt: skip
    assert found["design_value"].values[row, 0] == pytest.approx(best.x, rel=1e-4)
    assert found["wanted_value"].values[row, 0] == pytest.approx(
        20.0 * np.log10(best.fun), abs=CLOSE_DB
    )


def test_promise_of_a_robust_design_is_kept_by_fresh_pieces() -> None:
    """0.9-quantile of ten thousand pieces, beside that of ten thousand others: within 0.05 dB."""
    tolerances = (
        "[design.tolerances]\n"
        '"options.weight.mass_g" = { ratio = 0.03 }\n'
        '"options.weight.angle_deg" = { plus_minus = 5.0 }\n'
        '"options.weight.radius_mm" = { plus_minus = 2.0 }\n'
    )
    study = study_with(LEFT + WEIGHT.format(mass=50.0, angle=0.0) + SEARCH + tolerances)
    problem = Problem(study, made_up_radiation)
    found = searched_designs(problem, evaluating(problem))
    design = problem.space.limits[:, 0] * 0.0 + (
        found["design_value"].values[int(found["best_design"].values[0])]
        * np.array([variable.factor for variable in problem.space.variables])
    )
    promised = promise(problem, design, 10_000)
    others = problem.by_sample(design[None], problem.samples(10_000, 2))[0, :, 0]
    assert np.quantile(others, 0.9) == pytest.approx(promised.promised[0], abs=0.05)
    assert promised.promised[0] > promised.meant[0]
    assert promised.low[0] <= promised.promised[0] <= promised.high[0]
