"""Marks of charts have the values of the dataset that they are drawn from."""

import numpy as np
import pytest
import xarray as xr

import vibroacoustics as va
from vibroacoustics.report.charts.axes import amplitude_axis, band_axis, level_axis
from vibroacoustics.report.charts.marks import Axis, Bars, Chart, Line, Note, Panel, Points
from vibroacoustics.report.charts.svg import svg
from vibroacoustics.report.designs.evaluated import Column, Evaluated
from vibroacoustics.report.designs.figures import (
    front_chart,
    main_effects_charts,
    parallel_chart,
)
from vibroacoustics.report.figures.channel_orders import (
    compared_orders,
    order_differences,
    order_map,
    tracked_orders,
)
from vibroacoustics.report.figures.predicted import blocked_charts, predicted_levels
from vibroacoustics.report.figures.sources import power_chart

FREQUENCY = np.array([50.0, 100.0, 150.0])


def recording() -> xr.Dataset:
    """Orders 1 and 2 of a run-up from 20 to 40 Hz, in two channels."""
    time = np.arange(16384) / 1024.0
    turns = 20.0 * time + 10.0 * time**2 / time[-1]
    signal = np.cos(2.0 * np.pi * turns) + 0.3 * np.cos(4.0 * np.pi * turns)
    pulses = np.where(turns % 1.0 < 0.2, 5.0, 0.0)
    names = ["front", "ring", "tacho"]
    return va.label_recording([0.02 * signal, signal, pulses], 1024.0, names, ["Pa", "m/s²", "V"])


@pytest.fixture(scope="module")
def orders() -> xr.Dataset:
    asked = va.OrderAnalysis(va.SpeedChannel("tacho"), (1.0, 2.0), 8.0, with_map=True)
    return va.analyse_orders(recording(), asked)


def marks_of(chart: Chart, kind: type, panel: int = 0) -> list:
    return [mark for mark in chart.panels[panel].marks if isinstance(mark, kind)]


def test_an_order_map_shows_the_level_of_each_line(orders):
    (panel,) = order_map(orders, "ring").panels
    (colours,) = panel.marks
    spectra = orders["order_map"].sel(channel="ring").transpose("block", "map_order")
    shown = spectra.sel(map_order=colours.x)
    np.testing.assert_allclose(colours.values, 20.0 * np.log10(abs(shown)), rtol=1e-12)
    np.testing.assert_array_equal(colours.y, orders["block_speed"])
    assert colours.scale == (colours.values.max() - 60.0, colours.values.max())


def test_tracked_orders_are_lines_over_the_speed():
    tracked = va.track_orders(recording(), va.SpeedChannel("tacho"), (1.0, 2.0), 2.0)
    first, second = marks_of(tracked_orders(tracked, "ring"), Line)
    size = abs(tracked["tracked_order"].sel(channel="ring"))
    for line, order in ((first, 1.0), (second, 2.0)):
        assert line.label == f"{order:g}×"
        np.testing.assert_array_equal(line.y, size.sel(order=order))
        np.testing.assert_array_equal(line.x, tracked["track_speed"])


def test_compared_orders_with_limits_and_bars(orders):
    compared = va.compare(orders, orders).isel(speed=[0, 1])
    chart = compared_orders(compared, "ring")
    assert len(chart.panels) == 2
    first, second = marks_of(chart, Points)
    for points, name in ((first, "channel_order"), (second, "compared_order")):
        expected = abs(compared[name].sel(channel="ring").isel(speed=0))
        np.testing.assert_array_equal(points.y, expected)
        assert points.stems
    of_runs = compared.assign(order_mean_uncertainty=0.0 * compared["order_difference"] + 0.5)
    ring = marks_of(order_differences(of_runs, ["ring"]), Points)[0]
    difference = compared["order_difference"].sel(channel="ring").isel(speed=0)
    np.testing.assert_allclose(ring.interval, [difference - 1.0, difference + 1.0])


def test_over_many_speeds_an_order_without_values_has_no_panel(orders):
    compared = va.compare(orders, orders)
    quiet = compared["order"] == 2.0
    for name in ("channel_order", "compared_order"):
        compared[name] = compared[name].where(~quiet, 1e-9)
    (panel,) = compared_orders(compared, "ring").panels
    assert panel.title == "ring, order 1"


def test_blocked_forces_and_validation():
    force = np.array([[3.0, 2.0, 1.0]])
    level = np.array([[60.0, 20.0, -80.0]])
    coords = {"force_point": ["a"], "validation_point": ["b"], "frequency": FREQUENCY}
    forces = {f"blocked_force{end}": (("force_point", "frequency"), shift * force)
              for end, shift in (("", -1.0j), ("_low", 0.0), ("_high", 2.0))}  # fmt: skip
    levels = {f"validation_{name}": (("validation_point", "frequency"), level + shift)
              for name, shift in (("measured", 0.0), ("predicted", 1.0), ("predicted_low", -3.0),
                                  ("predicted_high", 4.0))}  # fmt: skip
    quantity = {"validation_quantity": ("validation_point", ["sound pressure"])}
    drawn, validation = blocked_charts(xr.Dataset({**forces, **levels, **quantity}, coords))
    (line,) = marks_of(drawn, Line)
    np.testing.assert_array_equal(line.y, force[0])
    np.testing.assert_allclose(line.interval, [np.full(3, 0.1), 2.0 * force[0]])
    measured, predicted = marks_of(validation, Line)
    np.testing.assert_array_equal(measured.y, level[0])
    np.testing.assert_array_equal(predicted.interval, [level[0] - 3.0, level[0] + 4.0])
    assert validation.panels[0].y.limits == (-17.0, 63.0)


def test_a_prediction_has_a_panel_for_each_change():
    shape = ("option", "receiver", "frequency")
    level = np.arange(9.0).reshape(3, 1, 3)
    values = {f"predicted_level{end}": (shape, level + shift)
              for end, shift in (("", 0.0), ("_low", -1.0), ("_high", 1.0))}  # fmt: skip
    coords = {"option": ["none", "soft", "mass"], "receiver": ["front"], "frequency": FREQUENCY}
    chart = predicted_levels(xr.Dataset(values, coords))
    assert [panel.title for panel in chart.panels] == ["front: soft", "front: mass"]
    assert [panel.x.label for panel in chart.panels] == ["", "Frequency, Hz"]
    before, after = marks_of(chart, Line, 1)
    np.testing.assert_array_equal([before.y, after.y], level[[0, 2], 0])
    np.testing.assert_array_equal(after.interval, [level[2, 0] - 1.0, level[2, 0] + 1.0])


def test_bars_of_bands_end_at_their_level_and_bands_without_one_have_none():
    level = np.array([50.0, np.nan, 60.0])
    values = {"measured_power_level": ("band", level),
              "background_correction": ("band", np.full(3, 1.0)),
              "environment_correction": ("band", np.full(3, 2.0))}  # fmt: skip
    chart = power_chart(xr.Dataset(values, {"band": [100.0, 125.0, 160.0]}))
    (bars,), (points,) = marks_of(chart, Bars), marks_of(chart, Points)
    np.testing.assert_array_equal(bars.base + bars.size, level)
    np.testing.assert_array_equal(points.y, level + 3.0)
    panel = Panel(Axis(), Axis(limits=(0.0, 80.0)), (Bars([0, 1, 2], level, upright=True),))
    path = svg(Chart("b", "", "", (panel,))).decode().partition(' fill="#000000"')[0]
    assert path.rpartition('d="')[2].count("Z") == 2


def designs() -> Evaluated:
    """Two variables, two objectives; design 3 breaks a constraint, 0 and 1 are the front."""
    first, second = np.array([1.0, 2.0, 3.0, 0.5]), np.array([5.0, 4.0, 6.0, 1.0])
    size, choice = np.array([10.0, 20.0, 30.0, 40.0]), np.array([0.0, 1.0, 1.0, 0.0])
    return Evaluated(
        (Column("size", "mm", size), Column("ring", "", choice, ("steel", "brass"))),
        (Column("level", "dB(A)", first), Column("force", "N", second)),
        np.array([True, True, True, False]), np.array([True, True, False, False]),
        np.array([1]),
    )  # fmt: skip


def test_designs_are_points_over_their_objectives():
    allowed, front, best = marks_of(front_chart(designs()), Points)
    for points, x, y in ((allowed, [3.0], [6.0]), (front, [1.0, 2.0], [5.0, 4.0]),
                         (best, [2.0], [4.0])):  # fmt: skip
        visible = np.asarray(points.x).size
        np.testing.assert_array_equal([points.x, points.y], [x[:visible], y[:visible]])
    assert best.label == "design 1"


def test_parallel_coordinates_go_from_the_least_to_the_greatest_allowed_value():
    chart = parallel_chart(designs())
    front, best = marks_of(chart, Line)
    np.testing.assert_allclose(front.x, [0.0, 0.0, 0.0, 0.5, np.nan, 0.5, 1.0, 0.5, 0.0, np.nan])
    np.testing.assert_allclose(best.x, [0.5, 1.0, 0.5, 0.0])
    words = [note.words for note in marks_of(chart, Note)]
    assert words == ["10", "30", "steel", "brass", "1", "3", "4", "6"]


def test_main_effects_are_quantiles_in_bins_of_a_variable():
    values = np.repeat([1.0, 2.0], 11)
    objective = np.tile(np.arange(11.0), 2) + np.where(values > 1.0, 5.0, 0.0)
    (chart,) = main_effects_charts(
        [Column("size", "mm", values)], Column("level", "", objective), 3
    )
    (line,) = marks_of(chart, Line)
    assert chart.name == "main_effects_3_1"
    np.testing.assert_array_equal(line.x, [1.0, 2.0])
    np.testing.assert_allclose([line.interval[0], line.y, line.interval[1]],
                               [[1.0, 6.0], [5.0, 10.0], [9.0, 14.0]])  # fmt: skip


@pytest.mark.parametrize(
    ("sizes", "limits", "ends"),
    [
        ([1.0, 0.1], (), (0.05, 2.0)),
        ([1.0, 0.0], (), (1e-5, 2.0)),
        ([1.0, np.nan], [0.01, 4.0], (0.005, 8.0)),
        ([0.0, np.nan], [1.0], None),
    ],
)
def test_an_axis_of_amplitudes_shows_their_limits(sizes, limits, ends):
    made = amplitude_axis("Force, N", sizes, limits).limits
    assert made == (None if ends is None else pytest.approx(ends))


def test_axes_of_levels_and_bands():
    assert level_axis("dB", [10.0, 60.0, np.nan], 80.0).limits == (7.0, 63.0)
    assert level_axis("dB", [-300.0, 60.0], 80.0).limits == (-17.0, 63.0)
    assert level_axis("dB", [np.nan]).limits is None
    assert band_axis([100.0, 125.0, 160.0, 200.0]).ticks == ((0.0, "100"), (3.0, "200"))
