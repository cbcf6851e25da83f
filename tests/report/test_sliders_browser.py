"""Sliders of uncertain parameters in Chromium and Firefox: levels, pictures, names."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from browsers import Firefox
from live_pages import open_page, page_of
from selenium.webdriver import Chrome
from selenium.webdriver.common.by import By
from sources_study import SOURCES_STUDY, run_made_up

from vibroacoustics.report.sections.unknowns import file_unit
from vibroacoustics.results.estimates import estimate
from vibroacoustics.study.loading import load_study
from vibroacoustics.uncertainty.slider_variables import HOOD
from vibroacoustics.uncertainty.sliders import NODES

pytestmark = pytest.mark.slow

TOTALS = """const {model, page} = vibroacoustics.panel;
return page.options.map((_, option) =>
  model.levels(0, model.given(option)).of.map((one) => one.total));"""
SET = """const {panel} = vibroacoustics;
const set = (positions) => {
  positions.forEach((position, k) => { panel.inputs[k].input.value = position; });
  panel.changed(false);
  return panel.state.live[0].of.map((one) => one.total);
};"""
DRAWN = """const {panel} = vibroacoustics;
document.querySelector('details:has(#live)').open = true;
panel.at("spectrum").scrollIntoView();
const later = () => new Promise((done) => setTimeout(done, 150));
const drawn = () => panel.at("spectrum").querySelector("canvas").toDataURL();
const found = [];
for (const {input} of panel.inputs) {
  const before = [];
  for (const end of [input.min, input.max]) {
    panel.reset();
    await later();
    const [text, picture] = [panel.at("says").textContent, drawn()];
    input.value = end;
    input.dispatchEvent(new Event("input"));
    await later();
    before.push([text !== panel.at("says").textContent, picture !== drawn()]);
  }
  found.push([input.getAttribute("aria-label"), before]);
}
panel.reset();
return found;"""


@pytest.fixture(scope="module")
def results():
    study = load_study(SOURCES_STUDY).replace({"uncertainty.random_samples": 8})
    return run_made_up(study, 10.0)


@pytest.fixture(scope="module")
def page(results, tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("sliders") / "report.html"
    path.write_bytes(page_of(results))
    return path


@pytest.fixture(scope="module")
def opened(browser: Chrome, page: Path) -> Chrome:
    browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    open_page(browser, page)
    return browser


def microphones(opened: Chrome) -> list[str]:
    return opened.execute_script("return vibroacoustics.panel.page.microphones")


def changes(results, option, setting):
    """Change of the level of an option by sample and microphone, from the results alone."""
    bands, change = results.sel(option=option)["slider_band_level"], 0.0
    for name, value in setting.items():
        one = results.sel(slider=name)
        nodes = one["slider_value"].values
        weight = xr.DataArray(
            [np.interp(value, nodes, row) for row in np.eye(nodes.size)], dims="slider_node"
        )
        change = change + (weight * one["slider_band_change"]).sum("slider_node")
    energy = (10.0 ** ((bands + change) / 10.0)).sum("noise_band")
    return 10.0 * np.log10(energy / (10.0 ** (bands / 10.0)).sum("noise_band"))


def written(value):
    """A change as the page writes it."""
    return "0.0" if abs(value) < 0.05 else f"{value:+.1f}".replace("-", "−")


def test_levels_begin_at_the_median_of_every_option(opened, results):
    totals = opened.execute_script(TOTALS)
    for option, row in zip(results["option"].values, totals, strict=True):
        for microphone, total in zip(microphones(opened), row, strict=True):
            at = {"option": option, "receiver": microphone, "speed": 2900.0}
            assert total == pytest.approx(estimate(results, "level_total", **at).value, abs=1e-3)


@pytest.mark.parametrize("option", [0, 2])
def test_changes_of_all_sliders_add_by_third_octave(opened, results, option):
    names = results["slider"].values.tolist()
    positions = [0.6 + 1.3 * number for number in range(len(names))]
    opened.execute_script(
        "vibroacoustics.panel.at('option').value = arguments[0]; vibroacoustics.panel.reset()",
        option,
    )
    got = opened.execute_script(f"{SET} return set(arguments[0]);", positions)
    setting = {
        name: np.interp(position, np.arange(NODES), results["slider_value"].sel(slider=name).values)
        for name, position in zip(names, positions, strict=True)
    }
    name = str(results["option"].values[option])
    change = changes(results, name, setting)
    expected = results["level_total"].sel(option=name, speed=2900.0)
    expected = expected + change.median("slider_machine")
    # Levels of bands have 10 bits, 0.03 dB: changes by them err by less than 0.01 dB.
    np.testing.assert_allclose(got, expected.sel(receiver=microphones(opened)), atol=1e-2)
    error = results["slider_addition_error"].isel(option=option).sel(receiver="front_1m")
    low, middle, high = np.quantile(change.sel(receiver="front_1m"), (0.1, 0.5, 0.9))
    words = [written(value) for value in (middle, low - float(error), high + float(error))]
    says = opened.execute_script("return vibroacoustics.panel.at('says').textContent")
    assert f"The sliders make {words[0]} dB ({words[1]} to {words[2]})." in says


def test_the_sound_and_the_spectrum_have_the_level_that_is_shown(opened):
    levels = opened.execute_script(
        f"{SET} vibroacoustics.panel.reset(); set([2, 5, 1, 6, 3.5].slice(0, panel.inputs.length));"
        "const {model, state} = panel, sound = model.sound(0, 0, state.values, state.live[0]);"
        "const lines = model.squares(0, state.live[0].pressure)[0];"
        "return [10 * Math.log10((lines + sound.rest) / 4e-10), state.live[0].of[0].total];"
    )
    assert levels[0] == pytest.approx(levels[1], abs=1e-6)


def test_one_slider_has_its_own_error_and_none_has_no_error(opened, results):
    opened.execute_script(
        "vibroacoustics.panel.at('option').value = 0; vibroacoustics.panel.reset()"
    )
    assert "slider" not in opened.execute_script(
        "return vibroacoustics.panel.at('says').textContent"
    )
    error = opened.execute_script(
        "const {panel} = vibroacoustics; panel.inputs[0].input.value = 0; panel.changed(false);"
        "return panel.model.error(panel.state.values, 0)"
    )
    expected = float(results["slider_interpolation_error"].values[0])
    assert error == pytest.approx(expected, abs=1e-3)


def test_values_have_the_unit_of_the_file(opened, results):
    sliders = opened.execute_script("return vibroacoustics.panel.page.sliders.list")
    for one, name in zip(sliders, results["slider"].values.tolist(), strict=True):
        unit, factor = ("dB", 1.0) if name == HOOD else file_unit(results, name)
        assert one["unit"] == unit
        nodes = results["slider_value"].sel(slider=name).values
        np.testing.assert_allclose(np.array(one["values"]) * factor, nodes)


def test_every_slider_changes_a_number_and_a_picture_and_has_a_name(opened, results):
    found = opened.execute_async_script(
        f"const finished = arguments[0]; (async () => {{{DRAWN}}})().then(finished);"
    )
    check_moves(found, results)
    sliders = opened.find_elements(By.CSS_SELECTOR, ".live-panel input[type=range]")
    shown = [one for one in sliders if one.is_displayed()]
    assert len(shown) == results.sizes["slider"]
    assert sorted(one.accessible_name for one in shown) == sorted(name for name, _ in found)
    assert opened.get_log("browser") == []


def test_every_slider_moves_in_firefox(fox: Firefox, page: Path, results):
    fox.open(page.as_uri(), 390)
    fox.run("while (!window.vibroacoustics) await new Promise((done) => setTimeout(done, 5))")
    check_moves(fox.run(DRAWN), results)
    fox.run("vibroacoustics.panel.inputs[0].input.focus()")
    says = "return vibroacoustics.panel.at('says').textContent"
    before = fox.run(says)
    fox.press("\ue010")  # the End key
    assert fox.run(says) != before
    assert fox.run("return document.documentElement.scrollWidth") <= 390
    assert fox.log == []


def check_moves(found, results):
    """At least one end of each slider is not where it begins."""
    assert len(found) == results.sizes["slider"]
    for name, ends in found:
        assert any(text and picture for text, picture in ends), name
        assert all(text == picture or not text for text, picture in ends), name
    assert ", dB" in found[-1][0]


def test_other_speeds_do_not_move(results, browser, tmp_path):
    speeds = results.assign(slider_speed=results["slider_speed"] + 1.0)
    (tmp_path / "page.html").write_bytes(page_of(speeds))
    open_page(browser, tmp_path / "page.html")
    assert browser.execute_script("return vibroacoustics.panel.page.sliders") is None
