"""Horizontal pendulums and one-way springs of the thesis (7.1, 7.2) against closed forms."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support import PIPELINES

from vibroacoustics.balancers.horizontal_pendulum import HorizontalPendulum
from vibroacoustics.balancers.one_way_springs import OneWaySprings
from vibroacoustics.balancers.spring_mass import sprung_mass_response
from vibroacoustics.base.errors import SolverError
from vibroacoustics.mechanics.bilinear import Bilinear, settled_start, stretch
from vibroacoustics.mechanics.moving_parts import wrench
from vibroacoustics.orders import order_spectrum
from vibroacoustics.study.loading import load_study

STUDY = load_study(PIPELINES / "copeland_balancers.toml")
MACHINE = STUDY.machine
SPEEDS = (2900.0, 3500.0)


def orders(option, speed_rpm):
    """Of what the option adds: force and moment by order, and its figures."""
    revolution = MACHINE.revolution(speed_rpm, 256)
    added = option.added(MACHINE, revolution)
    force, moment = wrench(added.parts, revolution.rotation)
    return order_spectrum(force, 8), order_spectrum(moment, 8), added.figures


def ring_n(speed_rpm):
    return MACHINE.oldham.mass_kg * 0.00675 * (speed_rpm * np.pi / 30.0) ** 2


# --- pendulums in the horizontal plane -----------------------------------------------------------


@pytest.mark.parametrize("speed_rpm", SPEEDS)
def test_horizontal_pendulums_move_with_the_ring(speed_rpm):
    """Along the stroke they hang on it like weights: 1 + m/M, with (7.5) l_h/(l_h - x_b)."""
    force, moment, figures = orders(STUDY.options["horizontal-pendulums"], speed_rpm)
    assert figures["settled_from_across_deg"] == pytest.approx(90.0, abs=1e-6)
    ratio = 1.0 + force[0, 1].real / ring_n(speed_rpm)
    assert ratio == pytest.approx(15.0 / (15.0 - 6.75), rel=1e-9)
    assert np.max(np.abs(force[0, 2:])) < 1e-9 * ring_n(speed_rpm)
    assert np.max(np.abs(force[1:])) == 0.0
    assert np.max(np.abs(moment[2])) == 0.0  # mirror images
    assert figures["across_multiplier"] > 1.5
    assert figures["along_multiplier"] == pytest.approx(np.exp(-2.0 * np.pi * 0.001), rel=1e-3)


def test_one_horizontal_pendulum_turns_the_machine():
    """7.1: 'bending moments and therefore vibration': m A ω² at the pivot's arm."""
    force, moment, figures = orders(STUDY.options["horizontal-pendulum-one-side"], 3500.0)
    expected = figures["added_mass_kg"] * 0.00675 * (3500.0 * np.pi / 30.0) ** 2 * 0.06
    assert abs(moment[2, 1]) == pytest.approx(expected, rel=1e-6)
    both, _, _ = orders(STUDY.options["horizontal-pendulums"], 3500.0)
    np.testing.assert_allclose(force[0], both[0], atol=1e-9)


def test_weight_does_not_tell_the_speeds_apart():
    """Without weight the motion over the crank angle is the same at every speed."""
    option = STUDY.options["horizontal-pendulums"]
    assert isinstance(option, HorizontalPendulum)
    slow, fast = (orders(option, speed)[2]["across_multiplier"] for speed in (300.0, 6000.0))
    assert slow == pytest.approx(fast, rel=1e-9)


# --- one-way springs -----------------------------------------------------------------------------


def springs(**values):
    option = STUDY.options["one-way-springs"]
    assert isinstance(option, OneWaySprings)
    return option.model_copy(update=values)


@pytest.mark.parametrize("speed_rpm", SPEEDS)
def test_springs_alike_both_ways_are_a_sprung_mass(speed_rpm):
    option = springs(pushing_ratio=1.0)
    force, _, _ = orders(option, speed_rpm)
    angular = speed_rpm * np.pi / 30.0
    response = sprung_mass_response(
        option.mass_kg, option.stiffness_n_per_m, option.damping_ratio, angular
    )
    expected = option.mass_kg * 0.00675 * angular**2 * response
    assert force[0, 1] == pytest.approx(expected, rel=1e-9)
    assert np.max(np.abs(force[0, 2:])) < 1e-9 * abs(expected)


def test_planks_of_both_sides_make_odd_orders_alone():
    force, _, _ = orders(springs(), 3500.0)
    size = abs(force[0, 1])
    assert np.max(np.abs(force[0, 0::2])) < 1e-9 * size
    assert abs(force[0, 3]) > 0.01 * size


def test_they_take_most_of_the_first_order_at_one_speed_only():
    left = [
        abs(ring_n(speed) + orders(springs(), speed)[0][0, 1]) / ring_n(speed) for speed in SPEEDS
    ]
    assert left == pytest.approx([1.216, 0.210], abs=0.005)


@pytest.mark.parametrize(("pulled", "ratio"), [(1.25, 0.2), (5.0, 0.2), (0.3, 0.1)])
def test_motion_in_pieces_is_that_of_an_integration(pulled, ratio):
    oscillator = Bilinear(pulled, ratio * pulled, 0.05)

    def slope(angle, state):
        stiffness = pulled if state[0] > 0.0 else ratio * pulled
        return state[1], np.cos(angle) - 0.1 * state[1] - stiffness * state[0]

    start = settled_start(oscillator)
    marks = 2.0 * np.pi * np.arange(64) / 64
    found = solve_ivp(
        slope, (0.0, 2.0 * np.pi), start, t_eval=[*marks, 2.0 * np.pi], rtol=1e-10, atol=1e-12
    )
    place, rate = stretch(oscillator, 64)
    # Kinks of the slope cost the integration some digits.
    np.testing.assert_allclose(found.y[0, :-1], place, atol=1e-7)
    np.testing.assert_allclose(found.y[1, :-1], rate, atol=1e-7)
    np.testing.assert_allclose(found.y[:, -1], start, atol=1e-7)


class SettlesInRateAlone:
    """A stretch that stays zero; a rate v that a revolution moves by (1 - v²)/1000, to 1."""

    def steps(self, start, steps, count):
        state = start
        for _ in range(count // steps):
            rate = state[1]
            state = np.array([0.5 * state[0], rate + 1e-3 * (1.0 - rate**2)])
            yield state, np.diag([0.5, 1.0 - 2e-3 * rate])


def test_motion_is_settled_when_stretch_and_rate_are():
    """Newton's steps change the rate alone, and the first one throws it far past 1."""
    assert settled_start(SettlesInRateAlone()) == pytest.approx((0.0, 1.0), abs=1e-10)


@pytest.mark.parametrize(("pulled", "pushed"), [(4.0, 1.0), (9.0, 0.04)])
def test_free_vibration_has_half_a_period_on_each_side(pulled, pushed):
    """Shaw & Holmes 1983: ω = 2 ω1 ω2/(ω1 + ω2)."""
    period = np.pi / np.sqrt(pulled) + np.pi / np.sqrt(pushed)
    assert Bilinear(pulled, pushed, 0.1).natural_ratio == pytest.approx(2.0 * np.pi / period)

    def slope(_, state):
        return state[1], -(pulled if state[0] > 0.0 else pushed) * state[0]

    end = solve_ivp(slope, (0.0, period), (0.0, 1.0), rtol=1e-10, atol=1e-12).y[:, -1]
    np.testing.assert_allclose(end, (0.0, 1.0), atol=1e-6)


def test_motions_of_several_revolutions_are_refused():
    """Near a half or a third of the shaft's frequency, where such oscillators have subharmonics."""
    with pytest.raises(SolverError, match=r"resonate at 0\.298 of the shaft frequency"):
        orders(springs(mass_kg=0.1454, stiffness_n_per_m=6510.0, pushing_ratio=0.05), 3500.0)


def test_words_of_both():
    for name, words in (("horizontal-pendulums", "settle 90"), ("one-way-springs", "planks move")):
        option = STUDY.options[name]
        figures = {key: np.array([v]) for key, v in orders(option, 3500.0)[2].items()}
        assert words in option.sentences(figures)[0]
        assert option.leaves_out(False)
