"""The part of the page that moves, in Chromium and Firefox from a file: levels, keys, sound."""

import base64
import re
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browsers import Firefox
from live_pages import (
    MOUNTS,
    OF_MOUNTS,
    OF_WEIGHT,
    baseline_run,
    both_run,
    floor_run,
    open_page,
    page_of,
    sliders_run,
    thesis_study,
)
from selenium.webdriver import Chrome
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from vibroacoustics.levels import a_weighting

pytestmark = pytest.mark.slow

EVERY = """const model = vibroacoustics.panel.model;
return model.every({...model.given(arguments[0]), ...arguments[1]})
  .map((speed) => speed.of.map((one) => [one.total, one.modelled]));"""
RENDERED = """const [s, m, option, quiet, seconds, done] = arguments;
const {panel, rendered} = vibroacoustics;
const sound = panel.model.sound(s, m, panel.model.given(option));
if (quiet) sound.rest = 0;
rendered(panel.page, [sound], seconds, 48000).then((samples) => done(text(samples)));
"""
TEXT = """const text = (samples) => {
  const bytes = new Uint8Array(samples.buffer);
  let letters = "";
  for (let i = 0; i < bytes.length; i += 8192) {
    letters += String.fromCharCode(...bytes.subarray(i, i + 8192));
  }
  return btoa(letters);
};
"""


@pytest.fixture(scope="module")
def results():
    return sliders_run()


@pytest.fixture(scope="module")
def page(results, tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("live") / "report.html"
    path.write_bytes(page_of(results))
    return path


@pytest.fixture(scope="module")
def opened(browser: Chrome, page: Path) -> Chrome:
    metrics = {"width": 390, "height": 844, "deviceScaleFactor": 2, "mobile": True}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
    open_page(browser, page)
    unfold(browser)
    return browser


def unfold(browser: Chrome) -> None:
    browser.execute_script("document.querySelector('details:has(#live)').open = true")


def levels_of(results, option) -> np.ndarray:
    """Total and modelled level, (speed, receiver, 2)."""
    at = results.sel(option=option)
    both = at["level_total"], at["level_modelled"].sel(weighting="A")
    return np.stack([one.transpose("speed", "receiver").values for one in both], axis=-1)


def sampled(letters: str) -> np.ndarray:
    return np.frombuffer(base64.b64decode(letters), "<f4").astype(float)


@pytest.mark.parametrize(
    ("option", "moved", "reference"),
    [
        (0, {}, "none"),
        (1, {}, "pendulum-inline"),
        (0, OF_WEIGHT, "weight"),
        (0, OF_MOUNTS, "mounts"),
        (4, OF_WEIGHT, "both"),
    ],
)
def test_sliders_show_what_the_pipeline_computes(opened, results, option, moved, reference):
    got = np.array(opened.execute_script(EVERY, option, moved))
    if reference != "both":
        np.testing.assert_allclose(got, levels_of(results, reference), atol=1e-3)
    else:  # the remainder is another one where the machine itself stands on other mounts
        np.testing.assert_allclose(got[..., 1], levels_of(both_run(), "weight")[..., 1], atol=1e-3)


def test_keys_move_levels_and_reset_takes_them_back(opened):
    opened.execute_script(
        "vibroacoustics.panel.at('option').value = 0; vibroacoustics.panel.reset()"
    )
    says = opened.find_element(By.CSS_SELECTOR, "[data-live=says]")
    before = says.text
    slider = opened.find_element(By.CSS_SELECTOR, "[data-live=moment]")
    slider.send_keys(Keys.END)
    moved = says.text
    assert before.startswith("Total 5")
    assert moved != before
    assert slider.get_attribute("aria-valuetext").endswith("g mm")
    slider.send_keys(Keys.TAB)
    assert opened.switch_to.active_element.get_attribute("data-live") == "angle"
    opened.find_element(By.CSS_SELECTOR, "[data-live=reset]").send_keys(Keys.ENTER)
    assert says.text == before
    assert opened.get_log("browser") == []


def test_a_phone_shows_it_without_scrolling_sideways(opened):
    width, window, charts = opened.execute_script(
        "return [document.documentElement.scrollWidth, innerWidth,"
        " document.querySelectorAll('#live canvas').length]"
    )
    assert (window, charts) == (390, 2)
    assert width <= window


def test_values_are_options_that_a_study_takes(opened):
    moved = {**OF_WEIGHT, **OF_MOUNTS}
    script = "const p = vibroacoustics.panel; return p.toml({...p.model.given(0), ...arguments[0]})"
    options = tomllib.loads(opened.execute_script(script, moved))["options"]
    weight = options["weight-tried"]
    assert weight["kind"] == "counterweight"
    assert weight["mass_g"] * weight["radius_mm"] == pytest.approx(12.0 * 25.0)
    assert [weight["angle_deg"], weight["height_mm"]] == pytest.approx([200.0, 40.0])
    mounts = options["mounts-tried"]["change"]["mounts"]
    assert {name: one["value"] for name, one in mounts.items()} == pytest.approx(MOUNTS)
    study = thesis_study({f"options.{name}": table for name, table in options.items()})
    assert {"weight-tried", "mounts-tried"} < set(study.options)


def test_orders_sound_at_their_levels(opened, results):
    asked = opened.execute_script(
        "const p = vibroacoustics.panel; return p.model.sound(0, 1, p.model.given(1)).orders"
    )
    script = f"{TEXT}{RENDERED}"
    samples = sampled(opened.execute_async_script(script, 0, 1, 1, True, 3.0))
    scale = opened.execute_script("return vibroacoustics.panel.page.full_scale_pa")
    peaks = np.abs(np.fft.rfft(samples)) * 2.0 / samples.size * scale
    for order, peak in enumerate(asked):
        if peak and np.hypot(*peak) > 1e-6:
            level = 20.0 * np.log10(peaks[145 * order] / np.hypot(*peak))  # 145 turns in 3 s
            assert abs(level) < 0.05
    assert sum(bool(peak) for peak in asked) >= 3


def test_the_sound_has_the_level_that_is_shown(opened, results):
    samples = sampled(opened.execute_async_script(f"{TEXT}{RENDERED}", 0, 1, 1, False, 3.0))
    scale = opened.execute_script("return vibroacoustics.panel.page.full_scale_pa")
    spectrum = np.fft.rfft(samples) * 2.0 / samples.size * scale
    hertz = np.arange(spectrum.size) / 3.0
    weight = 10.0 ** (a_weighting(np.maximum(hertz, 1e-3)) / 10.0)
    level = 10.0 * np.log10((0.5 * weight * np.abs(spectrum) ** 2)[1:].sum() / 4e-10)
    name = str(results["option"].values[1])
    assert level == pytest.approx(levels_of(results, name)[0, 1, 0], abs=0.05)


def test_twice_the_shaft_beats_with_twice_the_mains(opened):
    script = f"""{TEXT} const [done] = arguments, {{panel, rendered}} = vibroacoustics;
    const sound = {{shaft: 2900 / 60, orders: [, , [0.01, 0]], tones: [[100, 0.01, 0]],
      noise: [], rest: 0}};
    rendered(panel.page, [sound], 3, 8000).then((samples) => done(text(samples)));"""
    samples = sampled(opened.execute_async_script(script))
    envelope = np.abs(np.fft.rfft(samples**2))[1:60]
    assert (np.argmax(envelope) + 1) / 3.0 == pytest.approx(10.0 / 3.0)


def test_a_switch_leaves_no_gap(opened):
    script = f"""{TEXT} const done = arguments[0], {{panel, rendered}} = vibroacoustics;
    const one = panel.model.sound(0, 1, panel.model.given(1));
    const none = {{...one, orders: [], rest: 0}};
    const page = panel.page, ask = (sounds) => rendered(page, sounds, 0.5, 8000, 0.25);
    Promise.all([ask([one]), ask([one, one]), ask([one, none])])
      .then((all) => done(all.map(text)));"""
    alone, same, silenced = map(sampled, opened.execute_async_script(script))
    np.testing.assert_allclose(same, alone, atol=1e-4 * np.abs(alone).max())
    before, after = int(0.25 * 8000), int(0.255 * 8000)  # 5 ms
    np.testing.assert_allclose(silenced[:before], alone[:before], atol=1e-6)
    assert not np.any(silenced[after:])


def test_a_slider_retunes_the_sound_at_once(opened):
    script = f"""{TEXT} const done = arguments[0], {{panel, Voice}} = vibroacoustics;
    const context = new OfflineAudioContext(1, 48000, 48000), page = panel.page;
    const of = (size) => ({{shaft: 50, orders: [, [size, 0]], tones: [], noise: [], rest: 0}});
    const voice = new Voice(context, of(0.01), page.bands, 1, 0);
    voice.retune(of(0.02), 0.3);
    voice.out.connect(context.destination);
    context.startRendering().then((buffer) => done(text(buffer.getChannelData(0))));"""
    samples = sampled(opened.execute_async_script(script))
    wave = np.cos(2.0 * np.pi * 50.0 * np.arange(48000) / 48000)
    switched = int(0.3 * 48000)
    np.testing.assert_allclose(samples[:switched], 0.01 * wave[:switched], atol=2e-5)
    after = switched + int(0.045 * 48000)  # with 5 ms that the script waits
    np.testing.assert_allclose(samples[after:], 0.02 * wave[after:], atol=4e-5)


def test_a_blind_test_counts_right(opened):
    script = """const done = arguments[0], panel = vibroacoustics.panel;
    const press = (name) => panel.at(name).click(), said = [];
    press("abx-start");
    const trial = () => {
      if (panel.abx.finished) {
        panel.hear(null);
        return done([panel.abx.right, said, panel.at("abx-score").textContent,
          panel.at("abx-X").disabled]);
      }
      press("abx-X");
      const pressed = ["A", "B"].filter(
        (one) => panel.at(`hear-${one}`).getAttribute("aria-pressed") === "true");
      said.push(pressed.length);
      const hears = panel.player.playing, errs = said.length % 5 === 0;
      press(`abx-is-${errs ? { A: "B", B: "A" }[hears] : hears}`);
      setTimeout(trial, 5);
    };
    trial();"""
    right, shown, words, ended = opened.execute_async_script(script)
    assert (right, ended) == (8, True)  # the listener errs at every fifth of ten
    assert not any(shown)
    chance = 100.0 * (45 + 10 + 1) / 1024
    assert words.startswith("8 of 10 right")
    assert f"{chance:.1f} %" in words


def test_without_script_and_on_paper_it_is_not_there(opened, page):
    def shown() -> bool:
        return opened.find_element(By.CSS_SELECTOR, ".live-panel").is_displayed()

    assert shown()
    opened.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    assert not shown()
    opened.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
    opened.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": True})
    try:
        opened.get(page.as_uri())
        opened.find_element(By.TAG_NAME, "summary").click()
        assert "where a browser runs its script" in opened.find_element(By.ID, "live").text
        assert not shown()
    finally:
        opened.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": False})
        open_page(opened, page)
        unfold(opened)


def test_only_its_scripts_may_run(page, opened):
    text = page.read_text()
    policy = re.findall(r'Policy" content="([^"]*)"', text)[0].replace("&#39;", "'")
    assert policy.startswith("default-src 'none'")
    assert len(re.findall(r"script-src( 'sha256-[^']+'){2};", policy)) == 1
    assert "unsafe" not in policy
    opened.execute_script(
        "const s = document.createElement('script'); s.textContent = 'window.evil = 1';"
        "document.body.append(s)"
    )
    assert opened.execute_script("return window.evil") is None
    opened.get_log("browser")  # the refusal


def test_firefox_shows_the_same(fox: Firefox, page: Path, results: Any):
    fox.open(page.as_uri(), 390)
    fox.run("while (!window.vibroacoustics) await new Promise((done) => setTimeout(done, 5))")
    moved = ", ".join(f"{name}: {value}" for name, value in {**OF_WEIGHT}.items())
    got = np.array(
        fox.run(EVERY.replace("arguments[0]", "0").replace("arguments[1]", f"{{{moved}}}"))
    )
    np.testing.assert_allclose(got, levels_of(results, "weight"), atol=1e-3)
    assert fox.run("return document.documentElement.scrollWidth") <= 390
    fox.run("document.querySelector('details:has(#live)').open = true;"
            "vibroacoustics.panel.at('option').value = 0; vibroacoustics.panel.reset();"
            "vibroacoustics.panel.at('moment').focus()")  # fmt: skip
    says = "return vibroacoustics.panel.at('says').textContent"
    before = fox.run(says)
    fox.press("\ue010")  # the End key
    assert fox.run(says) != before
    letters = fox.run(
        f"""{TEXT} const {{panel, rendered}} = vibroacoustics;
        const sound = {{...panel.model.sound(0, 1, panel.model.given(1)), rest: 0}};
        const samples = await rendered(panel.page, [sound], 3, 48000);
        return [text(samples), sound.orders[1], panel.page.full_scale_pa];"""
    )
    samples, peak, scale = sampled(letters[0]), letters[1], letters[2]
    line = np.abs(np.fft.rfft(samples))[145] * 2.0 / samples.size * scale
    assert abs(20.0 * np.log10(line / np.hypot(*peak))) < 0.05
    assert fox.log == []


def test_a_weight_adds_to_what_cannot_be_taken_apart(browser, tmp_path):
    results = floor_run()
    (tmp_path / "page.html").write_bytes(page_of(results))
    open_page(browser, tmp_path / "page.html")
    assert browser.execute_script("return vibroacoustics.panel.page.mounts_move") is False
    got = np.array(browser.execute_script(EVERY, 0, OF_WEIGHT))
    np.testing.assert_allclose(got, levels_of(results, "weight"), atol=1e-3)
    unfold(browser)
    assert not browser.find_element(By.CSS_SELECTOR, "[data-live=lateral]").is_displayed()
    assert "do not move here" in browser.find_element(By.ID, "live").text


def test_sliders_move_over_a_baseline_as_in_the_pipeline(browser, tmp_path):
    results = baseline_run(tmp_path)
    (tmp_path / "page.html").write_bytes(page_of(results))
    open_page(browser, tmp_path / "page.html")
    assert browser.execute_script("return vibroacoustics.panel.page.mounts_move") is True
    none = levels_of(results, "none")
    for option, moved in (("none", {}), ("weight", OF_WEIGHT), ("mounts", OF_MOUNTS)):
        got = np.array(browser.execute_script(EVERY, 0, moved))
        expected = levels_of(results, option)
        np.testing.assert_allclose(got, expected, atol=1e-3)
        assert option == "none" or np.abs(expected - none)[0, 0, 0] > 0.03


def test_charts_are_drawn_when_seen_and_one_wave_is_made_of_many_events(browser, page):
    open_page(browser, page)
    script = """const done = arguments[0], panel = vibroacoustics.panel, counts = [0, 0];
    const later = (act) => setTimeout(act, 300);
    panel.hear("B");
    const voice = panel.player.voices.B;
    voice.retune = () => { counts[1] += 1; };
    for (let i = 0; i < 5; i++) {
      panel.at("angle").value = 10 * i;
      panel.at("angle").dispatchEvent(new Event("input"));
      panel.spectrum.draw(() => { counts[0] += 1; return [[], [], [], []]; });
    }
    later(() => {
      const folded = [...counts];
      document.querySelector("details:has(#live)").open = true;
      panel.at("spectrum").scrollIntoView();
      panel.hear(null);
      later(() => done([folded, counts]));
    });"""
    folded, seen = browser.execute_async_script(script)
    assert folded == [0, 1]
    assert seen == [1, 1]
