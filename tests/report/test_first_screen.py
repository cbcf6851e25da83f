"""The drawing and the chart that open the report."""

import json
import re
from collections.abc import Sequence

import numpy as np
import pytest
import xarray as xr
from support import tiny_run
from test_report import make_results

from vibroacoustics.base.errors import SchemaError
from vibroacoustics.report.blocks import Beside, Lights
from vibroacoustics.report.drawing import machine_picture
from vibroacoustics.report.drawing.loads import loads, turn
from vibroacoustics.report.drawing.outline import feet_m, outline
from vibroacoustics.report.drawing.view import bar, fitted
from vibroacoustics.report.lights import light, lights
from vibroacoustics.report.quantities import FOOT_FORCE, FORCE, LINE
from vibroacoustics.report.sections import SECTIONS
from vibroacoustics.report.shifts import Shift
from vibroacoustics.results.complete import check_run
from vibroacoustics.study.scoring import Measurable

SHELL = {
    "outer_diameter_m": 0.2,
    "height_m": 0.4,
    "dome_height_m": 0.05,
    "centre_of_mass_height_m": 0.15,
    "floor_clearance_m": 0.03,
}
WEIGHT = np.full(4, 0.25)


@pytest.fixture(scope="module")
def results() -> xr.Dataset:
    return tiny_run()


def changed_by(percent: Sequence[float]) -> Shift:
    """A force of 10 N that changes by as much in each of four samples."""
    before, changes = np.array([10.0]), np.asarray(percent, dtype=float)
    sampled_db = 20.0 * np.log10(1.0 + changes[:, None] / 100.0)
    after = before * (1.0 + changes.mean() / 100.0)
    return Shift(FORCE, before, after, sampled_db, WEIGHT, Measurable())


@pytest.mark.parametrize(
    ("percent", "word"),
    [
        ((-30.0, -20.0, -20.0, -10.0), "better"),
        ((30.0, 20.0, 20.0, 10.0), "worse"),
        ((1.0, 2.0, -2.0, -4.9), "no difference"),
        ((1.0, 2.0, -2.0, -5.1), "not sure"),
        ((10.0, 2.0, -2.0, -10.0), "not sure"),
        ((-10.0, -10.0, -10.0, 10.0), "better"),
    ],
)
def test_the_sign_follows_the_rule_of_the_verdicts(percent: tuple[float, ...], word: str) -> None:
    assert light([changed_by(percent)]).word == word


def test_better_at_one_microphone_and_worse_at_another_is_mixed() -> None:
    down, up = changed_by((-20.0,) * 4), changed_by((50.0,) * 4)
    both = light([down, up])
    assert (both.word, both.change) == ("mixed", "−20 to +50")
    assert both.band == pytest.approx((-0.2, 0.5))
    assert both.zone == pytest.approx(0.05)


def test_what_goes_beyond_the_scale_ends_at_it_and_keeps_its_number() -> None:
    large = light([changed_by((300.0,) * 4)])
    assert large.band == (1.0, 1.0)
    assert large.change == "+300"


def test_levels_are_in_db_of_a_scale_of_20() -> None:
    quieter = Shift(LINE, np.array([40.0]), np.array([35.0]), np.array([[-5.0]]), np.ones(1),
                    Measurable())  # fmt: skip
    assert light([quieter]) == light([quieter, quieter])
    assert light([quieter]).band == pytest.approx((-0.25, -0.25))
    assert light([quieter]).zone == pytest.approx(0.025)


def test_every_option_and_quantity_has_a_light() -> None:
    chart = lights(make_results({"none": 1.0, "louder": 1.8, "halved": 0.5, "perfect": 0.0}))
    assert chart is not None
    assert [(row.name, row.word) for row in chart.rows] == [
        ("louder", "worse"), ("halved", "better"), ("perfect", "better"),
    ]  # fmt: skip
    assert {len(row.lights) for row in chart.rows} == {len(chart.head) - 1} == {6}
    assert chart.rows[0].lights[0].change == "+80"
    assert chart.rows[2].lights[0].change == "vanishes"
    assert lights(make_results({"none": 1.0})) is None


def test_outline_of_shell_box_and_sphere_have_their_sizes() -> None:
    bodies = {
        "shell": ((-0.1, -0.15), (0.1, 0.25)),
        "box": ((-0.2, -0.15), (0.2, 0.45)),
        "sphere": ((-0.25, -0.15), (0.25, 0.35)),
    }
    sizes = {"length_m": 0.4, "width_m": 0.3, "height_m": 0.6, "diameter_m": 0.5}
    for kind, (lower, upper) in bodies.items():
        lines = outline(SHELL, {"kind": kind, **sizes})
        assert lines.side.min(axis=0) == pytest.approx(lower)
        assert lines.side.max(axis=0) == pytest.approx(upper)
        assert lines.floor_z_m == pytest.approx(-0.18)
    assert outline(SHELL, {"kind": "box", **sizes}).above.max(axis=0) == pytest.approx((0.2, 0.15))


def test_feet_stand_where_the_machine_says() -> None:
    square = feet_m({"shell": SHELL, "mounts": {"pitch_m": 0.2}, "feet": None})
    assert np.abs(square).tolist() == [[0.1, 0.1, 0.15]] * 4
    given = {
        "foot_1": {"x_m": 0.1, "y_m": 0.0, "height_m": None},
        "foot_2": {"x_m": -0.1, "y_m": 0.1, "height_m": -0.2},
        "foot_3": None,
    }
    feet = feet_m({"shell": SHELL, "feet": given})
    assert feet.tolist() == [[0.1, 0.0, -0.15], [-0.1, 0.1, -0.2]]


def test_a_view_has_one_scale_and_bars_of_round_length() -> None:
    view = fitted((0, 2), np.array([(-1.0, 0.0), (1.0, 1.0)]), (0, 0), (100, 100))
    assert view.scale == pytest.approx(50.0)
    assert view.of(np.array([1.0, 7.0, 1.0])) == pytest.approx((100.0, 25.0))
    assert ">1 m<" in bar((0, 0), 50.0, "m", 60.0)
    assert ">500 mm<" in bar((0, 0), 50.0, "m", 40.0)
    assert ">20 N<" in bar((0, 0), 2.0, "N", 60.0)


def test_loads_are_those_of_none_and_turn_through_their_amplitude(results: xr.Dataset) -> None:
    acting = loads(results)
    assert acting is not None
    largest = np.linalg.norm(turn(acting.force_n, (0, 1)), axis=1).max()
    assert largest == pytest.approx(acting.force_amplitude_n, rel=1e-3)
    none = results["force_amplitude"].sel(option="none", order=1)
    assert acting.force_amplitude_n == pytest.approx(float(none.max()))
    assert loads(results.drop_vars("force_order")) is None


def test_first_section_shows_drawing_beside_chart_and_is_not_folded(results: xr.Dataset) -> None:
    assert [name for name, section in SECTIONS.items() if not section.folded] == ["verdict"]
    blocks = SECTIONS["verdict"].blocks(results)
    (pair,) = (block for block in blocks if isinstance(block, Beside))
    assert isinstance(pair.wide, Lights)
    assert "front_1m, 0.24 m high" in str(pair.narrow)


def test_the_caption_gives_the_foot_force_of_the_tables(results: xr.Dataset) -> None:
    at = results["force_amplitude"].sel(option="none", order=1)
    feet = results["foot_force_amplitude"].sel(option="none", order=1)
    largest = float(feet.isel(speed=int(at.argmax("speed"))).max())
    picture = machine_picture(results)
    assert picture is not None
    assert f"at most {FOOT_FORCE.write(largest)} into a foot" in picture.caption


def test_drawing_is_light_and_loads_nothing(results: xr.Dataset) -> None:
    picture = machine_picture(results)
    assert picture is not None
    assert picture.ending == "svg"
    assert len(picture.png) < 15_000
    text = picture.png.decode()
    assert not re.search(r"href|url\(|<script|<style", text)
    for scale in (" mm<", " N<", " N foot<"):
        assert scale in text
    assert "nan" not in text


@pytest.mark.parametrize(
    ("table", "broken"),
    [
        ("machine", {"shell": {**SHELL, "height_m": "tall"}}),
        ("machine", {"mounts": {"pitch_m": None}}),
        ("machine", {"feet": {"foot_1": {"x_m": 0.1}}}),
        ("radiation", {"body": {"kind": "box", "length_m": 0.1}}),
        ("radiation", {"surroundings": {"walls": {"top": {"distance_m": 1.0}}}}),
    ],
)
def test_results_with_a_broken_geometry_are_refused(
    results: xr.Dataset, table: str, broken: dict[str, object]
) -> None:
    parameters = json.loads(results.attrs["parameters"])
    parameters[table] |= broken
    attrs = {**results.attrs, "parameters": json.dumps(parameters)}
    attrs.pop("parameters_sha256")
    changed = results.copy()
    changed.attrs = attrs
    with pytest.raises(SchemaError, match=next(iter(broken))):
        check_run(changed)


def test_older_results_have_no_drawing_and_the_chart_alone(results: xr.Dataset) -> None:
    older = results.drop_vars("foot_force_order")
    assert machine_picture(older) is None
    blocks = SECTIONS["verdict"].blocks(older)
    assert not any(isinstance(block, Beside) for block in blocks)
    assert any(isinstance(block, Lights) for block in blocks)
