"""Oil film of a plain bearing: finite differences, closed forms, film and metal in series."""

import numpy as np
import pytest
from documents import FORM, SECOND
from evidence import claim
from reynolds_journal import coefficients

from vibroacoustics.mechanics.journal_film import JournalFilm, short_bearing

DIAMETER, CLEARANCE, VISCOSITY, SPEED = 0.025, 12.5e-6, 4.5e-3, 304.0
OMEGA = 2.0 * np.pi * np.array([48.3, 500.0, 4000.0])


def in_common(film):
    """What no turn of the axes changes: traces, and the determinant of the dynamic stiffness."""
    dynamic = film.stiffness + 1j * OMEGA[:, None, None] * film.damping
    return [np.trace(film.stiffness), np.trace(film.damping), *np.linalg.det(dynamic)]


@pytest.mark.parametrize("ratio", [0.2, 0.5, 0.7])
def test_short_bearing_by_finite_differences(ratio):
    """Length a tenth of the diameter: pressure flows along alone, but for (L/D)² or 1 %.

    The cut at zero pressure moves by the grid's 1.5 degrees: another half per cent.
    """
    size = DIAMETER, 0.1 * DIAMETER, CLEARANCE, VISCOSITY, SPEED
    load, stiffness, damping = coefficients(size, ratio)
    film = short_bearing(*size, load)
    assert film.eccentricity_ratio == pytest.approx(ratio, rel=0.01)
    numerical = JournalFilm(ratio, stiffness, damping)
    exact = np.array(in_common(numerical))
    claim(
        f"Stiffness and damping of a short film, eccentricity {ratio:g}", kind="second code",
        source=SECOND("Reynolds' equation by differences, reynolds_journal"), unit="1",
        computed=in_common(film) / exact, reference=np.ones(exact.size), tolerance=0.015,
        topics=("frame",),
    )  # fmt: skip
    swirl = film.stiffness[0, 1] - film.stiffness[1, 0]
    assert swirl == pytest.approx(abs(stiffness[0, 1] - stiffness[1, 0]), rel=0.015)


@pytest.mark.parametrize(("ratio", "error"), [(0.4, 0.25), (0.7, 0.2)])
def test_bearing_as_long_as_wide(ratio, error):
    """What the short film errs by there: the part of the loss that it makes is too small."""
    size = DIAMETER, 0.9 * DIAMETER, CLEARANCE, VISCOSITY, SPEED
    load, stiffness, damping = coefficients(size, ratio)
    films = short_bearing(*size, load), JournalFilm(ratio, stiffness, damping)
    short, exact = (loss_factor(film, 1e8) for film in films)
    assert np.all(short < exact)
    assert np.all(short > (1.0 - error) * exact)


def loss_factor(film, metal, omega=OMEGA[1:]):
    flexibility = film.flexibility(metal, omega)
    return -flexibility.imag / flexibility.real


def test_centred_journal():
    """Without load no stiffness, C = π μ R L³/2c³ and cross stiffness C Ω/2 (half Sommerfeld)."""
    length = 0.02
    film = short_bearing(DIAMETER, length, CLEARANCE, VISCOSITY, SPEED, 1e-3)
    damping = np.pi * VISCOSITY * 0.5 * DIAMETER * length**3 / (2.0 * CLEARANCE**3)
    scale = damping * SPEED
    # The first correction is linear in the eccentricity, some 1e-6.
    assert film.eccentricity_ratio < 1e-5
    claim(
        "Damping of a centred journal", kind="exact", source=FORM("π μ R L³/(2 c³)"), unit="N s/m",
        computed=film.damping, reference=damping * np.eye(2), tolerance=1e-4 * damping,
        topics=("frame",),
    )  # fmt: skip
    expected = 0.5 * scale * np.array([[0.0, 1.0], [-1.0, 0.0]])
    claim(
        "Cross stiffness of a centred journal", kind="exact", source=FORM("C Ω/2"), unit="N/m",
        computed=film.stiffness, reference=expected, tolerance=1e-4 * scale, topics=("frame",),
    )  # fmt: skip


def test_series_of_film_and_metal():
    """Half the trace of the matrices in series; metal alone beside a rigid film, and film alone."""
    film, metal = short_bearing(DIAMETER, 0.022, CLEARANCE, VISCOSITY, SPEED, 2960.0), 1e8 + 1e6j
    for omega, got in zip(OMEGA, film.flexibility(metal, OMEGA), strict=True):
        dynamic = film.stiffness + 1j * omega * film.damping
        series = np.linalg.inv(np.linalg.inv(dynamic) + np.eye(2) / metal)
        assert 1.0 / got == pytest.approx(0.5 * np.trace(series), rel=1e-12)
        alone = 2.0 / np.trace(dynamic)
        assert film.flexibility(1e20, np.array([omega]))[0] == pytest.approx(alone, rel=1e-8)
    assert loss_factor(film, metal)[0] == pytest.approx(0.03, abs=0.02)


@pytest.mark.parametrize("load_n", [1e-6, 1.0, 3e3, 1e5])
def test_load_is_carried(load_n):
    """The film's force at the eccentricity that it states is the load."""
    film = short_bearing(DIAMETER, 0.022, CLEARANCE, VISCOSITY, SPEED, load_n)
    e = film.eccentricity_ratio
    scale = VISCOSITY * SPEED * DIAMETER * 0.022**3 / (8.0 * CLEARANCE**2)
    got = scale * e * np.sqrt(16.0 * e**2 + np.pi**2 * (1.0 - e**2)) / (1.0 - e**2) ** 2
    claim(
        f"Load that a short film bears, {load_n:g} N", kind="exact", unit="N", computed=got,
        source=FORM("e √(16 e² + π² (1 − e²))/(1 − e²)²"), reference=load_n,
        tolerance=1e-6 * load_n, topics=("frame",),
    )  # fmt: skip
