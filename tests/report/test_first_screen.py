"""The first screen of the report, and the folded drawing and chart of the machine."""

import csv
import io
import json
import re
from collections.abc import Sequence

import numpy as np
import pytest
import xarray as xr
from sources_study import sources_run
from support import tiny_run
from test_report import make_results

from vibroacoustics.base.errors import SchemaError
from vibroacoustics.report import render
from vibroacoustics.report.blocks import Beside, Details, Intervals, Lights, Text
from vibroacoustics.report.drawing.machine import bar, feet_m, fitted, loads, outline, turn
from vibroacoustics.report.drawing.picture import machine_picture
from vibroacoustics.report.quantities import FOOT_FORCE, FORCE, LINE, TOTAL
from vibroacoustics.report.sections import SECTIONS
from vibroacoustics.report.sections.verdict import words as first_screen
from vibroacoustics.report.sections.verdict.content import light, lights
from vibroacoustics.report.sections.verdict.words import sentences
from vibroacoustics.report.shifts import Shift, level_word
from vibroacoustics.results.bands import Band
from vibroacoustics.results.complete import check_run
from vibroacoustics.study.scoring import Measurable

SHELL = {
    "outer_diameter_m": 0.2,
    "height_m": 0.4,
    "dome_height_m": 0.05,
    "centre_of_mass_height_m": 0.15,
    "floor_clearance_m": 0.03,
}


@pytest.fixture(scope="module")
def results() -> xr.Dataset:
    return tiny_run()


def changed_by(percent: Sequence[float]) -> Shift:
    """A force of 10 N that changes by as much in each of four samples."""
    before, changes = np.array([10.0]), np.asarray(percent, dtype=float)
    least = Measurable()
    after = before * (1.0 + changes.mean() / 100.0)
    gain_db = 20.0 * np.log10(after / before)
    interval = Band(changes.min(), float(np.median(changes)), changes.max())
    grown, fallen = (
        float((sign * changes > 100.0 * least.force_ratio).mean()) for sign in (1.0, -1.0)
    )
    return Shift(FORCE, before, after, gain_db, (interval,), grown, fallen, least)


@pytest.mark.parametrize(
    ("percent", "word"),
    [
        ((-30.0, -20.0, -20.0, -10.0), "better"),
        ((30.0, 20.0, 20.0, 10.0), "worse"),
        ((1.0, 2.0, -2.0, -4.9), "no change"),
        ((1.0, 2.0, -2.0, -5.1), "uncertain"),
        ((10.0, 2.0, -2.0, -10.0), "uncertain"),
        ((-10.0, -10.0, -10.0, 10.0), "uncertain"),
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
    change = (Band(-5.0, -5.0, -5.0),)
    quieter = Shift(LINE, np.array([40.0]), np.array([35.0]), np.array([-5.0]), change, 0.0, 1.0,
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


def test_first_section_shows_two_charts_and_folds_the_machine(results: xr.Dataset) -> None:
    assert [name for name, section in SECTIONS.items() if not section.folded] == ["verdict"]
    assert SECTIONS["verdict"].title == "Summary"
    blocks = SECTIONS["verdict"].blocks(results)
    (pair,) = (block for block in blocks if isinstance(block, Beside))
    assert isinstance(pair.narrow, Intervals)
    assert isinstance(pair.wide, Intervals)
    (folded,) = (block for block in blocks if isinstance(block, Details))
    drawing, chart, ranking = folded.blocks
    assert "front_1m, 0.24 m high" in str(drawing)
    assert isinstance(chart, Lights)
    assert isinstance(ranking, Text)


def test_the_caption_gives_the_foot_force_of_the_tables(results: xr.Dataset) -> None:
    at = results["force_amplitude"].sel(option="none", order=1)
    feet = results["foot_force_amplitude"].sel(option="none", order=1)
    largest = float(feet.isel(speed=int(at.argmax("speed"))).max())
    picture = machine_picture(results)
    assert picture is not None
    assert f"Largest force into a foot: {FOOT_FORCE.write(largest)}." in picture.caption


def test_drawing_is_light_and_loads_nothing(results: xr.Dataset) -> None:
    picture = machine_picture(results)
    assert picture is not None
    assert picture.ending == "svg"
    assert len(picture.content) < 15_000
    text = picture.content.decode()
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


def test_results_without_forces_of_feet_have_no_drawing(results: xr.Dataset) -> None:
    older = results.drop_vars("foot_force_order")
    assert machine_picture(older) is None
    blocks = SECTIONS["verdict"].blocks(older)
    (folded,) = (block for block in blocks if isinstance(block, Details))
    assert isinstance(folded.blocks[0], Lights)


# --- sentences and charts ------------------------------------------------------------------------


@pytest.fixture(scope="module")
def sampled() -> xr.Dataset:
    return sources_run()


@pytest.fixture(scope="module")
def tables(sampled: xr.Dataset) -> dict[str, list[dict[str, str]]]:
    """Rows of the CSV files without an option at the published microphone."""
    files = render(sampled)
    rows = {
        name: list(csv.DictReader(io.StringIO(files[name].decode())))
        for name in ("comparison.csv", "sources.csv")
    }
    return {
        name: [one for one in of_file if one["receiver"] == "front_1m"]
        for name, of_file in rows.items()
    }


def numbers(text: str) -> list[tuple[float, float]]:
    """Numbers of a text with half the unit of their last digit that is not zero."""
    found = []
    for sign, whole, decimals in re.findall(r"(−?)(\d+)(?:\.(\d+))?", text):
        zeros = len(whole) - len(whole.rstrip("0")) if whole != "0" else 0
        unit = 10.0 ** -len(decimals) if decimals else 10.0**zeros
        value = float(f"{whole}.{decimals or 0}")
        found.append((-value if sign else value, 0.5 * unit + 1e-9))
    return found


def assert_written(text: str, expected: Sequence[float]) -> None:
    known = numbers(text)
    assert len(known) == len(expected), text
    for (value, half_unit), exact in zip(known, expected, strict=True):
        assert value == pytest.approx(exact, abs=half_unit), text


def of_parts(row: dict[str, str], stem: str, unit: str, factor: float = 1.0) -> list[float]:
    """Value and ends of a column."""
    parts = ("", "_10_percent", "_90_percent")
    return [factor * float(row[f"{stem}{part}{unit}"]) for part in parts]


@pytest.mark.parametrize("name", ["sampled", "results"])
def test_the_first_screen_has_six_short_sentences_at_most(
    name: str, request: pytest.FixtureRequest
) -> None:
    texts = sentences(request.getfixturevalue(name))
    assert len(texts) <= 6
    assert sum(len(text.split()) for text in texts) <= 90
    assert max(len(text.split()) for text in texts) <= 25
    assert all(text.endswith(".") for text in texts)


def test_the_level_is_that_of_comparison_csv(
    sampled: xr.Dataset, tables: dict[str, list[dict[str, str]]]
) -> None:
    none = next(row for row in tables["comparison.csv"] if row["option"] == "none")
    (text, *_) = sentences(sampled)
    name, _, rest = text.partition(" at 2900 rpm: ")
    assert name == json.loads(sampled.attrs["parameters"])["machine"]["name"]
    level, rest = rest.split(" dB(A) at front_1m ")
    interval, published = rest.split("), fitted to the published ")
    value, low, high = of_parts(none, "level_total", "_dba")
    assert_written(level, [value])
    assert_written(interval.replace("80\u00a0% interval ", ""), [low, high])
    assert published == "56."


def test_the_dominant_source_is_that_of_sources_csv(
    sampled: xr.Dataset, tables: dict[str, list[dict[str, str]]]
) -> None:
    rows = [row for row in tables["sources.csv"] if row["option"] == "none"]
    largest = max(rows, key=lambda row: float(row["share_of_energy"]))
    text = sentences(sampled)[2].replace("<1\u00a0%", "0\u00a0%")
    assert json.loads(sampled.attrs["words"])["sources"][largest["source"]] in text
    assert "not settled" in text
    assert_written(text, of_parts(largest, "share_of_energy", "", 100.0))


def test_the_best_option_for_the_feet_is_that_of_the_median_changes(
    sampled: xr.Dataset, tables: dict[str, list[dict[str, str]]]
) -> None:
    change = sampled["foot_force_change_1x"].squeeze()
    best = change["option"].values[int(np.argmin(change.values))]
    text = next(
        one
        for one in sentences(sampled)
        if one.startswith(
            "Largest reduction of force on the most loaded foot at shaft speed (1×): option "
        )
    )
    name, _, size = text.partition(": option ")[2].partition(", ")
    assert name == best
    ratios = [
        100.0
        * (10.0 ** (sampled[f"foot_force_change_1x{end}"].squeeze().sel(option=best) / 20) - 1)
        for end in ("", "_10_percent", "_90_percent")
    ]
    assert " (from " in size  # the upper end reads as the value
    assert_written(size, [float(one) for one in ratios[:2]])
    force = {row["option"]: float(row["foot_force_1x_n"]) for row in tables["comparison.csv"]}
    of_medians = 100.0 * (force[best] / force["none"] - 1.0)
    assert numbers(size)[0][0] == pytest.approx(of_medians, abs=3.0)


def changed(change_db: float, low: float, high: float, up: float, down: float) -> Shift:
    """A total that changes at two speeds, at the first by nothing."""
    bands = (Band(0.0, 0.0, 0.0), Band(low, change_db, high))
    level = np.array([50.0, 50.0])
    gain = np.array([0.0, change_db])
    return Shift(TOTAL, level, level + gain, gain, bands, up, down, Measurable())


@pytest.mark.parametrize(
    ("ends", "up", "down", "expected"),
    [
        ((0.6, 2.0), 0.9, 0.0, "louder"),
        ((0.0, 2.0), 0.6, 0.0, "uncertain"),  # the interval reaches what cannot be measured
        ((-1.0, 2.0), 0.6, 0.6, "uncertain"),
        ((-2.0, -0.6), 0.0, 0.9, "quieter"),
        ((-2.0, 0.0), 0.0, 0.6, "uncertain"),
        ((-1.0, 2.0), 0.4, 0.0, "uncertain"),
        ((-1.0, 2.0), 0.0, 0.2, "uncertain"),
        ((-0.2, 0.3), 0.09, 0.09, "no change"),
    ],
)
def test_the_word_on_a_change_follows_interval_and_probabilities(
    ends: tuple[float, float], up: float, down: float, expected: str
) -> None:
    one = changed(sum(ends) / 2.0, *ends, up, down)
    assert level_word(one) == expected
    assert one.largest == 1


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (changed(1.3, 0.6, 2.0, 0.9, 0.0), "Option twin raises the level: +1.3 dB (+0.6 to +2.0)."),
        (
            changed(1.0, 0.0, 2.0, 0.6, 0.0),
            "Option twin may raise the level: +1.0 dB (0.0 to +2.0).",
        ),
        (
            changed(-2.0, -9.0, 9.0, 0.6, 0.6),
            "Option twin may raise or lower the level: −2.0 dB (−9.0 to +9.0).",
        ),
    ],
)
def test_a_claim_says_which_way_an_option_may_change_the_level(
    results: xr.Dataset, change: Shift, words: str
) -> None:
    speeds = results.isel(speed=[0]).reindex(speed=[1.0, results.speed.item(0)])
    claim = first_screen._claim(speeds, {"twin": change}, ["twin"], "raise")
    assert claim.replace("\N{NO-BREAK SPACE}", " ") == words


def test_parts_of_the_level_are_those_of_the_results(sampled: xr.Dataset) -> None:
    chart = first_screen.contributions(sampled)
    rows = {row.name: row for row in chart.rows}
    assert [row.word for row in chart.rows[:2]] == ["published", "total"]
    assert (rows["published"].low, rows["published"].value, rows["published"].high) == (
        54.0, 56.0, 58.0,
    )  # fmt: skip
    at = {"option": "none", "receiver": "front_1m", "speed": 2900.0}
    names = json.loads(sampled.attrs["words"])["sources"]
    gas = {**at, "sound_source": "gas"}
    for name, variable, selection in (
        ("machine", "level_total", at), ("unmodelled noise", "residual_level", at),
        (names["gas"], "source_level", gas),
    ):  # fmt: skip
        expected = [
            sampled[f"{variable}{end}"].sel(selection).item()
            for end in ("_10_percent", "", "_90_percent")
        ]
        assert [rows[name].low, rows[name].value, rows[name].high] == expected
    low, high = chart.scale
    assert low <= min(row.value for row in chart.rows[:3])
    assert high >= max(row.high for row in chart.rows)
    assert chart.zone is None
    quiet = {
        name for source, name in names.items()
        if sampled["source_level_90_percent"].sel({**at, "sound_source": source}).item()
        < rows["machine"].value - 30.0
    }  # fmt: skip
    assert quiet
    assert not quiet & set(rows)


def test_changes_by_option_are_those_of_the_results(sampled: xr.Dataset) -> None:
    chart = first_screen.changes(sampled)
    assert chart is not None
    assert [row.name for row in chart.rows] == sampled["option"].values.tolist()
    at = {"receiver": "front_1m", "speed": 2900.0}
    for row in chart.rows[1:]:
        expected = [
            sampled[f"change_total{end}"].sel(option=row.name, **at).item()
            for end in ("_10_percent", "", "_90_percent")
        ]
        assert [row.low, row.value, row.high] == expected
    assert chart.zone == (-0.5, 0.5)
    assert chart.scale[0] == -chart.scale[1]
    assert first_screen.changes(make_results({"none": 1.0})) is None


@pytest.mark.parametrize(
    ("gain_db", "grown", "fallen", "speed"),
    [([-3.0, 1.0], 0.8, 0.2, 1), ([3.0, -1.0], 0.2, 0.8, 1), ([-3.0, 1.0], 0.8, 0.8, 0)],
)
def test_a_change_is_shown_where_it_goes_the_way_that_is_said(gain_db, grown, fallen, speed):
    """An option that may raise the level is not shown with a fall of 3 dB at another speed."""
    bands = tuple(Band(gain - 1.0, gain, gain + 1.0) for gain in gain_db)
    one = np.ones(2)
    of_total = Shift(TOTAL, one, one, np.array(gain_db), bands, grown, fallen, Measurable())
    assert of_total.largest == speed


def test_a_run_without_the_published_speed_is_complete_and_read() -> None:
    results = sources_run().copy()
    parameters = json.loads(results.attrs["parameters"])
    parameters["machine"]["overall_noise"]["speed_rpm"] = 3000.0
    attrs = {**results.attrs, "parameters": json.dumps(parameters)}
    attrs.pop("parameters_sha256")
    results.attrs = attrs
    check_run(results)
    assert "at 2900 rpm" in render(results)["report.html"].decode()
