"""What the level hangs on, in words: shares where they are resolved, what to measure next."""

import json

import numpy as np
import pytest
from test_report_sources import with_sources

from vibroacoustics.base import rounding
from vibroacoustics.base.vocabulary import stamp
from vibroacoustics.report.drawn_words import file_unit
from vibroacoustics.report.sections import SECTIONS
from vibroacoustics.report.unknowns import (
    NOT_RESOLVED,
    measure_next_sentence,
    quality_sentence,
    unknowns_table,
)

NAMES = ["variation.mobility_change_db", "gas.polytropic_index", "mounts.pitch_m"]
KNOWLEDGE = ["before", "flat", "near"]


def with_unknowns(quality=(0.95, 0.92, 0.91), change=(0.75, 0.1, 0.0, 0.05)):
    """Results of eleven draws of a rising gain, the loud ones of no weight."""
    results = with_sources({"none": 40.0, "rattles": 62.0, "idle": 40.0})
    draws = np.arange(1, results.sizes["bank_draw"] + 1)
    values = np.stack([draws - 6.0, 1.0 + 0.01 * draws, 0.1 + 0.0 * draws], axis=1)
    share = [[0.8, 0.15, 0.004], [0.7, 0.25, 0.004], [0.6, 0.3, 0.004]]
    by_name = {"drawn_parameter": NAMES}
    known = {"knowledge": KNOWLEDGE}
    options = {"option": results["option"].values}
    of_options = np.array([np.full(4, np.nan), change, np.zeros(4)])
    kept = results.drop_dims("drawn_parameter")
    kept["bank_weight"] = kept["bank_weight"] * np.where(draws <= 6, 1.0, 0.0)
    return kept.assign(
        bank_value=stamp("bank_value", values, {"bank_draw": draws, **by_name}),
        drawn_value=stamp("drawn_value", values, {"draw": draws, **by_name}),
        level_share=stamp("level_share", share, {**known, **by_name}),
        level_share_quality=stamp("level_share_quality", np.array(quality), known),
        change_share=stamp(
            "change_share", of_options, {**options, "unknown": [*NAMES, "remainder.level_db"]}
        ),
        change_share_quality=stamp("change_share_quality", np.array([np.nan, 0.5, 0.0]), options),
        change_variance=stamp("change_variance", np.array([0.0, 4.0, 1.0]), options),
    )


def plain(text):
    return text.replace("\u00a0", " ")


def test_prior_stands_beside_posterior_for_each_unknown_that_matters():
    table = unknowns_table(with_unknowns())
    gain, index, others = ([plain(cell) for cell in row] for row in table.rows)
    assert gain[0] == "path through the shell mobility change, dB"
    # Six to eleven samples: the ends, −4.5 and −0.5 dB, are open by about 1 dB.
    assert gain[1:] == ["0 (−4 to 4)", "−2 (−4 to 0)", "−2 (−4 to 0)", *gain[4:]]
    assert gain[4:] == ["80 %", "70 %", "60 %"]
    assert index[4:] == ["15 %", "25 %", "30 %"]
    assert others[0] == "1 other, less than 1 % each"
    assert others[4:] == ["0.40 %", "0.40 %", "0.40 %"]


def test_shares_are_told_only_where_they_are_resolved():
    nothing = with_unknowns(quality=(0.95, 0.5, -0.1))
    assert "nothing with the published level, prior near" in quality_sentence(nothing)
    results = with_unknowns(quality=(0.95, 0.5, np.nan))
    first, *_ = unknowns_table(results).rows
    assert first[5:] == (NOT_RESOLVED, NOT_RESOLVED)
    text = plain(quality_sentence(results))
    assert "95 % by the ranges alone, 50 % with the published level, prior flat." in text
    assert "Below 90 % shares are not resolved" in text
    assert NOT_RESOLVED not in quality_sentence(with_unknowns())
    assert "too few" in quality_sentence(with_unknowns(quality=[np.nan] * 3))


def test_the_unknown_that_would_narrow_the_changes_most_is_named():
    """0.75 of 4 in a sum of 5 dB²; half the band of the option is left."""
    results = with_unknowns()
    text = plain(measure_next_sentence(results))
    assert text.startswith("Measure next, as far as 11 draws tell: path through the shell mobility")
    assert "take about 60 % of the variance" in text
    change = results["level_total_by_draw"].sel(receiver="front_1m", speed=2900.0)
    change = (change.sel(option="rattles") - change.sel(option="none")).values
    low, high = np.quantile(change, (0.1, 0.9))
    assert f"from {high - low:.1f} to about {0.5 * (high - low):.1f} dB." in text
    rest = plain(measure_next_sentence(with_unknowns(change=(0.1, 0.1, 0.0, 0.3))))
    assert ": the level of what is not modelled. To know it" in rest
    assert "do not tell" in measure_next_sentence(with_unknowns(change=(0.0, 0.0, 0.0, 0.0)))
    assert measure_next_sentence(results.isel(option=[0])) == ""


@pytest.mark.parametrize("quality", [(0.95, 0.92, 0.91), (np.nan, np.nan, np.nan)])
def test_the_report_has_the_section(quality):
    results = with_unknowns(quality)
    section = SECTIONS["unknowns"]
    assert section.applies(results)
    first, *_ = section.blocks(results)
    assert first.words.startswith("Measure next")
    assert not section.applies(results.drop_vars("level_share"))


def test_values_are_in_the_units_of_the_file():
    results = with_unknowns()
    parameters = json.loads(results.attrs["parameters"])
    record = dict(parameters["records"][0], field="mounts.pitch_mm")
    of_file = results.assign_attrs(
        parameters=json.dumps({**parameters, "records": [record, *parameters["records"]]})
    )
    assert file_unit(results, "mounts.pitch_m") == ("m", 1.0)
    assert file_unit(of_file, "mounts.pitch_m") == ("mm", 1e-3)
    of_file["level_share"][:, 2] = 0.3
    row = next(row for row in unknowns_table(of_file).rows if row[0] == "mounts pitch, mm")
    assert row[1] == "100"


@pytest.mark.parametrize(
    ("value", "text"),
    [(1e8, "1·10⁸"), (123456.0, "123000"), (0.01234, "0.0123"), (-2.5, "−2.5"),
     (-1.55e-5, "−1.55·10⁻⁵"), (0.0, "0"), (np.nan, "–")],
)  # fmt: skip
def test_three_digits_of_any_size(value, text):
    assert rounding.three_digits(value) == text


def test_one_column_says_that_no_share_is_resolved():
    table = unknowns_table(with_unknowns(quality=(0.1, 0.2, np.nan)))
    assert table.head[4:] == ("share of the variance",)
    assert {row[4:] for row in table.rows} == {(NOT_RESOLVED,)}
    assert {len(row) for row in table.rows} == {len(table.head)}


@pytest.mark.parametrize(
    ("value", "unit", "write", "text"),
    [
        (47.6, 0.0, rounding.level, "47.6"),
        (47.64, 0.1, rounding.level, "47.6"),
        (47.6, 1.0, rounding.level, "48"),
        (47.6, 10.0, rounding.level, "50"),
        (0.04, 0.1, rounding.signed, "0.0"),
        (-2.6, 1.0, rounding.signed, "−3"),
        (1.6, 1.0, rounding.signed, "+2"),
        (0.0234, 0.001, rounding.three_digits, "0.023"),
        (1.24e10, 1e9, rounding.three_digits, "1.2·10¹⁰"),
        (np.nan, 1.0, rounding.level, rounding.NOTHING),
    ],
)
def test_digits_follow_the_unit(value, unit, write, text):
    assert rounding.to_unit(value, unit, write) == text


def test_each_end_of_a_span_has_its_unit():
    assert rounding.span([16.4, 1.93], rounding.signed, [1.0, 0.1]) == "+1.9 to +16"
    assert rounding.span([0.3, -0.4], rounding.signed, [1.0, 1.0]) == "0"
