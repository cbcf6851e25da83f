"""Unknowns in words: shares where they are resolved, what to measure next."""

import json

import numpy as np
import pytest
from test_report_sources import with_sources

from vibroacoustics.base import rounding
from vibroacoustics.base.vocabulary import stamp
from vibroacoustics.report.sections import SECTIONS
from vibroacoustics.report.sections.unknowns import (
    NOT_RESOLVED,
    file_unit,
    measure_next_sentence,
    resolved_sentence,
    unknowns_table,
)

NAMES = ["variation.mobility_change_db", "gas.polytropic_index", "mounts.pitch_m"]
KNOWLEDGE = ["before", "flat", "near"]


def with_unknowns(floors=(0.1, 0.1, 0.1), gain=(0.5, 0.2, 0.0), votes=(5, 0, 0), perfect=0.9):
    """Results of eleven samples of a rising gain, the loud ones of no weight."""
    results = with_sources({"none": 40.0, "rattles": 62.0, "idle": 40.0})
    samples = np.arange(1, results.sizes["prior_sample"] + 1)
    values = np.stack([samples - 6.0, 1.0 + 0.01 * samples, 0.1 + 0.0 * samples], axis=1)
    share = np.array([[0.8, 0.15, 0.004], [0.7, 0.25, 0.004], [0.6, 0.3, 0.004]])
    by_name = {"uncertain_parameter": NAMES}
    known = {"knowledge": KNOWLEDGE}
    choices = {"choice": ["sound", "sound and foot force"]}
    chosen = {"choice_option": ["none", "idle"]}
    kept = results.drop_dims("uncertain_parameter")
    kept["prior_sample_weight"] = kept["prior_sample_weight"] * np.where(samples <= 6, 1.0, 0.0)
    ends = {"level_share": share, "level_share_low": 0.8 * share, "level_share_high": 1.1 * share}
    both = {"parameter_information": gain, "parameter_information_votes": votes}
    return kept.assign(
        prior_sample_value=stamp(
            "prior_sample_value", values, {"prior_sample": samples, **by_name}
        ),
        sampled_value=stamp("sampled_value", values, {"sample": samples, **by_name}),
        level_share_floor=stamp("level_share_floor", np.array(floors), known),
        **{name: stamp(name, value, {**known, **by_name}) for name, value in ends.items()},
        choice_utility=stamp("choice_utility", np.zeros((2, 2)), {**choices, **chosen}),
        perfect_information=stamp("perfect_information", np.array([0.02, perfect]), choices),
        parameter_information_floor=stamp(
            "parameter_information_floor", np.array([0.4, 0.4]), choices
        ),
        **{
            name: stamp(name, np.array([[0.0, 0.0, 0.0], value]), {**choices, **by_name})
            for name, value in both.items()
        },
    )


def plain(text):
    return text.replace("\u00a0", " ")


def test_prior_stands_beside_posterior_for_each_unknown_that_matters():
    table = unknowns_table(with_unknowns())
    gain, index = ([plain(cell) for cell in row] for row in table.rows)
    assert gain[0] == "path through the shell mobility change, dB"
    # Six to eleven samples: the ends, −4.5 and −0.5 dB, are open by about 1 dB.
    assert gain[1:] == ["0 (−4 to 4)", "−2 (−4 to 0)", "−2 (−4 to 0)", *gain[4:]]
    assert gain[4:] == ["80 % (64 % to 88 %)", "70 % (56 % to 77 %)", "60 % (48 % to 66 %)"]
    assert index[4:] == ["15 % (12 % to 16 %)", "25 % (20 % to 28 %)", "30 % (24 % to 33 %)"]


def test_shares_are_given_only_where_their_interval_lies_above_chance():
    """The lower ends are 0.12, 0.2 and 0.24."""
    results = with_unknowns(floors=(0.121, 0.3, 0.9))
    gain, *others = unknowns_table(results).rows
    assert not others
    assert plain(gain[4]) == "80 % (64 % to 88 %)"
    assert plain(gain[5]) == "70 % (56 % to 77 %)"
    assert len(gain) == 6  # no column of the prior with which nothing is resolved
    text = plain(resolved_sentence(results))
    assert "Parameters with resolved shares, of 3: 1 by the ranges alone" in text
    assert "1 by the ranges alone, 1 with the published data, prior flat, 0 with" in text
    index = unknowns_table(with_unknowns(floors=(0.121, 0.1, 0.9))).rows[1]
    assert plain(index[4]) == NOT_RESOLVED
    nothing = with_unknowns(floors=(0.9, 0.9, 0.9))
    assert unknowns_table(nothing) is None
    nothing["level_share"][:] = np.nan
    assert "too few" in resolved_sentence(nothing)


def test_the_unknown_worth_a_measurement_is_named():
    text = measure_next_sentence(with_unknowns())
    assert text == (
        "No value of a parameter would change the choice of option on sound. Before an option is "
        "chosen on sound and foot force, measure path through the shell mobility change: its value "
        "is worth 0.5 dB in the mean, all values 0.9 dB."
    )


@pytest.mark.parametrize("told", [{"votes": (4, 1, 0)}, {"gain": (0.39, 0.2, 0.0)}])
def test_no_unknown_is_named_by_four_of_five_or_below_chance(told):
    text = measure_next_sentence(with_unknowns(**told))
    assert (
        "worth 0.9 dB for the choice of option on sound and foot force; 11 samples do not" in text
    )
    assert "Before" not in text


def test_no_measurement_where_all_values_are_worth_nothing():
    results = with_unknowns(perfect=0.09)
    assert measure_next_sentence(results) == (
        "No value of a parameter would change the choice of option on sound or on sound and foot "
        "force. Most valuable measurement for the dominant source: a third-octave spectrum."
    )
    assert measure_next_sentence(results.drop_vars("parameter_information")) == ""


@pytest.mark.parametrize("floors", [(0.1, 0.1, 0.1), (0.9, 0.9, 0.9)])
def test_the_report_has_the_section(floors):
    results = with_unknowns(floors)
    section = SECTIONS["unknowns"]
    assert section.applies(results)
    first, *_ = section.blocks(results)
    assert first.words.startswith("No value of a parameter would")
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
    of_file["level_share_low"][:, 2] = 0.3
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
