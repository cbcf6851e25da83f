"""`vibroacoustics.plot`: the report's pictures as figures, and what they refuse."""

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure
from test_report_sources import with_sources

import vibroacoustics as va
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.report import render
from vibroacoustics.report.figures.sources import _sources
from vibroacoustics.report.figures.style import png

pytestmark = pytest.mark.usefixtures("real_pictures")
OF_A_RUN = (
    "force_over_revolution", "force_orders", "foot_force_orders", "level_orders",
    "mount_transmissibility", "green_difference", "levels", "scores",
)  # fmt: skip


@pytest.fixture(scope="module")
def results() -> xr.Dataset:
    return with_sources({"none": 40.0, "rattles": 52.0})


def test_the_report_draws_with_the_same_functions(results):
    files = render(results)
    for name in OF_A_RUN:
        assert files[f"figures/{name}.png"] == png(getattr(va.plot, name)(results)), name
    (transfer,) = [name for name in files if name.startswith("figures/transfer_")]
    assert files[transfer] == png(va.plot.transfer(results))
    assert files["figures/sources_third_octaves.png"] == png(va.plot.source_third_octaves(results))
    assert files["figures/sources_options.png"] == png(va.plot.option_third_octaves(results))


def test_a_notebook_shows_a_figure(results):
    figure = va.plot.levels(results)
    assert isinstance(figure, Figure)
    assert figure._repr_png_() == png(figure)


def test_a_figure_can_be_changed(results):
    figure = va.plot.levels(results)
    before = png(figure)
    figure.axes[0].set_title("Mine")
    assert png(figure) != before


def test_another_speed_is_drawn(results):
    lowest = float(results["speed"].min())
    drawn = va.plot.force_over_revolution(results, lowest)
    assert png(drawn) != png(va.plot.force_over_revolution(results))


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
    figure = va.plot.source_third_octaves(changed)
    drawn = [line.get_ydata() for line in figure.axes[0].lines]
    quiet = [values for values in drawn if np.nanmax(values) < 0.0]
    assert len(quiet) == is_drawn
    assert all(np.isfinite(values).tolist() == [True, False, False, False] for values in quiet)
    silent = _sources(changed).caption.partition("everywhere below −10 dB: ")[2]
    assert ("key" in silent.lower()) == (not is_drawn)


def test_third_octaves_of_sources_at_any_speed(results):
    lowest = float(results["speed"].min())
    figure = va.plot.source_third_octaves(results, option="rattles", speed_rpm=lowest)
    at = {"option": "rattles", "receiver": "front_1m", "speed": lowest}
    levels = results["source_band_level"].sel(at)
    for line in figure.axes[0].lines:
        drawn = line.get_ydata()
        shown = np.isfinite(drawn)
        assert any(np.array_equal(drawn[shown], one[shown]) for one in levels.values)


def test_unknown_labels_are_refused(results):
    with pytest.raises(ParameterError, match="receiver = behind: not in these results; there are"):
        va.plot.levels(results, "behind")
    with pytest.raises(ParameterError, match=r"speed = 1\.0: not in these results"):
        va.plot.force_over_revolution(results, 1.0)
