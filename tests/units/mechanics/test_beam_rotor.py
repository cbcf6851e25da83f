"""Finite-element rotor: exact frequencies, order of convergence, gyroscopic splitting."""

import numpy as np
import pytest
from documents import FORM, ROSS
from evidence import claim
from hypothesis import given
from hypothesis import strategies as st
from rotor_at_rest import natural_frequencies_hz

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.mechanics.beam_rotor import (
    RotorMatrices,
    Section,
    assemble,
    beam_element,
    whirl_frequencies_hz,
    with_disc,
)

STEEL = Section(16e-3, 2.1e11, 7850.0)
LENGTH = 0.12


def _pinned(elements, section=STEEL):
    """Uniform shaft whose ends cannot move sideways."""
    rotor = assemble(section, np.linspace(0.0, LENGTH, elements + 1))
    size = len(rotor.mass)
    kept = np.setdiff1d(np.arange(size), [0, 1, size - 4, size - 3])
    at = np.ix_(kept, kept)
    return RotorMatrices(rotor.mass[at], rotor.gyroscopic[at], rotor.stiffness[at])


def _exact_hz(mode, spin, section=STEEL):
    """Pinned Rayleigh shaft: (ρA + ρI k²) ω² ± 2 ρI Ω k² ω = EI k⁴ with k = nπ/l."""
    k = mode * np.pi / LENGTH
    density, second = section.density_kg_per_m3, section.second_moment_m4
    mass = density * (section.area_m2 + second * k**2)
    gyroscopic = 2.0 * density * second * spin * k**2
    roots = np.roots([mass, -gyroscopic, -section.youngs_modulus_pa * second * k**4])
    return np.sort(np.abs(roots)) / (2.0 * np.pi)


@pytest.mark.parametrize("mode", [1, 2])
def test_frequency_converges_with_the_fourth_power(mode):
    """Cubic shapes: the error of a frequency falls as the element's length to the fourth.

    The next term of the error is smaller by (k h)²/10 or so: 4 % at eight elements, mode 2.
    """
    errors = [
        natural_frequencies_hz(_pinned(n))[2 * mode - 1] / _exact_hz(mode, 0.0)[0] - 1.0
        for n in (8, 16)
    ]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(4.0, abs=0.06)


@pytest.mark.parametrize("spin", [0.0, 312.0, 20000.0])
def test_whirl_of_a_pinned_shaft(spin):
    found = whirl_frequencies_hz(_pinned(40), spin)[:4]
    exact = np.concatenate([_exact_hz(mode, spin) for mode in (1, 2)])
    # Error (k h)⁴/1440 of a frequency: (2π/40)⁴/1440 = 4e-7 of mode 2.
    claim(
        f"Whirl of a pinned shaft at {spin:g} rad/s", kind="exact", unit="Hz", computed=found,
        source=FORM("(ρA + ρI k²) ω² ± 2 ρI Ω k² ω = EI k⁴"), reference=exact,
        tolerance=1e-6 * exact, topics=("shaft", "hermetic-reciprocating"),
    )  # fmt: skip


def test_free_slender_beam():
    """Euler-Bernoulli: βl = 4.730041 and 7.853205. Rotary inertia takes (d/l)² off: 1e-6."""
    section = Section(1e-3 * LENGTH, 2.1e11, 7850.0)
    found = natural_frequencies_hz(assemble(section, np.linspace(0.0, LENGTH, 41)))[4:8:2]
    stiffness = section.youngs_modulus_pa * section.second_moment_m4
    speed = np.sqrt(stiffness / (section.density_kg_per_m3 * section.area_m2))
    exact = np.array([4.730041, 7.853205]) ** 2 * speed / (2.0 * np.pi * LENGTH**2)
    claim(
        "Bending frequencies of a free slender beam", kind="exact", unit="Hz", computed=found,
        source=FORM("β l = 4.730041 and 7.853205, Euler and Bernoulli"), reference=exact,
        tolerance=5e-6 * exact, topics=("shaft", "hermetic-reciprocating"),
    )  # fmt: skip


@given(st.floats(1e-3, 0.1), st.floats(1e-3, 1.0))
def test_rigid_motions_of_an_element(diameter, length):
    """No force, the right mass and moments of inertia, no gyroscopic force of a translation."""
    section = Section(diameter, 2.1e11, 7850.0)
    element = beam_element(section, length)
    shift = np.array([1.0, 0, 0, 0, 1.0, 0, 0, 0])
    turn = np.array([0.0, 0, 0, 1.0, length, 0, 0, 1.0])  # θy about the first end
    mass = section.density_kg_per_m3 * section.area_m2 * length
    size = np.max(np.abs(element.stiffness)) * max(1.0, length)
    assert np.max(np.abs(element.stiffness @ np.stack((shift, turn)).T)) < 1e-12 * size
    assert shift @ element.mass @ shift == pytest.approx(mass, rel=1e-12)
    inertia = mass * (length**2 / 3.0 + diameter**2 / 16.0)
    assert turn @ element.mass @ turn == pytest.approx(inertia, rel=1e-12)
    assert np.max(np.abs(element.gyroscopic @ shift)) <= 1e-12 * np.max(np.abs(element.gyroscopic))
    turn_x = np.array([0.0, -0.0, 1.0, 0, 0, -length, 1.0, 0])
    polar = mass * diameter**2 / 8.0
    assert turn_x @ element.gyroscopic @ turn == pytest.approx(polar, rel=1e-12)


def test_disc_precesses_like_a_free_top():
    """A disc alone on a soft spring in tilt: Id ω² ± Ip Ω ω - k = 0."""
    zero, one = np.zeros((4, 4)), np.eye(4)
    rotor = with_disc(RotorMatrices(zero, zero, 1000.0 * one), 0, 0.8, 6e-4, 1e-3)
    roots = np.abs(np.roots([6e-4, 1e-3 * 312.0, -1000.0])) / (2.0 * np.pi)
    bounce = np.sqrt(1000.0 / 0.8) / (2.0 * np.pi)
    expected = np.sort([bounce, bounce, *roots])
    claim(
        "Whirl of a disc on a soft spring", kind="exact", unit="Hz", reference=expected,
        source=FORM("I_d ω² ± I_p Ω ω − k = 0"), computed=whirl_frequencies_hz(rotor, 312.0),
        tolerance=1e-9 * expected, topics=("shaft", "hermetic-reciprocating"),
    )  # fmt: skip


def test_nodes_must_ascend():
    with pytest.raises(ParameterError, match="must ascend"):
        assemble(STEEL, np.array([0.0, 0.1, 0.1]))


ROSS_2_3_HZ = {  # ross-rotordynamics 2.3.0, Rotor.run_modal, undamped, without axial and torsional
    (1e7, 312.0): [264.86546691, 278.57101855, 856.60863953, 897.20166043, 1155.47765525,
                   1180.0470177, 3436.80846469, 3465.39878285, 8034.28077133, 8070.06511101],
    (1e8, 5000.0): [225.41563726, 644.61945395, 1278.26559125, 2162.95604759, 3198.16945355,
                    3202.65530682, 3776.97416815, 4308.99026795, 8753.09129623, 9243.69622196],
}  # fmt: skip


@pytest.mark.parametrize(("stiffness", "spin"), list(ROSS_2_3_HZ))
def test_whirl_frequencies_of_another_package(stiffness, spin):
    """Four elements of 40, 40, 20, 20 mm; discs of 0.2 kg, 2e-5, 3e-5 kg m² and 0.8 kg, 0.6e-3,
    1e-3 kg m² at the ends; equal isotropic bearings at the first and third node; no shear."""
    rotor = assemble(STEEL, np.array([0.0, 0.04, 0.08, 0.10, 0.12]))
    rotor = with_disc(with_disc(rotor, 0, 0.2, 2e-5, 3e-5), 4, 0.8, 0.6e-3, 1e-3)
    supported = rotor.stiffness.copy()
    for at in (0, 1, 8, 9):
        supported[at, at] += stiffness
    found = whirl_frequencies_hz(RotorMatrices(rotor.mass, rotor.gyroscopic, supported), spin)
    # ROSS solves a non-symmetric eigenvalue problem with free axial motion: 1e-8 or so.
    expected = np.array(ROSS_2_3_HZ[stiffness, spin])
    claim(
        f"Ten whirl frequencies on bearings of {stiffness:g} N/m at {spin:g} rad/s", unit="Hz",
        kind="second code", source=ROSS("Rotor.run_modal"), computed=found[:10],
        reference=expected, tolerance=1e-7 * expected, topics=("shaft", "hermetic-reciprocating"),
    )  # fmt: skip
