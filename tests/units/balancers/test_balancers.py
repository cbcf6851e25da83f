"""Balancing options: what they add and what they refuse."""

import numpy as np
import pytest
from pydantic import ValidationError
from scipy.integrate import solve_ivp
from support import CRANK_ANGLE, ROUNDING, balancing, steady, turning

from vibroacoustics.balancers.counterweight import Counterweight
from vibroacoustics.balancers.hood import Hood
from vibroacoustics.balancers.pendulum import pendulum_mass
from vibroacoustics.balancers.spring_mass import printed_mass, sprung_mass_response, tuned_mass
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.mechanics.moving_parts import wrench
from vibroacoustics.mechanics.pendulum import (
    Drive,
    multiplier,
    periodic_state,
    revolution,
    settle,
    swing,
)
from vibroacoustics.orders import order_spectrum

DRIVE = Drive(length_m=25e-3, damping_ratio=0.02, stroke_m=6.75e-3, frequency_hz=3500.0 / 60.0)


def test_every_option_tells_its_added_mass(thesis_study):
    for option in thesis_study.options:
        added = balancing(thesis_study, option, 3500.0)
        parts_kg = sum(part.mass_kg for part in added.parts)
        assert added.figures["added_mass_kg"] == pytest.approx(parts_kg, rel=1e-12)
        assert all(np.isfinite(value) for value in added.figures.values())
        assert {part.source for part in added.parts} <= {"balancer"}


def test_reports_carry_their_unit(thesis_study):
    for option in thesis_study.options:
        for name in balancing(thesis_study, option, 3500.0).figures:
            assert name.endswith(("_kg", "_deg", "_mm", "_w", "_rpm", "_multiplier")), name


@pytest.mark.parametrize(
    ("growth", "words"),
    [
        ([3.0], "Hanging is unstable (Floquet multiplier 3.00)"),
        ([0.9], "Hanging is stable"),
        ([0.9, 1.2], "Hanging is stable at some of the speeds only"),
    ],
)
def test_figures_of_a_pendulum_become_sentences(thesis_study, growth, words):
    figures = {
        "hanging_multiplier": np.array(growth),
        "settled_angle_deg": np.array([-83.3]),
    }
    sentences = thesis_study.options["pendulum-side"].sentences(figures)
    assert words in sentences[0]
    assert "settles 83.3°" in sentences[1]


def test_figures_of_damping_become_sentences(thesis_study):
    sentences = thesis_study.options["damping"].sentences({"dissipated_power_w": np.array([10.5])})
    assert sentences == ("It dissipates 10.5 W.",)


def test_counterweight_opposite_the_pin_is_what_its_place_says(thesis_study):
    """m r ω² along the shaft's frame, ahead of the crank pin by its angle."""
    weight = Counterweight(mass_kg=0.1, radius_m=0.02, angle_rad=np.pi, height_m=0.05)
    (part,) = weight.added(thesis_study.machine, steady(3000.0)).parts
    assert part.position_m[:, 0] == pytest.approx([-0.02, 0.0, 0.05])
    force = order_spectrum(wrench([part], turning(50.0)).force_n, 1)[:, 1]
    size = 0.1 * 0.02 * (100.0 * np.pi) ** 2
    # -m a of x = -r cos θ: the force points to the weight.
    assert force[0] == pytest.approx(-size, rel=ROUNDING)
    assert force[1] == pytest.approx(1j * size, rel=ROUNDING)


def test_insertion_loss_holds_in_its_bands_only():
    """Edges of the third octave at 1 kHz, base ten: 891.3 and 1122.0 Hz."""
    hood = Hood(band_hz=(800.0, 1000.0), insertion_loss_db=(3.0, 10.0))
    loss = hood.insertion_loss()
    frequency = np.array([0.0, 700.0, 800.0, 891.0, 892.0, 1122.0, 1123.0])
    assert list(loss.at(frequency)) == [0.0, 0.0, 3.0, 3.0, 10.0, 10.0, 0.0]
    assert loss.amplitude_factor(np.array([1000.0]))[0] == pytest.approx(10.0**-0.5)


@pytest.mark.parametrize(
    ("bands", "losses", "words"),
    [
        ((100.0, 125.0), (3.0,), "1 values for 2 bands"),
        ((125.0, 100.0), (3.0, 3.0), "must rise"),
        ((10.0,), (3.0,), "from 20 to 20000 Hz"),
        ((100.0,), (90.0,), "allowed -80 to 80 dB"),
    ],
)
def test_hood_that_cannot_be(bands, losses, words):
    with pytest.raises(ValidationError, match=words):
        Hood(band_hz=bands, insertion_loss_db=losses)


# --- pendulum ------------------------------------------------------------------------------------


def test_revolution_tangent_is_the_derivative_of_the_map():
    state, step = np.array([1.4, 0.1]), 1e-5
    _, tangent = revolution(DRIVE, state)
    columns = [
        (revolution(DRIVE, state + step * unit)[0] - revolution(DRIVE, state - step * unit)[0])
        / (2.0 * step)
        for unit in np.eye(2)
    ]
    # step² of a third derivative that grows with (2π)³ = 250; integration 1e-12 / step.
    np.testing.assert_allclose(tangent, np.transpose(columns), atol=1e-6)


def test_area_shrinks_by_the_damping():
    """Liouville: product of the multipliers = exp(-2π · 2ζ ω_n/ω)."""
    natural = np.sqrt(9.80665 / DRIVE.length_m) / (2.0 * np.pi * DRIVE.frequency_hz)
    _, tangent = revolution(DRIVE, np.array(settle(DRIVE)))
    # 1e-12 per step of the integration, some hundred steps
    assert np.linalg.det(tangent) == pytest.approx(np.exp(-4.0 * np.pi * 0.02 * natural), abs=1e-9)


def test_settled_state_repeats():
    state = settle(DRIVE)
    after, _ = revolution(DRIVE, np.array(state))
    np.testing.assert_allclose(after, state, atol=1e-10)
    angle = swing(DRIVE, state, CRANK_ANGLE)
    assert angle[0] == pytest.approx(state[0])


def test_slow_pendulum_hangs():
    """Far below 991 rpm, and away from its 189 rpm, the bob follows linear theory to (A/l)²."""
    drive = Drive(25e-3, 0.02, 1e-4, 500.0 / 60.0)
    state = settle(drive)
    ratio = np.sqrt(9.80665 / 25e-3) / (2.0 * np.pi * 500.0 / 60.0)
    linear = (1e-4 / 25e-3) / (ratio**2 - 1.0 + 2j * 0.02 * ratio)
    assert state[0] == pytest.approx(linear.real, rel=1e-4)


def test_swing_against_another_integrator():
    """Radau of another family, to 1e-10: its tolerance times the number of its steps."""
    push, stiffness, damping = DRIVE.motion

    def slope(angle, state):
        swung, rate = state
        turning = push * np.cos(angle) * np.cos(swung) - stiffness * np.sin(swung)
        return rate, turning - damping * rate

    state = settle(DRIVE)
    other = solve_ivp(
        slope, (0.0, 2.0 * np.pi), state, "Radau", CRANK_ANGLE, rtol=1e-11, atol=1e-12
    )
    np.testing.assert_allclose(swing(DRIVE, state, CRANK_ANGLE), other.y[0], atol=1e-9)


@pytest.mark.parametrize("speed_rpm", [3396.741854636591, 3409.0])
def test_pendulum_settles_where_the_start_near_hanging_leads_to_no_periodic_motion(speed_rpm):
    """At the first speed to one that repeats after several revolutions, at the second late."""
    drive = Drive(25e-3, 0.02, 6.75e-3, speed_rpm / 60.0)
    state = settle(drive)
    assert multiplier(drive, state) < 1.0
    assert abs(np.rad2deg(np.mean(swing(drive, state, CRANK_ANGLE)))) == pytest.approx(85, abs=0.5)


def test_periodic_state_from_hanging_keeps_to_it():
    hanging = periodic_state(DRIVE, (-0.27, 0.0))
    assert np.max(np.abs(swing(DRIVE, hanging, CRANK_ANGLE))) < 0.5
    assert multiplier(DRIVE, hanging) > 1.0


@pytest.mark.parametrize("reach", [6.75e-3, 5e-3])
def test_pendulum_must_reach_farther_than_the_stroke(reach):
    with pytest.raises(ParameterError, match=r"horizontal_reach_mm = .* mm.*6\.75 mm"):
        pendulum_mass(6.75e-3, 0.0727, reach)


# --- mass between springs ------------------------------------------------------------------------


def test_too_stiff_springs_are_refused():
    with pytest.raises(ParameterError, match=r"stiffness_n_per_mm = 5 N/mm.*below 4\.883 N/mm"):
        tuned_mass(5000.0, 0.0727, 2.0 * np.pi * 3500.0 / 60.0)


def test_too_soft_springs_for_the_printed_equation():
    with pytest.raises(ParameterError, match=r"stiffness_n_per_mm = 4 N/mm.*above 4\.883 N/mm"):
        printed_mass(4000.0, 0.0727, 2.0 * np.pi * 3500.0 / 60.0)


def test_undamped_resonance_is_refused():
    with pytest.raises(ParameterError, match="resonance at 1000 rpm"):
        sprung_mass_response(
            1.0, 0.5 * (2.0 * np.pi * 1000.0 / 60.0) ** 2, 0.0, np.pi * 100.0 / 3.0
        )


def test_stiff_springs_carry_the_mass_along():
    assert sprung_mass_response(0.1, 1e12, 0.0, 300.0) == pytest.approx(1.0, abs=1e-8)


def test_dissipated_power_is_force_times_velocity(thesis_study):
    """Mean of c (v1 - v2)² over the revolution, by quadrature; 23 W at µ = 1, ζ = 0.05."""
    option = thesis_study.options["spring-mass"].model_copy(
        update={"stiffness_n_per_m": 2442.0, "damping_ratio": 0.05}
    )
    study = thesis_study.model_copy(update={"options": {"it": option}})
    added = balancing(study, "it", 3500.0)
    assert added.figures["dissipated_power_w"] == pytest.approx(23.0, abs=0.5)
    omega = 2.0 * np.pi * 3500.0 / 60.0
    (part,) = added.parts
    ring = 6.75e-3 * np.cos(CRANK_ANGLE)
    slip = (
        omega * np.gradient(np.pad(part.position_m[0] - ring, 1, "wrap"), 2.0 * np.pi / 256)[1:-1]
    )
    damper = 2.0 * 0.05 * np.sqrt(2.0 * 2442.0 * part.mass_kg)
    # np.gradient errs by h²/6 = 1e-4 in the slip, twice that in the power.
    assert np.mean(damper * slip**2) == pytest.approx(added.figures["dissipated_power_w"], rel=3e-4)


# --- the others ----------------------------------------------------------------------------------


def test_ring_damping_power(thesis_study):
    """c (ω r)² / 2 with 5 N s/m, 6.75 mm, 3500 rpm: 15.30 W."""
    facts = balancing(thesis_study, "damping", 3500.0).figures
    assert facts["dissipated_power_w"] == pytest.approx(15.302, abs=5e-4)


def test_ring_damping_pushes_against_the_velocity(thesis_study):
    """c ω r sin θ on a ring at r cos θ."""
    force = balancing(thesis_study, "damping", 3500.0).on_ring
    expected = 5.0 * 2.0 * np.pi * 3500.0 / 60.0 * 6.75e-3 * np.sin(CRANK_ANGLE)
    np.testing.assert_allclose(force.force_n, expected, rtol=1e-12, atol=1e-12)
    assert force.from_housing


def test_twin_ring_moves_in_opposite_phase(thesis_study):
    (twin,) = balancing(thesis_study, "twin-oldham", 3500.0).parts
    np.testing.assert_allclose(twin.position_m[0], -6.75e-3 * np.cos(CRANK_ANGLE), atol=1e-18)
    assert np.all(twin.position_m[2] == pytest.approx(0.110 - 0.200))


def test_counterweights_act_at_the_height_of_the_ring(thesis_study):
    parts = balancing(thesis_study, "counterweight-half", 3500.0).parts
    moments = np.array([part.mass_kg * part.position_m[0, 0] for part in parts])
    heights = np.array([part.position_m[2, 0] for part in parts])
    assert moments.sum() == pytest.approx(-0.5 * 0.0727 * 6.75e-3)
    assert moments @ heights / moments.sum() == pytest.approx(0.110)
