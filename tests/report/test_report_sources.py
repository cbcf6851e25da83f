"""The report where gas, keys and motor are modelled: bands, shares, options that rattle."""

import csv
import io
import json
import re

import numpy as np
import pytest
import xarray as xr
from judged_results import _nominal, judged, restated
from pages import comparison_text
from test_report import PUBLISHED_DBA, make_results

from vibroacoustics.base.vocabulary import DERIVED_SUPPLY, GIVEN_SUPPLY, WEIGHTINGS, check, stamp
from vibroacoustics.report import render
from vibroacoustics.report.option_verdict import option_verdict, option_verdicts
from vibroacoustics.report.sections.assumptions import not_modelled, unmodelled_sentence
from vibroacoustics.report.sections.scores import too_close_words
from vibroacoustics.report.sections.sources.content import source_table
from vibroacoustics.report.sections.sources.words import certainty_sentences, samples_sentence
from vibroacoustics.report.sections.unknowns import held_sentence, sampled_sentences
from vibroacoustics.report.sections.verdict.words import sentences
from vibroacoustics.report.tables import escape_markdown
from vibroacoustics.results.bands import Band, percent
from vibroacoustics.sources.cases import MovingParts
from vibroacoustics.sources.gas import ScrollGasForces
from vibroacoustics.sources.keys import OldhamKeyForces
from vibroacoustics.sources.motor import MotorPulsation

FIGURES = ["key_impacts_per_revolution", "key_force_peak_n", "foot_force_2x_line_n"]
SOURCES = ["moving_parts", "gas", "keys", "motor"]
PRIORS = {"prior": ["flat", "near"]}
BANDS_HZ = [50.0, 100.0, 1000.0, 2000.0]
SPREAD_DB = np.array([-4.0, 0.0, 3.0])
"""Of every source but the moving parts, over the samples."""
OF_SAMPLE = [0, 0, 0, 1, 1, 1, 1, 1, 2, 2, 2]
"""Spread of each sample: quantiles at 10, 50 and 90 % of eleven are the second, sixth, tenth."""


def energy(*levels_db: float) -> float:
    """Sum of levels, dB."""
    return float(10.0 * np.log10(np.sum(10.0 ** (np.array(levels_db) / 10.0))))


def with_sources(
    keys_dba: dict[str, float],
    gas_dba: float = 50.0,
    nominal_above_db: float = 0.0,
) -> xr.Dataset:
    """Results whose options change the level of the keys only; the median is as given.

    With the nominal values gas and keys are louder by `nominal_above_db`.
    """
    factors = {name: 0.5 if name == "rattles" else 1.0 for name in keys_dba}
    results = make_results(factors, receivers=("front_1m",))
    speeds = [float(speed) for speed in results["speed"].values]
    sampled = np.zeros((3, 2, len(keys_dba), 4, 1))
    for number, keys in enumerate(keys_dba.values()):
        levels = np.array([7.0, gas_dba, keys, -120.0])
        spread = SPREAD_DB[:, None] * np.array([0.0, 1.0, 1.0, 1.0])
        sampled[:, :, number, :, 0] = (levels + spread)[:, None]
    assumed = sampled[1] + nominal_above_db * np.array([0.0, 1.0, 1.0, 0.0])[:, None]
    sampled = sampled[OF_SAMPLE]
    weight = np.full(len(OF_SAMPLE), 1.0 / len(OF_SAMPLE))
    made = _levels(speeds, list(keys_dba), sampled, assumed, weight)
    kept = results.drop_dims(["sound_source", "figure"]).drop_vars(
        set(made.data_vars), errors="ignore"
    )
    results = kept.merge(made, join="exact").assign_attrs(results.attrs)
    parameters = json.loads(results.attrs["parameters"])
    parameters["ranges"] = [
        {"table": "gas", "field": "polytropic_index"},
        {"table": "variation", "field": "mobility_change_db"},
    ]
    parameters["radiation"]["maximum_frequency_hz"] = 4000.0
    record = {**parameters["records"][1], "field": "gas.polytropic_index"}
    parameters["records"].append(record)
    results["supply_frequency"] = stamp(
        "supply_frequency", [50.0, 60.0], {"speed": speeds}, source=GIVEN_SUPPLY
    )
    results.attrs["parameters"] = json.dumps(parameters)
    words = json.loads(results.attrs["words"])
    words["source_figures"] = FIGURES
    words["shell_bends"] = True
    words["labels"] = dict(OldhamKeyForces.labels)
    words["sources"] = {
        "moving_parts": MovingParts.label,
        "gas": ScrollGasForces.label,
        "keys": OldhamKeyForces.label,
        "motor": MotorPulsation.label,
    }
    results.attrs["words"] = json.dumps(words)
    return restated(judged(results))


def _levels(
    speeds: list[float],
    options: list[str],
    sampled: np.ndarray,
    assumed: np.ndarray,
    weight: np.ndarray,
) -> xr.Dataset:
    place = {"speed": speeds, "option": options, "receiver": ["front_1m"]}
    by_source = {**place, "sound_source": SOURCES}
    samples = {"sample": np.arange(1, weight.size + 1)}
    bank = {"prior_sample": samples["sample"]}
    power, own = 10.0 ** (sampled / 10.0), 10.0 ** (assumed / 10.0)
    band = np.stack([assumed - 40.0, assumed - 30.0, assumed, assumed - 10.0], axis=-1)
    arrays = {
        "source_level": stamp("source_level", assumed, by_source),
        "source_level_by_sample": stamp(
            "source_level_by_sample", sampled, {**samples, **by_source}
        ),
        "sample_weight": stamp("sample_weight", [weight, weight], {**PRIORS, **samples}),
        "prior_sample_weight": stamp("prior_sample_weight", [weight, weight], {**PRIORS, **bank}),
        "prior_sample_level": stamp("prior_sample_level", np.full(weight.size, 57.0), bank),
        "prior_sample_value": stamp(
            "prior_sample_value",
            np.zeros((weight.size, 1)),
            {**bank, "uncertain_parameter": ["gas.polytropic_index"]},
        ),
        "sampled_value": stamp(
            "sampled_value",
            samples["sample"][:, None].astype(float),
            {**samples, "uncertain_parameter": ["gas.polytropic_index"]},
        ),
        "source_band_level": stamp("source_band_level", band, {**by_source, "band": BANDS_HZ}),
        "total_band_level": stamp(
            "total_band_level",
            10.0 * np.log10((10.0 ** (band / 10.0)).sum(axis=2)),
            {**place, "noise_band": BANDS_HZ},
        ),
    }
    published = 10.0 ** (PUBLISHED_DBA / 10.0)
    rest = np.maximum(published - power.sum(axis=-2)[:, :1, :1], 0.0)
    left = np.maximum(published - own.sum(axis=-2)[:1, :1], 0.0)
    modelled, total = own.sum(axis=-2), own.sum(axis=-2) + left
    for name, many in (("modelled", power.sum(axis=-2)), ("total", power.sum(axis=-2) + rest)):
        sampled_level = 10.0 * np.log10(many)
        arrays[f"level_{name}_by_sample"] = stamp(
            f"level_{name}_by_sample", sampled_level, {**samples, **place}
        )
    weighted = {**place, "weighting": list(WEIGHTINGS)}
    of_all = np.stack([10.0 * np.log10(modelled)] * 3, axis=-1)
    arrays["level_modelled"] = stamp("level_modelled", of_all, weighted)
    arrays["level_total"] = stamp("level_total", 10.0 * np.log10(total), place)
    remainder = 10.0 * np.log10(np.maximum(rest[:, 0, 0, 0], 1e-30))
    arrays["level_unmodelled_by_sample"] = stamp("level_unmodelled_by_sample", remainder, samples)
    arrays["level_unmodelled"] = stamp(
        "level_unmodelled", 10.0 * np.log10(np.maximum(left, 1e-30)).item()
    )
    figures = np.zeros((2, len(options), len(FIGURES) + 1))
    figures[..., 1:3] = [70.0, 0.2]
    if "rattles" in options:
        figures[:, options.index("rattles"), 0] = 12.0
    arrays["reported_figure"] = stamp(
        "reported_figure",
        figures,
        {"speed": speeds, "option": options, "figure": [*FIGURES, "added_mass_kg"]},
    )
    return check(xr.Dataset(arrays))


@pytest.fixture(scope="module")
def results() -> xr.Dataset:
    return with_sources({"none": 40.0, "rattles": 62.0, "idle": 40.0})


@pytest.fixture(scope="module")
def files(results: xr.Dataset) -> dict[str, bytes]:
    return render(results)


def test_the_first_screen_names_the_source_with_most_of_the_energy() -> None:
    """Gas has 50.1 % in the three of eleven samples in which it has 53 dB(A) of 56."""
    texts = {
        gas: " ".join(sentences(with_sources({"none": 40.0}, gas_dba=gas))).replace("\u00a0", " ")
        for gas in (50.0, 60.0)
    }
    largest = "largest: gas forces, 30 % (10 % to 50 %) of the energy"
    assert f"is not settled; {largest}" in texts[50.0]
    assert "The dominant source is gas forces: 9" in texts[60.0]


def test_shares_are_means_of_the_samples_and_add_up(results: xr.Dataset) -> None:
    """Gas has 46, 50 and 53 of 56 dB(A) in three, five and three of eleven samples."""
    mean = (3.0 * 10.0**-1.0 + 5.0 * 10.0**-0.6 + 3.0 * 10.0**-0.3) / 11.0
    own = results.sel(option="none", speed=2900.0, receiver="front_1m")
    assert own["source_share"].sel(sound_source="gas").item() == pytest.approx(mean)
    parts = own["source_share"].sum().item() + own["unmodelled_share"].item()
    assert parts == pytest.approx(1.0)
    shown = {row[0]: row[2].replace("\u00a0", " ") for row in source_table(results).rows}
    assert shown["Gas forces"] == "30 % (10 % to 50 %)"
    assert shown["Oldham keys"] == "3 % (1 % to 5 %)"
    assert shown["Moving parts (orders of the rigid machine)"] == "<1 %"
    assert shown["Unmodelled noise"] == "70 % (40 % to 90 %)"


def test_the_report_says_how_sure_the_ranking_is(results: xr.Dataset) -> None:
    sure = " ".join(certainty_sentences(results))
    assert "not settled: the interval of gas forces is not above one half and above" in sure
    assert "11 samples were weighted by the likelihood of the published level" in sure
    assert "effective sample size 11. 11 of them were computed" in sure
    assert "2 values are sampled" in sure
    assert "The dominant source is not settled" in " ".join(sentences(results))


def test_too_few_samples_that_agree_leave_nominal_values(results: xr.Dataset) -> None:
    names = [name for name in results.variables if "sample" in results[name].dims]
    few = _nominal(results).drop_vars([*names])
    few["prior_sample_weight"] = few["prior_sample_weight"] * 0.0
    few["prior_sample_weight"][:, :2] = 0.5
    rows = source_table(few).rows
    assert rows[0][0] == "Gas forces"
    assert not any(" to " in cell for row in rows for cell in row[1:])
    told = samples_sentence(few).replace("\u00a0", " ")
    assert "Too few of 11 samples agree with the data: effective sample size 2.0." in told
    assert "In 100 % of them the modelled sources exceed the published 56 dB(A)" in told
    assert told in render(few)["report.html"].decode().replace("&nbsp;", " ").replace("\u00a0", " ")


def test_what_is_not_sampled_is_in_a_file_with_range_and_reason(results: xr.Dataset) -> None:
    held = {"table": "shell", "field": "dome_height_m", "lowest": 0.0, "highest": 0.06}
    record = {"field": "shell.dome_height_mm", "file": "f.toml", "source": "assumed", "value": "40",
              "unit": "mm", "lowest": 0.0, "highest": 60.0}  # fmt: skip
    held_results = with_parameters(
        results, held_ranges=[{**held, "reason": "give the outside"}], records=[record]
    )
    assert "One value with a range is not sampled" in held_sentence(held_results)
    (row,) = csv.DictReader(io.StringIO(render(held_results)["inputs.csv"].decode()))
    assert (row["highest"], row["highest_si"], row["use"]) == ("60", "0.06", "give the outside")
    assert held_sentence(results) == ""


def test_error_of_the_projection_is_stated(results: xr.Dataset) -> None:
    coords = {"uncertain_parameter": ["housing.inertia_xx_kg_m2", "structure.thickness_m"]}
    own = results.drop_dims("uncertain_parameter")
    own["projection_error"] = stamp("projection_error", [np.nan, 0.0096], coords)
    text = " ".join(sampled_sentences(own)).replace("\u00a0", " ")
    assert "largest error of a natural frequency: shell thickness 0.96 %" in text


def with_parameters(results: xr.Dataset, **changes: object) -> xr.Dataset:
    """Results whose study has other parameters."""
    changed = results.copy()
    parameters = {**json.loads(results.attrs["parameters"]), **changes}
    return changed.assign_attrs(parameters=json.dumps(parameters))


def test_the_highest_frequency_is_told(results: xr.Dataset) -> None:
    assert "up to 4000 Hz" in " ".join(certainty_sentences(results))


def test_the_line_of_the_motor_is_never_called_2x(results: xr.Dataset) -> None:
    text = certainty_sentences(results)[-1]
    assert "100 Hz beside 2× at 96.7 Hz (2900 rpm), 120 Hz beside 2× at 116.7 Hz" in text
    assert "0.200 N" in text
    assert "derived" not in text
    assert "Motor at twice the line frequency" in [row[0] for row in source_table(results).rows]


def test_a_supply_that_is_derived_is_told(results: xr.Dataset) -> None:
    supply = stamp("supply_frequency", [49.9638, 59.8], source=DERIVED_SUPPLY)
    text = certainty_sentences(results.assign(supply_frequency=supply))[-1]
    assert "99.9 Hz beside 2× at 96.7 Hz (2900 rpm), 119.6 Hz beside" in text
    assert "The supply's frequency is derived from speed and slip" in text


def test_an_option_that_rattles_is_not_better(results: xr.Dataset) -> None:
    own = option_verdict(results, "rattles")
    assert own.judgement == "mixed"
    assert own.worse_in == ("total level",)
    assert "total level +" in own.reason
    text = " ".join(own.sentences)
    assert "Keys of the ring: 12.0 impacts per revolution, up to 70.0 N" in text
    assert "0.001 dB" not in text
    idle = option_verdict(results, "idle")
    assert idle.judgement == "no measurable change"


def test_without_sources_the_same_option_is_better() -> None:
    assert option_verdict(make_results({"none": 1.0, "rattles": 0.5}), "rattles").judgement == (
        "better"
    )


def test_a_band_on_both_sides_of_zero_judges_nothing() -> None:
    results = with_sources({"none": 40.0, "idle": 40.0})
    for name in ("level_modelled_by_sample", "level_total_by_sample"):
        results[name].loc[{"option": "idle"}] += xr.DataArray(
            np.array([-0.3, 0.0, 0.2])[OF_SAMPLE],
            dims="sample",
            coords={"sample": results["sample"]},
        )
    assert option_verdict(restated(results), "idle").judgement == "no measurable change"


@pytest.mark.parametrize(
    ("change_db", "judgement"),
    [
        ([-9.0, 0.4, 0.4], "uncertain"),  # 3 of 11 samples down
        ([-9.0, 0.6, 0.4], "uncertain"),  # 5 of 11 samples up, 3 down
        ([0.0, 0.6, 0.6], "uncertain"),  # the interval holds what cannot be measured
        ([-0.6, -0.6, 9.0], "uncertain"),
        ([0.6, 0.6, 0.7], "worse"),
        ([-0.6, -0.6, -9.0], "better"),
    ],
)
def test_a_level_counts_if_it_could_be_measured_in_one_sample_of_ten(
    change_db: list[float], judgement: str
) -> None:
    results = with_sources({"none": 40.0, "it": 40.0})
    results["level_total_by_sample"].loc[{"option": "it"}] += xr.DataArray(
        np.array(change_db)[OF_SAMPLE], dims="sample", coords={"sample": results["sample"]}
    )
    assert option_verdict(restated(results), "it").judgement == judgement


def test_the_smallest_change_that_counts_is_a_setting() -> None:
    results = with_sources({"none": 40.0, "it": 40.0})
    results["level_total_by_sample"].loc[{"option": "it"}] += 0.6
    assert option_verdict(restated(results), "it").judgement == "worse"
    scoring = json.loads(results.attrs["parameters"])["scoring"]
    blunt = with_parameters(results, scoring={**scoring, "measurable": {"level_db": 1.0}})
    blunt = restated(blunt)
    assert option_verdict(blunt, "it").judgement == "no measurable change"


def test_tables_markdown_and_csv_have_the_same_verdicts(
    results: xr.Dataset, files: dict[str, bytes]
) -> None:
    verdicts = {one.option: (one.judgement, one.reason) for one in option_verdicts(results)}
    rows = list(csv.DictReader(io.StringIO(files["scores.csv"].decode())))
    assert {row["option"]: (row["verdict"], row["because"]) for row in rows[1:]} == verdicts
    text = files["comparison.md"].decode()
    for option, (word, reason) in verdicts.items():
        assert f"| {option} | {word} | {escape_markdown(reason)} |" in text
        short = "no change" if word.startswith("no measurable") else word
        assert f"| {option} | {short} |" in text


def test_the_tables_show_bands_in_place_of_single_levels(results: xr.Dataset) -> None:
    assert "Values are medians of the weighted samples" in comparison_text(results)
    band = energy(46.0, 36.0, 7.0), energy(50.0, 40.0, 7.0), energy(53.0, 43.0, 7.0)
    page = render(results)["comparison.md"].decode()
    assert f"{band[1]:.0f} ({band[0]:.0f} to {band[2]:.0f})" in page
    assert "Values are medians of the weighted samples" in page


def test_forces_count_and_show_in_the_samples_where_they_were_sampled(results: xr.Dataset) -> None:
    """`idle` shakes as `none` at the values as given, a fifth more in eight of eleven samples."""
    speeds, options = results["speed"].values, results["option"].values
    coords = {"sample": results["sample"].values, "speed": speeds, "option": options}
    force = np.full((results.sizes["sample"], 2, 3), 40.0)
    force[3:, :, 2] = 48.0
    sampled = results.assign(
        {
            name: stamp(name, force, coords)
            for name in ("force_1x_by_sample", "moment_1x_by_sample", "foot_force_1x_by_sample")
        }
    )
    sampled = restated(sampled)
    verdict = option_verdict(sampled, "idle")
    assert verdict.judgement == "uncertain"
    assert verdict.reason.startswith("1× force 0 to +20 % (73 % of samples)")
    assert "48 (from 40)" in comparison_text(sampled)
    row = render(sampled)["comparison.csv"].decode().splitlines()[0]
    assert "force_1x_10_percent_n" in row
    fewer = sampled.copy(deep=True)
    fewer["sample_weight"][:, 3:] = 0.0
    fewer["sample_weight"][:, :3] = 1.0 / 3.0
    assert option_verdict(restated(fewer), "idle").judgement == "no measurable change"


def _remainder(spread_db: float) -> float:
    modelled = energy(50.0 + spread_db, 40.0 + spread_db)
    return float(10.0 * np.log10(10.0 ** (PUBLISHED_DBA / 10.0) - 10.0 ** (modelled / 10.0)))


def test_total_and_modelled_level_hold_all_sources(
    results: xr.Dataset, files: dict[str, bytes]
) -> None:
    rows = list(csv.DictReader(io.StringIO(files["comparison.csv"].decode())))
    row = next(row for row in rows if (row["option"], row["speed_rpm"]) == ("rattles", "2900"))
    # 7 dB(A) of the moving parts are 2e-6 of the energy.
    modelled = energy(50.0, 62.0)
    assert float(row["level_modelled_dba"]) == pytest.approx(modelled, abs=1e-4)
    assert float(row["level_total_dba"]) == pytest.approx(
        energy(modelled, _remainder(0.0)), abs=1e-4
    )
    assert float(row["change_total_10_percent_db"]) < float(row["change_total_db"])
    assert float(row["change_total_db"]) < float(row["change_total_90_percent_db"])
    assert float(row["change_total_nominal_db"]) == pytest.approx(float(row["change_total_db"]))
    assert "level_modelled_dbc" in row
    ends = (float(row[f"change_total_{share}_percent_db"]) for share in (10, 90))
    assert " to ".join(f"{end:+.0f}" for end in ends) in comparison_text(results)


def test_sources_csv_equals_the_dataset(results: xr.Dataset, files: dict[str, bytes]) -> None:
    rows = list(csv.DictReader(io.StringIO(files["sources.csv"].decode())))
    assert len(rows) == 3 * 2 * 1 * 4
    for row in rows:
        at = {
            "option": row["option"],
            "speed": float(row["speed_rpm"]),
            "receiver": row["receiver"],
            "sound_source": row["source"],
        }
        own = results.sel(at)
        assert float(row["level_dba"]) == pytest.approx(float(own["source_level"]), rel=1e-8)
        assert float(row["share_of_energy"]) == pytest.approx(float(own["source_share"]), rel=1e-8)
        assert float(row["level_90_percent_dba"]) == pytest.approx(
            float(own["source_level_by_sample"][9]), rel=1e-8
        )
        for part in ("10_percent", "90_percent", "nominal"):
            assert float(row[f"share_of_energy_{part}"]) == pytest.approx(
                float(own[f"source_share_{part}"]), rel=1e-8
            )


def test_tables_rank_the_sources(results: xr.Dataset) -> None:
    table = source_table(results)
    assert [row[0] for row in table.rows][:3] == [
        "Gas forces",
        "Oldham keys",
        "Moving parts (orders of the rigid machine)",
    ]
    assert len(table.head) == len(table.rows[0]) == 3
    assert table.caption.startswith("2900 rpm")
    assert table.rows[-1] == ("Machine", "56.0", "100 %")


def test_what_is_not_modelled_follows_the_study(results: xr.Dataset) -> None:
    inside, outside = (
        " ".join(not_modelled(own)) for own in (results, make_results({"none": 1.0}))
    )
    assert "The shell is rigid" in outside
    assert "The shell is rigid" not in inside
    for word in ("bearing", "wraps", "jets", "pipes", "floor"):
        assert word in inside
    rest = np.sort(results["level_unmodelled_by_sample"].values[: len(OF_SAMPLE)])
    assert f"{rest[1]:.0f} to {rest[9]:.0f}" in unmodelled_sentence(results)


def test_the_section_is_there_only_with_sources(files: dict[str, bytes]) -> None:
    page = files["report.html"].decode()
    without = render(make_results({"none": 1.0, "halved": 0.5}))
    assert "Dominant sources" in page
    assert "Dominant sources" not in without["report.html"].decode()
    assert "sources.csv" not in without
    # Each figure with its text, the one of the options too: `rattles` raises 1 kHz by 11.7 dB.
    for start in ("Third-octave levels", "A-weighted third-octave levels"):
        assert len(re.findall(rf'<img [^>]*alt="{start}[^"]{{20,}}"', page)) == 1
    assert "{{" not in page
    assert "nan" not in re.sub(r"data:image[^\"]*", "", page).lower().split()


def test_a_study_of_none_alone_has_sources_and_no_changes() -> None:
    files = render(with_sources({"none": 40.0}))
    page = files["report.html"].decode()
    assert "Dominant sources" in page
    assert "figures/sources_options.svg" not in files


def test_bands_and_shares_in_words() -> None:
    own = Band(44.7, 48.9, 51.2)
    assert own.middle_and_ends(lambda value: f"{value:.1f}") == "48.9 (44.7 to 51.2)"
    assert Band(6.9, 6.9, 6.9).middle_and_ends(lambda value: f"{value:.1f}") == "6.9"
    texts = [percent(share).replace("\u00a0", " ") for share in (0.2, 0.0123, -0.05, 1e-6, np.nan)]
    assert texts == ["20 %", "1.2 %", "−5.0 %", "< 0.01 %", "–"]


def test_options_that_rank_first_by_nothing_are_named(results: xr.Dataset) -> None:
    """`idle` does what none does: a first place of its is no difference."""
    share = results["first_place_share"].copy(data=[0.5, 0.46, 0.04])
    words = too_close_words(results.assign(first_place_share=share)).replace("\u00a0", " ")
    assert "too small to be measured: idle (4.0 %)." in words
    assert too_close_words(results.assign(first_place_share=share * [1.0, 1.0, 0.0])) == ""
