"""A driven plate against closed forms, integrals by quadrature and random matrices."""

from itertools import pairwise

import numpy as np
import pytest
from documents import FORM, SECOND
from evidence import claim
from scipy.integrate import quad

from vibroacoustics.base.constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from vibroacoustics.base.weighting import WEIGHTING
from vibroacoustics.levels.structure_borne import level_range, mean_square_per_power
from vibroacoustics.study.structure_borne import StructureBorne
from vibroacoustics.transfer.plate.driven import (
    Plate,
    input_power,
    likeness,
    near_power,
    radiation_efficiency,
    wave_power,
)
from vibroacoustics.transfer.plate.under_feet import modal_overlap, relative_variance

STEEL = StructureBorne(
    thickness_m=1e-3, density_kg_per_m3=7850.0, youngs_modulus_pa=2.1e11, loss_factor_ratio=0.01
)
AIR = AIR_DENSITY_KG_PER_M3 * SPEED_OF_SOUND_M_PER_S
HERE = np.zeros((1, 3))


def plate_of(settings, size=None):
    return Plate(settings.mass_kg_per_m2, settings.bending_stiffness_n_m,
                 settings.loss_factor_ratio, size)  # fmt: skip


def one_newton(frequency):
    """Root mean square."""
    return np.full((len(frequency), 1), np.sqrt(2.0), dtype=complex)


def power_by_quadrature(plate, hertz, loss, distance_m=0.0, sides=2.0):
    """Sound power to one side of two equal forces of 1 N rms (one where they are in one point).

    Of the spectrum of the plate's velocity over wavenumbers along it: those below ω/c radiate.
    """
    omega, k0 = 2.0 * np.pi * hertz, 2.0 * np.pi * hertz / SPEED_OF_SOUND_M_PER_S
    stiffness = plate.bending_stiffness_n_m * (1.0 + 1j * loss)

    def density(angle):
        kx, kz = k0 * np.sin(angle), k0 * np.cos(angle)
        of_plate = 1j * omega * plate.mass_kg_per_m2 + stiffness * kx**4 / (1j * omega)
        velocity = 1.0 / (of_plate + sides * AIR * k0 / kz)
        turns = np.linspace(0.0, 2.0 * np.pi, 65)[:-1]
        forces = np.abs(1.0 + np.exp(1j * kx * distance_m * np.cos(turns))) ** 2
        share = np.mean(forces) / 4.0 if distance_m == 0.0 else np.mean(forces)
        radiated = AIR * k0 / kz * abs(velocity) ** 2 * share
        return radiated * kx * 2.0 * np.pi / (2.0 * np.pi) ** 2 * kz

    ratio = plate.coincidence_hz / hertz
    near = np.arcsin(np.sqrt(ratio)) if ratio < 1.0 else 1.0
    steps = [0.0, near - 1e-2, near - 1e-3, near, near + 1e-3, near + 1e-2, np.pi / 2.0 - 1e-9]
    return sum(quad(density, a, b, limit=400)[0] for a, b in pairwise(steps))


def test_mobility_and_coincidence_of_a_steel_sheet():
    """Printed for 1 mm steel: coincidence near 12 kHz; Y = 1/(2.3 ρ c_L h²) within its rounding."""
    speed = np.sqrt(2.1e11 / (7850.0 * (1.0 - 0.09)))
    assert STEEL.coincidence_hz == pytest.approx(12e3, rel=0.02)
    exact = 1.0 / (2.3 * 7850.0 * speed * 1e-6)
    claim(
        "Mobility of a steel sheet of 1 mm", kind="exact", source=FORM("1/(2.3 ρ c_L h²)"),
        computed=STEEL.mobility_m_per_ns, reference=exact, tolerance=0.01 * exact, unit="m/(N s)",
        topics=("structure_borne",),
    )  # fmt: skip


def test_one_newton_at_one_metre_is_34_dba():
    """At 58.3 Hz, 1× of 3500 rpm; air on both sides takes 2 dB off the limp sheet's 34.2."""
    frequency = np.array([3500.0 / 60.0])
    plate = plate_of(STEEL)
    power = near_power(plate, frequency, one_newton(frequency), HERE)
    square = power * mean_square_per_power(np.array([1.0]), None)
    level = 10.0 * np.log10(square / 4e-10) + WEIGHTING["A"](frequency)
    assert level == pytest.approx(34.0, abs=3.0)
    assert level == pytest.approx(32.17, abs=0.02)


def test_near_field_of_a_limp_sheet_in_closed_form():
    frequency = np.array([20.0, 100.0, 500.0])
    plate = plate_of(STEEL)
    mu = 2.0 * AIR / (2.0 * np.pi * frequency * plate.mass_kg_per_m2)
    limp = AIR_DENSITY_KG_PER_M3 / (2.0 * np.pi * SPEED_OF_SOUND_M_PER_S * plate.mass_kg_per_m2**2)
    expected = limp * (1.0 - mu * np.arctan(1.0 / mu))
    power = near_power(plate, frequency, one_newton(frequency), HERE)
    claim(
        "Near field of a limp sheet", kind="exact", source=FORM("1 − µ arctan(1/µ)"), unit="W",
        computed=power, reference=expected, tolerance=2e-3 * expected,  # stiffness at 500 Hz: 0.2 %
        topics=("structure_borne",),
    )  # fmt: skip


@pytest.mark.parametrize("distance_m", [0.0, 0.25])
@pytest.mark.parametrize("hertz", [58.0, 1000.0, 8000.0])
def test_near_field_by_quadrature(hertz, distance_m):
    plate, frequency = plate_of(STEEL), np.array([hertz])
    feet = np.array([[0.0, 0.0, 0.0], [distance_m, 0.0, 0.0]])[: 2 if distance_m else 1]
    force = np.full((1, len(feet)), np.sqrt(2.0), dtype=complex)
    expected = power_by_quadrature(plate, hertz, 1e-6, distance_m)
    claim(
        f"Near field of a steel sheet, {hertz:g} Hz, feet {distance_m:g} m apart", unit="W",
        kind="second code", source=SECOND("quadrature over wavenumbers, test_plate"),
        computed=near_power(plate, frequency, force, feet)[0], reference=expected,
        tolerance=1e-3 * expected, topics=("structure_borne",),
    )  # fmt: skip


def test_waves_above_coincidence_by_quadrature():
    """A heavy wall of concrete, 2 to 8 times its coincidence; light load of air."""
    wall = StructureBorne(thickness_m=0.16, density_kg_per_m3=2300.0, youngs_modulus_pa=3e10,
                          loss_factor_ratio=0.02)  # fmt: skip
    plate = plate_of(wall)
    for ratio in (2.0, 4.0, 8.0):
        frequency = np.array([ratio * plate.coincidence_hz])
        expected = power_by_quadrature(plate, frequency[0], 0.02)
        given = wave_power(plate, frequency, np.array([wall.mobility_m_per_ns]))
        claim(
            f"Waves of a concrete wall at {ratio:g} times its coincidence", kind="second code",
            source=SECOND("quadrature over wavenumbers, test_plate"), computed=given[0], unit="W",
            reference=expected, tolerance=0.05 * expected, topics=("structure_borne",),
        )  # fmt: skip
        assert near_power(plate, frequency, one_newton(frequency), HERE)[0] == 0.0


def test_all_that_is_put_in_leaves_by_loss_and_both_sides():
    plate = plate_of(STEEL, (0.6, 0.5))
    frequency = np.geomspace(20.0, 2e4, 40)
    each_side = wave_power(plate, frequency, np.ones(40))
    share = STEEL.loss_factor_ratio / plate.total_loss_ratio(frequency)
    np.testing.assert_allclose(2.0 * each_side + share, 1.0, rtol=1e-12)


def test_radiation_efficiency_of_a_plate():
    """Above coincidence, toward it from below, and corners alone far below by their formula."""
    size, hertz = (4.0, 3.0), 1000.0
    above = radiation_efficiency(np.array([2000.0, 16000.0]), hertz, size)
    np.testing.assert_allclose(above, [np.sqrt(2.0), np.sqrt(16.0 / 15.0)], rtol=1e-12)
    # EN 12354-1, B.2: σ = 2 (l1 + l2)/(l1 l2) c/f_c δ1 + δ2 at λ = 1/2, worked out by hand
    delta_1 = (0.75 * np.log(3.0) + 1.0) / (4.0 * np.pi**2 * 0.75**1.5)
    delta_2 = 8.0 * 343.0**2 * 0.5 / (1e6 * np.pi**4 * 12.0 * 0.5 * np.sqrt(0.75))
    expected = 14.0 / 12.0 * 0.343 * delta_1 + delta_2
    assert radiation_efficiency(np.array([250.0]), hertz, size)[0] == pytest.approx(expected)
    assert not radiation_efficiency(np.array([500.0]), hertz, None).any()
    everywhere = radiation_efficiency(np.geomspace(1.0, 1e5, 200), hertz, size)
    assert np.all((everywhere > 0.0) & (everywhere <= 2.0))


def test_first_mode_ends_the_piston():
    """EN 12354-1, B.2: f11 = c²/(4 f_c) (1/l1² + 1/l2²), below it at most 4 l1 l2 f²/c²."""
    length, width, hertz, c = 0.8, 0.5, 12000.0, SPEED_OF_SOUND_M_PER_S
    first_hz = c**2 / (4.0 * hertz) * (1.0 / length**2 + 1.0 / width**2)
    frequency = first_hz * np.array([0.5, 0.99, 1.01])
    piston = 4.0 * length * width * (frequency / c) ** 2
    found = radiation_efficiency(frequency, hertz, (length, width))
    np.testing.assert_allclose(found[:2], piston[:2], rtol=1e-12)
    assert found[2] > 2.0 * piston[2]


def test_power_of_feet_together():
    """Close feet push as one, opposite ones cancel; far apart each for itself."""
    plate, frequency = plate_of(STEEL), np.array([100.0])
    mobility = np.full((1, 2), STEEL.mobility_m_per_ns)
    one = STEEL.mobility_m_per_ns
    for distance, force, expected in (
        (1e-6, [1.0, 1.0], 4.0 * one),
        (1e-6, [1.0, -1.0], 0.0),
        (2.404825557695773 / plate.wavenumber(frequency)[0], [1.0, -1.0], 2.0 * one),  # J0 = 0
    ):
        alike = likeness(plate, frequency, np.array([[0.0, 0.0], [0.0, distance]]))
        peaks = np.sqrt(2.0) * np.array([force], dtype=complex)
        assert input_power(peaks, mobility, alike)[0] == pytest.approx(expected, abs=1e-9)


def test_mean_mobility_of_a_finite_plate_is_that_without_end():
    """Modes of a hinged plate, mean over points and frequencies, η = 0.05.

    Its edges leave 1 - P/(2 k S) of the modes of its area (Weyl), 6 % fewer here: within 1 % then.
    """
    length, width, loss = 0.8, 0.6, 0.05
    m, n = np.meshgrid(np.arange(1, 60), np.arange(1, 60), indexing="ij")
    square = (m * np.pi / length) ** 2 + (n * np.pi / width) ** 2
    natural = np.sqrt(STEEL.bending_stiffness_n_m / STEEL.mass_kg_per_m2) * square
    omega = 2.0 * np.pi * np.linspace(300.0, 900.0, 60)[:, None, None]
    mass = STEEL.mass_kg_per_m2 * length * width
    summed = (1j * omega / (mass * (natural**2 * (1.0 + 1j * loss) - omega**2))).sum((1, 2))
    wavenumber = plate_of(STEEL).wavenumber(omega.ravel() / (2.0 * np.pi))
    fewer = 1.0 - np.mean((length + width) / (wavenumber * length * width))
    assert summed.real.mean() == pytest.approx(fewer * STEEL.mobility_m_per_ns, rel=0.01)
    density = np.sum((natural > omega[0, 0, 0]) & (natural < omega[-1, 0, 0])) / 600.0
    overlap = modal_overlap(np.array(600.0), STEEL.mass_kg_per_m2, STEEL.bending_stiffness_n_m,
                            np.array(loss), length * width)  # fmt: skip
    assert overlap == pytest.approx(600.0 * loss * density, rel=0.1)


def test_variance_by_random_matrices():
    """Energy of 3 modes a band and of 0.5, natural frequencies of random matrices: within 10 %."""
    generator = np.random.default_rng(1)
    size, runs = 90, 500
    energy = {0.5: [], 3.0: []}
    for _ in range(runs):
        matrix = generator.standard_normal((size, size))
        values = np.linalg.eigvalsh((matrix + matrix.T) / 2.0)
        spacing = np.pi / np.sqrt(2.0 * size)  # in the middle of the semicircle
        middle = np.linspace(-4.0, 4.0, 5) * spacing * 3.0
        weight = generator.standard_normal(size) ** 2
        for overlap, values_so_far in energy.items():
            half = 0.5 * overlap * spacing
            each = weight / (1.0 + ((values - middle[:, None]) / half) ** 2)
            values_so_far.extend(each.sum(1).tolist())
    for overlap, of_overlap in energy.items():
        expected = np.var(of_overlap) / np.mean(of_overlap) ** 2
        assert relative_variance(np.array(overlap)) == pytest.approx(expected, rel=0.1)


def test_ranges_hold_the_mean_and_nine_in_ten():
    samples = np.random.default_rng(2).lognormal(-0.5 * np.log(2.0), np.sqrt(np.log(2.0)), 40000)
    low, high = level_range(np.array(1.0), 0.0)
    expected = 10.0 * np.log10(np.quantile(samples, [0.05, 0.95]) / samples.mean())
    np.testing.assert_allclose([low, high], expected, atol=0.15)
    np.testing.assert_allclose(level_range(np.array(0.0), 5.0), [-8.224, 8.224], atol=1e-3)
    assert np.all(np.diff(relative_variance(np.geomspace(0.01, 1e3, 100))) < 0.0)


def test_room_adds_the_diffuse_field():
    open_space = mean_square_per_power(np.array([2.0]), None)
    room = mean_square_per_power(np.array([2.0]), 10.0)
    assert open_space[0] == pytest.approx(AIR / (8.0 * np.pi))
    assert room[0] - open_space[0] == pytest.approx(0.4 * AIR)
