"""The sound of a run-up on its page: parts, levels, solo and mute, in Chromium and Firefox."""

import base64

import numpy as np
import pytest
from browsers import Firefox
from selenium.webdriver import Chrome
from selenium.webdriver.common.by import By
from support import assert_refused, command_here

from vibroacoustics import (
    OrderAnalysis,
    SpeedChannel,
    analyse_orders,
    export_recording,
    label_recording,
)
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.measured import run_up_sound as sounds
from vibroacoustics.measured.run_up_sound import listened, played
from vibroacoustics.report.live.run_up_data import mu_law
from vibroacoustics.report.recordings import analysis_of_orders

RATE_HZ = 20480.0
TIME_S = np.arange(int(15.0 * RATE_HZ)) / RATE_HZ
SHAFT_HZ = 20.0 + 2.0 * TIME_S
ANGLE = 2.0 * np.pi * (20.0 * TIME_S + TIME_S**2)
ORDER_3_PA = 0.05 + 0.2 / (1.0 + ((3.0 * SHAFT_HZ - 100.0) / 8.0) ** 2)
NOISE_PA = 0.02 * np.random.default_rng(3).standard_normal(TIME_S.size)
SETTINGS = OrderAnalysis(SpeedChannel("speed"), orders=(1.0, 3.0), with_map=None)
READY = """const done = arguments[0];
const wait = () => (window.vibroacoustics ? done() : setTimeout(wait, 5));
wait();"""
TEXT = """const text = (samples) => {
  const bytes = new Uint8Array(samples.buffer);
  let letters = "";
  for (let i = 0; i < bytes.length; i += 8192) {
    letters += String.fromCharCode(...bytes.subarray(i, i + 8192));
  }
  return btoa(letters);
};
"""
PARTS = f"{TEXT} return vibroacoustics.panel.sound.rendered().map(text);"


@pytest.fixture(scope="module")
def recording():
    signal = 0.5 * np.cos(ANGLE + 0.4) + ORDER_3_PA * np.cos(3.0 * ANGLE) + NOISE_PA + 1.0
    names, units = ["microphone", "speed"], ["Pa", "rpm"]
    return label_recording([signal, 60.0 * SHAFT_HZ], RATE_HZ, names, units)


@pytest.fixture(scope="module")
def orders(recording):
    return analyse_orders(recording, SETTINGS)


@pytest.fixture(scope="module")
def sound(recording, orders):
    return listened(recording, SETTINGS, orders, "microphone")


@pytest.fixture(scope="module")
def page(orders, sound, tmp_path_factory):
    path = tmp_path_factory.mktemp("sound") / "orders.html"
    path.write_bytes(analysis_of_orders(orders, "microphone", sound).html())
    return path


@pytest.fixture(scope="module")
def opened(browser: Chrome, page) -> Chrome:
    metrics = {"width": 1280, "height": 900, "deviceScaleFactor": 1, "mobile": False}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
    browser.get(page.as_uri())
    browser.execute_async_script(READY)
    return browser


def samples_of(letters):
    return np.frombuffer(base64.b64decode(letters), "<f4").astype(float)


def block_levels(orders, samples, sound):
    """RMS of samples under the window of every block that is within the sound, and which."""
    rms, inside = [], []
    time_s = sound.start_s + np.arange(samples.size) / sound.sample_rate_hz
    duration_s = 60.0 * orders.attrs["revolutions_per_block"] / orders["block_speed"].values
    for middle_s, length_s in zip(orders["block_time"].values, duration_s, strict=True):
        share = (time_s - middle_s) / length_s
        window = np.where(np.abs(share) < 0.5, np.cos(np.pi * share) ** 2, 0.0)
        inside.append(middle_s - length_s > time_s[0] and middle_s + length_s < time_s[-1])
        rms.append(np.sqrt(np.sum((window * samples) ** 2) / np.sum(window**2)))
    return np.array(rms), np.array(inside)


def assert_as_loud_as_the_cut(orders, sound, parts):
    for number, order in enumerate(sound.order):
        rms, inside = block_levels(orders, parts[number], sound)
        cut = orders["block_order_rms"].sel(channel="microphone", order=order).values
        difference_db = 20.0 * np.log10(rms / cut)[inside]
        assert inside.mean() > 0.9
        assert abs(np.mean(difference_db)) < 0.05
        assert np.abs(difference_db).max() < 0.3  # with noise in the band of a block
        assert np.percentile(np.abs(difference_db), 90) < 0.1


def test_orders_and_residual_are_those_of_the_signal(sound):
    """Envelopes against the peaks that the signal is made of; the residual is the noise."""
    assert (sound.order.tolist(), sound.sample_rate_hz) == ([1.0, 3.0], 16000.0)
    time_s = sound.start_s + np.arange(sound.envelope.shape[1]) / sound.envelope_rate_hz
    inner = slice(20, -20)
    wanted = np.interp(time_s, TIME_S, ORDER_3_PA)[inner]
    np.testing.assert_allclose(np.abs(sound.envelope[1, inner]), wanted, atol=0.01)
    np.testing.assert_allclose(sound.envelope[0, inner], 0.5 * np.exp(0.4j), atol=0.01)
    rms = np.sqrt(np.mean(sound.residual**2))
    assert rms == pytest.approx(0.02 * np.sqrt(16000.0 / RATE_HZ), rel=0.03)


def test_rates_that_a_browser_plays():
    signal = np.cos(2.0 * np.pi * 100.0 * np.arange(44100) / 44100.0)
    for rate_hz, wanted_hz in ((44100.0, 16000.0), (2000.0, 8000.0), (51199.3, 51199.3 / 3.0)):
        samples, got_hz = played(signal, rate_hz)
        assert got_hz == pytest.approx(wanted_hz)
        assert samples.size / got_hz == pytest.approx(signal.size / rate_hz, abs=1e-3)
    assert played(signal, 12000.0)[0] is signal


def test_coding_of_the_residual_is_38_db_below_it():
    noise = np.random.default_rng(0).standard_normal(50_000)
    for gain in (0.2, 0.01):
        sample = gain * noise / np.abs(noise).max()
        size = (mu_law(sample) - 128.0) / 127.0
        decoded = np.sign(size) * np.expm1(np.abs(size) * np.log(256.0)) / 255.0
        error_db = 10.0 * np.log10(np.mean((decoded - sample) ** 2) / np.mean(sample**2))
        assert error_db < (-35.0 if gain > 0.1 else -20.0)


def test_a_long_recording_is_refused(recording, orders, monkeypatch):
    monkeypatch.setattr(sounds, "LONGEST_S", 10.0)
    with pytest.raises(
        ParameterError, match=r"listen = microphone: 15 s are too long, at most 10 s"
    ):
        listened(recording, SETTINGS, orders, "microphone")
    assert listened(recording, SETTINGS, orders) is None
    with pytest.raises(ParameterError, match="nose"):
        listened(recording, SETTINGS, orders, "nose")


def test_an_unknown_channel_is_refused_before_the_analysis(recording, tmp_path):
    file = export_recording(recording, tmp_path / "run_up.nc")
    words = ("orders", file, "--speed-channel", "speed", "--out", tmp_path / "out", "--listen")
    for name in ("nose", "speed"):
        message = f"run_up.nc: --listen = {name}: must be one of microphone"
        assert_refused(command_here(*words, name), message)
    assert not (tmp_path / "out").exists()
    outcome = command_here(*words, "microphone")
    assert outcome.returncode == 0, outcome.stderr
    assert '"residual":' in (tmp_path / "out" / "orders.html").read_text("utf-8")


def test_the_first_channel_of_sound_pressure_is_heard(recording, orders, sound):
    by_default = listened(recording, SETTINGS, orders)
    assert by_default.channel == "microphone"
    np.testing.assert_array_equal(by_default.residual, sound.residual)
    assert listened(recording, SETTINGS, orders.drop_vars("order_map")) is None
    other = orders.assign_coords(channel_unit=("channel", ["V"]))
    assert listened(recording, SETTINGS, other) is None


@pytest.mark.slow
def test_an_order_alone_is_as_loud_as_its_cut(opened, orders, sound):
    parts = [samples_of(letters) for letters in opened.execute_script(PARTS)]
    assert_as_loud_as_the_cut(orders, sound, parts)
    residual = parts[-1]
    assert residual.size == sound.residual.size
    error_db = 20.0 * np.log10(np.std(residual - sound.residual) / np.std(sound.residual))
    assert error_db < -35.0


@pytest.mark.slow
def test_solo_mute_and_play_from_a_speed(opened):
    opened.execute_script("vibroacoustics.panel.cut(3, 2400)")
    opened.find_element(By.CSS_SELECTOR, "[data-live=play]").click()
    gains = (
        "return vibroacoustics.panel.sound.gains.map((_, part) => "
        "vibroacoustics.panel.sound.hears(part))"
    )
    assert opened.execute_script(gains) == [True, True, True]
    begun_s = opened.execute_script("return vibroacoustics.panel.sound.now")
    assert begun_s == pytest.approx(10.0, abs=1.0)  # 2400 rpm is at 10 s
    press = "document.querySelector(`[aria-label='${arguments[0]}']`).click()"
    opened.execute_script(press, "Solo 3×")
    assert opened.execute_script(gains) == [False, True, False]
    opened.execute_script(press, "Solo 3×")
    opened.execute_script(press, "Mute residual")
    assert opened.execute_script(gains) == [True, True, False]
    script = """const done = arguments[0], {sound} = vibroacoustics.panel;
    const values = () => sound.gains.map((gain) => gain.gain.value);
    setTimeout(() => done([sound.fullScale, ...values()]), 300);"""
    full_scale, *values = opened.execute_async_script(script)
    np.testing.assert_allclose(np.array(values) * full_scale, [1.0, 1.0, 0.0], atol=0.01)
    assert "rpm" in opened.find_element(By.CSS_SELECTOR, "[data-live=heard]").text
    opened.find_element(By.CSS_SELECTOR, "[data-live=stop]").click()
    assert opened.find_element(By.CSS_SELECTOR, "[data-live=heard]").text == ""
    assert opened.get_log("browser") == []


@pytest.mark.slow
def test_firefox_renders_the_same(fox: Firefox, page, orders, sound):
    fox.open(page.as_uri(), 1280)
    fox.run("while (!window.vibroacoustics) await new Promise((done) => setTimeout(done, 5))")
    assert_as_loud_as_the_cut(orders, sound, [samples_of(one) for one in fox.run(PARTS)])
    fox.run("vibroacoustics.panel.play(); vibroacoustics.panel.silence()")
    assert fox.log == []
