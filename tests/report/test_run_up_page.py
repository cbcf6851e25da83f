"""The interactive map of a run-up, in Chromium and Firefox: cursor, cuts, sizes."""

import re
from pathlib import Path

import numpy as np
import pytest
from browsers import Firefox
from selenium.webdriver import ActionChains, Chrome
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from vibroacoustics import OrderAnalysis, SpeedChannel, analyse_orders, label_recording
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.levels import a_weighting
from vibroacoustics.report.live.run_up_data import (
    MOST_LEVELS,
    STEP_DB,
    level_bytes,
    shown_blocks,
)
from vibroacoustics.report.recordings import analysis_of_orders
from vibroacoustics.results.over_speed.run_up_sound import shown_channel

RATE_HZ = 4096.0
READY = """const done = arguments[0];
const wait = () => (window.vibroacoustics ? done() : setTimeout(wait, 5));
wait();"""


@pytest.fixture(scope="module")
def orders():
    """20 s up from 1200 to 3600 rpm: orders 1, 3 and 7.5, and a resonance at 200 Hz; offset."""
    time_s = np.arange(int(20.0 * RATE_HZ)) / RATE_HZ
    angle = 2.0 * np.pi * (20.0 * time_s + time_s**2)
    shaft_hz = 20.0 + 2.0 * time_s
    swelling = 0.05 + 0.4 / (1.0 + ((3.0 * shaft_hz - 130.0) / 5.0) ** 2)
    signal = 0.5 * np.cos(angle) + swelling * np.cos(3.0 * angle) + 0.1 * np.cos(7.5 * angle)
    signal += 0.002 * np.random.default_rng(3).standard_normal(time_s.size) + 2.0
    names, units = ["foot", "microphone", "speed"], ["m/s²", "Pa", "rpm"]
    recording = label_recording([9 * signal, signal, 60.0 * shaft_hz], RATE_HZ, names, units)
    settings = OrderAnalysis(SpeedChannel("speed"), orders=(1.0, 3.0), with_map=None)
    return analyse_orders(recording, settings)


@pytest.fixture(scope="module")
def page(orders, tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("run_up") / "orders.html"
    path.write_bytes(analysis_of_orders(orders).html())
    return path


@pytest.fixture(scope="module")
def opened(browser: Chrome, page: Path) -> Chrome:
    metrics = {"width": 1280, "height": 900, "deviceScaleFactor": 1, "mobile": False}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
    browser.get(page.as_uri())
    browser.execute_async_script(READY)
    browser.execute_script("document.querySelector('.run-up').scrollIntoView()")
    return browser


def level_of_lines(orders, channel, reference):
    """Level of every line of every block, dB, blocks by rising speed."""
    mapped = orders.sortby("block_speed")["order_map"].sel(channel=channel)
    peak = np.abs(mapped.transpose("block", "map_order").values)
    return 20.0 * np.log10(np.maximum(peak, 1e-12) / np.sqrt(2.0) / reference)


def cut_of_the_analysis(orders, order):
    rms = orders.sortby("block_speed")["block_order_rms"].sel(channel="microphone", order=order)
    return 20.0 * np.log10(rms.values / 20e-6)


def test_levels_of_8_bits_are_within_half_a_step():
    level_db = np.random.default_rng(0).uniform(30.0, 92.0, 5000)
    stored = level_bytes(level_db, 92.0)
    np.testing.assert_allclose(
        92.0 - (255.0 - stored) * STEP_DB, level_db, atol=0.5 * STEP_DB + 1e-9
    )


def test_a_long_recording_is_thinned():
    assert shown_blocks(831, 121).step == 1
    step = shown_blocks(100_000, 400).step
    assert 100_000 * 400 / step <= MOST_LEVELS


def test_the_first_channel_of_sound_pressure_is_shown(orders):
    assert shown_channel(orders, None) == "microphone"
    assert shown_channel(orders, "foot") == "foot"
    with pytest.raises(ParameterError, match="nose"):
        analysis_of_orders(orders, "nose")
    page = analysis_of_orders(orders, "foot").html().decode()
    assert "Interactive map of foot" in page


def test_the_page_allows_its_scripts_alone_and_markdown_omits_them(page, orders):
    text = page.read_text()
    policy = re.findall(r'Policy" content="([^"]*)"', text)[0].replace("&#39;", "'")
    assert len(re.findall(r"script-src( 'sha256-[^']+'){2};", policy)) == 1
    assert "unsafe" not in policy
    assert (
        "levels" not in analysis_of_orders(orders).markdown().decode().split("Interactive")[1][:80]
    )


@pytest.mark.slow
def test_every_point_of_the_map_reads_its_level(opened, orders):
    level_db = level_of_lines(orders, "microphone", 20e-6)
    script = """const {runUp} = vibroacoustics;
    return runUp.rpm.map((rpm) => runUp.orders.map((order) => runUp.read(order, rpm).level));"""
    first = orders.sizes["map_order"] - len(
        opened.execute_script("return vibroacoustics.runUp.orders")
    )
    got, wanted = np.array(opened.execute_script(script)), level_db[:, first:]
    loud = wanted > wanted.max() - 60.0
    assert loud.mean() > 0.05
    np.testing.assert_allclose(got[loud], wanted[loud], atol=0.5 * STEP_DB + 1e-6)
    assert got[~loud].max() < wanted.max() - 59.0


@pytest.mark.slow
def test_cut_at_an_order_is_that_of_the_analysis(opened, orders):
    for order in (1.0, 3.0):
        got = opened.execute_script("return vibroacoustics.runUp.orderCut(arguments[0])", order)
        np.testing.assert_allclose(got, cut_of_the_analysis(orders, order), atol=0.13)


@pytest.mark.slow
def test_weighted_cut_and_other_cuts(opened, orders):
    script = """const {runUp} = vibroacoustics;
    runUp.weighted = true;
    const weighted = runUp.orderCut(3);
    runUp.weighted = false;
    const cuts = [runUp.frequencyCut(60), runUp.speedCut(2400)];
    return [weighted, runUp.orderCut(3), runUp.rpm, ...cuts];"""
    curves = [np.array(values, dtype=float) for values in opened.execute_script(script)]
    weighted, plain, rpm, at_60_hz, at_speed = curves
    np.testing.assert_allclose(weighted - plain, a_weighting(3.0 * rpm / 60.0), atol=1e-6)
    # Order 1 is at 60 Hz at 3600 rpm, order 3 at 1200 rpm.
    fast = rpm > 3570.0
    np.testing.assert_allclose(at_60_hz[fast], 20.0 * np.log10(0.5 / 2**0.5 / 20e-6), atol=0.3)
    level_db = level_of_lines(orders, "microphone", 20e-6)
    nearest = int(np.abs(rpm - 2400.0).argmin())
    np.testing.assert_allclose(
        np.max(at_speed), level_db[nearest, orders["map_order"] > 0.4].max(), atol=0.13
    )


@pytest.mark.slow
def test_the_cursor_reads_and_a_click_cuts(opened):
    over = opened.find_element(By.CSS_SELECTOR, "[data-live=map] .u-over")
    place = """const {panel} = vibroacoustics, plot = panel.map.plot;
    const {width, height} = plot.over.getBoundingClientRect();
    return [plot.valToPos(3, "x") - width / 2, plot.valToPos(2600, "y") - height / 2];"""
    right, down = opened.execute_script(place)
    ActionChains(opened).move_to_element_with_offset(over, right, down).perform()
    says = opened.find_element(By.CSS_SELECTOR, "[data-live=says]")
    order, hertz, rpm, level = map(float, re.findall(r"[\d.]+", says.text)[:4])
    assert order == pytest.approx(3.0, abs=0.01)
    assert rpm == pytest.approx(2600.0, abs=15.0)
    assert hertz == pytest.approx(3.0 * rpm / 60.0, abs=0.2)
    assert level == pytest.approx(20.0 * np.log10(0.45 / 2**0.5 / 20e-6), abs=0.5)
    ActionChains(opened).click().perform()
    assert opened.execute_script("return vibroacoustics.panel.order") == pytest.approx(3.0)
    titles = [each.text for each in opened.find_elements(By.CSS_SELECTOR, ".charts .u-title")]
    assert titles[0] == "Order 3 over the speed"
    assert titles[2].startswith("Orders at 2")
    field = opened.find_element(By.CSS_SELECTOR, "[data-live=order]")
    field.clear()
    field.send_keys("7.5", Keys.TAB)
    assert opened.find_element(By.CSS_SELECTOR, "[data-live=order-cut] .u-title").text == (
        "Order 7.5 over the speed"
    )
    assert opened.get_log("browser") == []


LINE = """const {panel} = vibroacoustics, order = 3;
panel.at("line-part").open = true;
await new Promise((done) => setTimeout(done, 300));
const line = panel.line, plot = line.plot, box = plot.over.getBoundingClientRect();
panel.at("line-order").value = String(order);
const event = (name, time, hertz) => plot.over.dispatchEvent(new PointerEvent(name, {pointerId: 1,
  clientX: box.left + plot.valToPos(time, "x"), clientY: box.top + plot.valToPos(hertz, "y")}));
plot.over.setPointerCapture = () => {};
event("pointerdown", 4, order * 28);
event("pointermove", 10, order * 40);
event("pointermove", 10.02, order * 40.1);
event("pointerup", 10, order * 40);
event("pointermove", 12, order * 44);
event("pointerdown", 16, order * 52);
event("pointerup", 16, order * 52);
const drawn = panel.at("line-option").value;
panel.at("line-copy").click();
const said = panel.at("line-copy").textContent;
panel.at("line-back").click();
const fewer = panel.at("line-option").value;
panel.at("line-clear").click();
return [drawn, said, fewer, panel.at("line-option").value, panel.at("line-copy").disabled];"""


def assert_draws_a_line(drawn, said, fewer, cleared, is_disabled):
    points = [tuple(map(float, each.split(":"))) for each in drawn.split(" ")[1].split(",")]
    assert drawn.startswith("--tacholess-line ")
    # Order 3 over 3 is the shaft; a pixel is 0.02 s and 4 rpm.
    np.testing.assert_allclose(points, [(4, 1680), (10.02, 2406), (16, 3120)], atol=12.0)
    assert np.abs(np.array(points)[:, 0] - [4.0, 10.02, 16.0]).max() < 0.1
    assert (said, fewer.count(":")) == ("Copied", 2)
    assert (cleared, is_disabled) == ("", True)


@pytest.mark.slow
def test_a_line_that_is_drawn_is_printed_as_an_option(opened):
    script = f"const done = arguments[0]; (async () => {{{LINE}}})().then(done)"
    assert_draws_a_line(*opened.execute_async_script(script))
    assert opened.get_log("browser") == []


@pytest.mark.slow
def test_a_phone_shows_it_without_scrolling_sideways(browser, page):
    metrics = {"width": 390, "height": 844, "deviceScaleFactor": 2, "mobile": True}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
    browser.get(page.as_uri())
    browser.execute_async_script(READY)
    assert browser.execute_script("return document.documentElement.scrollWidth") <= 390


@pytest.mark.slow
def test_firefox_shows_the_same(fox: Firefox, page: Path, orders):
    fox.open(page.as_uri(), 1280)
    fox.run("while (!window.vibroacoustics) await new Promise((done) => setTimeout(done, 5))")
    got = fox.run("return vibroacoustics.runUp.orderCut(3)")
    np.testing.assert_allclose(got, cut_of_the_analysis(orders, 3.0), atol=0.13)
    says = fox.run(
        "vibroacoustics.panel.cut(3, 2600); return vibroacoustics.panel.at('order').value"
    )
    assert says == "3"
    assert_draws_a_line(*fox.run(LINE))
    assert fox.log == []
