"""The report on small synthetic results: tables, verdict, escaping, self-containment."""

import base64
import csv
import hashlib
import io
import json
import re
from collections.abc import Sequence
from html import unescape as html_text
from typing import Any

import numpy as np
import pytest
import xarray as xr
from judged_results import judged
from pages import comparison_text

from vibroacoustics.base.rounding import (
    level,
    level_change,
    signed,
    significant,
    span,
)
from vibroacoustics.base.vocabulary import (
    AXES,
    RIGID_BODY_DOFS,
    WEIGHTINGS,
    check,
    stamp,
)
from vibroacoustics.report import render
from vibroacoustics.report.figures.scores import contributions
from vibroacoustics.report.option_verdict import option_verdict, option_verdicts
from vibroacoustics.report.sections import scores
from vibroacoustics.report.sections.assumptions import records_table
from vibroacoustics.report.sections.comparison import (
    comparison,
    comparison_data,
    comparison_table,
)
from vibroacoustics.report.sections.mounts import isolation_sentence, shape_words
from vibroacoustics.report.sections.radiation import grid_error_sentence
from vibroacoustics.report.sections.reasons import options_table
from vibroacoustics.report.sections.scores import ranking_sentence, scores_data, wrong_sums
from vibroacoustics.report.sections.verdict.words import sentences
from vibroacoustics.report.tables import to_csv
from vibroacoustics.scoring import score
from vibroacoustics.study.scoring import CriterionScale, Scoring

COLUMNS = (
    "option,speed_rpm,receiver,force_1x_n,force_2x_n,moment_1x_nm,foot_force_1x_n,level_1x_db,"
    "level_2x_db,level_1x_dba,level_modelled_dba,level_total_dba,change_1x_db,change_modelled_db,"
    "change_total_db"
)
PUBLISHED_DBA = 56.0
HOUSING = {
    "mass_kg": 35.0,
    "inertia_xx_kg_m2": 0.57,
    "inertia_yy_kg_m2": 0.57,
    "inertia_zz_kg_m2": 0.12,
}


def make_results(
    factors: dict[str, float],
    speeds: Sequence[float] = (2900.0, 3500.0),
    receivers: Sequence[str] = ("front_1m", "side_1m"),
    published: bool = True,
    facts: dict[str, dict[str, float]] | None = None,
    published_dba: float = PUBLISHED_DBA,
) -> xr.Dataset:
    """Results in which an option multiplies all forces and sounds of `none` by its factor."""
    options = list(factors)
    gain = np.array(list(factors.values()))[None, :]
    speed = np.array(speeds)[:, None]
    force = 45.3 * (speed / 2900.0) ** 2 * gain  # speed, option
    coords = {"speed": list(speeds), "option": options}
    parts = [
        _mechanics(coords, force),
        _mounts(),
        _sound(coords, force, list(receivers), published_dba),
        _facts(coords, facts or {}),
        _scores(options, gain[0]),
        _published() if published else xr.Dataset(),
    ]
    results = xr.merge([check(part) for part in parts], join="exact")
    results.attrs = _attributes(options, list(receivers), published_dba)
    return judged(results)


def _mechanics(coords: dict[str, Any], force: np.ndarray) -> xr.Dataset:
    orders = np.arange(5)
    first = (orders == 1).astype(float)
    angle = 2.0 * np.pi * np.arange(64) / 64
    wave = np.zeros((*force.shape, 1, 3, 64))
    wave[:, :, 0, 0] = force[..., None] * np.cos(angle)
    feet = {"foot": ["left", "right"]}
    foot = force[..., None, None] * np.array([0.01, 0.005])[:, None] * first
    spread = {**coords, "order": orders}
    source = {"source": ["oldham"], "axis": list(AXES), "crank_angle": angle}
    return xr.Dataset(
        {
            "force": stamp("force", wave, {**coords, **source}),
            "force_amplitude": stamp("force_amplitude", force[..., None] * first, spread),
            "moment_amplitude": stamp("moment_amplitude", 0.11 * force[..., None] * first, spread),
            "foot_force_amplitude": stamp("foot_force_amplitude", foot, {**spread, **feet}),
        }
    )


def _mounts() -> xr.Dataset:
    shapes = np.diag(1.0 / np.sqrt([35.0, 35.0, 35.0, 0.57, 0.57, 0.12]))
    modes = {"mode": [f"mode_{number}" for number in range(1, 7)]}
    frequency = np.geomspace(1.0, 200.0, 20)
    response = np.tile(1.0 / (1.0 - (frequency / 12.0) ** 2 + 0.1j), (3, 1))
    axes = {"axis": list(AXES), "mount_frequency": frequency}
    return xr.Dataset(
        {
            "natural_frequency": stamp("natural_frequency", np.linspace(4.0, 17.5, 6), modes),
            "mode_shape": stamp(
                "mode_shape",
                shapes[:, None, :],
                {**modes, "body": ["machine"], "dof": list(RIGID_BODY_DOFS)},
            ),
            "mode_energy": stamp(
                "mode_energy",
                (shapes[:, None, :] != 0.0).astype(float),
                {**modes, "body": ["machine"], "dof": list(RIGID_BODY_DOFS)},
            ),
            "mount_transmissibility": stamp("mount_transmissibility", response, axes),
        }
    )


def _sound(
    coords: dict[str, Any], force: np.ndarray, receivers: list[str], published_dba: float
) -> xr.Dataset:
    orders = np.arange(5)
    line = 12.0 + 20.0 * np.log10(np.maximum(force, 1e-12))
    levels = np.full((*force.shape, len(receivers), 5, 3), -250.0)
    levels[..., 1, 0] = line[..., None]
    levels[..., 1, 1:] = line[..., None, None] - 30.0
    modelled = levels[..., 1, :]
    total = 10.0 * np.log10(10.0 ** (modelled[..., 1] / 10.0) + 10.0 ** (published_dba / 10.0))
    at = {**coords, "receiver": receivers}
    weighted = {**at, "weighting": list(WEIGHTINGS)}
    by_source = {**coords, "sound_source": ["moving_parts"], "receiver": receivers}
    frequency = np.array([25.0, 50.0, 100.0])
    transfer = np.ones((len(receivers), 6, 3)) * frequency * (1.0 + 0.5j)
    field = {"receiver": receivers, "dof": list(RIGID_BODY_DOFS), "frequency": frequency}
    gap = {"receiver": receivers, "frequency": frequency}
    spectra = {
        name: stamp(name, transfer, field)
        for name in ("transfer_vector", "transfer_vector_closed_form")
    }
    spectra["transfer_vector_error"] = stamp(
        "transfer_vector_error", 0.01 * np.abs(transfer), field
    )
    return xr.Dataset(
        {
            **spectra,
            "order_level": stamp("order_level", levels, {**weighted, "order": orders}),
            "level_modelled": stamp("level_modelled", modelled, weighted),
            "level_total": stamp("level_total", total, at),
            "level_unmodelled": stamp("level_unmodelled", published_dba),
            "source_level": stamp("source_level", modelled[:, :, None, :, 1], by_source),
            "line_difference": stamp("line_difference", np.full(total.shape, -0.02), at),
            "green_difference": stamp("green_difference", np.full((len(receivers), 3), -0.07), gap),
        }
    )


def _facts(coords: dict[str, Any], facts: dict[str, dict[str, float]]) -> xr.Dataset:
    names = ["added_mass_kg", *sorted({fact for own in facts.values() for fact in own})]
    values = np.full((len(coords["speed"]), len(coords["option"]), len(names)), np.nan)
    values[..., 0] = 0.0
    for option, own in facts.items():
        for fact, value in own.items():
            values[:, coords["option"].index(option), names.index(fact)] = value
    return xr.Dataset(
        {"reported_figure": stamp("reported_figure", values, {**coords, "figure": names})}
    )


def _scores(options: list[str], gain: np.ndarray) -> xr.Dataset:
    option = {"option": options}
    criterion = {
        "criterion": ["foot_force_1x_n"],
        "criterion_label": ("criterion", ["Foot force"]),
        "criterion_unit": ("criterion", ["N"]),
    }
    by_method = {**option, "scoring_method": ["weighted_sum"]}
    utility = np.clip((4.0 - gain) / 4.0, 0.0, 1.0)
    rank = 1.0 + (utility[:, None] < utility[None, :]).sum(axis=1)
    first = (rank == 1.0) / (rank == 1.0).sum()
    return xr.Dataset(
        {
            "criterion_value": stamp("criterion_value", gain[:, None], {**option, **criterion}),
            "weight": stamp("weight", [1.0], criterion),
            "criterion_best": stamp("criterion_best", [0.0], criterion),
            "criterion_worst": stamp("criterion_worst", [4.0], criterion),
            "score": stamp("score", utility[:, None], by_method),
            "rank": stamp("rank", rank[:, None], by_method),
            "first_place_share": stamp("first_place_share", first, option),
        }
    )


def _published() -> xr.Dataset:
    option = {"published_option": ["Pendulum", "Eccentric"]}
    scores = {**option, "published_criterion": ["Fatigue", "Aspect"]}
    return xr.Dataset(
        {
            "published_score": stamp(
                "published_score", [[1.0, 2.0], [3.0, 3.0]], scores, source="T"
            ),
            "published_sum": stamp("published_sum", [3.0, 9.0], option, source="T"),
            "recomputed_sum": stamp("recomputed_sum", [3.0, 6.0], option),
        }
    )


def _attributes(options: list[str], receivers: list[str], published_dba: float) -> dict[str, str]:
    record = {"file": "m.toml", "value": "1", "unit": "kg", "lowest": None, "highest": None}
    noise = {"level_dba": published_dba, "speed_rpm": 2900.0, "distance_m": 1.0}
    parameters = {
        "title": "A study",
        "source_file": "study.toml",
        "catalogue_receiver": receivers[0],
        "receivers": {name: {"x_m": 1.0, "y_m": 0.0, "height_m": 0.2} for name in receivers},
        "options": {},
        "machine": {
            "name": "Machine",
            "kind": "oldham-scroll",
            "housing": HOUSING,
            "overall_noise": noise,
            "errata": [],
        },
        "radiation": {"surroundings": "hard-floor"},
        "scoring": {"random_weightings": 100, "published": {"source": "T"}},
        "records": [
            {**record, "field": "measured", "source": "thesis"},
            {**record, "field": "guessed", "source": "assumed", "lowest": 0.5, "highest": 2.0},
        ],
    }
    words = {
        "axes": "x, y and z",
        "orders": "Orders are multiples of the mean shaft frequency.",
        "leaves_out": [],
        "labels": {},
        "sources": {},
        "source_figures": [],
        "shell_bends": False,
        "sentences": {option: [] for option in options},
    }
    return {
        "title": "A study",
        "created_utc": "2026-01-01T00:00:00Z",
        "parameters": json.dumps(parameters),
        "words": json.dumps(words),
        "package_versions": json.dumps({"numpy": "2.2"}),
        "radiation": "{}",
    }


@pytest.fixture(scope="module")
def results() -> xr.Dataset:
    return make_results({"none": 1.0, "louder": 1.8, "halved": 0.5, "idle": 1.0, "perfect": 0.0})


@pytest.fixture(scope="module")
def files(results: xr.Dataset) -> dict[str, bytes]:
    return render(results)


def test_comparison_csv_has_the_columns_and_one_row_per_option_speed_and_receiver(
    results: xr.Dataset,
) -> None:
    lines = to_csv(comparison_data(results)).decode().splitlines()
    assert lines[0] == f"{COLUMNS},level_modelled_db,level_modelled_dbc"
    assert len(lines) == 1 + 5 * 2 * 2


def test_comparison_csv_equals_the_dataset(results: xr.Dataset) -> None:
    compared = comparison(results)
    rows = list(csv.DictReader(io.StringIO(to_csv(comparison_data(results)).decode())))
    for row in rows:
        own = compared.sel(
            option=row["option"], speed=float(row["speed_rpm"]), receiver=row["receiver"]
        )
        for name in COLUMNS.split(",")[3:]:
            assert float(row[name]) == pytest.approx(float(own[name]), rel=1e-8, abs=1e-300)
    louder = next(row for row in rows if row["option"] == "louder" and row["speed_rpm"] == "2900")
    assert float(louder["force_1x_n"]) == pytest.approx(1.8 * 45.3)
    assert float(louder["foot_force_1x_n"]) == pytest.approx(0.01 * 1.8 * 45.3)
    assert float(louder["change_1x_db"]) == pytest.approx(20.0 * np.log10(1.8))


def test_scores_csv_repeats_scores_and_ranks(results: xr.Dataset) -> None:
    rows = list(csv.DictReader(io.StringIO(to_csv(scores_data(results)).decode())))
    assert [row["option"] for row in rows] == [str(name) for name in results["option"].values]
    assert [float(row["score_weighted_sum"]) for row in rows] == pytest.approx(
        results["score"].values[:, 0]
    )
    assert {"rank_weighted_sum", "first_place_share"} <= rows[0].keys()


@pytest.mark.long
def test_silence_is_never_shown_as_a_number(results: xr.Dataset, files: dict[str, bytes]) -> None:
    cells = [str(cell) for row in comparison_table(results).rows for cell in row]
    assert "< −40" in cells
    for name in ("report.html", "comparison.md"):
        assert not re.search(r"[−-]\d{3}\.\d", files[name].decode())


@pytest.mark.parametrize(
    ("factor", "judgement"),
    [(1.8, "worse"), (0.5, "better"), (0.0, "better"), (1.0, "no measurable change"),
     (1.04, "no measurable change"), (0.96, "no measurable change")],
)  # fmt: skip
def test_the_verdict_follows_the_sign(factor: float, judgement: str) -> None:
    assert option_verdict(make_results({"none": 1.0, "it": factor}), "it").judgement == judgement


def test_every_option_has_one_short_row(results: xr.Dataset) -> None:
    table = options_table(option_verdicts(results))
    assert table is not None
    words = {row[0]: row[1:3] for row in table.rows}
    assert words["idle"] == ("no measurable change", "levels < 0.5 dB, forces < 5 %")
    assert words["louder"][0] == "worse"
    assert "1× force +" in words["louder"][1]
    assert max(len(" ".join(row).split()) for row in table.rows) < 60


@pytest.mark.parametrize(
    ("labels", "values", "told"),
    [
        (
            ["Foot force", "Cost", "Added mass"],
            [[4.0, 0.0, 0.0], [2.0, 9.0, 3.0]],
            "below none, mainly by cost.",
        ),
        (["Foot force", "Added mass"], [[4.0, 0.0], [3.0, 5.0]], "mainly by added mass."),
        (["Foot force", "Risk, 1 to 9"], [[4.0, 1.0], [3.0, 5.0]], "mainly by risk, 1 to 9."),
        (["Foot force", "Risk"], [[4.0, 1.0], [1.0, 1.0]], ""),
    ],
)
def test_why_a_better_option_ranks_behind_is_told_by_the_criteria_that_decide(
    labels: list[str], values: list[list[float]], told: str
) -> None:
    names = [f"criterion_{number}" for number in range(len(labels))]
    scales = {
        name: CriterionScale(best=0.0, worst=10.0, weight=1.0, label=label)
        for name, label in zip(names, labels, strict=True)
    }
    coords = {"option": ["none", "halved"], "given_criterion": names}
    results = make_results({"none": 1.0, "halved": 0.5}).drop_dims(["criterion", "scoring_method"])
    results = results.drop_vars("first_place_share").assign(
        given_value=stamp("given_value", values, coords)
    )
    scored = score(results, Scoring(criteria=scales))
    merged = results.merge(scored)
    text = ranking_sentence(merged, option_verdicts(merged))
    assert ("ranks below none" in text) == bool(told)
    assert told in text
    if not told:  # ranked below by rounding alone, it has no sentence
        assert not scores._behind(merged, "halved")


def test_a_line_that_rises_elsewhere_makes_the_verdict_mixed() -> None:
    results = make_results({"none": 1.0, "halved": 0.5}, published_dba=22.0)
    results["order_level"].loc[{"option": "halved", "receiver": "side_1m", "order": 1}] += 12.0
    own = option_verdict(judged(results), "halved")
    assert own.judgement == "mixed"
    assert own.worse_in == ("1× line at side_1m",)
    assert own.reason.endswith("; worse: 1× line +6.0 dB at side_1m")


@pytest.mark.parametrize(
    ("line_db", "judgement"),
    [
        ((45.0, 51.0), "mixed"),
        ((25.0, 31.0), "better"),  # below 32.1 dB, the threshold of hearing at 48.3 Hz
        ((27.0, 33.0), "mixed"),
    ],
)
def test_a_line_that_nobody_hears_makes_nothing_worse(
    line_db: tuple[float, float], judgement: str
) -> None:
    results = make_results({"none": 1.0, "halved": 0.5}, speeds=(2900.0,), published_dba=10.0)
    line = {"receiver": "side_1m", "order": 1}
    for option, level_db in zip(("none", "halved"), line_db, strict=True):
        results["order_level"].loc[{"option": option, **line}] = level_db
    results["level_total"].loc[{"receiver": "side_1m"}] = 10.0
    assert option_verdict(judged(results), "halved").judgement == judgement


def test_a_line_that_the_total_masks_makes_nothing_worse() -> None:
    """51 dB at 48.3 Hz are 20.4 dB(A): at most 15 dB below the total of 35, not of 36 dB(A)."""
    results = make_results({"none": 1.0, "halved": 0.5}, speeds=(2900.0,), published_dba=10.0)
    line = {"receiver": "side_1m", "order": 1}
    results["order_level"].loc[{"option": "none", **line}] = 45.0
    results["order_level"].loc[{"option": "halved", **line}] = 51.0
    for total_dba, judgement in ((35.0, "mixed"), (36.0, "better")):
        masked = results.copy(deep=True)
        masked["level_total"].loc[{"receiver": "side_1m"}] = total_dba
        assert option_verdict(judged(masked), "halved").judgement == judgement


def test_the_first_screen_says_whether_the_total_changes() -> None:
    factors = {"none": 1.0, "louder": 4.0}
    assert "No option lowers the level by 0.5 dB." in sentences(make_results(factors))
    louder = " ".join(sentences(make_results(factors, published_dba=22.0)))
    assert "Option louder raises the level: +" in louder
    halved = make_results({"none": 4.0, "halved": 1.0}, published_dba=15.0)
    assert "Option halved lowers the level: −" in " ".join(sentences(halved))
    alone = sentences(make_results({"none": 1.0}))
    assert not any("option" in sentence for sentence in alone)


def test_what_an_option_says_of_itself_is_in_its_verdict() -> None:
    results = make_results({"none": 1.0, "swing": 1.8, "calm": 1.1})
    words = json.loads(results.attrs["words"])
    words["sentences"]["swing"] = ["Hanging is unstable."]
    results.attrs["words"] = json.dumps(words)
    assert "Hanging is unstable." in option_verdict(results, "swing").sentences
    assert "Hanging is unstable." not in option_verdict(results, "calm").sentences


def test_published_sums_are_checked(results: xr.Dataset) -> None:
    assert wrong_sums(results) == ["Eccentric"]
    scoring = render(results)["scoring.csv"].decode()
    assert "published_sum,1," in scoring
    assert "is wrong for Eccentric" in render(results)["report.html"].decode()


def test_contributions_add_up_to_the_weighted_sum(results: xr.Dataset) -> None:
    added = contributions(results).sum("criterion").values
    assert added == pytest.approx(results["score"].sel({"scoring_method": "weighted_sum"}).values)


def test_inputs_are_in_a_file_and_the_widest_range_on_the_page(results: xr.Dataset) -> None:
    rows = records_table(results).rows
    assert rows[0][0] == "guessed"
    assert rows[0][3] == "0.5 to 2"
    inputs = list(csv.DictReader(io.StringIO(render(results)["inputs.csv"].decode())))
    assert {row["field"] for row in inputs} == {"guessed", "measured"}
    assert {(row["lowest"], row["highest"]) for row in inputs} >= {("0.5", "2")}


def test_modes_are_named_by_their_energy(results: xr.Dataset) -> None:
    assert shape_words(results, "mode_1") == "moves along x 100 %"
    assert shape_words(results, "mode_6") == "turns about z 100 %"
    assert "the mounts isolate" in isolation_sentence(results)
    slow = make_results({"none": 1.0}, speeds=(600.0,))
    assert "can meet a resonance" in isolation_sentence(slow)


@pytest.mark.parametrize(("share", "shown"), [(0.01, "0.09"), (1e-6, "0.01"), (0.0, "0.01")])
def test_error_of_the_radiation_is_below_what_is_said(results, share, shown):
    """20 lg 1.01 = 0.086 dB; an error that is small is not shown as none."""
    error = share * np.abs(results["transfer_vector"])
    sentence = grid_error_sentence(results.assign(transfer_vector_error=error))
    assert f"below {shown} dB in half, below {shown} dB in 95 %" in sentence


def test_the_page_is_self_contained(files: dict[str, bytes]) -> None:
    page = files["report.html"].decode()
    addresses = re.findall(r"""(?:src|href)\s*=\s*["']([^"']*)["']""", page)
    assert addresses
    assert all(address.startswith(("data:", "#")) for address in addresses)
    assert "<script" not in page
    assert "@import" not in page
    assert "url(" not in page


def test_a_browser_may_show_the_style_and_the_figures_of_the_page_and_nothing_else(
    files: dict[str, bytes],
) -> None:
    page = files["report.html"].decode()
    policy = html_text(
        re.findall(r'<meta http-equiv="Content-Security-Policy" content="([^"]*)">', page)[0]
    )
    (style,) = re.findall(r"<style>(.*?)</style>", page, re.DOTALL)
    digest = base64.b64encode(hashlib.sha256(style.encode()).digest()).decode()
    assert policy.split("; ") == [
        "default-src 'none'",
        "img-src data:",
        f"style-src 'sha256-{digest}'",
        "base-uri 'none'",
        "form-action 'none'",
    ]
    assert not re.search(r"<[^>]* style=", page)  # the hash allows none
    assert page.index("Content-Security-Policy") < page.index("<style>")


def test_every_figure_is_on_the_page_with_its_text(files: dict[str, bytes]) -> None:
    page = files["report.html"].decode()
    pictures = [name for name in files if name.startswith("figures/")]
    assert page.count("<img ") == len(pictures)
    assert len(re.findall(r'<img [^>]*alt="[^"]{20,}"', page)) == len(pictures)
    assert all(files[name].startswith(b"<svg ") for name in pictures)


def test_names_are_escaped() -> None:
    evil = "<script>alert(1)</script>$x|y"
    page = render(make_results({"none": 1.0, evil: 1.5}, receivers=("a/<b>",)))
    assert "<script" not in page["report.html"].decode()
    assert "&lt;script&gt;" in page["report.html"].decode()
    assert "<script" not in page["comparison.md"].decode()
    assert "figures/transfer_a_b_.svg" in page


@pytest.mark.parametrize("start", ["=", "+", "-", "@", "\t"])
def test_no_name_is_a_formula_in_a_spreadsheet(start: str) -> None:
    name = f"{start}SUM(1+1)"
    made = make_results({"none": 1.0, name: 1.5}, receivers=(name,))
    for table in (to_csv(comparison_data(made)), to_csv(scores_data(made))):
        rows = list(csv.DictReader(io.StringIO(table.decode())))
        assert f"'{name}" in {row["option"] for row in rows}
        assert name not in {cell for row in rows for cell in row.values()}


def test_the_report_is_the_same_twice(results: xr.Dataset, files: dict[str, bytes]) -> None:
    assert render(results) == files


def test_a_single_option_speed_and_microphone_without_published_table() -> None:
    results = make_results({"none": 1.0}, speeds=(2900.0,), receivers=("only",), published=False)
    files = render(results)
    assert "No option" not in files["report.html"].decode()
    assert len(files["comparison.csv"].decode().splitlines()) == 2
    assert "Published scores" not in files["report.html"].decode()


def test_terminal_table_is_narrow_and_ascii(results: xr.Dataset) -> None:
    long = make_results({"none": 1.0, "an-option-with-a-very-long-name-indeed": 1.8})
    for own in (results, long):
        text = comparison_text(own)
        assert text.isascii()
        assert max(len(line) for line in text.splitlines()) <= 110
    assert comparison_text(results).count("perfect") == 2


def test_rounding() -> None:
    assert significant(45.2576) == "45.3"
    assert significant(119.59) == "120"
    assert significant(-0.4872) == "−0.487"
    assert significant(1e-14) == "0"
    assert significant(float("nan")) == "–"
    assert signed(-0.0004, 3) == "0.000"
    assert signed(0.0006, 3) == "+0.001"
    assert signed(-1.55) == "−1.6"
    assert level(-213.4) == "< −40"
    assert level_change(-300.0, -250.0, 40.0) == "silent"
    assert level_change(300.0, 40.0, -250.0) == "–"
    assert span([1.0, 1.01], signed) == "+1.0"
