"""What the report says of a measured baseline."""

import re

import pytest
from sound_studies import result_with_baseline
from tonal_spectra import tonal_spectrum

from vibroacoustics.commands.tone_tables import tone_row
from vibroacoustics.report.sections import SECTIONS, baseline
from vibroacoustics.report.sections import reasons as verdict
from vibroacoustics.report.sections.verdict import words as first_screen
from vibroacoustics.sound import tonality
from vibroacoustics.sound.ingredients import ingredients


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    return result_with_baseline(tmp_path_factory.mktemp("stand"))


def test_the_section_says_what_the_data_cannot_tell(results):
    section = SECTIONS["baseline"]
    assert section.applies(results)
    text = " ".join(baseline.limits(results))
    assert "was measured at front_1m (orders.csv, thirds.csv)" in baseline.summary(results)
    assert "Third octaves: 16 to 1000 Hz at front_1m; in other bands the unmodelled noise" in text
    assert re.search(r"counts, up to \d+\s% of the energy of the total level", text)
    assert "2 of 4 values (order, speed, microphone) have a phase" in text
    assert "levels at 950 rpm are interpolated between measured speeds" in text
    assert "nothing was measured at 1200 rpm" in text
    assert "At side_1m, above_1m nothing was measured" in text
    tables = [block for block in section.blocks(results) if hasattr(block, "rows")]
    assert [table.caption.split(",")[1].strip() for table in tables] == ["900 rpm", "950 rpm"]
    assert [row[:4] for row in tables[0].rows] == [
        ("1", "15.0", "yes", "90.0"), ("2", "30.0", "no", "60.0")
    ]  # fmt: skip


def test_the_verdict_holds_the_model_against_what_was_measured(results):
    total = results["level_total"].sel(speed=900.0, option="none", receiver="front_1m").item()
    text = " ".join(verdict.reasons(results))
    share = baseline.not_measured(results)
    how = "most of it assumed in bands that were not measured" if share > 0.5 else "as measured"
    assert f"The rest, {how}, {total:.1f} dB(A) at 900 rpm" in text
    at = {"speed": 950.0, "option": "none", "receiver": "front_1m"}
    level = results["level_total"].sel(at).item()
    (first, *_) = first_screen.sentences(results)
    assert first == (
        f"Reciprocating compressor by table at 950 rpm: {level:.1f} dB(A) at front_1m, "
        "fitted to the assumed 82 at 1000 rpm."
    )


def test_results_without_a_baseline_have_no_such_section(results):
    assert not SECTIONS["baseline"].applies(results.drop_vars("baseline_share"))


def test_tones_and_loudness_of_every_option_stand_in_a_table(results):
    section = SECTIONS["tones"]
    assert section.applies(results)
    table, *_, note = section.blocks(results)
    assert table.caption.endswith("front_1m, 950 rpm")
    assert [row[0] for row in table.rows] == [str(name) for name in results["option"].values]
    assert {row[1] for row in table.rows} == {"none"}  # orders 1 to 4 of 15 Hz are below 89.1 Hz
    assert "ECMA-418-1" in note.words
    assert not section.applies(results.drop_vars("noise_band_level"))


def test_a_prominent_tone_is_named_with_its_ratios(results):
    loud = results.copy()
    loud["tone_frequency"] = 10.0 * loud["tone_frequency"]
    at_150_hz = {"line": "order 1", "receiver": "above_1m"}
    loud["pressure_line"] = loud["pressure_line"].copy()
    loud["pressure_line"].loc[at_150_hz] = 30.0
    parts = ingredients(loud, "none", "above_1m", 900.0)
    (tone, *others) = tonality.prominent(tonality.tones(tonal_spectrum(parts)))
    assert tone.name == "order 1"
    name, hertz, _, over_noise, over_bands = tone_row(tone)
    assert (name, hertz) == ("order 1", "150.0")
    assert over_noise.endswith("(14.9)")
    assert over_bands.endswith("(17.2)")
    assert not others


def test_without_loudness_the_section_says_what_to_do(results):
    assert "sone" in SECTIONS["tones"].blocks(results)[0].head
    *tables, note = SECTIONS["tones"].blocks(results.drop_vars(["loudness", "sharpness"]))
    assert "Run the study again" in note.words
    assert "sone" not in tables[0].head
