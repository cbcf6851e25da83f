"""Leaking and filling pockets: mass, work, gaps, forces of suction pockets, tight as before."""

import numpy as np
import pytest
from scroll_closed_forms import suction_volume_m3
from scroll_flanks import INNER, OUTER, fixed_flank, moved
from scroll_openings import GAS, OPENING, SPEED_RPM, WRAPS
from test_scroll_gas import OTHER_WRAPS

from vibroacoustics.mechanics.nozzle import nozzle_flow
from vibroacoustics.mechanics.rotation import uniform_crank_angle
from vibroacoustics.sources.scroll_gas import leakage as leakage_module
from vibroacoustics.sources.scroll_gas.cycle import _of_suction_pockets, scroll_gas_cycle
from vibroacoustics.sources.scroll_gas.leakage import gap_area_m2
from vibroacoustics.sources.scroll_gas.opening import opening_constants, steady_opening
from vibroacoustics.sources.scroll_gas.opening_equations import density
from vibroacoustics.sources.scroll_gas.parameters import (
    ScrollLeakage,
    chamber_volume_m3,
    contact_angle,
    pair_volume_m3,
    pocket_volume,
)
from vibroacoustics.sources.scroll_gas.suction import pocket_pressure, suction_flow

ANGLE = uniform_crank_angle(8192)
TURN = 2.0 * np.pi
GAPS = ScrollLeakage(tip_gap_m=10e-6, flank_gap_m=10e-6, flow_ratio=0.5)
TIGHT = ScrollLeakage(tip_gap_m=0.0, flank_gap_m=0.0, flow_ratio=0.5)
FILLING = suction_flow(WRAPS, 4e-3, 0.8, (GAS.suction_pressure_pa, 33.0, 182.0), SPEED_RPM)
CASES = {"leaks": (GAPS, None), "fills": (None, FILLING), "both": (GAPS, FILLING)}


def opened(leakage=None, filling=None):
    return steady_opening(WRAPS, GAS, OPENING, SPEED_RPM, leakage=leakage, filling=filling)


@pytest.fixture(scope="module")
def histories():
    return {name: opened(*tables) for name, tables in CASES.items()}


def test_gaps_of_no_height_change_nothing():
    without, tight = opened(), opened(TIGHT)
    np.testing.assert_array_equal(tight.chamber_pa, without.chamber_pa)
    one, other = (scroll_gas_cycle(WRAPS, GAS, ANGLE, gas) for gas in (tight, without))
    np.testing.assert_array_equal(one.tangential_force_n, other.tangential_force_n)


def test_the_mass_that_is_not_lost_leaves_through_the_port(histories):
    """Mass at closing, less the leak of a new pocket's contacts over their first turn."""
    gas = histories["leaks"]
    trapped, omega = gas.trapped, TURN * SPEED_RPM / 60.0
    constants = opening_constants(WRAPS, GAS, OPENING, SPEED_RPM)
    opens = np.asarray(WRAPS.opening_angle_rad)
    held = 2.0 * float(pocket_volume(WRAPS, opens)) * density(float(gas.pair_pa[0]), constants)
    closed = held / trapped.mass_ratio[-1]
    angle = trapped.contact_angle
    leak = np.concatenate([[0.0], np.cumsum(0.5 * np.diff(angle) * (
        trapped.leak_kg_per_s[1:] + trapped.leak_kg_per_s[:-1]))]) / omega  # fmt: skip
    out, kept = np.interp(TURN, angle, leak), np.interp([opens, opens + TURN], angle, leak)
    # Of one pair over its life: what crosses its inner contacts less what crosses its outer ones.
    gained = (kept[1] - out) - kept[0]
    assert held - closed == pytest.approx(gained, rel=1e-4)
    port = float(np.trapezoid(gas.port_flow_kg_per_s, gas.since_opening)) / omega
    assert port == pytest.approx(closed - out, rel=1e-5)
    assert 0.03 < out / closed < 0.12


@pytest.mark.parametrize("name", CASES)
def test_work_on_the_shaft_is_that_on_the_gas(histories, name):
    """-∮ p dV of a pair from the beginning of its pockets to the end of its gas."""
    gas = histories[name]
    cycle = scroll_gas_cycle(WRAPS, GAS, ANGLE, gas)
    life = np.linspace(-TURN, WRAPS.opening_angle_rad, 40001)
    volume = np.where(
        life < 0.0,
        suction_volume_m3(WRAPS, life + TURN),
        pocket_volume(WRAPS, np.maximum(life, 0.0)),
    )
    pressure = pocket_pressure(WRAPS, GAS, life - 1e-8, gas)
    work = -2.0 * np.trapezoid(pressure, volume)
    half = gas.since_opening.size // 2
    apart, joined = gas.since_opening[: half + 1], gas.since_opening[half:]
    work -= np.trapezoid(gas.pair_pa[: half + 1], pair_volume_m3(WRAPS, apart))
    inside = chamber_volume_m3(WRAPS, OPENING.chamber_volume_m3, gas.since_opening)
    before = chamber_volume_m3(WRAPS, OPENING.chamber_volume_m3, apart - 1e-12)
    work -= np.trapezoid(gas.chamber_pa[: half + 1], before)
    work -= np.trapezoid(gas.chamber_pa[half:], inside[half:])
    assert joined[0] == pytest.approx(np.pi)
    assert TURN * cycle.torque_n_m.mean() == pytest.approx(work, rel=1e-4)


def test_leaks_converge_with_the_step(histories, monkeypatch):
    monkeypatch.setattr(leakage_module, "STEPS", 2048)
    fine, taken = opened(GAPS), histories["leaks"]
    assert np.abs(fine.pair_pa / taken.pair_pa - 1.0).max() < 1e-5


@pytest.mark.parametrize("wraps", [WRAPS, OTHER_WRAPS])
def test_tips_are_half_a_turn_of_two_wraps(wraps):
    """Length of the middle of a wrap from the contact of one flank to that of the other."""
    gaps = ScrollLeakage(tip_gap_m=1e-5, flank_gap_m=0.0, flow_ratio=1.0)
    contact = float(contact_angle(wraps, np.asarray(1.0)))
    ends = contact - 0.5 * np.pi, contact + 0.5 * np.pi
    middle = 0.5 * sum(fixed_flank(wraps, side).between(*ends) for side in (INNER, OUTER))
    length = np.abs(np.diff(middle)).sum()
    assert float(gap_area_m2(wraps, gaps, np.asarray(1.0))) == pytest.approx(
        2e-5 * length, rel=1e-4
    )


@pytest.mark.parametrize("kappa", [0.95, 1.0, 1.1, 1.4])
def test_nozzle_chokes_and_follows_bernoulli(kappa):
    """Small steps as of constant density; below the critical ratio no more flows."""
    p, rho = 30e5, 100.0
    small = nozzle_flow(p, p * (1.0 - 1e-6), rho, rho, kappa)
    assert small == pytest.approx(np.sqrt(2.0 * rho * 1e-6 * p), rel=1e-5)
    assert nozzle_flow(p * (1.0 - 1e-6), p, rho, rho, kappa) == pytest.approx(-small)
    at_most = np.sqrt(kappa * p * rho) * (2.0 / (kappa + 1.0)) ** (
        0.5 * (kappa + 1.0) / (kappa - 1.0) if kappa != 1.0 else 0.0
    )
    at_most *= np.exp(-0.5) if kappa == 1.0 else 1.0
    for outside in (0.3, 0.1):
        assert nozzle_flow(p, outside * p, rho, rho, kappa) == pytest.approx(at_most, rel=1e-12)


@pytest.mark.parametrize("wraps", [WRAPS, OTHER_WRAPS])
@pytest.mark.parametrize("since", [0.8, 2.5, 4.4])
def test_suction_pockets_press_flanks_and_plates(wraps, since):
    """Chords of the orbiting flanks from contact to end; area of pockets and tips."""
    crank = wraps.closing_crank_angle_rad + since
    contact, end = (float(contact_angle(wraps, np.asarray(at))) for at in (since, 0.0))
    chord = 0.0
    for side, lead in ((OUTER, -1.0), (INNER, 1.0)):
        flank = moved(fixed_flank(wraps, side), wraps, crank)
        line = flank.between(contact + lead * 0.5 * np.pi, end + lead * 0.5 * np.pi)
        chord += lead * (line[-1] - line[0])
    on_scroll = 1j * wraps.height_m * chord / np.exp(1j * crank)
    width = 2.0 * wraps.base_radius_m * wraps.height_m
    tangential, radial, axial = _of_suction_pockets(wraps, np.asarray(since))
    expected = np.array([tangential - width * contact, radial - width])
    np.testing.assert_allclose([-on_scroll.imag, -on_scroll.real], expected, rtol=1e-6)
    at_contact = _of_suction_pockets(wraps, np.zeros(()))[2]
    pockets = 2.0 * float(suction_volume_m3(wraps, np.asarray(since))) / wraps.height_m
    tips = wraps.thickness_m * wraps.base_radius_m * (end**2 - contact**2)
    inside = at_contact - np.pi * wraps.base_radius_m**2 * (end**2 - contact**2)
    assert float(axial - inside) == pytest.approx(pockets + tips, rel=1e-9)


def test_suction_pockets_begin_and_close_without_a_step(histories):
    cycle = scroll_gas_cycle(WRAPS, GAS, ANGLE, histories["both"])
    for force in (cycle.tangential_force_n, cycle.radial_force_n, cycle.axial_force_n):
        assert np.abs(np.diff(force, append=force[0])).max() < 0.01 * force.max()


def test_a_pocket_closes_with_the_pressure_that_it_filled_to(histories):
    """Some 3 % over suction, and compressed from there."""
    gas = histories["fills"]
    before, after, later = pocket_pressure(WRAPS, GAS, np.array([-1e-9, 1e-9, 3.0]), gas)
    assert before == pytest.approx(after, rel=1e-6)
    assert after / GAS.suction_pressure_pa == pytest.approx(1.03, abs=0.005)
    alone = pocket_pressure(WRAPS, GAS, np.array([3.0]), opened())[0]
    assert later / alone == pytest.approx(after / GAS.suction_pressure_pa, rel=1e-6)
