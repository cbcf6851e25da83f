"""Gas forces of the scroll: published numbers, laws, a second method, the thesis's program."""

import csv
from functools import partial
from pathlib import Path

import numpy as np
import pytest
import thesis_appendix_a
from documents import APART, FORM, PDSIM, SECOND, THESIS
from evidence import claim
from hypothesis import given, settings
from hypothesis import strategies as st
from machine_files import machine_of
from scroll_closed_forms import (
    built_in_pressure_pa,
    built_in_volume_ratio,
    compression_work_j,
    displacement_m3,
)
from scroll_flanks import (
    INNER,
    OUTER,
    Position,
    axial_force,
    chamber_pressures,
    closed_area,
    force_and_moment,
)
from scroll_openings import WRAPS
from support import ROOT

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.mechanics.rotation import uniform_crank_angle
from vibroacoustics.orders import order_spectrum
from vibroacoustics.sources.scroll_gas.cycle import ScrollGasCycle, scroll_gas_cycle
from vibroacoustics.sources.scroll_gas.parameters import (
    ScrollGas,
    ScrollWraps,
    area_inside,
    contact_angle,
    pocket_volume,
)
from vibroacoustics.sources.scroll_gas.suction import (
    pocket_pressure,
)

claimed = partial(claim, topics=("scroll-gas",))
UNITS = {"force": "N", "torque": "N m", "order": "N m", "revolution": "J"}
VALIDATION_FILE = ROOT / "data" / "validation" / "scroll_gas.csv"
CASES = ["15 to 41.159 bar", "6.78 to 30.7 bar"]
OTHER_WRAPS = ScrollWraps(
    base_radius_m=3e-3,
    height_m=0.02,
    thickness_m=4.4e-3,
    start_angle_rad=2.0,
    turns=2.3,
    closing_crank_angle_rad=-1.0,
)
HALF_DEGREES = uniform_crank_angle(720)
FINE = uniform_crank_angle(36000)


def published(case: str) -> dict[str, tuple[float, float]]:
    """Value and half a unit of its last digit, by quantity."""
    with VALIDATION_FILE.open(encoding="utf-8") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        printed = {row["quantity"]: row["value"] for row in rows if row["case"] == case}
    decimals = {name: len(text.partition(".")[2]) for name, text in printed.items()}
    return {name: (float(text), 0.5 * 10.0 ** -decimals[name]) for name, text in printed.items()}


def gas_of(case: str) -> ScrollGas:
    suction, discharge = (float(word) for word in case.removesuffix(" bar").split(" to "))
    return ScrollGas(
        suction_pressure_pa=1e5 * suction,
        discharge_pressure_pa=1e5 * discharge,
        polytropic_index=published(case)["polytropic index"][0],
    )


GAS = gas_of(CASES[0])


def figures(cycle: ScrollGasCycle) -> dict[str, float]:
    """The figures of data/validation/scroll_gas.csv."""
    orders = np.abs(order_spectrum(cycle.torque_n_m, 4))
    tangential = cycle.tangential_force_n
    return {
        "mean tangential force": float(tangential.mean()),
        "smallest tangential force": float(tangential.min()),
        "largest tangential force": float(tangential.max()),
        "radial force": float(cycle.radial_force_n.mean()),
        "mean torque": float(cycle.torque_n_m.mean()),
        **{f"torque order {order}": float(orders[order]) for order in range(1, 5)},
        "work per revolution": float(2.0 * np.pi * cycle.torque_n_m.mean()),
    }


def unit_of(name: str) -> str:
    """Unit of a figure by a word of its name."""
    return next(unit for word, unit in UNITS.items() if word in name)


# --- published numbers ---------------------------------------------------------------------------


@pytest.mark.parametrize("case", CASES)
def test_forces_and_torque_orders_are_the_published_ones(case):
    """Within 1 %, for the finer step and the second case's derived index, and half a last digit."""
    printed = published(case)
    found = figures(scroll_gas_cycle(WRAPS, gas_of(case), FINE))
    for name in printed.keys() & found.keys():
        value, rounding = printed[name]
        claimed(
            f"Gas of the scroll: {name}, {case}", kind="second code", unit=unit_of(name),
            source=APART("F_t = 2 r_b h Σ Δp t"), computed=found[name], reference=value,
            tolerance=0.01 * value + rounding,
        )  # fmt: skip


def test_first_case_is_reproduced_to_every_digit_with_steps_of_half_a_degree():
    """The opening falls on a sample; the published numbers have that step.

    The largest force and the fourth order show it: with fine steps 3347 N and 0.0526 N m.
    """
    found = figures(scroll_gas_cycle(WRAPS, GAS, HALF_DEGREES))
    printed = published(CASES[0])
    for name, value in found.items():
        claimed(
            f"Gas of the scroll: {name}, steps of half a degree", kind="second code",
            source=APART("F_t = 2 r_b h Σ Δp t"), computed=value, reference=printed[name][0],
            tolerance=printed[name][1], unit=unit_of(name),
        )  # fmt: skip


def test_geometry_is_the_published_one():
    printed = published("geometry")
    found = {
        "displacement": 1e6 * displacement_m3(WRAPS),
        "orbit radius": 1e3 * WRAPS.orbit_radius_m,
        "built-in volume ratio": built_in_volume_ratio(WRAPS),
        "opening to the discharge": np.degrees(WRAPS.opening_angle_rad),
    }
    for name, (value, rounding) in printed.items():
        # The thickness is printed to 0.5 µm of 3.46 mm of orbit radius: 1.5e-4. It is derived from
        # the displacement, which and the orbit radius are therefore no evidence.
        if name in ("displacement", "orbit radius"):
            assert found[name] == pytest.approx(value, rel=1.5e-4, abs=rounding), name
            continue
        of_thesis = name == "opening to the discharge"
        claimed(
            f"Geometry of the scroll: {name}", kind="printed" if of_thesis else "exact",
            source=THESIS("6.1") if of_thesis else FORM("9π/(2 π/3 + 3π)"),
            computed=found[name], reference=value, tolerance=max(1.5e-4 * value, rounding),
            unit="deg" if of_thesis else "1",
        )  # fmt: skip


@pytest.mark.parametrize("wraps", [WRAPS, OTHER_WRAPS])
def test_displacement_and_volume_ratio_are_those_of_a_scroll_library(wraps):
    """PDSim (I. Bell), scroll/core.py, `Vdisp` and `Vratio` of flanks that begin at -a and a."""
    span = 2.0 * wraps.end_angle_rad - 3.0 * np.pi
    area = 2.0 * np.pi * wraps.base_radius_m * wraps.orbit_radius_m
    name = f"wraps of {1e3 * wraps.base_radius_m:g} mm"
    volume = area * wraps.height_m * span
    claimed(
        f"Displacement, {name}", kind="second code", source=PDSIM("Vdisp"), unit="m³",
        computed=displacement_m3(wraps), reference=volume, tolerance=1e-14 * volume,
    )  # fmt: skip
    ratio = span / (2.0 * wraps.start_angle_rad + 3.0 * np.pi)
    claimed(
        f"Built-in volume ratio, {name}", kind="second code", source=PDSIM("Vratio"), unit="1",
        computed=built_in_volume_ratio(wraps), reference=ratio, tolerance=1e-14 * ratio,
    )  # fmt: skip


def test_thesis_names_the_closing_and_the_opening():
    """Section 6.1: four pockets from about 90° to 210°, in steps of 8°."""
    opening = np.degrees(WRAPS.closing_crank_angle_rad + WRAPS.opening_angle_rad) % 360.0
    claimed(
        "Crank angle at which a pocket opens", kind="printed", source=THESIS("6.1"), unit="deg",
        computed=opening, reference=210.0, tolerance=2.1e-4,
    )  # fmt: skip


# --- laws ----------------------------------------------------------------------------------------

wraps_strategy = st.builds(
    lambda base, height, share, start, turns, closing: ScrollWraps(
        base_radius_m=base,
        height_m=height,
        thickness_m=share * np.pi * base,
        start_angle_rad=0.5 * share * np.pi + start,
        turns=1.5 + (0.5 * share * np.pi + start) / (2.0 * np.pi) + turns,
        closing_crank_angle_rad=closing,
    ),
    st.floats(1e-3, 1e-2),
    st.floats(5e-3, 0.1),
    st.floats(0.0, 0.9),
    st.floats(1e-3, 4.0),
    st.floats(0.05, 3.0),
    st.floats(-6.0, 6.0),
)
gas_strategy = st.builds(
    lambda suction, ratio, index: ScrollGas(
        suction_pressure_pa=suction, discharge_pressure_pa=suction * ratio, polytropic_index=index
    ),
    st.floats(1e5, 3e6),
    st.floats(1.1, 8.0),
    st.floats(1.01, 1.6),
)


@settings(max_examples=25, deadline=None)
@given(wraps_strategy, gas_strategy)
def test_work_per_revolution_is_the_closed_form(wraps, gas):
    """Over- and under-compression included.

    A sample's share of the revolution at the step, 2π/36000 of it, is uncertain by half; the rest
    is smooth and good to that squared.
    """
    cycle = scroll_gas_cycle(wraps, gas, FINE)
    step = abs(gas.discharge_pressure_pa - built_in_pressure_pa(wraps, gas))
    force = 4.0 * np.pi * wraps.base_radius_m * wraps.height_m * step
    allowed = 2.0 * np.pi / FINE.size * force * wraps.orbit_radius_m
    work = 2.0 * np.pi * float(cycle.torque_n_m.mean())
    assert work == pytest.approx(compression_work_j(wraps, gas), rel=1e-6, abs=allowed)


def test_work_is_least_where_pocket_and_discharge_meet():
    matched = GAS.model_copy(update={"discharge_pressure_pa": built_in_pressure_pa(WRAPS, GAS)})
    n, ratio = GAS.polytropic_index, matched.discharge_pressure_pa / GAS.suction_pressure_pa
    ideal = ratio ** ((n - 1.0) / n) - 1.0
    ideal *= n / (n - 1.0) * GAS.suction_pressure_pa * displacement_m3(WRAPS)
    assert compression_work_j(WRAPS, matched) == pytest.approx(ideal, rel=1e-13)


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
def test_tangential_and_radial_force_do_not_depend_on_the_thickness(share):
    """Up to 60 % of half the pitch; at two thirds the flanks would begin inside the base circle."""
    thin = WRAPS.model_copy(update={"thickness_m": 0.0})
    thick = WRAPS.model_copy(
        update={"thickness_m": share * 2.0 / 3.0 * np.pi * WRAPS.base_radius_m}
    )
    one, other = (scroll_gas_cycle(wraps, GAS, HALF_DEGREES) for wraps in (thin, thick))
    assert other.tangential_force_n == pytest.approx(one.tangential_force_n, rel=1e-12)
    assert other.radial_force_n == pytest.approx(one.radial_force_n, rel=1e-12)


def test_radial_force_is_that_of_the_two_pressures_alone():
    cycle = scroll_gas_cycle(WRAPS, GAS, HALF_DEGREES)
    rise = GAS.discharge_pressure_pa - GAS.suction_pressure_pa
    expected = 2.0 * WRAPS.base_radius_m * WRAPS.height_m * rise
    assert cycle.radial_force_n == pytest.approx(np.full(720, expected), rel=1e-12)


def test_pressure_falls_and_rises_to_the_discharge_when_a_pocket_opens():
    opening = WRAPS.opening_angle_rad
    for case, sign in zip(CASES, (-1.0, 1.0), strict=True):
        gas = gas_of(case)
        before, after = pocket_pressure(WRAPS, gas, np.array([opening - 1e-6, opening]))
        assert before == pytest.approx(built_in_pressure_pa(WRAPS, gas), rel=1e-6)
        assert after == gas.discharge_pressure_pa
        assert np.sign(after - before) == sign


def test_pair_of_forces_has_no_resultant_and_no_moment_and_does_the_work():
    cycle = scroll_gas_cycle(WRAPS, GAS, HALF_DEGREES)
    orbiting, angle = cycle.on_orbiting_scroll_n, cycle.crank_angle
    assert np.all(orbiting + cycle.on_fixed_scroll_n == 0.0)
    # Power on the orbiting scroll, which circles counter-clockwise, is that of -T on the shaft.
    velocity = cycle.orbit_radius_m * np.stack([-np.sin(angle), np.cos(angle)])
    power = np.sum(orbiting[:2] * velocity, axis=0)
    assert power == pytest.approx(-cycle.torque_n_m, rel=1e-12)
    # Moment about the orbiting scroll's own axis, from the line of action.
    arm = cycle.line_of_action_m - cycle.orbit_radius_m * np.stack([np.cos(angle), np.sin(angle)])
    moment = arm[0] * orbiting[1] - arm[1] * orbiting[0]
    assert moment == pytest.approx(cycle.self_rotation_moment_n_m, rel=1e-12)
    assert np.all(orbiting[2] < 0.0)


def test_area_inside_grows_by_gas_and_wraps_from_contact_to_contact():
    """From one contact to the next outwards: two pockets and a turn of both wraps."""
    contact = contact_angle(WRAPS, np.array([0.7, 0.7 + 2.0 * np.pi]))
    larger, smaller = area_inside(WRAPS, contact)
    pockets = 2.0 * float(pocket_volume(WRAPS, np.array(0.7))) / WRAPS.height_m
    # Thickness times length of the middle over the turn whose ends are the tips' middles.
    mean = contact[0] - np.pi
    wraps = 2.0 * WRAPS.thickness_m * WRAPS.base_radius_m * 2.0 * np.pi * mean
    assert larger - smaller == pytest.approx(pockets + wraps, rel=1e-12)


# --- a second method -----------------------------------------------------------------------------

FLANKS = 2e-6
"""Relative. A polygon of 20 000 points over 17.8 rad lies (9e-4)²/8 = 1e-7 of the radius of
curvature off its arcs, and so the contacts that are fitted to its gaps are found to 2e-7 rad. That
moves the force by as much of the tangential one, which is up to 9 times the radial one: 1.8e-6."""


@pytest.mark.parametrize(
    ("wraps", "gas", "degrees"),
    [
        (WRAPS, GAS, 20.0),
        (WRAPS, gas_of(CASES[1]), 95.0),
        (WRAPS, GAS, 150.0),
        (WRAPS, gas_of(CASES[1]), 340.0),
        (OTHER_WRAPS, GAS, 100.0),
        (WRAPS.model_copy(update={"thickness_m": 5e-4}), GAS, 60.0),
    ],
)
def test_pressure_integrated_along_the_flanks_gives_the_same(wraps, gas, degrees):
    crank_angle = wraps.closing_crank_angle_rad + np.radians(degrees)
    position, closed = Position(wraps, crank_angle), closed_area(wraps)
    pressure = {side: chamber_pressures(position, gas, side, closed) for side in (INNER, OUTER)}
    force, moment, _ = force_and_moment(position, pressure)
    cycle = scroll_gas_cycle(wraps, gas, np.array([crank_angle]))
    along_crank = force / np.exp(1j * crank_angle)
    figures = {
        "tangential": (-along_crank.imag, cycle.tangential_force_n[0]),
        "radial": (-along_crank.real, cycle.radial_force_n[0]),
        "moment": (moment, cycle.self_rotation_moment_n_m[0]),
        "axial": (axial_force(position, pressure), cycle.axial_force_n[0]),
    }
    flanks, ours = np.array(list(figures.values())).T
    named = f"crank angle of {degrees:g}°, thickness of {1e3 * wraps.thickness_m:g} mm"
    claimed(
        f"Gas forces by pressure along the flanks, {named}", kind="second code", unit="1",
        source=SECOND("polygon of 20 000 points, scroll_flanks"), computed=ours / flanks,
        reference=1.0, tolerance=FLANKS,
    )  # fmt: skip
    x, y, _ = cycle.on_orbiting_scroll_n[:, 0]
    assert abs(force - complex(x, y)) < FLANKS * abs(force)


@pytest.mark.parametrize("degrees", [40.0, 200.0])
def test_uniform_pressure_gives_no_force_and_no_moment(degrees):
    """Against parts of 150 N to 1.9 kN on flanks and faces; and adding one changes nothing."""
    position = Position(WRAPS, WRAPS.closing_crank_angle_rad + np.radians(degrees))
    closed = closed_area(WRAPS)
    pressure = {side: chamber_pressures(position, GAS, side, closed) for side in (INNER, OUTER)}
    uniform = {side: np.full_like(pressure[side], 15e5) for side in pressure}
    force, moment, parts = force_and_moment(position, uniform)
    assert min(abs(part) for part in parts) > 100.0
    # Rounding of 40 000 coordinates at 3e-18 m each, times 15 bar and 30 mm, adds up to 5e-9 N at
    # worst and to 200 times less where it is random.
    assert abs(force) < 1e-10
    assert abs(moment) < 1e-12
    raised = {side: pressure[side] + 100e5 for side in pressure}
    difference = force_and_moment(position, raised)[0] - force_and_moment(position, pressure)[0]
    assert abs(difference) < 1e-8


# --- the thesis's program ------------------------------------------------------------------------


@pytest.fixture(scope="module")
def appendix_a():
    return thesis_appendix_a.appendix_a_force()


def test_appendix_a_as_printed(appendix_a):
    """Against the program itself, run by GNU Octave 7.3 on the printed text, in bar m."""
    printed = published("appendix A")
    crank_angle, force = appendix_a
    size = np.hypot(*force)
    for name, ours in (("smallest", size.min()), ("largest", size.max())):
        claimed(
            f"Appendix A as printed: {name} force", kind="second code", unit="bar m", computed=ours,
            source=APART("program of appendix A, GNU Octave 7.3"), tolerance=0.005,
            reference=printed[f"{name} force"][0],
        )  # fmt: skip
    octave = {
        0: (0.01086901791, 5.422471967),
        12: (-5.287948367, -0.544444843),
        26: (2.774103545, -5.23794325),
        27: (3.425877771, -4.732176026),
        45: (0.01086901791, 5.422471967),
    }
    assert crank_angle.shape == (46,)
    for index, components in octave.items():
        assert force[:, index] == pytest.approx(components, rel=1e-9), index  # ten digits shown


def test_appendix_a_points_the_right_way_and_is_five_to_six_times_too_large(appendix_a):
    """The right force, of wraps without thickness, turns alike once a revolution."""
    crank_angle, force = appendix_a
    thin = WRAPS.model_copy(update={"thickness_m": 0.0})
    right = scroll_gas_cycle(thin, GAS, crank_angle).on_fixed_scroll_n[:2]
    newton = force * 1e5 * WRAPS.height_m
    ratio = np.hypot(*newton) / np.hypot(*right)
    assert 5.0 < ratio.min() < ratio.max() < 6.0
    claimed(
        "Gas force of appendix A over the right one", kind="printed", source=THESIS("appendix A"),
        computed=ratio.min(), reference=1.0, tolerance=0.01, unit="1",
        missed="Lengths that diverge with the step, areas 26 % too large, twice the displacement",
    )  # fmt: skip
    turned = np.angle((newton[0] + 1j * newton[1]) / (right[0] + 1j * right[1]))
    assert np.max(np.abs(turned)) < np.radians(10.0)


def test_faults_of_appendix_a_are_as_stated(appendix_a):
    """Lengths that diverge as the step shrinks; areas 26 % too large; twice the displacement."""
    radius = thesis_appendix_a.BASE_RADIUS_M

    def length(degrees: float) -> float:
        """Sum of l1 over the half turns 270° to 450° and 630° to 810° of crank angle 0."""
        total = 0.0
        for start in (270.0, 630.0):
            t = np.radians(start + degrees * np.arange(round(180.0 / degrees) + 2))
            total += float(np.sum(np.sqrt(np.abs(np.diff(radius**2 * (1.0 + t**2))))))
        return total

    # Three digits: 0.440 m at 1°, 1.397 m at 0.1°, true 0.127 m.
    assert length(1.0) == pytest.approx(0.440, abs=0.0005)
    assert length(0.1) == pytest.approx(np.sqrt(10.0) * length(1.0), rel=0.01)
    thin = WRAPS.model_copy(update={"thickness_m": 0.0})
    largest = float(pocket_volume(thin, np.zeros(()))) / thin.height_m
    area = published("appendix A")["largest area"][0]
    assert area / largest == pytest.approx(1.26, abs=0.005)
    printed = published("no thickness")["displacement"]
    claimed(
        "Displacement of wraps without thickness", kind="exact", unit="cm³",
        source=FORM("2π r_b (π r_b) h 9π"), computed=1e6 * displacement_m3(thin),
        reference=printed[0], tolerance=printed[1],
    )  # fmt: skip


def test_force_angle_of_figure_20_jumps_by_the_arc_tangent_alone(appendix_a):
    """Printed: from -90° to 90° over each half turn, with a jump between. The force itself turns
    once a revolution, with the crank, and never by more than 15° more or less than it."""
    crank_angle, (x, y) = appendix_a
    printed = np.degrees(np.arctan(y / x))
    jumps = np.flatnonzero(np.diff(printed) < -100.0)
    assert jumps.size == 2
    apart = np.degrees(np.diff(crank_angle[jumps])).item()
    assert apart == pytest.approx(180.0, abs=8.0)  # the program's step
    turned = np.unwrap(np.arctan2(y, x))
    assert turned[-1] - turned[0] == pytest.approx(2.0 * np.pi, abs=1e-9)
    assert np.all(np.diff(turned) > 0.0)
    assert np.ptp(turned - crank_angle) < np.radians(15.0)


@pytest.mark.parametrize("side", [INNER, OUTER])
def test_flanks_slide_on_one_another(side):
    """4.2: 'pure rolling with no sliding'. Rolling would pass equal lengths of both flanks; they
    differ by r Δθ, the way of the orbiting scroll: 1.05 m/s at 2900 rpm, 21 mm a turn."""
    step = 0.5
    one, later = Position(WRAPS, 1.0), Position(WRAPS, 1.0 + step)
    (at, foot), (at_later, foot_later) = one.touching[side][0], later.touching[side][0]

    def length(flank, first, last):
        return float(np.sum(np.abs(np.diff(flank.between(first, last)))))

    passed = length(one.orbiting[side], at, at_later)
    on_fixed = length(one.fixed[-side], foot, foot_later)
    slid = abs(on_fixed - passed)
    assert slid == pytest.approx(WRAPS.orbit_radius_m * step, rel=1e-3)
    assert slid > 0.05 * min(passed, on_fixed)
    speed = slid / step * 2900.0 * np.pi / 30.0
    assert speed == pytest.approx(1.05, abs=0.005)


# --- bad input -----------------------------------------------------------------------------------

WRAPS_TABLE = {
    "base_radius_mm": 2.15,
    "height_mm": 30.0,
    "thickness_mm": 3.293,
    "start_angle_deg": 60.0,
    "turns": 3.0,
    "closing_crank_angle_deg": 90.0,
}
GAS_TABLE = {
    "suction_pressure_bar": 15.0,
    "discharge_pressure_bar": 41.159,
    "polytropic_index": 1.1558,
}


def sourced(table: dict[str, float]) -> dict[str, object]:
    return {key: {"value": value, "source": "test"} for key, value in table.items()}


def test_tables_of_a_machine_file_give_the_same_parameters():
    path = Path("machine.toml")
    wraps = machine_of(sourced(WRAPS_TABLE), path, ScrollWraps)
    assert wraps.model_dump() == pytest.approx(WRAPS.model_dump(), rel=1e-15)
    gas = machine_of(sourced(GAS_TABLE), path, ScrollGas)
    assert gas.model_dump(exclude_defaults=True) == pytest.approx(
        GAS.model_dump(exclude_defaults=True), rel=1e-15
    )


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"thickness_mm": 6.8}, ["thickness_mm = 6.8 mm", "below", "6.75442 mm"]),
        ({"start_angle_deg": 40.0}, ["start_angle_deg = 40°", "at least", "43.8779°"]),
        ({"turns": 1.6}, ["turns = 1.6", "exceed 1.66667", "no pocket"]),
        ({"base_radius_mm": 0.0}, ["base_radius_mm = 0", "mm"]),
        ({"height_mm": float("nan")}, ["height_mm"]),
        ({"pitch_mm": 13.0}, ["pitch_mm"]),
    ],
)
def test_impossible_wraps_are_refused(changed, words):
    with pytest.raises(ParameterError) as refusal:
        machine_of(sourced({**WRAPS_TABLE, **changed}), Path("machine.toml"), ScrollWraps)
    for word in words:
        assert word in str(refusal.value)


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"discharge_pressure_bar": 14.0}, ["discharge_pressure_bar = 14 bar", "exceed", "15 bar"]),
        ({"polytropic_index": 1.0}, ["polytropic_index = 1"]),
        ({"suction_pressure_bar": -1.0}, ["suction_pressure_bar = -1", "bar"]),
    ],
)
def test_impossible_gas_is_refused(changed, words):
    with pytest.raises(ParameterError) as refusal:
        machine_of(sourced({**GAS_TABLE, **changed}), Path("machine.toml"), ScrollGas)
    for word in words:
        assert word in str(refusal.value)
