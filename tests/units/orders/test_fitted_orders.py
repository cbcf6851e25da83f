"""Orders of a few revolutions and half orders, fitted to the whole recording."""

import numpy as np
import pytest
from support import assert_refused, command_here

import vibroacoustics as va
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.orders.fitted_orders import common_spacing, fit_orders

RATE_HZ = 12800.0
PEAKS = {0.5: 0.7 * np.exp(0.4j), 1.0: 1.5 * np.exp(-1.1j), 1.5: 0.2, 4.0: 0.5 * np.exp(2.0j)}
"""Pa."""


def turned(revolutions, start_hz=10.0, sweep_hz_per_s=0.0):
    """Crank angle in rad of a shaft that turns so often."""
    time_s = np.arange(round(10.0 * RATE_HZ)) / RATE_HZ
    turns = start_hz * time_s + 0.5 * sweep_hz_per_s * time_s**2
    return 2.0 * np.pi * turns[turns <= revolutions]


def sound(angle_rad, peaks=None):
    return sum((peak * np.exp(1j * order * angle_rad)).real for order, peak in
               (peaks or PEAKS).items())  # fmt: skip


def analysed(signal, rpm, orders=(0.5, 1.0, 1.5, 4.0), **options):
    recording = va.label_recording([signal], RATE_HZ, ["mic"], ["Pa"])
    settings = va.OrderAnalysis(va.NominalSpeed(rpm), orders, is_fit=True, **options)
    return va.analyse_orders(recording, settings)


def errors(found, orders=(0.5, 1.0, 1.5, 4.0)):
    values = found["channel_order"].values[0, 0]
    return max(abs(value - PEAKS[order]) for value, order in zip(values, orders, strict=True))


@pytest.mark.parametrize("revolutions", [2.05, 2.5, 3.7, 9.3])
def test_half_orders_of_a_few_revolutions(revolutions):
    """Against the amplitudes that made the sound, with a constant beside them."""
    found = analysed(0.3 + sound(turned(revolutions)), 600.0)
    assert errors(found) < 1e-6
    assert found.attrs["revolutions_per_block"] == pytest.approx(revolutions, abs=0.01)
    lines = found["mean_order_spectrum"].sel(channel="mic")
    assert lines.sel(map_order=0.5).item() == pytest.approx(0.7 / np.sqrt(2.0), rel=1e-6)
    assert lines.sel(map_order=0.0).item() == pytest.approx(0.3, abs=1e-6)
    assert lines.sel(map_order=2.0).item() < 1e-6


def test_against_the_blocks():
    """Whole revolutions in plenty: both ways have the same orders."""
    angle_rad = turned(40.0)
    recording = va.label_recording([sound(angle_rad)], RATE_HZ, ["mic"], ["Pa"])
    speed, orders, fine = va.NominalSpeed(600.0), (0.5, 1.0, 1.5, 4.0), {"resolution_order": 0.15}
    blocks = va.analyse_orders(recording, va.OrderAnalysis(speed, orders, **fine))
    fitted = va.analyse_orders(recording, va.OrderAnalysis(speed, orders, is_fit=True))
    np.testing.assert_allclose(
        fitted["channel_order_rms"].values, blocks["channel_order_rms"].values, rtol=2e-4
    )
    np.testing.assert_allclose(
        fitted["channel_order"].values, blocks["channel_order"].values, rtol=2e-4, atol=2e-5
    )


def test_a_run_up_over_the_angle():
    angle_rad = turned(3.7, sweep_hz_per_s=8.0)
    fitted = fit_orders(sound(angle_rad)[None], angle_rad, np.arange(0.5, 20.5, 0.5), True)
    assert abs(fitted[0, 1] - PEAKS[0.5]) < 1e-9
    assert abs(fitted[0, 8] - PEAKS[4.0]) < 1e-9


def test_weights_keep_other_sound_out():
    """A tone beyond the highest order that is fitted: the Hann weights let in less of it."""
    angle_rad = turned(3.7)
    other = sound(angle_rad, {27.3: 1.0})[None]
    orders = np.arange(0.5, 20.5, 0.5)
    let_in = {taper: np.abs(fit_orders(other, angle_rad, orders, taper)[0, 1:9]).max()
              for taper in (True, False)}  # fmt: skip
    assert let_in[True] < 1e-3 < let_in[False]


def test_spacing():
    assert common_spacing((0.5, 1.0, 1.5)) == 0.5
    assert common_spacing((2.0, 4.0)) == 2.0
    assert common_spacing((1.5, 2.0)) == 0.5
    assert common_spacing((1.0 / 3.0, 1.0)) == pytest.approx(1.0 / 3.0)


def test_what_cannot_be_fitted():
    with pytest.raises(ParameterError, match=r"orders 0\.5 apart need 2 revolutions, .* has 1\.9"):
        analysed(sound(turned(1.9)), 600.0)
    with pytest.raises(
        ParameterError, match="maximum_order = 700: must be above 0 and at most 576"
    ):
        analysed(sound(turned(3.0)), 600.0, maximum_order=700.0, orders=(1.0,))
    with pytest.raises(ParameterError, match=r"takes .* GiB, at most 1 GiB: analyse without fit"):
        analysed(np.zeros(900_000), 600.0, maximum_order=100.0)


def test_the_command(tmp_path):
    recording = va.label_recording([sound(turned(3.7))], RATE_HZ, ["mic"], ["Pa"])
    file = va.export_recording(recording, tmp_path / "engine.csv")
    words = ["orders", file, "--rpm", 600, "--orders", "0.5,1,1.5", "--out", tmp_path]
    assert_refused(command_here(*words, "--resolution", 0.25), "revolutions give --fit")
    done = command_here(*words)  # fewer than four revolutions are fitted
    assert done.returncode == 0, done.stderr
    assert "blocks of 3.7 revolutions, least squares, hann window" in done.stdout
    found = va.open_results(tmp_path / "orders.nc")["channel_order"].sel(order=0.5).item()
    assert abs(found - PEAKS[0.5]) < 1e-6
