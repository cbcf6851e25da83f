"""A synchronous motor with magnets in its rotor: inductances of three phases over the angle."""

import numpy as np
import pytest
from test_synchronous_motor import ANGLE, SPEED, THIRD, motor, of_phases

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.sources.synchronous_motor.harmonics import (
    _rotor_frame,
    dead_time_voltage_v,
    operating_point,
    pair_currents,
    reluctance_torque,
    shaft_orders,
)
from vibroacoustics.sources.synchronous_motor.switching import sidebands

OMEGA = 3.0 * SPEED
SALIENT = motor(saliency_ratio=1.8, current_advance_rad=np.radians(25.0), dead_time_s=3e-6)


def phase_inductances(given, angle):
    """Of three phases, shape (3, 3, angles), and by angle: the magnets' axis is a quarter behind
    their voltage, and a phase has the most flux where it faces the quadrature axis."""
    mean, half = given.phase_inductance_h, given.saliency_h
    shift = THIRD * np.arange(3)
    common = np.where(np.eye(3) > 0, 2.0, -1.0)[..., None] / 3.0 * mean
    both = 2.0 * angle - shift[:, None, None] - shift[None, :, None]
    return common + 2.0 / 3.0 * half * np.cos(both), -4.0 / 3.0 * half * np.sin(both)


def test_torque_is_that_of_inductances_over_the_angle():
    """p/2 iᵀ dL/dθ i of three phases, with harmonics of any phase."""
    current = {1: 12.0 + 5.0j, 5: 0.3j, 7: -0.4 + 0.1j, 11: 0.1 + 0.2j, 13: 0.05j}
    phases = of_phases(current)
    _, over_angle = phase_inductances(SALIENT, ANGLE)
    torque = 0.5 * SALIENT.pole_pairs * np.einsum("it,ijt,jt->t", phases, over_angle, phases)
    spectrum = 2.0 * np.fft.rfft(torque) / ANGLE.size
    spectrum[0] *= 0.5
    expected = reluctance_torque(SALIENT, _rotor_frame(current), 30)
    assert expected == pytest.approx(spectrum[:31], abs=1e-12)
    by_hand = 3.0 * 3.0 * SALIENT.saliency_h * (12.0 * 5.0)  # 3/2 p (L_q - L_d) i_q (-i_d)
    assert expected[0].real == pytest.approx(by_hand, rel=0.01)


def test_currents_meet_the_voltages_over_time():
    """R i + d(L i)/dt is what the dead time and the magnets leave, phase by phase."""
    point = operating_point(SALIENT, SPEED, 10.0)
    phases = of_phases(point.current_a)
    inductance, _ = phase_inductances(SALIENT, ANGLE)
    flux = np.fft.rfft(np.einsum("ijt,jt->it", inductance, phases), axis=-1)
    rise = np.fft.irfft(1j * OMEGA * np.arange(flux.shape[-1]) * flux, ANGLE.size)
    dropped = 2.0 * np.fft.rfft(SALIENT.phase_resistance_ohm * phases + rise) / ANGLE.size
    lost = dead_time_voltage_v(SALIENT)
    for k in (5, 7, 11, 13):
        assert dropped[0, k] == pytest.approx(lost[k] - point.emf_v[k], abs=1e-9), k
    assert dropped[0, 1] == pytest.approx(point.voltage_v - point.emf_v[1], abs=1e-9)
    assert np.angle(point.current_a[1]) == pytest.approx(np.radians(25.0))


@pytest.mark.parametrize("ratio", [0.7, 1.0, 2.5])
def test_mean_torque_is_carried_by_magnets_and_saliency(ratio):
    given = motor(saliency_ratio=ratio, current_advance_rad=0.3)
    orders = shaft_orders(given, operating_point(given, SPEED, 8.0), 36)
    assert orders[0] == pytest.approx(8.0, rel=1e-12)


def test_saliency_with_advance_spares_current():
    """The advance that spares most is that of the most torque per ampere, in closed form."""
    sizes = {
        degrees: abs(
            operating_point(
                motor(
                    saliency_ratio=2.0, current_advance_rad=np.radians(degrees), fifth_ratio=0.0,
                    seventh_ratio=0.0, eleventh_ratio=0.0, thirteenth_ratio=0.0, dead_time_s=0.0,
                ), SPEED, 10.0,
            ).current_a[1]
        )
        for degrees in np.arange(0.0, 45.0, 0.25)
    }  # fmt: skip
    best = min(sizes, key=sizes.__getitem__)
    difference, flux, size = 2.0 * 2e-3, 0.152, sizes[best]  # L_q - L_d of 6 mH and 2:1
    sine = (-flux + np.sqrt(flux**2 + 8.0 * (difference * size) ** 2)) / (4.0 * difference * size)
    assert np.sin(np.radians(best)) == pytest.approx(sine, abs=0.004)
    assert size < sizes[0.0]


def test_sidebands_of_a_salient_rotor_hold_the_voltages_of_both_axes():
    """Without resistance and far above the line each axis has its own inductance."""
    given = motor(saliency_ratio=1.5, phase_resistance_ohm=1e-12)
    fast = 1e6 * OMEGA
    along_q = pair_currents(given, (1.0, fast), (1.0, fast))
    along_d = pair_currents(given, (1.0, fast), (-1.0, fast))
    # Equal waves that turn both ways lie along one axis, opposite ones along the other.
    assert along_q[0] == pytest.approx(1.0 / (1j * fast * 7.2e-3))
    assert along_d[0] == pytest.approx(1.0 / (1j * fast * 4.8e-3))


def test_sidebands_differ_little_with_little_saliency():
    """And not at all without: the torque is that of one inductance."""
    round_rotor, nearly = motor(), motor(saliency_ratio=1.001)
    one, other = (
        {(s.carrier, s.electrical): s.torque_n_m for s in sidebands(
            given, operating_point(given, SPEED, 10.0), 9000.0)}
        for given in (round_rotor, nearly)
    )  # fmt: skip
    assert one.keys() == other.keys()
    largest = max(abs(value) for value in one.values())
    off = max(abs(one[side] - other[side]) for side in one) / largest
    assert 1e-6 < off < 5e-3


def test_an_advance_that_cannot_carry_the_load_is_refused():
    given = motor(saliency_ratio=0.2, current_advance_rad=1.0)
    with pytest.raises(ParameterError, match=r"current_advance_deg = 57.*at 40 N m"):
        operating_point(given, SPEED, 40.0)
