"""Published numbers of the large reciprocating compressor (Tsuji et al. 2012), beside ours."""

import csv
from functools import partial

import numpy as np
import pytest
from documents import APART, TSUJI
from evidence import claim
from machine_files import changed, machine_file
from scipy.optimize import brentq, minimize_scalar
from support import ROOT

from vibroacoustics.mechanisms.reciprocating.cycle import efficiency_map, optimum_bore, steady_cycle
from vibroacoustics.mechanisms.reciprocating.slider_crank import design_at_bore, motion
from vibroacoustics.study.loading import load_machine

MACHINE = load_machine(machine_file("mayekawa_wbhe"))
BORE_M = 0.13
claimed = partial(claim, kind="printed", topics=("reciprocating",))
PRINTED_RADII = {"journal_radius_m": 0.092, "crank_pin_radius_m": 0.09, "piston_pin_radius_m": 0.04}
# The paper's own dynamics: 0.0857 mm taken at its word, and a rod of uniform thickness, m l²/12.
PRINTED_ROD = {
    "small_end_to_centre_m": 0.2999,
    "big_end_to_centre_m": 0.0857e-3,
    "rod_inertia_kg_m2": 3.864 * 0.3**2 / 12.0,
}


def published(quantity: str) -> dict[str, float]:
    """Values of a quantity by where they hold."""
    with (ROOT / "data" / "validation" / "tsuji.csv").open(encoding="utf-8") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return {row["at"]: float(row["value"]) for row in rows if row["quantity"] == quantity}


@pytest.mark.parametrize("speed_rpm", [800, 1000, 1200])
def test_best_efficiency_and_its_bore(speed_rpm):
    """Within 0.4 points and 2 mm: radii, centre of mass and clearance are inferred."""
    bore_m, efficiency = optimum_bore(MACHINE, speed_rpm, 0.10, 0.18)
    claimed(
        f"Best bore at {speed_rpm} rpm", source=TSUJI("3.2, figure 5(c)"), computed=1e3 * bore_m,
        reference=published("optimum bore")[f"{speed_rpm} rpm"], tolerance=2.0, unit="mm",
    )  # fmt: skip
    printed = published("mechanical efficiency")[f"{speed_rpm} rpm"]
    claimed(
        f"Best mechanical efficiency at {speed_rpm} rpm", source=TSUJI("3.2, figure 5(c)"),
        computed=100.0 * efficiency, reference=printed, tolerance=0.4, unit="%",
    )  # fmt: skip


@pytest.mark.parametrize(
    ("speed_rpm", "bore_mm", "percent"),
    [(800.0, 120.0, 86.63), (1000.0, 129.0, 84.63), (1200.0, 138.0, 82.71)],
)
def test_printed_radii_are_no_radii(speed_rpm, bore_mm, percent):
    """Against the same model solved apart from this code: to 0.1 points, and to 1 mm, as it has
    whole ones. The paper prints 92.1, 91.1 and 90.3 %.
    """
    bore_m, efficiency = optimum_bore(
        changed(MACHINE, sliding_pairs=PRINTED_RADII), speed_rpm, 0.10, 0.18
    )
    apart = partial(claimed, kind="second code", source=APART("equations of Tsuji"))
    named = f"at {speed_rpm:g} rpm, radii as printed"
    apart(f"Best bore {named}", computed=1e3 * bore_m, reference=bore_mm, tolerance=1.0, unit="mm")
    apart(f"Efficiency {named}, beside a solution apart", computed=100.0 * efficiency,
          reference=percent, tolerance=0.1, unit="%")  # fmt: skip
    claimed(
        f"Best mechanical efficiency {named}", source=TSUJI("3.2, figure 5(c)"), unit="%",
        computed=100.0 * efficiency, tolerance=0.4,
        reference=published("mechanical efficiency")[f"{speed_rpm:g} rpm"],
        missed="The printed radii of the sliding pairs are diameters",
    )  # fmt: skip
    if speed_rpm == 1000.0:
        assert 100.0 * efficiency == pytest.approx(84.6, abs=0.05)


@pytest.mark.parametrize("bore_mm", [100, 130])
def test_speed_fluctuation_with_one_inertia(bore_mm):
    """Half a unit of the last digit, with the printed centre of mass taken at its word."""
    machine = changed(MACHINE, piston_and_rod=PRINTED_ROD)
    ratio = steady_cycle(machine, 1e-3 * bore_mm, 1000.0).rotation.fluctuation_ratio
    claimed(
        f"Speed fluctuation with a bore of {bore_mm} mm", source=TSUJI("3.2, figure 3(c)"),
        computed=100.0 * ratio, reference=published("speed fluctuation")[f"{bore_mm} mm"],
        tolerance=0.05, unit="%",
    )  # fmt: skip


def test_corrected_rod_does_not_give_both_speed_fluctuations():
    """The inertia that fits 130 mm misses 100 mm by 30 %: the reciprocating end is too heavy."""

    def percent(inertia, bore_mm):
        machine = changed(MACHINE, crankshaft={"inertia_kg_m2": inertia})
        return 100.0 * steady_cycle(machine, 1e-3 * bore_mm, 1000.0).rotation.fluctuation_ratio

    def misses(inertia, bore_mm):
        return percent(inertia, bore_mm) - published("speed fluctuation")[f"{bore_mm} mm"]

    fits = [brentq(misses, 0.1, 0.4, args=(bore,), xtol=1e-4) for bore in (100, 130)]
    assert fits == pytest.approx([0.211, 0.152], abs=5e-4)
    other = percent(fits[1], 100)
    assert other == pytest.approx(10.7, abs=0.05)
    claimed(
        "Speed fluctuation of 100 mm with the corrected rod and the inertia of 130 mm", unit="%",
        source=TSUJI("3.2, figure 3(c)"), computed=other, tolerance=0.05,
        reference=published("speed fluctuation")["100 mm"],
        missed="The paper's own rod has its centre of mass 0.0857 mm off the big end",
    )  # fmt: skip


def test_printed_rod_does_not_give_the_optimum_bore():
    """Taken at its word it moves the best bore by 9 mm; the efficiencies need the corrected one."""
    bore_m, _ = optimum_bore(changed(MACHINE, piston_and_rod=PRINTED_ROD), 1000.0, 0.10, 0.18)
    assert 1e3 * bore_m > published("optimum bore")["1000 rpm"] + 5.0


@pytest.mark.parametrize("bore_m", [0.13, 0.18])
def test_gas_torque_peaks_before_top_dead_centre(bore_m):
    """And with it, for large bores, deceleration and wall friction. The figure is read to 1°."""
    run = steady_cycle(MACHINE, bore_m, 1000.0)
    degrees = np.rad2deg(run.kinematics.crank_angle) - 360.0
    for name, peak in (
        ("gas torque", np.argmax(run.load_torque_n_m["gas"])),
        ("deceleration", np.argmin(run.rotation.acceleration_rad_per_s2)),
        ("wall friction", np.argmax(np.abs(run.friction.wall_n))),
    ):
        printed = published("crank angle of peak gas torque")["all"]
        claimed(
            f"Crank angle of peak {name}, bore of {1e3 * bore_m:g} mm", computed=degrees[peak],
            source=TSUJI("3.2, figures 3(a), 3(d), 4(d)"), reference=printed, tolerance=1.0,
            unit="deg",
        )  # fmt: skip


def test_losses_over_bore():
    """3.2: with a smaller bore the piston pin loses less and the wall more.

    The paper has the least loss of the crank pin near 140 mm; ours is at 127 mm.
    """
    bores = 1e-3 * np.arange(100.0, 181.0, 10.0)
    works = [steady_cycle(MACHINE, bore, 1000.0).load_work_j for bore in bores]
    assert np.all(np.diff([work["piston_pin"] for work in works]) > 0.0)
    assert np.all(np.diff([work["cylinder_wall"] for work in works]) < 0.0)
    least = minimize_scalar(
        lambda bore: steady_cycle(MACHINE, float(bore), 1000.0).load_work_j["crank_pin"],
        bounds=(0.11, 0.15), method="bounded",
    ).x  # fmt: skip
    assert 1e3 * least == pytest.approx(127.0, abs=0.5)
    claimed(
        "Bore of the least loss in the crank pin", source=TSUJI("3.2, figure 5(a)"), unit="mm",
        computed=1e3 * least, reference=published("bore of least crank pin loss")["1000 rpm"],
        tolerance=2.0, missed="Not reproduced with the corrected radii",
    )  # fmt: skip


def test_efficiency_map():
    """One optimum a speed, at larger bores for higher speeds."""
    bores = 1e-3 * np.arange(100.0, 181.0, 10.0)
    efficiency = efficiency_map(MACHINE, [800.0, 1000.0, 1200.0], bores)
    assert efficiency.shape == (3, 9)
    assert bores[np.argmax(efficiency, axis=1)] == pytest.approx([0.12, 0.13, 0.14])
    assert np.all(np.diff(efficiency[:, :3], axis=0) < 0.0)


def test_piston_torque_is_a_misprint_by_ten():
    """m ω² x' x'' of the piston has -71.2 N m at -38.6° for 100 mm; the paper prints -7.5 N m."""
    crank = design_at_bore(MACHINE.piston_and_rod, 0.10)
    moved = motion(crank, np.deg2rad(np.arange(-1800, 1800) / 10.0))
    omega = 2.0 * np.pi * 1000.0 / 60.0
    torque = crank.piston_mass_kg * omega**2 * moved.piston_m[2] * moved.piston_m[1]
    peak = np.argmin(torque)
    assert torque[peak] == pytest.approx(-71.2, abs=0.05)
    assert np.rad2deg(moved.crank_angle[peak]) == pytest.approx(-38.6, abs=0.05)
    printed = published("piston inertia torque")["100 mm"]
    assert printed == pytest.approx(0.1 * torque[peak], rel=0.1)
    claimed(
        "Inertia torque of the piston, bore of 100 mm", source=TSUJI("3.2, figure 3(e)"),
        computed=torque[peak], reference=printed, tolerance=0.5, unit="N m",
        missed="A misprint by ten: about −75",
    )  # fmt: skip


def test_reference_design():
    crank = design_at_bore(MACHINE.piston_and_rod, BORE_M)
    # The displacement is printed to 0.5 cm³ of 1327, 0.04 % of the stroke.
    claimed(
        "Stroke with a bore of 130 mm", source=TSUJI("abstract, 4"), unit="mm",
        computed=2e3 * crank.crank_radius_m, reference=published("stroke")["130 mm"],
        tolerance=4e-4 * 100.0,
    )  # fmt: skip
    assert crank.piston_mass_kg == pytest.approx(2.65)
    assert crank.displacement_m3 == pytest.approx(1327e-6)
