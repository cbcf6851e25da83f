"""Critical speeds: exact cases, the thesis's figures, another package."""

import csv
from itertools import pairwise

import numpy as np
import pytest
from documents import FORM, ROSS, THESIS
from evidence import claim
from hypothesis import given
from hypothesis import strategies as st
from jeffcott import unbalance_deflection_m
from machine_files import machine_file, values_of
from support import ROOT

from vibroacoustics.base.constants import STANDARD_GRAVITY_M_PER_S2
from vibroacoustics.mechanics.beam_rotor import (
    RotorMatrices,
    Section,
    assemble,
    whirl_frequencies_hz,
    with_disc,
    with_ring,
)
from vibroacoustics.mechanics.critical_speed import (
    forward_critical_speeds,
    on_bearings,
    rule_of_thumb_rpm,
    sag_under_weight_m,
    scroll_shaft_rotor,
)
from vibroacoustics.mechanics.scroll_shaft import ScrollShaft

VALUES = values_of(machine_file("copeland_zp41k3e"))["shaft"]
SHAFT = ScrollShaft(**VALUES)
RPM = 30.0 / np.pi
LENGTH = 0.2
LIGHT = Section(0.02, 2.06e11, 1e-6)
"""Next to no mass: 6e-11 kg, against discs of a kilogram."""
STIFFNESS = LIGHT.youngs_modulus_pa * LIGHT.second_moment_m4


def rows(name):
    with (ROOT / name).open(encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def held(rotor, *freedoms):
    """The rotor without some freedoms' motion; whole nodes only."""
    kept = np.setdiff1d(np.arange(len(rotor.mass)), freedoms)
    at = np.ix_(kept, kept)
    return RotorMatrices(rotor.mass[at], rotor.gyroscopic[at], rotor.stiffness[at])


# --- published -----------------------------------------------------------------------------------


@pytest.mark.parametrize("row", rows("data/validation/thesis_shaft.csv"))
def test_printed_figures(row):
    """Exact arithmetic, to the last digit printed."""
    found = rule_of_thumb_rpm(float(row["deflection_cm"]))
    # Rounded or cut off: within one unit of the last digit.
    claim(
        f"300/√y of the shaft, {row['speed_rpm']} rpm", kind="printed", source=THESIS("6.2"),
        computed=found, reference=float(row["critical_speed_rpm"]), unit="rpm", topics=("shaft",),
        tolerance=float(row["last_digit_rpm"]),
    )  # fmt: skip


def test_printed_deflections_fit_no_critical_speed():
    """y = e ω²/(ω_c² - ω²) grows at least with the speed squared; the printed ones grow less."""
    (fast, slow) = rows("data/validation/thesis_shaft.csv")
    squares = (float(fast["speed_rpm"]) / float(slow["speed_rpm"])) ** 2
    printed = float(fast["deflection_cm"]) / float(slow["deflection_cm"])
    assert printed < squares
    speeds = np.array([3500.0, 2900.0])
    for critical in (4000.0, 20000.0, 1e6):
        ratio = np.divide(*unbalance_deflection_m(1e-5, speeds, critical))
        assert ratio > squares
    # So the rule gives another "critical speed" at another speed or unbalance of the same shaft.
    small, large = (100.0 * unbalance_deflection_m(e, 2900.0, 25000.0) for e in (1e-4, 1e-3))
    assert rule_of_thumb_rpm(small) == pytest.approx(np.sqrt(10.0) * rule_of_thumb_rpm(large))


def test_rule_of_thumb_is_that_of_the_sag():
    """√(g/y) in rpm with y in cm is 299.04/√y."""
    assert RPM * np.sqrt(100.0 * STANDARD_GRAVITY_M_PER_S2) == pytest.approx(299.04, abs=0.005)
    assert rule_of_thumb_rpm(4.0) == 150.0


# --- exact ---------------------------------------------------------------------------------------


def disc_between_bearings(mass, transverse=0.0, axial=0.0):
    rotor = with_disc(assemble(LIGHT, np.linspace(0.0, LENGTH, 5)), 2, mass, transverse, axial)
    return on_bearings(rotor, np.array([0, 4]), 1e15)


@given(st.floats(0.1, 10.0))
def test_jeffcott_rotor(mass):
    """A disc in the middle: 48 EI/l³; its sag gives the same, its tilt does not matter."""
    exact = np.sqrt(48.0 * STIFFNESS / LENGTH**3 / mass)
    # Bearings of 1e15 N/m against a shaft of 1e7 N/m, and rounding of the solver in 20 freedoms of
    # condition 1e11: 1e-6.
    rotor = disc_between_bearings(mass, 1e-4, 2e-4)
    assert forward_critical_speeds(rotor)[0] == pytest.approx(exact, rel=1e-5)
    sag = np.max(sag_under_weight_m(rotor))
    assert np.sqrt(STANDARD_GRAVITY_M_PER_S2 / sag) == pytest.approx(exact, rel=1e-5)


@pytest.mark.parametrize(
    ("transverse", "axial"), [(0.0, 0.0), (2e-3, 1e-3), (1e-3, 1e-3), (5e-4, 1e-3), (2e-4, 4e-4)]
)
def test_overhung_disc(transverse, axial):
    """Clamped light shaft with a disc at its end (Timoshenko's Vibration Problems):

    y = F l³/3EI + M l²/2EI, slope = F l²/2EI + M l/EI, F = mΩ²y, M = (I_d - I_p) Ω² slope.
    """
    mass, bending = 1.5, STIFFNESS
    rotor = with_disc(assemble(LIGHT, np.linspace(0.0, LENGTH, 6)), 5, mass, transverse, axial)
    flexibility = (
        np.array([[LENGTH**3 / 3.0, LENGTH**2 / 2.0], [LENGTH**2 / 2.0, LENGTH]]) / bending
    )
    inverse_squares = np.linalg.eigvals(flexibility @ np.diag([mass, transverse - axial]))
    exact = np.sort(1.0 / np.sqrt(inverse_squares[inverse_squares > 1e-12]))
    found = forward_critical_speeds(held(rotor, 0, 1, 2, 3))
    claim(
        f"Critical speeds with an overhung disc, {transverse:g} and {axial:g} kg m²", kind="exact",
        source=FORM("flexibility of a clamped beam, Timoshenko"), computed=found[: exact.size],
        reference=exact, tolerance=1e-6 * exact, unit="rad/s", topics=("shaft",),
    )  # fmt: skip
    # The rest belongs to the shaft's mass of 6e-11 kg: 1e5 times higher.
    assert np.all(found[exact.size :] > 1e3 * exact[-1])


@pytest.mark.parametrize("diameter", [0.004, 0.02])
def test_simply_supported_shaft(diameter):
    """Rayleigh shaft, forward: Ω² = EI k⁴/(ρA - ρI k²), k = nπ/l; Euler-Bernoulli if slender."""
    section = Section(diameter, 2.06e11, 7850.0)
    rotor = assemble(section, np.linspace(0.0, LENGTH, 41))
    found = forward_critical_speeds(on_bearings(rotor, np.array([0, 40]), 1e15))[:3]
    k = np.arange(1, 4) * np.pi / LENGTH
    bending = section.youngs_modulus_pa * section.second_moment_m4
    density = section.density_kg_per_m3
    inertia = density * (section.area_m2 - section.second_moment_m4 * k**2)
    # Cubic elements: (k h)⁴/1440 = (3π/40)⁴/1440 = 2e-6; bearings: 1e15 N/m against 1e7 N/m.
    exact = np.sqrt(bending * k**4 / inertia)
    claim(
        f"Critical speeds of a simply supported shaft of {1e3 * diameter:g} mm", kind="exact",
        source=FORM("Ω² = EI k⁴/(ρA − ρI k²), Rayleigh shaft"), computed=found, reference=exact,
        tolerance=5e-6 * exact, unit="rad/s", topics=("shaft",),
    )  # fmt: skip
    slender = np.sqrt(bending / (density * section.area_m2)) * k**2
    assert np.all(np.abs(found / slender - 1.0) < 0.05 * (k * diameter) ** 2)


def test_critical_speed_is_where_whirl_meets_rotation():
    """The same from the whirl frequencies at that speed, which know no direction of whirl."""
    rotor = scroll_shaft_rotor(SHAFT)
    for critical in forward_critical_speeds(rotor)[:2]:
        whirl = 2.0 * np.pi * whirl_frequencies_hz(rotor, critical)
        assert np.min(np.abs(whirl / critical - 1.0)) < 1e-8


# --- the thesis's shaft --------------------------------------------------------------------------


def oracle():
    return [row for row in rows("tests/oracles/rotor/results.csv") if row["shear"] == "0"]


@pytest.mark.parametrize("row", oracle())
def test_scroll_shaft_of_another_package(row):
    """ROSS 2.3.0, tests/oracles/rotor; iterated to 1e-8. The motor's rotor is four discs there."""
    diameter, mass = float(row["diameter_m"]), float(row["rotor_kg"]) / 4.0
    discs = 0.065 + 0.085 * (np.arange(4) + 0.5) / 4.0
    fixed = [0.0, *discs, 0.185, 0.220]
    nodes = np.unique(
        np.concatenate(
            [np.linspace(a, b, 1 + int(np.ceil((b - a) / 0.01))) for a, b in pairwise(fixed)]
        )
    )
    rotor = assemble(Section(diameter, 2.06e11, 7850.0), nodes)
    squares = 0.25 * (0.07**2 + diameter**2)
    inertias = mass * (0.25 * squares + (0.085 / 4.0) ** 2 / 12.0), 0.5 * mass * squares
    for disc in discs:
        rotor = with_disc(rotor, int(np.argmin(abs(nodes - disc))), mass, *inertias)
    rotor = with_disc(rotor, nodes.size - 1, float(row["pin_kg"]), 0.0, 0.0)
    bearings = np.array([0, int(np.argmin(abs(nodes - 0.185)))])
    found = forward_critical_speeds(on_bearings(rotor, bearings, float(row["bearing_n_per_m"])))
    expected = [float(row["first"]), float(row["second"])]
    changed = ", ".join(
        f"{float(row[name]):g} {unit}"
        for name, unit in (("diameter_m", "m"), ("bearing_n_per_m", "N/m"), ("rotor_kg", "kg"),
                           ("pin_kg", "kg on the pin"))
    )  # fmt: skip
    claim(
        f"Critical speeds of the scroll's shaft: {changed}", kind="second code",
        source=ROSS("tests/oracles/rotor"), computed=found[:2], reference=expected,
        tolerance=1e-6 * np.array(expected), unit="rad/s", topics=("shaft",),
    )  # fmt: skip


def test_ring_follows_the_shaft():
    """Mass, moments about both ends and the spin's moment of a rigid ring; it has no stiffness."""
    nodes, ends, mass = np.linspace(0.0, LENGTH, 9), (0.05, 0.125), 2.3
    shaft = assemble(LIGHT, nodes)
    ring = with_ring(shaft, nodes, ends, mass, (0.02, 0.07))
    moved = np.zeros((len(ring.mass), 4))
    moved[0::4, 0], moved[1::4, 1] = 1.0, 1.0
    moved[1::4, 2], moved[2::4, 2] = -nodes, 1.0
    moved[0::4, 3], moved[3::4, 3] = nodes, 1.0
    middle, length = np.mean(ends), ends[1] - ends[0]
    squares = 0.25 * (0.02**2 + 0.07**2)
    about_end = mass * (0.25 * squares + length**2 / 12.0 + middle**2)
    got = moved.T @ ring.mass @ moved
    assert np.diag(got) == pytest.approx([mass, mass, about_end, about_end], rel=1e-6)
    assert got[0, 3] == pytest.approx(mass * middle, rel=1e-6)
    assert (moved.T @ ring.gyroscopic @ moved)[2, 3] == pytest.approx(0.5 * mass * squares)
    np.testing.assert_array_equal(ring.stiffness, shaft.stiffness)


def test_scroll_shaft_runs_below_its_critical_speed():
    """The conclusion of the thesis holds at every corner of the assumed ranges."""
    corners = [
        {"diameter_m": d, "bearing_stiffness_n_per_m": k, "rotor_mass_kg": m, "pin_mass_kg": p}
        for d in (0.020, 0.030)
        for k in (1e7, 1e9)
        for m in (1.8, 3.2)
        for p in (0.0, 1.9)
    ]
    speeds = [
        RPM * forward_critical_speeds(scroll_shaft_rotor(SHAFT.model_copy(update=corner)))[0]
        for corner in corners
    ]
    assert min(speeds) > 3.0 * 3500.0


# --- bad input -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"main_bearing_height_m": 0.14}, "main_bearing_height_mm = 140 mm: must be above"),
        ({"main_bearing_height_m": 0.25}, "below the crank pin at 220 mm"),
        ({"rotor_height_m": 0.04}, "reaches below the lower bearing"),
        ({"diameter_m": 0.0}, "greater than 0"),
        ({"bearing_stiffness_n_per_m": float("nan")}, "finite"),
    ],
)
def test_shaft_that_cannot_be(change, message):
    with pytest.raises(ValueError, match=message):
        ScrollShaft(**{**VALUES, **change})
