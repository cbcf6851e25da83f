"""Which input or law flips the headlines: results made up, with alternatives by hand."""

import pytest
import xarray as xr
from test_energy_words import with_alternatives

from vibroacoustics.base.vocabulary import stamp
from vibroacoustics.report.blocks import Definitions
from vibroacoustics.report.sections import SECTIONS
from vibroacoustics.report.sections.changed_inputs import (
    AS_REPORTED,
    alternative_words,
    flips,
    headline_table,
    rows_of,
)
from vibroacoustics.report.sections.sources.words import dominant_source
from vibroacoustics.report.sections.verdict.words import by_effect
from vibroacoustics.results.alternatives import (
    LEAST_EFFECTIVE,
    headline_variables,
    with_alternative,
)
from vibroacoustics.results.estimates import estimate

AT = {"speed": 2900.0, "option": "none", "receiver": "front_1m"}


def with_changes(effective: tuple[float, float] = (40.0, 60.0)) -> xr.Dataset:
    """Results in which no option raises the level with the first alternative, both with another.

    With the first one no option reduces the foot force either. The level is known within 2 dB.
    """
    results = with_alternatives(("none", "rattles", "idle"))
    for end, off_db in (("_10_percent", -2.0), ("_90_percent", 2.0)):
        results[f"level_total{end}"] = results[f"level_total{end}"] + off_db
    speeds, options = results["speed"].values, results["option"].values
    changes = [{"rattles": 0.1, "idle": 0.0}, {"rattles": 9.0, "idle": 7.0}]
    coords = {
        "alternative": results["alternative"].values,
        "alternative_quantity": ["level_total", "foot_force"],
        "speed": speeds,
        "option": options,
    }
    forces = [{}, {"rattles": -6.0}]
    value = [
        [[[of.get(name, 0.0) for name in options]] * len(speeds) for of in quantities]
        for quantities in zip(changes, forces, strict=True)
    ]
    array = xr.DataArray(value, dims=list(coords), coords=coords)
    made = {
        f"alternative_change{end}": array + off
        for end, off in (("", 0.0), ("_10_percent", -0.05), ("_90_percent", 0.05))
    }
    made["alternative_increase"] = (array > 0.5).astype(float)
    made["alternative_decrease"] = (array < -0.5).astype(float)
    stamped = {name: stamp(name, each.values, coords) for name, each in made.items()}
    size = stamp("alternative_change_effective", effective, {"alternative": coords["alternative"]})
    return results.assign({**stamped, "alternative_change_effective": size})


@pytest.fixture(scope="module")
def results() -> xr.Dataset:
    return with_changes()


def plain(text: str) -> str:
    return text.replace("\u00a0", " ")


def test_results_with_an_alternative_have_its_headlines(results: xr.Dataset) -> None:
    headlines = headline_variables(results)
    other = with_alternative(headlines, "level alone")
    assert dominant_source(results) == ("gas", False)
    assert dominant_source(other) == ("gas", True)
    assert by_effect(results) == ([], ["rattles"])
    assert by_effect(other) == ([], [])
    assert estimate(other, "level_total", **AT) == (53.0, 55.0, 57.0)
    assert estimate(other, "source_share", **AT, sound_source="gas").value == pytest.approx(0.7)
    assert estimate(other, "unmodelled_share", **AT).value == pytest.approx(0.1)
    at = {"speed": 3500.0, "option": "rattles", "receiver": "front_1m"}
    assert estimate(other, "change_total", **at) == pytest.approx((0.05, 0.1, 0.15))
    assert estimate(other, "foot_force_change_1x", **at).value == 0.0
    # Other speeds, options and the results themselves stay.
    elsewhere = {**AT, "speed": 3500.0}
    assert estimate(other, "level_total", **elsewhere) == estimate(
        results, "level_total", **elsewhere
    )
    assert estimate(results, "level_total", **AT).value != 55.0


def test_rows_name_the_headlines_that_flip(results: xr.Dataset) -> None:
    reported, alone, other = rows_of(results)
    assert reported.name == AS_REPORTED
    assert flips(reported, reported) == []
    assert flips(reported, alone) == ["dominant source", "options", "vibration"]
    assert flips(reported, other) == ["options"]
    assert alone.claims["dominant source"] == "the dominant source is gas forces"
    assert alone.claims["options"] == (
        "no option is likely to lower the level, no option to raise it"
    )
    assert other.claims["options"] == (
        "no option is likely to lower the level, idle or rattles to raise it"
    )
    assert other.claims["vibration"] == "rattles reduces the foot force most"
    assert [name for name, _ in other.changes] == ["idle", "rattles"]


def test_the_level_flips_where_its_median_leaves_the_interval(results: xr.Dataset) -> None:
    low, _, high = estimate(results, "level_total", **AT)
    for off_db, leaves in ((-0.1, False), (0.1, True)):
        level = results["alternative_level"].copy()
        level[:] = high + off_db
        reported, alone, _ = rows_of(results.assign(alternative_level=level))
        assert ("level" in flips(reported, alone)) is leaves
    assert low < high


def test_the_table_says_which_rows_have_too_few_samples() -> None:
    results = with_changes((LEAST_EFFECTIVE - 1.0, LEAST_EFFECTIVE))
    table = headline_table(results, rows_of(results))
    few, enough = table.rows[1:]
    assert few[0] == "without published spectral share"
    assert plain(few[1]) == "55.0 (53.0 to 57.0)"
    assert plain(few[2]) == "gas forces 70 % (56 % to 84 %)"
    assert "Largest decrease by an option, dB" not in table.head  # none lowers the level
    assert few[3] == "–"
    assert few[4] == "dominant source; changes: too few samples (19 effective)"
    assert plain(enough[3]) == "rattles +9.0 (from +8.9)"
    section = SECTIONS["alternatives"]
    data = section.tables(results)["alternatives.csv"]
    assert list(data["largest_change_option"])[1:] == ["", "rattles"]
    assert list(data["level_total_dba"])[1] == 55.0
    assert list(data["changes_effective_samples"])[1:] == [19.0, 20.0]


def test_a_cell_with_too_few_samples_alone_begins_with_a_capital() -> None:
    results = with_changes((LEAST_EFFECTIVE - 1.0, LEAST_EFFECTIVE))
    few = results["alternative_effective"].copy(data=[LEAST_EFFECTIVE - 2.0, LEAST_EFFECTIVE])
    results = results.assign(alternative_effective=few)
    table = headline_table(results, rows_of(results))
    assert table.rows[1][-1] == "Too few samples (19 effective)"


def test_the_section_gives_each_headline_and_needs_alternatives(results: xr.Dataset) -> None:
    section = SECTIONS["alternatives"]
    assert section.applies(results)
    assert section.folded
    assert not section.applies(results.drop_vars("alternative_change"))
    listed = next(one for one in section.blocks(results) if isinstance(one, Definitions))
    assert [one.term for one in listed.entries] == [
        "Level", "Dominant source", "Options and level", "Options and vibration",
    ]  # fmt: skip
    assert [one.tag for one in listed.entries] == ["holds", "flips", "flips", "flips"]
    assert listed.entries[1].words == (
        "Without published spectral share: the dominant source is gas forces."
    )


def test_words_of_alternatives(results: xr.Dataset) -> None:
    assert alternative_words(results, "a law of one's own") == "a law of one's own"
    assert alternative_words(results, "other prior").startswith("unmodelled noise ")
    assert alternative_words(results, "no discrepancy") == "model discrepancy of zero"
