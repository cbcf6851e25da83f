"""Charts: positions in the SVG follow from the values, and matplotlib draws the same."""

import json
import re
from xml.dom import minidom

import numpy as np
import pytest

from vibroacoustics.report.charts.figure import figure
from vibroacoustics.report.charts.frame import frame_of
from vibroacoustics.report.charts.layout import layout, round_ticks, scale_of
from vibroacoustics.report.charts.marks import (
    Area,
    Axis,
    Bars,
    Chart,
    Image,
    Line,
    Note,
    Panel,
    Points,
    Segments,
    Span,
    named_axis,
)
from vibroacoustics.report.charts.svg import picture, svg
from vibroacoustics.report.charts.svg_marks import PALETTE, _resampled

X = np.array([1.0, 10.0, 100.0])
Y = np.array([20.0, 40.0, 30.0])
MARKS = (
    Span(2.0, 5.0, "avoided"),
    Line(X, Y, "level", interval=(Y - 5.0, Y + 5.0)),
    Points(X, Y + 1.0, "measured", interval=(Y, Y + 2.0), stems=True, filled=False),
    Segments([np.nan], [25.0], [np.nan], [25.0], "limit"),
    Segments([2.0], [21.0], [3.0], [30.0], arrow=True),
    Area([10.0, 20.0, 20.0], [21.0, 21.0, 25.0], "part", fill="#cccccc", colour="#000000"),
    Note(10.0, 40.0, "loudest <1>"),
)


def chart(*marks, **panel) -> Chart:
    axes = {"x": Axis("Frequency, Hz", "log"), "y": Axis("Level, dB")} | panel
    return Chart("levels", "Levels.", "Levels by frequency.", (Panel(marks=marks, **axes),))


def points_of(path: str) -> np.ndarray:
    pairs = re.findall(r"[ML](-?[\d.]+) (-?[\d.]+)", path)
    return np.array(pairs, float)


def test_points_are_where_their_values_are():
    drawn = chart(Line(X, Y, dash="-", colour="#123456"))
    (box,) = layout(drawn).boxes
    text = svg(drawn).decode()
    path = re.search(r'<path d="([^"]+)" fill="none" stroke="#123456"', text)[1]
    points = points_of(path)
    # a logarithmic axis, 4 % of the range beyond the ends
    room = 0.04 / 1.08
    across = box.x + box.width * (room + (1.0 - 2.0 * room) * np.array([0.0, 0.5, 1.0]))
    down = box.y + box.height * (1.0 - room - (1.0 - 2.0 * room) * (Y - 20.0) / 20.0)
    np.testing.assert_allclose(points, np.stack([across, down], -1), atol=0.06)


def test_polar_angles_run_from_the_right_against_the_clock():
    panel = Panel(Axis(), Axis(limits=(0.0, 60.0)), (Line([0.0, 90.0], [60.0, 30.0]),), polar=True)
    (box,) = layout(Chart("p", "", "", (panel,))).boxes
    frame = frame_of(panel, box)
    (right, above), middle = frame.points([0.0, 90.0], [60.0, 30.0]), frame.middle
    np.testing.assert_allclose(right, [middle[0] + frame.radius, middle[1]])
    np.testing.assert_allclose(above, [middle[0], middle[1] - 0.5 * frame.radius])


def test_every_mark_is_drawn_and_named_in_both():
    drawn = chart(*MARKS)
    document = minidom.parseString(svg(drawn))  # noqa: S318
    nodes = document.getElementsByTagName("text")
    texts = {node.firstChild.data for node in nodes if node.firstChild}
    names = ["avoided", "level", "measured", "limit", "part"]
    assert {*names, "loudest <1>", "Frequency, Hz", "Level, dB"} <= texts
    made = figure(drawn)
    assert [text.get_text() for text in made.legends[0].get_texts()] == names
    (axes,) = made.axes
    frame = frame_of(drawn.panels[0], layout(drawn).boxes[0])
    assert axes.get_xlim() == pytest.approx((frame.x.low, frame.x.high))
    np.testing.assert_array_equal(axes.lines[0].get_ydata(), Y)


def test_bars_begin_at_their_base():
    bars = Bars([0, 1], [3.0, 2.0], [0.0, 1.0], "force", interval=([2.0, 2.5], [4.0, 3.5]))
    drawn = chart(bars, x=Axis("Force, N"), y=named_axis(["none", "ring"]))
    panel, (box,) = drawn.panels[0], layout(drawn).boxes
    frame = frame_of(panel, box)
    assert (frame.x.low, frame.y.low, frame.y.high) == (0.0, 1.5, -0.5)
    path = re.search(r'd="M([\d.]+) [\d.]+H([\d.]+)V', svg(drawn).decode())
    assert float(path[1]) == pytest.approx(box.x, abs=0.06)
    share = 3.0 / frame.x.high
    assert float(path[2]) == pytest.approx(box.x + share * box.width, abs=0.06)


def test_an_image_keeps_its_peaks_and_its_blanks():
    values = np.zeros((3, 5000))
    values[1, 1234], values[2, :2500] = 50.0, np.nan
    image = Image(np.arange(5000.0), [1.0, 2.0, 3.0], values, (0.0, 50.0), "dB")
    panel = Panel(Axis(), Axis(), (image,))
    (box,) = layout(Chart("m", "", "", (panel,))).boxes
    grid = _resampled(image, frame_of(panel, box))
    assert np.nanmax(grid) == 50.0
    row = np.argwhere(grid == 50.0)
    assert pytest.approx(row[0, 1] / grid.shape[1], abs=2 / grid.shape[1]) == 1234 / 5000
    assert np.isnan(grid[0, 0])
    assert grid[0, -1] == 0.0  # the highest row is on top
    assert PALETTE[-3:].hex() == "e6e6e6"


def test_charts_as_json():
    data = json.loads(json.dumps(chart(Line(X, [1.0, np.nan, np.inf], "a")).data()))
    (panel,) = data["panels"]
    assert panel["marks"][0]["x"] == [1.0, 10.0, 100.0]
    assert panel["marks"][0]["y"] == [1.0, None, None]
    assert (data["name"], panel["x"]["label"], panel["x"]["scale"]) == (
        "levels",
        "Frequency, Hz",
        "log",
    )


@pytest.mark.parametrize(
    ("low", "high", "words"),
    [
        (0.0, 10.0, ["0", "2", "4", "6", "8", "10"]),
        (-0.4, 0.3, ["−0.4", "−0.3", "−0.2", "−0.1", "0", "0.1", "0.2", "0.3"]),
        (2900.0, 3000.0, ["2900", "2920", "2940", "2960", "2980", "3000"]),
    ],
)
def test_round_ticks(low, high, words):
    assert [word for _, word in round_ticks(low, high)] == words


def test_ticks_of_a_logarithmic_axis():
    powers = scale_of(Axis(scale="log"), np.array([1e-5, 1e3])).ticks
    assert [word for _, word in powers] == [
        "10⁻⁵",
        "10⁻⁴",
        "10⁻³",
        "0.01",
        "0.1",
        "1",
        "10",
        "100",
        "1000",
    ]
    few = scale_of(Axis(scale="log"), np.array([20.0, 300.0])).ticks
    assert [word for _, word in few] == ["20", "50", "100", "200"]


def test_an_axis_without_values_says_so():
    drawn = chart(Line(X, np.zeros(3)), y=Axis("Force, N", "log"))
    assert b"Every value is too small to show." in svg(drawn)
    assert figure(drawn).axes[0].texts[0].get_text() == "Every value is too small to show."


def test_a_chart_is_drawn_once():
    drawn = chart(Line(X, Y))
    assert picture(drawn) is picture(drawn)
    assert svg(drawn) == svg(chart(Line(X, Y)))


def test_long_lines_keep_their_extremes():
    x = np.linspace(0.0, 1.0, 100_000)
    y = np.sin(40.0 * x)
    y[54321] = 3.0
    drawn = chart(Line(x, y, colour="#123456", dash="-"), x=Axis("s"))
    path = re.search(r'<path d="([^"]+)" fill="none" stroke="#123456"', svg(drawn).decode())[1]
    points = points_of(path)
    assert len(points) < 1000
    frame = frame_of(drawn.panels[0], layout(drawn).boxes[0])
    assert points[:, 1].min() == pytest.approx(frame.points([0.0], [3.0])[0, 1], abs=0.06)


def test_an_image_of_equal_values_has_a_scale():
    image = Image([1.0, 2.0], [1.0, 2.0], np.full((2, 2), 30.0), (30.0, 30.0), "dB")
    drawn = chart(image, x=Axis("x"), y=Axis("y"))
    assert image.ends == (29.5, 30.5)
    assert b">30.0</text>" in svg(drawn)
    assert figure(drawn).axes[0].collections[0].get_clim() == (29.5, 30.5)
