"""Published numbers of the slider-link compressor (Dagilis et al.), beside ours."""

import csv
from functools import partial

import numpy as np
import pytest
from documents import DAGILIS
from evidence import claim
from slider_link_files import MACHINE_FILE, SPEED, changed_machine
from support import ROOT

from vibroacoustics.base.constants import STANDARD_GRAVITY_M_PER_S2
from vibroacoustics.mechanisms.slider_link.bearing_friction import (
    loaded_coefficient,
    petroff_coefficient,
    thrust_friction_moment,
)
from vibroacoustics.mechanisms.slider_link.machine import SliderLinkMachine
from vibroacoustics.mechanisms.slider_link.motion import SliderLinkCycle, steady_motion
from vibroacoustics.study.loading import load_machine

claimed = partial(claim, kind="printed", topics=("slider-link",))
VALIDATION_FILE = ROOT / "data" / "validation" / "dagilis_slider_link.csv"


def printed() -> dict[str, float]:
    rows = csv.DictReader(
        line for line in VALIDATION_FILE.read_text("utf-8").splitlines() if line[0] != "#"
    )
    return {row["quantity"]: float(row["value"]) for row in rows}


@pytest.fixture(scope="module")
def machine() -> SliderLinkMachine:
    return load_machine(MACHINE_FILE)


@pytest.fixture(scope="module")
def cycle(machine) -> SliderLinkCycle:
    return steady_motion(machine, SPEED, 96)


@pytest.mark.parametrize("which", ["low", "high", "tilted"])
def test_thrust_bearing_power(machine, which):
    """3, 3.8 and 6.8 W at µ = 0.086, 0.108 and 0.194: half of the last digit of power and µ."""
    friction, power = printed()[f"thrust_friction_{which}"], printed()[f"thrust_power_{which}"]
    bearing = machine.bearings.thrust.model_copy(update={"friction_ratio": friction})
    weight = machine.masses.crankshaft_mass_kg * STANDARD_GRAVITY_M_PER_S2
    computed = SPEED * thrust_friction_moment(bearing, weight)
    claimed(
        f"Power of the thrust bearing, friction {which}", source=DAGILIS("section 4 after (24)"),
        computed=computed, reference=power, tolerance=0.05 + power * 0.0005 / friction, unit="W",
    )  # fmt: skip


def test_thrust_powers_belong_to_one_bearing(machine):
    """F R_eff = P / (µ ω) = 0.1135 N m, half of the last digits of P and µ."""
    values = printed()
    for which in ("low", "high", "tilted"):
        friction, power = values[f"thrust_friction_{which}"], values[f"thrust_power_{which}"]
        slack = 0.05 / power + 0.0005 / friction
        assert power / (friction * SPEED) == pytest.approx(0.1135, rel=slack)
    weight = machine.masses.crankshaft_mass_kg * STANDARD_GRAVITY_M_PER_S2
    unit = machine.bearings.thrust.model_copy(update={"friction_ratio": 1.0})
    assert thrust_friction_moment(unit, weight) == pytest.approx(0.1135, abs=5e-5)


def test_displacement(machine):
    area = np.pi / 4.0 * machine.mechanism.bore_m**2
    volume_cm3 = 1e6 * area * 2.0 * machine.mechanism.crank_radius_m
    assert volume_cm3 == pytest.approx(printed()["displacement"], abs=0.05)


def test_oil_pump_power(cycle):
    """At the speed of its power the moment is constant, so is its work: 2.5 W."""
    power = cycle.work_j["oil_pump"] * SPEED / (2.0 * np.pi)
    assert power == pytest.approx(printed()["oil_pump_power"], rel=1e-9)


def test_link_friction_is_below_the_measured_gain(machine, cycle):
    """Without it the paper measured less than 4 W; with its boundary friction it would be 30 W."""
    per_second = SPEED / (2.0 * np.pi)
    assert cycle.work_j["link"] * per_second < printed()["link_loss_gain_below"]
    boundary = changed_machine(mechanism__link_friction_ratio=printed()["boundary_friction_lowest"])
    lost = steady_motion(boundary, SPEED, 96).work_j["link"] * per_second
    assert lost == pytest.approx(30.0, abs=0.5)


def test_friction_without_eccentricity(machine):
    """(20): 0.55 ψ (d/l)^1.5 for a short bearing; at l = d the printed (l/d)^m is the same."""
    values = printed()
    bearing = machine.bearings.lower  # 12 mm long, 16 mm wide
    load, velocity = np.array([300.0]), np.array([SPEED])
    rest = loaded_coefficient(bearing, load, velocity, 0.005) - petroff_coefficient(
        bearing, load, velocity, 0.005
    )
    clearance = bearing.clearance_m / bearing.radius_m
    stretched = (16.0 / 12.0) ** values["short_bearing_exponent"]
    expected = values["eccentricity_free_term"] * clearance * stretched
    claimed(
        "Friction of a short bearing without eccentricity", source=DAGILIS("(20)"), unit="1",
        computed=rest[0], reference=expected, tolerance=1e-6 * expected,
    )  # fmt: skip
