"""Figures over the speed: lines hold what the dataset holds; crossings; speeds to avoid."""

import csv
import io

import numpy as np
import pytest
import xarray as xr
from pages import page_of
from support import TINY, made_up_radiation

import vibroacoustics as va
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.base.vocabulary import stamp
from vibroacoustics.report.avoid import avoid_data
from vibroacoustics.report.blocks import Part, from_json, pictures, to_json
from vibroacoustics.report.blocks import rendered as drawn_blocks
from vibroacoustics.report.charts.marks import Line, Points, Segments
from vibroacoustics.report.compared.page import channel_charts, over_speed_parts
from vibroacoustics.report.sections import SECTIONS
from vibroacoustics.report.tables import to_csv
from vibroacoustics.results.figure_limits import Compared
from vibroacoustics.results.over_speed.avoid import (
    FOOT_FORCE,
    LEVEL,
    STANDS_OUT_DB,
    avoided,
    ranges_to_avoid,
    recorded_speeds_to_avoid,
    speeds_to_avoid,
)
from vibroacoustics.results.over_speed.modes import (
    crossing_speeds,
    crossings,
    loudest_lines,
    modes_of,
    sound_lines,
)
from vibroacoustics.results.over_speed.order_cuts import order_cuts
from vibroacoustics.results.over_speed.plane import MOST_COLUMNS, MOST_ROWS, plane_of

TUNED_RPM = 3500.0
SPRING_MASS = {
    "kind": "spring-mass", "stiffness_n_per_mm": 3.255, "tuned_speed_rpm": TUNED_RPM,
    "damping_ratio": 0.01, "height_below_ring_mm": 25.0,
}  # fmt: skip
SHELL_HZ = [500.0, 740.0]
MICROPHONE = "pressure front_1m"


def run_over(speeds):
    study = va.load_study(TINY)
    values = {
        "operation.speed_rpm": speeds,
        "operation.maximum_order": 12,
        "options.spring-mass": SPRING_MASS,
    }
    return va.run(study.replace(values), radiation=made_up_radiation)


@pytest.fixture(scope="module")
def results():
    """31 speeds; the modes of shell and gas are made up."""
    made = run_over([float(speed) for speed in np.arange(1500.0, 4501.0, 100.0)])
    modes = {
        "shell_frequency": stamp("shell_frequency", SHELL_HZ, {"shell_mode": ["n2_1", "n3_1"]}),
        "gas_frequency": stamp("gas_frequency", [600.0], {"gas_mode": ["annulus_n2_1"]}),
    }
    return made.assign(modes)


def chart(verb, *args, **keywords):
    """What a function of `va.plot` draws, as data."""
    return getattr(va.plot, verb).__wrapped__(*args, **keywords)


def drawn(made, label, panel=0):
    (mark,) = [mark for mark in made.panels[panel].marks if getattr(mark, "label", None) == label]
    return mark.x, mark.y


def test_levels_are_those_of_the_dataset(results):
    made = chart("levels_over_speed", results)
    for panel, level in enumerate(
        (results["level_total"], results["level_modelled"].sel(weighting="A"))
    ):
        expected = level.sel(option="spring-mass", receiver="front_1m").values
        speed, values = drawn(made, "spring-mass", panel)
        np.testing.assert_array_equal(speed, results["speed"])
        shown = np.isfinite(values)  # what lies far below the highest is not drawn
        assert shown.sum() > 10
        np.testing.assert_array_equal(values[shown], expected[shown])
    source = chart("source_levels_over_speed", results, option="spring-mass")
    values = drawn(source, "all modelled")[1]
    np.testing.assert_array_equal(values[np.isfinite(values)], expected[np.isfinite(values)])


def test_levels_beside_another_result_are_dashed(results):
    made = chart(
        "levels_over_speed",
        results,
        options=["none"],
        beside=results,
        beside_options=["spring-mass"],
    )
    values = drawn(made, "B: spring-mass")[1]
    np.testing.assert_array_equal(
        values, results["level_total"].sel(option="spring-mass", receiver="front_1m")
    )
    lines = [mark for mark in made.panels[0].marks if isinstance(mark, Line)]
    assert [line.dash for line in lines] == ["-", "--"]


def test_order_cuts_of_a_study(results):
    made = chart("orders_over_speed", results, option="spring-mass")
    level = results["order_level"].sel(
        option="spring-mass", receiver="front_1m", order=1, weighting="Z"
    )
    np.testing.assert_allclose(drawn(made, "1×")[1], level, atol=1e-9)
    force = chart("orders_over_speed", results, "force x")
    expected = abs(results["force_order"].sel(option="none", axis="x", order=1).sum("source"))
    np.testing.assert_allclose(drawn(force, "1×")[1], expected / np.sqrt(2.0), rtol=1e-12)
    with pytest.raises(ParameterError, match="channel = behind: not in these results"):
        chart("orders_over_speed", results, "behind")


def test_order_cuts_of_a_comparison(results):
    compared = va.compare(results, results, {MICROPHONE: MICROPHONE}, other_option="spring-mass")
    cuts = order_cuts(compared)
    for option, rms in zip(("none", "spring-mass"), cuts.rms, strict=True):
        of_study = order_cuts(results, option=option)
        row = of_study.order.tolist().index(1.0)
        np.testing.assert_allclose(rms[cuts.order.tolist().index(1.0)], of_study.rms[0, row])
    (part,) = over_speed_parts(Compared(compared, results, results))
    assert [one.name for one in pictures(part.blocks)] == [
        "compared_levels_over_speed", "compared_campbell",
    ]  # fmt: skip
    (picture,) = channel_charts(compared, MICROPHONE)
    assert picture.caption == f"Orders of {MICROPHONE} over the speed. Solid: A, dashed: B."
    assert channel_charts(compared.isel(speed=[0, 1]), MICROPHONE) == []


def test_map_of_a_study_has_the_power_of_its_lines(results):
    plane = plane_of(results)
    row = np.flatnonzero(plane.along == 3000.0)[0]
    lines = [line for line in sound_lines(results) if line.order == 1.0]
    assert plane.frequency_hz[plane.level_db[row].argmax()] == pytest.approx(50.0, abs=2.5)
    level = results["order_level"].sel(
        option="none", receiver="front_1m", order=1, weighting="Z", speed=3000.0
    )
    assert plane.level_db[row].max() == pytest.approx(level.item(), abs=1e-9)
    assert len(lines) == 1
    assert plane.level_db.shape[0] <= MOST_ROWS + 1
    assert plane.level_db.shape[1] <= MOST_COLUMNS + 1


def test_an_order_crosses_a_mode_where_its_frequency_does():
    """n = 60 f/k in closed form; a tone that is bent, by its pieces; none beyond the speeds."""
    speed = np.array([1500.0, 2000.0, 3000.0, 4500.0])
    for order in (1.0, 2.0, 7.5, 10.0):
        (rpm,) = crossing_speeds(speed, order * speed / 60.0, order * 41.0)
        assert rpm == pytest.approx(60.0 * 41.0, rel=1e-12)
    assert crossing_speeds(speed, speed / 60.0, 80.0).size == 0
    bent = np.array([100.0, np.nan, 90.0, 120.0])
    np.testing.assert_allclose(crossing_speeds(speed, bent, 100.0), [3500.0])
    falls_and_rises = np.array([100.0, 80.0, 100.0, 80.0])
    assert crossing_speeds(speed, falls_and_rises, 90.0).tolist() == [1750.0, 2500.0, 3750.0]


def test_campbell_marks_the_crossings(results):
    lines, modes = loudest_lines(results), modes_of(results)
    speed = results["speed"].values
    level = results["level_modelled"].sel(option="none", receiver="front_1m", weighting="A")
    met = crossings(lines, modes, speed, level.values)
    expected = {
        (line.name, mode.frequency_hz): 60.0 * mode.frequency_hz / line.order
        for line in lines
        for mode in modes
        if speed[0] < 60.0 * mode.frequency_hz / line.order < speed[-1]
    }
    assert {(one.line.name, one.mode.frequency_hz) for one in met} == set(expected)
    for one in met:
        key = one.line.name, one.mode.frequency_hz
        assert one.speed_rpm == pytest.approx(expected[key], rel=1e-12)
    made = chart("campbell", results)
    above = made.panels[0].marks
    marks = [(mark.x, mark.y) for mark in above if isinstance(mark, Points)]
    assert sum(len(speeds) for speeds, _ in marks) == sum(one.mode.kind != "mounts" for one in met)
    level_lines = {hz for mark in above if isinstance(mark, Segments) for hz in mark.y}
    assert level_lines >= {*SHELL_HZ, 600.0}


def test_speeds_to_avoid_of_a_peak_in_closed_form():
    """A triangle of 2 dB per 100 rpm: 3 dB below its top at 150 rpm on either side."""
    speed = np.arange(1000.0, 3001.0, 100.0)
    level = 60.0 - 2.0 * abs(speed - 2000.0) / 100.0
    (one,) = ranges_to_avoid(speed, level)
    assert (one.from_rpm, one.peak_rpm, one.to_rpm) == (1850.0, 2000.0, 2150.0)
    assert one.above_db == pytest.approx(20.0)
    assert ranges_to_avoid(speed, np.maximum(level, 60.0 - 0.99 * STANDS_OUT_DB)) == []
    assert ranges_to_avoid(speed, speed) == []  # an end is no maximum
    assert ranges_to_avoid(speed, np.full(speed.size, 50.0)) == []


def test_speeds_to_avoid_of_noisy_blocks():
    """Noise of 2 dB from block to block hides no resonance and makes none."""
    speed = np.linspace(900.0, 3900.0, 1500)
    noise = 2.0 * np.random.default_rng(5).standard_normal(speed.size)
    resonance = 20.0 / (1.0 + ((speed - 2100.0) / 80.0) ** 2)
    (one,) = recorded_speeds_to_avoid(speed, 50.0 + noise + resonance)
    assert one.from_rpm < 2100.0 < one.to_rpm < one.from_rpm + 250.0


def test_speeds_to_avoid_of_a_tuned_mass(results):
    """Below its tuning the mass resonates with the ring: level and foot force stand out at 1×."""
    assert speeds_to_avoid(results) == []
    of_quantity = {one.quantity: one for one in speeds_to_avoid(results, of=["spring-mass"])}
    assert set(of_quantity) == {LEVEL, FOOT_FORCE}
    for one in of_quantity.values():
        assert one.line == "1×"
        assert one.line_hz == pytest.approx(one.range.peak_rpm / 60.0)
        assert one.mode is None  # of the mass, which is none of the machine's
        assert one.range.to_rpm < TUNED_RPM


@pytest.mark.parametrize(
    ("mode_over_line", "is_near"), [(0.94, False), (0.96, True), (1.04, True), (1.06, False)]
)
def test_a_mode_within_five_percent_of_the_line_is_named(results, mode_over_line, is_near):
    line_hz = speeds_to_avoid(results, of=["spring-mass"])[0].line_hz
    frequency_hz = mode_over_line * line_hz
    with_mode = results.assign(natural_frequency=0.0 * results["natural_frequency"] + frequency_hz)
    for one in speeds_to_avoid(with_mode, of=["spring-mass"]):
        assert (one.mode is not None) == is_near
        assert one.mode is None or one.mode.kind == "mounts"


def test_the_section_of_the_report(results):
    section = SECTIONS["speeds"]
    assert section.applies(results)
    assert not section.applies(results.isel(speed=[0, 15]))
    blocks = section.blocks(results)
    drawn_pictures = list(pictures(blocks))
    assert [one.name for one in drawn_pictures] == [
        "levels_over_speed", "orders_over_speed", "speed_frequency_map", "campbell",
    ]  # fmt: skip
    assert max(len(one.content) for one in drawn_pictures) < 150_000
    assert all(one.wide for one in drawn_pictures)
    page = page_of(Part("speeds", "Speeds", tuple(blocks))).html()
    assert page.count(b'<figure class="full">') == 4
    assert from_json(to_json(blocks)) == drawn_blocks(blocks)
    assert "Without a balancer no speed is to be avoided" in blocks[0].words
    assert {row[0] for row in blocks[1].rows} == {"spring-mass"}
    rows = list(csv.DictReader(io.StringIO(to_csv(avoid_data(avoided(results))).decode())))
    assert {(row["option"], row["line"], row["mode"]) for row in rows} == {
        ("spring-mass", "1×", "")
    }


@pytest.mark.parametrize("verb", ["levels_over_speed", "orders_over_speed", "campbell"])
def test_a_single_speed_is_drawn(results, verb):
    getattr(va.plot, verb)(results.isel(speed=[7]))


def test_pictures_of_a_thousand_speeds_are_small(results):
    """Few rows and columns of a map; lines keep two points a pixel."""
    section = SECTIONS["speeds"]
    many = over_a_thousand(results)
    sizes = [len(each.content) for each in pictures(section.blocks(many))]
    assert sum(sizes) < 600_000


def test_maps_of_a_thousand_speeds_are_coarse(results):
    assert plane_of(over_a_thousand(results)).level_db.shape[0] <= MOST_ROWS


def over_a_thousand(results):
    speed = np.linspace(1500.0, 4500.0, 1000)
    kept = results[["pressure_line", "level_modelled", "level_total", "foot_force_amplitude",
                    "natural_frequency", "reported_figure", "shell_frequency",
                    "force_order", "moment_order", "foot_force_order",
                    "velocity_order"]]  # fmt: skip
    return kept.interp(speed=speed, assume_sorted=True).assign_attrs(results.attrs)


def test_a_recording_that_stays_at_a_speed_is_drawn_over_the_time():
    tone = np.cos(2.0 * np.pi * 50.0 * np.arange(8192) / 1024.0)
    recording = va.label_recording([0.1 * tone], 1024.0, ["front"], ["Pa"])
    mapped = va.speed_frequency_map(recording, va.NominalSpeed(3000.0), 8.0)
    made = chart("levels_over_speed", mapped)
    assert made.panels[-1].x.label == "Time, s"
    time, level = drawn(made, "unweighted")
    np.testing.assert_array_equal(time, mapped["block_time"])
    np.testing.assert_array_equal(level, mapped["block_level"].sel(channel="front", weighting="Z"))
    assert isinstance(mapped, xr.Dataset)
