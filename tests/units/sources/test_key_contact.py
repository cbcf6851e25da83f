"""A key against its slot: film, layer, elastic face and their series, each by a second method."""

import numpy as np
import pytest
from key_oracle import FaceLaw, rebound_speed, tsuji_damping
from scipy.integrate import quad
from scipy.sparse import coo_array
from scipy.sparse.linalg import spsolve

from vibroacoustics.sources.oldham_keys.contact import (
    Face,
    contact_damping,
    contact_mass_kg,
    contact_stiffness_n_per_m1p5,
    film_mobility,
    film_sag_m,
    film_shape,
    flat_face_ratio,
    series_force,
)
from vibroacoustics.sources.oldham_keys.integration import EVALUATIONS, next_deflection
from vibroacoustics.sources.oldham_keys.rattle import STEP_RATIO

VISCOSITY, WIDTH, LENGTH, MASS, MODULUS = 4.5e-3, 6e-3, 12e-3, 0.03, 58e9
FLOODED = 1.0
SPEEDS = np.geomspace(0.01, 2.0, 8)
CROWNS = (0.1, 0.25, 0.63, 1.6, 4.0)


def face(crown=0.63, layer=FLOODED, restitution=0.7, width=WIDTH, length=LENGTH) -> Face:
    stiffness = contact_stiffness_n_per_m1p5(MODULUS, crown)
    ratio = max(width, length) / min(width, length)
    return Face(
        stiffness,
        contact_damping(restitution, MASS, stiffness),
        6.0 * np.pi * VISCOSITY * crown**2,
        film_sag_m(width, length, crown),
        float(film_shape(ratio)),
        layer,
    )


def coefficient(thickness, one: Face) -> float:
    """Film force per speed of approach, N s/m."""
    return 1.0 / film_mobility(thickness, one)[0]


def flat_coefficient(width, length, thickness) -> float:
    """Double Fourier series of Reynolds' equation between flat rectangles, N s/m."""
    odd = np.arange(1, 400, 2) * np.pi
    m, n = np.meshgrid(odd / width, odd / length)
    terms = 64.0 / (width * length * m**2 * n**2 * (m**2 + n**2))
    return 12.0 * VISCOSITY / thickness**3 * float(terms.sum())


def reynolds_coefficient(width, length, crown, thickness, count=160) -> float:
    """Film force per speed from ∇·(h³ ∇p) = -12 μ on a quarter of the face, finite volumes.

    The grid is denser in the middle, where the pressure of a thin film peaks.
    """
    stretch = np.arcsinh(np.arange(count + 1) / count * 30.0)
    stretch = np.sinh(stretch[-1] * np.arange(count + 1) / count) / 30.0
    x, y = 0.5 * width * stretch, 0.5 * length * stretch
    mid_x, mid_y = 0.5 * (x[1:] + x[:-1]), 0.5 * (y[1:] + y[:-1])

    def cubed(x, y):
        return (thickness + (x[:, None] ** 2 + y[None] ** 2) / (2.0 * crown)) ** 3

    size_x, size_y = np.diff(x), np.diff(y)
    # Conductances of inner sides, of the edges to zero pressure, none through the symmetry planes.
    between_x = cubed(x[1:], mid_y) * size_y / np.append(np.diff(mid_x), x[-1] - mid_x[-1])[:, None]
    between_y = cubed(mid_x, y[1:]) * size_x[:, None] / np.append(np.diff(mid_y), y[-1] - mid_y[-1])
    cell = np.arange(count**2).reshape(count, count)
    diagonal = np.zeros((count, count))
    rows, columns, values = [], [], []
    for flow, first, second in (
        (between_x, np.s_[:-1, :], np.s_[1:, :]),
        (between_y, np.s_[:, :-1], np.s_[:, 1:]),
    ):
        diagonal += flow
        diagonal[second] += flow[first]
        rows += [cell[first].ravel(), cell[second].ravel()]
        columns += [cell[second].ravel(), cell[first].ravel()]
        values += [-flow[first].ravel()] * 2
    rows, columns = np.concatenate([*rows, cell.ravel()]), np.concatenate([*columns, cell.ravel()])
    matrix = coo_array((np.concatenate([*values, diagonal.ravel()]), (rows, columns))).tocsc()
    area = np.outer(size_x, size_y).ravel()
    return 4.0 * float(area @ spsolve(matrix, 12.0 * VISCOSITY * area))


# --- film ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(("ratio", "printed"), [(1.0, 0.422), (2.0, 0.686), (4.0, 0.842)])
def test_ratio_of_the_flat_face(ratio, printed):
    """Printed to three digits."""
    assert float(flat_face_ratio(ratio)) == pytest.approx(printed, abs=5e-4)
    assert flat_face_ratio(np.array([1.0, ratio])).shape == (2,)


@pytest.mark.parametrize("ratio", [0.5, 1.0, 2.0, 3.0])
def test_flat_face_is_that_of_the_double_fourier_series(ratio):
    """To 0.1 %, with a crown of 1e6 m: its sag is below 1e-5 of the film."""
    one = face(crown=1e6, width=WIDTH, length=ratio * WIDTH)
    expected = flat_coefficient(WIDTH, ratio * WIDTH, 1e-5)
    assert coefficient(1e-5, one) == pytest.approx(expected, rel=1e-3)


def test_thin_film_is_that_of_a_sphere():
    """6 π μ R²/h to 1 % where the crown's sag at the edge is 1600 films: W²/(8 R h) ≥ 200."""
    crown = 0.1
    thickness = WIDTH**2 / (8.0 * crown * 200.0)
    expected = 6.0 * np.pi * VISCOSITY * crown**2 / thickness
    one = face(crown=crown, length=WIDTH)
    assert coefficient(thickness, one) == pytest.approx(expected, rel=0.01)


@pytest.mark.parametrize("thickness", [1e-7, 1e-6, 1e-5, 1e-4])
def test_film_of_a_disc_is_exact(thickness):
    """By quadrature of Reynolds' equation around an axis: c = 6 π μ ∫ ρ³/h³ dρ."""
    radius, crown = 3e-3, 0.5
    integral, _ = quad(
        lambda rho: rho**3 / (thickness + rho**2 / (2.0 * crown)) ** 3,
        0.0, radius, points=np.geomspace(1e-5, radius, 9)[:-1], epsrel=1e-12,
    )  # fmt: skip
    disc = face(crown)._replace(sag=radius**2 / (2.0 * crown), shape=1.0)
    expected = 6.0 * np.pi * VISCOSITY * integral
    assert coefficient(thickness, disc) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("ratio", [0.5, 1.0, 1.5, 2.0, 3.0])
@pytest.mark.parametrize("thickness_over_sag", [0.03, 0.3, 1.0, 3.0])
def test_film_of_a_crowned_rectangle_is_that_of_reynolds(ratio, thickness_over_sag):
    """Within 2 %; finite volumes of half the size change the expected value by 0.1 %."""
    crown, length = 0.4, ratio * WIDTH
    one = face(crown, length=length)
    thickness = thickness_over_sag * one.sag
    expected = reynolds_coefficient(WIDTH, length, crown, thickness)
    assert coefficient(thickness, one) == pytest.approx(expected, rel=0.02)


@pytest.mark.parametrize("thickness_over_sag", [0.03, 3.0])
def test_reynolds_solution_converges(thickness_over_sag):
    thickness = thickness_over_sag * film_sag_m(WIDTH, LENGTH, 0.4)
    coarse, fine = (reynolds_coefficient(WIDTH, LENGTH, 0.4, thickness, n) for n in (80, 160))
    assert coarse == pytest.approx(fine, rel=4e-3)  # a quarter of it remains


@pytest.mark.parametrize("thickness", [1e-7, 1e-6, 1e-5])
def test_thick_layer_is_flooded(thickness):
    one = face()
    layered = one._replace(layer=one.sag + thickness)
    assert coefficient(thickness, layered) == pytest.approx(coefficient(thickness, one), rel=1e-6)


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
def test_layer_on_a_crown_alone(share):
    """6 π μ R² (1 - h/t)²/h, the closed form of a sphere that dips into oil."""
    crown, layer = 0.1, 5e-6
    square = face(crown, layer, length=WIDTH)
    assert layer < square.sag
    thickness = share * layer
    expected = 6.0 * np.pi * VISCOSITY * crown**2 * (1.0 - share) ** 2 / thickness
    assert coefficient(thickness, square) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("layer", [3e-6, 2e-5, FLOODED])
@pytest.mark.parametrize("thickness", [1e-7, 1e-6, 2.9e-6, 1.5e-5])
def test_slope_of_the_mobility(layer, thickness):
    """By central differences."""
    one = face(layer=layer)
    if thickness > layer:
        pytest.skip("above the layer")
    step = 1e-5 * thickness
    low, high = (film_mobility(thickness + sign * step, one)[0] for sign in (-1.0, 1.0))
    slope = film_mobility(thickness, one)[1]
    assert slope == pytest.approx((high - low) / (2.0 * step), rel=1e-3)


# --- face ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("restitution", np.linspace(0.3, 0.99, 12))
def test_damping_is_that_of_the_fitted_inversion(restitution):
    """Tsuji's restitution f gives e = f + (1 - f)²/5 without pull, a fit within 0.005."""
    exact = contact_damping(restitution, MASS, 1e10)
    low, high = (tsuji_damping(restitution + off, MASS, 1e10) for off in (0.005, -0.005))
    assert low < exact < high


def test_elastic_face_has_no_damping():
    assert contact_damping(1.0, MASS, 1e10) == 0.0


def test_mass_at_a_key():
    """Kinetic energy of ring and scroll after a unit impulse at a key is 1/(2 M)."""
    ring, radius, ring_inertia, scroll_inertia = 0.07, 0.055, 1.8e-4, 8e-4
    energy = 0.5 / ring + 0.5 * radius**2 / ring_inertia + 0.5 * radius**2 / scroll_inertia
    mass = contact_mass_kg(ring, radius, ring_inertia, scroll_inertia)
    assert energy == pytest.approx(0.5 / mass, rel=1e-12)


# --- one impact ----------------------------------------------------------------------------------


class Impact:
    """A mass against one face, stepped as the ring's keys are."""

    def __init__(self, one: Face, speed: float, gap: float, ratio: float) -> None:
        depth = (1.25 * MASS * speed**2 / one.stiffness) ** 0.4
        self.one, self.gap, self.speed, self.d = one, gap, speed, 0.0
        self.step = ratio * np.sqrt(MASS / (1.5 * one.stiffness * np.sqrt(depth)))
        self.force = 0.0

    def advance(self) -> None:
        before, self.gap = self.gap, self.gap - self.step * self.speed
        self.d = next_deflection(self.d, before, self.gap, self.step, self.one)
        for _ in range(EVALUATIONS):
            middle = self.speed - 0.5 * self.step * self.force / MASS
            self.force = series_force(self.d, self.gap, middle, self.one)
        self.speed -= self.step * self.force / MASS

    @property
    def energy(self) -> float:
        middle = self.speed + 0.5 * self.step * self.force / MASS
        return 0.5 * MASS * middle**2 + 0.4 * self.one.stiffness * self.d**2.5


def rebound(one: Face, speed: float, gap: float, ratio: float = STEP_RATIO) -> float:
    """Speed after an impact over the speed before; 0 of a key that stays in its film."""
    impact = Impact(one, speed, gap, ratio)
    for _ in range(10**6):
        impact.advance()
        if impact.speed < 0.0 and impact.force == 0.0 and impact.d == 0.0:
            return -impact.speed / speed
        if abs(impact.speed) < 1e-4 * speed and impact.gap > 0.0:
            return 0.0
    raise AssertionError("the mass stays")


@pytest.mark.parametrize("restitution", [0.4, 0.7, 0.9])
@pytest.mark.parametrize("speed", [0.01, 0.2, 2.0])
def test_dry_restitution_is_the_one_stated(restitution, speed):
    """In the mean over the steps' phase at the meeting, at the step in use; each to 0.012."""
    one = face(layer=0.0, restitution=restitution)
    ratios = [rebound(one, speed, gap) for gap in np.linspace(1.5e-5, 1.6e-5, 20)]
    assert np.mean(ratios) == pytest.approx(restitution, abs=0.005)
    assert np.abs(np.array(ratios) - restitution).max() < 0.012
    assert rebound(one, speed, 1.5e-5, 0.05) == pytest.approx(restitution, abs=0.005)


def oracle(one: Face) -> FaceLaw:
    """Constants from their definitions, not by the functions under test."""
    area = one.sphere * one.sag**2
    return FaceLaw(one.stiffness, one.damping, area, one.sag, one.shape, one.layer)


def check_rebound(crown, speed, layer):
    """Within 0.01 of a stiff solver."""
    one, gap = face(crown, layer), 1.5e-5
    expected = rebound_speed(oracle(one), MASS, speed, gap) / speed
    assert rebound(one, speed, gap) == pytest.approx(expected, abs=0.01)


@pytest.mark.parametrize(
    ("crown", "speed", "layer"),
    [(0.1, 0.2, FLOODED), (0.1, 2.0, FLOODED), (0.63, 0.05, 3e-6), (4.0, 0.5, 3e-6)],
)
def test_rebound_is_that_of_a_stiff_solver(crown, speed, layer):
    check_rebound(crown, speed, layer)


@pytest.mark.long
@pytest.mark.parametrize("layer", [FLOODED, 3e-6, 0.0])
@pytest.mark.parametrize("crown", CROWNS)
@pytest.mark.parametrize("speed", SPEEDS)
def test_all_rebounds_are_those_of_a_stiff_solver(crown, speed, layer):
    check_rebound(crown, speed, layer)


def check_energy(count: int, seed: int) -> None:
    """T + ⅖ K d^2.5 never rises by more than 1e-6 of T, at steps of 1/500 rad."""
    random = np.random.default_rng(seed)
    for _ in range(count):
        crown = 0.1 * 40.0 ** random.random()
        layer = random.choice([0.0, 1.0, 5e-7 * 200.0 ** random.random()])
        one = face(crown, float(layer), 0.5 + 0.4 * random.random())
        impact = Impact(one, 0.01 * 200.0 ** random.random(), 5e-7, 2e-3)
        first = last = impact.energy
        for _ in range(6000):
            impact.advance()
            assert impact.energy <= last + 1e-6 * first
            last = impact.energy


def test_energy_never_rises():
    check_energy(5, 1)


@pytest.mark.long
def test_energy_of_500_impacts_never_rises():
    check_energy(500, 2)
