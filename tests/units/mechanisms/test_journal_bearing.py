"""Oil films: closed forms against numerical integrals of the film pressure."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from printed_films import long_bearing_force, long_bearing_pressure, printed_film_force
from scipy.integrate import solve_bvp

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.mechanisms.hermetic.journal_bearing import (
    COMPLEX_STEP,
    film_coordinates,
    highest_pressure_pa,
    linear_film,
    positive_film_force,
    short_bearing_force,
    short_bearing_pressure,
)
from vibroacoustics.mechanisms.hermetic.parameters import JournalBearing

BEARING = JournalBearing(radius_m=8e-3, width_m=6e-3, clearance_m=15e-6, viscosity_pa_s=5e-3)
SPIN = 312.0
INTEGRAL = 1e-6
"""Relative, between the closed form of a force and the numerical integral of its pressure; the
worst of the quadratures below leaves about 1e-7."""

SMALLEST = np.finfo(float).tiny
"""Below it numbers lose their digits."""

eccentricities = st.floats(0.01, 0.95)
rates = st.floats(-200.0, 200.0)
slips = st.floats(-900.0, 900.0)


def _integrated(pressure, mean_over_middle, start, end):
    """Force along ξ and η of a pressure over an arc; ξ points to the thinnest film."""
    # The integrand is analytic; 200 Gauss points leave rounding at ε = 0.95.
    nodes, weights = np.polynomial.legendre.leggauss(200)
    angle = start + 0.5 * (end - start) * (nodes + 1.0)
    area = BEARING.radius_m * BEARING.width_m * mean_over_middle * 0.5 * (end - start)
    load = area * weights * pressure(angle)
    return np.sum(load * np.cos(angle)), np.sum(load * np.sin(angle))


@given(eccentricities, rates, slips)
def test_short_force_is_the_integral_of_its_pressure(eccentricity, rate, slip):
    def middle(angle):
        return short_bearing_pressure(BEARING, angle, eccentricity, rate, slip)

    # The mean of l²/4 - z² over the width is two thirds of its value in the middle.
    expected = np.array(_integrated(middle, 2.0 / 3.0, 0.0, np.pi))
    found = np.array(short_bearing_force(BEARING, eccentricity, rate, slip))
    # The two parts may cancel, hence the size of the parts.
    parts = np.abs(short_bearing_force(BEARING, eccentricity, abs(rate), 0.0)) + np.abs(
        short_bearing_force(BEARING, eccentricity, 0.0, abs(slip))
    )
    assert np.all(np.abs(found - expected) <= INTEGRAL * np.max(parts) + SMALLEST)


@given(eccentricities, rates, slips)
def test_long_force_is_the_integral_of_its_pressure(eccentricity, rate, slip):
    def pressure(angle):
        return long_bearing_pressure(BEARING, angle, eccentricity, rate, slip)

    expected = np.array(_integrated(pressure, 1.0, 0.0, np.pi))
    found = np.array(long_bearing_force(BEARING, eccentricity, rate, slip))
    parts = np.abs(long_bearing_force(BEARING, eccentricity, abs(rate), 0.0)) + np.abs(
        long_bearing_force(BEARING, eccentricity, 0.0, abs(slip))
    )
    assert np.all(np.abs(found - expected) <= INTEGRAL * np.max(parts) + SMALLEST)


@pytest.mark.parametrize(("eccentricity", "rate", "slip"), [(0.3, 50.0, 312.0), (0.8, -20.0, 90.0)])
def test_long_pressure_solves_the_reynolds_equation(eccentricity, rate, slip):
    """Eq. 23 without side flow, ambient at 0 and π, by SciPy's boundary value solver."""
    scale = 12.0 * BEARING.viscosity_pa_s * (BEARING.radius_m / BEARING.clearance_m) ** 2

    def flow(angle, state):
        thickness = 1.0 + eccentricity * np.cos(angle)
        source = rate * np.cos(angle) - 0.5 * slip * eccentricity * np.sin(angle)
        return np.stack((state[1] / thickness**3, source))

    mesh = np.linspace(0.0, np.pi, 400)
    solved = solve_bvp(
        flow, lambda a, b: np.array([a[0], b[0]]), mesh, np.zeros((2, 400)), tol=1e-8,
        max_nodes=20000,
    )  # fmt: skip
    found = long_bearing_pressure(BEARING, mesh, eccentricity, rate, slip) / scale
    assert solved.success
    assert found == pytest.approx(solved.sol(mesh)[0], abs=INTEGRAL * np.max(np.abs(found)))


def test_printed_long_pressure_does_not_give_the_printed_force():
    """Erratum: (25) leaves ε̇/ε [1/(1-ε)² - 1/(1+ε)²] at π, where (28) and (29) have ambient."""
    eccentricity, scale = 0.5, 6.0 * BEARING.viscosity_pa_s * (8e-3 / 15e-6) ** 2

    def printed(angle, rate, slip):
        thickness = 1.0 + eccentricity * np.cos(angle)
        wedge = eccentricity * np.sin(angle) * (2.0 + eccentricity * np.cos(angle))
        wedge /= (2.0 + eccentricity**2) * thickness**2
        squeeze = (thickness**-2 - (1.0 + eccentricity) ** -2) / eccentricity
        return scale * (slip * wedge + rate * squeeze)

    steady = _integrated(lambda angle: printed(angle, 0.0, SPIN), 1.0, 0.0, np.pi)
    assert steady == pytest.approx(long_bearing_force(BEARING, eccentricity, 0.0, SPIN), rel=1e-9)
    _, across = _integrated(lambda angle: printed(angle, 10.0, 0.0), 1.0, 0.0, np.pi)
    _, law = long_bearing_force(BEARING, eccentricity, 10.0, 0.0)
    # Integral of (25): G 2ε̇/((1-ε²)(1+ε)), of (29): G 2εε̇/((2+ε²)(1-ε²)): (2+ε²)/(ε(1+ε)) = 3.
    assert across / law == pytest.approx(3.0, rel=1e-9)


vectors = st.tuples(st.floats(0.01, 0.95), st.floats(0.0, 6.28))


@given(vectors, st.tuples(st.floats(1e-5, 5e-3), st.floats(0.0, 6.28)))
def test_positive_film_is_the_integral_of_positive_pressure(place, moving):
    displacement = 15e-6 * place[0] * np.array([np.cos(place[1]), np.sin(place[1])])
    velocity = moving[0] * np.array([np.cos(moving[1]), np.sin(moving[1])])
    coordinates = film_coordinates(BEARING, displacement, velocity, np.array(SPIN))
    # The midpoint rule over the whole circle, kinks and all: 20 000 angles leave about 1e-7.
    angle = (np.arange(20000) + 0.5) * 2.0 * np.pi / 20000
    pressure = np.maximum(short_bearing_pressure(BEARING, angle, *coordinates), 0.0)
    area = BEARING.radius_m * BEARING.width_m * 2.0 / 3.0 * 2.0 * np.pi
    absolute = angle + place[1] + np.pi  # from the thickest film to the x axis
    expected = -area * np.array(
        [np.mean(pressure * np.cos(absolute)), np.mean(pressure * np.sin(absolute))]
    )
    found = positive_film_force(BEARING, displacement, velocity, np.array(SPIN))
    assert found == pytest.approx(expected, abs=INTEGRAL * np.linalg.norm(expected))


@pytest.mark.parametrize("law", [short_bearing_force, long_bearing_force])
def test_printed_force_in_x_and_y(law):
    """Journal on the x axis: ξ is x, η is y."""
    place, velocity = np.array([6e-6, 0.0]), np.array([1e-4, 3e-4])
    radial, transverse = law(BEARING, 0.4, 1e-4 / 15e-6, SPIN - 2.0 * 3e-4 / 6e-6)
    found = printed_film_force(law)(BEARING, place, velocity, np.array(SPIN))
    assert found == pytest.approx([radial, transverse], rel=1e-12)


def test_printed_and_positive_film_agree_without_squeeze():
    place, velocity = np.array([9e-6, 2e-6]), np.zeros(2)
    printed = printed_film_force(short_bearing_force)(BEARING, place, velocity, np.array(SPIN))
    assert positive_film_force(BEARING, place, velocity, np.array(SPIN)) == pytest.approx(
        printed, rel=1e-12
    )


def test_printed_film_pulls_where_the_positive_one_pushes():
    """A journal drawn back without slip: (26) keeps the half of 0 ≤ φ ≤ π and reads tension."""
    radial, _ = short_bearing_force(BEARING, 0.6, -50.0, 0.0)
    assert radial > 0.0
    place, velocity = np.array([9e-6, 0.0]), np.array([-50.0 * 15e-6, 0.0])
    spin = np.array(0.0)
    force = positive_film_force(BEARING, place, velocity, spin)
    assert 0.0 < force[0] < radial  # the oil in the wide half only, which pushes outwards


def test_peak_pressure_of_a_steady_short_film():
    """Ocvirk: cos φ = (1 - sqrt(1 + 24 ε²)) / (4 ε) at the peak. The grid errs by 1e-5 here."""
    eccentricity = 0.7
    peak = np.arccos((1.0 - np.sqrt(1.0 + 24.0 * eccentricity**2)) / (4.0 * eccentricity))
    exact = short_bearing_pressure(BEARING, peak, eccentricity, 0.0, SPIN)
    place = np.array([[15e-6 * eccentricity, 0.0]])
    found = highest_pressure_pa(BEARING, place, np.zeros((1, 2)), np.array([SPIN]))
    assert found[0] == pytest.approx(exact, rel=1e-5)


def test_film_force_has_the_slope_of_a_complex_step():
    """Central differences of 0.1 nm and 0.1 µm/s err by 1e-9 of a 15 µm film, with rounding 1e-6.

    The journal moves across its displacement and out, so that the film's half is in no axis.
    """
    place, velocity, spin = np.array([9e-6, 2e-6]), np.array([-3e-4, 5e-4]), np.array(SPIN)

    def force(values):
        return positive_film_force(BEARING, values[:2], values[2:], spin)

    start = np.concatenate([place, velocity])
    scale = np.linalg.norm(force(start))
    for axis, step in enumerate((1e-10, 1e-10, 1e-7, 1e-7)):
        move = np.eye(4)[axis]
        differences = (force(start + step * move) - force(start - step * move)) / (2.0 * step)
        slope = force(start + 1j * COMPLEX_STEP * move).imag / COMPLEX_STEP
        of_place = scale / np.linalg.norm(start[:2] if axis < 2 else start[2:])
        assert slope == pytest.approx(differences, abs=1e-5 * of_place)


def test_linear_film_balances_its_load_and_meets_differences():
    film = linear_film(BEARING, 50.0, SPIN)
    spin = np.array(SPIN)

    def force(place, velocity):
        return positive_film_force(BEARING, place, velocity, spin)

    radial, transverse = short_bearing_force(BEARING, film.eccentricity_ratio, 0.0, SPIN)
    assert np.hypot(radial, transverse) == pytest.approx(50.0, rel=1e-9)
    attitude = np.pi - np.arctan2(transverse, radial)
    place = 15e-6 * film.eccentricity_ratio * np.array([np.cos(attitude), np.sin(attitude)])
    assert force(place, np.zeros(2)) == pytest.approx([-50.0, 0.0], abs=1e-8)
    for axis, (step, rate) in enumerate(zip(1e-10 * np.eye(2), 1e-7 * np.eye(2), strict=True)):
        slope = (force(place + step, np.zeros(2)) - force(place - step, np.zeros(2))) / 2e-10
        # Central differences: 1e-10 m of 3 µm of film leave about (1e-10 / 3e-6)², and rounding.
        assert -slope == pytest.approx(film.stiffness[:, axis], rel=1e-6)
        drag = (force(place, rate) - force(place, -rate)) / 2e-7
        assert -drag == pytest.approx(film.damping[:, axis], rel=1e-6)


def test_journal_beyond_its_clearance_is_refused():
    with pytest.raises(ParameterError, match=r"eccentricity ratio = 1\.2: must be less than 1"):
        film_coordinates(BEARING, np.array([18e-6, 0.0]), np.zeros(2), np.array(SPIN))


@pytest.mark.parametrize("load", [0.0, -1.0, 1e9])
def test_load_that_no_film_carries_is_refused(load):
    with pytest.raises(ParameterError, match="load_n"):
        linear_film(BEARING, load, SPIN)
