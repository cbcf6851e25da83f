"""`vibroacoustics.plot`: the report's charts as figures, and what they refuse."""

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure
from test_report_sources import with_sources

import vibroacoustics as va
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.report import render
from vibroacoustics.report.charts.marks import Chart
from vibroacoustics.report.charts.svg import svg
from vibroacoustics.report.figures.orders import loudest_orders

OF_A_RUN = (
    "force_over_revolution", "force_orders", "foot_force_orders", "level_orders",
    "mount_transmissibility", "green_difference", "levels", "scores",
)  # fmt: skip


@pytest.fixture(scope="module")
def results() -> xr.Dataset:
    return with_sources({"none": 40.0, "rattles": 52.0})


def chart(name: str, *args, **kwargs) -> Chart:
    """What a function draws, as data."""
    return getattr(va.plot, name).__wrapped__(*args, **kwargs)


def test_the_report_draws_the_same_charts(results):
    files = render(results)
    for name in OF_A_RUN:
        assert files[f"figures/{name}.svg"] == svg(chart(name, results)), name
    (transfer,) = [name for name in files if name.startswith("figures/transfer_")]
    assert files[transfer] == svg(chart("transfer", results))
    spectra = svg(chart("source_third_octaves", results))
    assert files["figures/sources_third_octaves.svg"] == spectra
    assert files["figures/sources_options.svg"] == svg(chart("option_third_octaves", results))


def test_a_notebook_shows_a_figure(results):
    drawn = va.plot.levels(results)
    assert isinstance(drawn, Figure)
    assert drawn._repr_png_().startswith(b"\x89PNG")


def test_a_figure_can_be_changed(results):
    drawn = va.plot.levels(results)
    before = drawn._repr_png_()
    drawn.axes[0].set_title("Mine")
    assert drawn._repr_png_() != before


def test_another_speed_is_drawn(results):
    lowest = float(results["speed"].min())
    along_y = chart("force_over_revolution", results, lowest).panels[1]
    force = results["force"].sel(speed=lowest, axis="y").sum("source")
    for line, option in zip(along_y.marks, results["option"].values, strict=True):
        np.testing.assert_array_equal(line.y, force.sel(option=option).values)


def test_orders_that_carry_the_sound_are_shown():
    orders = np.arange(1.0, 31.0)
    near = {"none": 12.0, "ring": 25.0}
    level = xr.concat(
        [
            xr.DataArray(-np.abs(orders - loud), {"order": orders}, ["order"])
            for loud in near.values()
        ],
        xr.Variable("option", list(near)),
    )
    level = level + xr.DataArray([0.0, 10.0], dims="option")
    assert loudest_orders(level) == [1.0, 10.0, 11.0, 12.0, 13.0, 23.0, 24.0, 25.0, 26.0]
    assert loudest_orders(level.where(level > 8.5)) == [1.0, 24.0, 25.0, 26.0]


@pytest.mark.parametrize("name", sorted({*va.plot.__all__} - {"curves"}))  # drawn by name
def test_a_missing_variable_is_named(name):
    with pytest.raises(ParameterError, match=rf"^plot\.{name}: these results hold no \w+ \("):
        getattr(va.plot, name)(xr.Dataset())


@pytest.mark.parametrize(("loudest_db", "is_drawn"), [(-8.0, True), (-12.0, False)])
def test_a_source_below_minus_10_db_everywhere_is_not_drawn(results, loudest_db, is_drawn):
    """The caption names it; of a source that is drawn, bands below are left out."""
    changed = results.copy(deep=True)
    keys = changed["source_band_level"].sel(sound_source="keys")
    keys[...] = -12.0
    keys[{"band": 0}] = loudest_db
    spectra = chart("source_third_octaves", changed)
    drawn = [line.y for line in spectra.panels[0].marks]
    quiet = [values for values in drawn if np.nanmax(values) < 0.0]
    assert len(quiet) == is_drawn
    assert all(np.isfinite(values).tolist() == [True, False, False, False] for values in quiet)
    silent = spectra.caption.partition("everywhere below −10 dB: ")[2]
    assert ("key" in silent.lower()) == (not is_drawn)


def test_third_octaves_of_sources_at_any_speed(results):
    lowest = float(results["speed"].min())
    spectra = chart("source_third_octaves", results, option="rattles", speed_rpm=lowest)
    at = {"option": "rattles", "receiver": "front_1m", "speed": lowest}
    levels = results["source_band_level"].sel(at)
    for line in spectra.panels[0].marks:
        shown = np.isfinite(line.y)
        assert any(np.array_equal(line.y[shown], one[shown]) for one in levels.values)


def test_unknown_labels_are_refused(results):
    with pytest.raises(ParameterError, match="receiver = behind: not in these results; there are"):
        va.plot.levels(results, "behind")
    with pytest.raises(ParameterError, match=r"speed = 1\.0: not in these results"):
        va.plot.force_over_revolution(results, 1.0)
