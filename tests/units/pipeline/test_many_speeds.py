"""Lists of speeds: ranges, orders left out, the catalogue's speed apart, size of the result."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from sources_study import SOURCES_STUDY, run_made_up
from support import PIPELINES, ROOT, made_up_radiation, made_up_transfer_vectors

from vibroacoustics import pipeline
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.base.vocabulary import REPRESENTATIVE, VARIABLES
from vibroacoustics.commands import outputs
from vibroacoustics.levels import SILENCE_DB
from vibroacoustics.results import size, speed_blocks
from vibroacoustics.stages import forces as forces_stage
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.operation import speed_range
from vibroacoustics.study.study import Study

THESIS = (PIPELINES / "copeland_thesis.toml").read_text().replace("../data", str(ROOT / "data"))
OPERATION = """speed_rpm = [2900.0, 3500.0]
crank_angle_samples = 256"""
AGREE = 1e-9
"""Of the largest magnitude of a variable."""


def study_at(folder: Path, operation: str) -> Study:
    """The thesis study with another operation."""
    assert OPERATION in THESIS
    file = folder / "study.toml"
    file.write_text(THESIS.replace(OPERATION, operation))
    return load_study(file)


def run_at(folder: Path, operation: str) -> xr.Dataset:
    """Its results, radiation made up."""
    return pipeline.run(study_at(folder, operation), radiation=made_up_radiation)


def of_one_sample(name: str) -> bool:
    """Whether it is of the representative sample, whose choice depends on all speeds."""
    return VARIABLES[name].statistic == REPRESENTATIVE or name.startswith("representative_")


def assert_same_at_speed(one: xr.Dataset, many: xr.Dataset, speed: float) -> None:
    """Every variable over the speed; orders that only one of them has are silent."""
    for name, alone in one.data_vars.items():
        if "speed" not in alone.dims or of_one_sample(str(name)):
            continue
        at = {"speed": speed}
        here, there = alone.sel(at), many[name].sel(at)
        for axis in {"order", "line", "judged_tone"} & set(alone.dims):
            there = there.sel({axis: alone[axis]})
        here, there = np.asarray(here), np.asarray(there)
        np.testing.assert_array_equal(np.isnan(here), np.isnan(there))
        largest = np.nanmax(np.abs(here), initial=0.0)
        np.testing.assert_allclose(there, here, rtol=0, atol=AGREE * largest, err_msg=str(name))


# --- ranges --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("start", "stop", "step", "speeds"),
    [
        (2000.0, 2100.0, 50.0, (2000.0, 2050.0, 2100.0)),
        (2000.0, 2099.0, 50.0, (2000.0, 2050.0)),
        (2000, 2000, 1, (2000.0,)),
        (1000.0, 1000.3, 0.1, (1000.0, 1000.1, 1000.2, 1000.3)),  # 0.3 / 0.1 is below 3
    ],
)
def test_range_includes_its_stop_where_a_step_meets_it(start, stop, step, speeds):
    assert speed_range({"start": start, "stop": stop, "step": step}) == speeds


def test_range_of_a_thousand_speeds():
    assert len(speed_range({"start": 2000.0, "stop": 2999.0, "step": 1.0})) == 1000


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ("start = 2000, stop = 3000, step = 0", ["step = 0 rpm", "above 0"]),
        ("start = 2000, stop = 3000, step = -1", ["step = -1 rpm", "above 0"]),
        ("start = 3000, stop = 2000, step = 1", ["stop = 2000 rpm", "start = 3000 rpm"]),
        ("start = 2000, stop = 3000, step = 1", ["step = 1 rpm", "more than 1000"]),
        ("start = 2000, stop = 3000, step = 1e-300", ["more than 1000"]),
        ("start = 2000, stop = 3000", ["step: is missing"]),
        ("start = 2000, stop = inf, step = 1", ["stop = inf", "number"]),
        ('start = "a", stop = 3000, step = 1', ["start = a", "number"]),
        ("start = 2000, stop = 3000, step = 100, count = 3", ["count", "unknown key"]),
        ("start = 10, stop = 30, step = 10", ["speed_rpm = 10 rpm", "60 to 60000"]),
    ],
)
def test_ranges_that_are_refused(tmp_path, given, words):
    with pytest.raises(ParameterError) as refusal:
        study_at(tmp_path, f"speed_rpm = {{ {given} }}")
    for word in ("study.toml: operation", *words):
        assert word in str(refusal.value)
    assert "\n" not in str(refusal.value)


def test_a_list_of_a_thousand_and_one_speeds_is_refused(tmp_path):
    speeds = [2000.0 + number for number in range(1001)]
    with pytest.raises(ParameterError, match="speed_rpm"):
        study_at(tmp_path, f"speed_rpm = {speeds}")


def test_range_over_the_list_of_a_study_that_is_extended(tmp_path):
    (tmp_path / "base.toml").write_text(THESIS)
    file = tmp_path / "over.toml"
    table = "{ start = 2900.0, stop = 3000.0, step = 50.0 }"
    file.write_text(f'extends = "base.toml"\n[operation]\nspeed_rpm = {table}\n')
    assert load_study(file).operation.speed_rpm == (2900.0, 2950.0, 3000.0)


# --- a speed alone and in a list -----------------------------------------------------------------


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    return tmp_path_factory.mktemp("speeds")


@pytest.fixture(scope="module")
def many(folder) -> xr.Dataset:
    """In two blocks and a first speed alone; neither the catalogue's speed nor an order given."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(speed_blocks, "SPEEDS_IN_BLOCK", 2)
        return run_at(folder, "speed_rpm = { start = 2600.0, stop = 3500.0, step = 300.0 }")


@pytest.mark.parametrize("speed", [2600.0, 2900.0, 3200.0, 3500.0])
def test_a_speed_alone_agrees_with_the_same_in_a_list(folder, many, speed):
    assert_same_at_speed(run_at(folder, f"speed_rpm = [{speed}]"), many, speed)


def test_remainder_does_not_depend_on_the_speeds(folder, many):
    """The catalogue's speed of 2900 rpm is among the many, and not here."""
    apart = run_at(folder, "speed_rpm = [3500.0]")["level_unmodelled"].item()
    assert apart == pytest.approx(many["level_unmodelled"].item(), rel=1e-12)


def test_louder_model_is_refused_at_a_catalogue_speed_apart(tmp_path):
    study = study_at(tmp_path, "speed_rpm = [3500.0]")
    loud = (made_up_transfer_vectors(study, gain=1e6), False)
    with pytest.raises(ParameterError, match=r"overall_noise\.level_dba = 56 dB\(A\)"):
        pipeline.run(study, radiation=lambda *_: loud)


# --- orders --------------------------------------------------------------------------------------


def test_as_many_orders_as_the_highest_frequency_holds(many):
    """2500 Hz: 57 at 2600 rpm, 42 at 3500 rpm; beyond them there is silence."""
    assert many["order"].values.tolist() == list(range(58))
    fast = many.sel(speed=3500.0)
    for name in ("force_order", "velocity_order", "foot_force_order"):
        assert not fast[name].sel(order=slice(43, None)).values.any(), name
        assert many[name].sel(speed=2600.0, order=57).values.any(), name
    silent = fast["pressure_line"].sel(line=fast["line_order"] > 42.5)
    assert silent.sizes["line"] == 15
    assert not silent.values.any()
    assert many["pressure_line"].sel(speed=2600.0, line="order 57").values.any()
    silent = fast["order_level"].sel(order=slice(43, None), weighting="Z")
    assert np.all(silent == SILENCE_DB)
    assert np.all(np.isfinite(many["level_modelled"]))
    assert many["order_frequency"].sel(speed=3500.0, order=57) == pytest.approx(57 * 3500 / 60)


@pytest.mark.filterwarnings("ignore:.*usual is")
def test_orders_need_crank_angles(tmp_path):
    operation = "speed_rpm = [1000.0, 2900.0]\ncrank_angle_samples = 300"
    with pytest.raises(ParameterError, match=r"crank_angle_samples = 300: .*300.*1000 rpm"):
        study_at(tmp_path, operation)
    study_at(tmp_path, operation.replace("300", "302"))


def test_catalogue_speed_counts_among_the_speeds_for_the_orders(tmp_path):
    """60 orders reach 2000 Hz at 2000 rpm, but 2900 Hz where the remainder is computed."""
    with pytest.raises(ParameterError, match=r"maximum_frequency_hz = 2500 Hz: .* 2900 Hz"):
        study_at(tmp_path, "speed_rpm = [2000.0]\nmaximum_order = 60")


def sources_at(folder: Path, *replaced: tuple[str, str]) -> Study:
    """The study of several sources with another operation."""
    text = SOURCES_STUDY.read_text().replace("../../data", str(ROOT / "data"))
    for old, new in (("stopping = true\n", ""), ("maximum_order = 16\n", ""), *replaced):
        assert old in text
        text = text.replace(old, new)
    file = folder / "sources.toml"
    file.write_text(text)
    return load_study(file)


@pytest.fixture(scope="module")
def driven(folder) -> xr.Dataset:
    """Several sources at three speeds, as many orders as the highest frequency holds."""
    return run_made_up(
        sources_at(
            folder,
            ("speed_rpm = [2900.0]", "speed_rpm = [2600.0, 2900.0, 3500.0]"),
            ("= [50.0]", "= [45.0, 50.0, 60.0]"),
        )
    )


@pytest.mark.parametrize(
    ("speed", "supply"), [pytest.param(2600.0, 45.0, marks=pytest.mark.long), (3500.0, 60.0)]
)
@pytest.mark.long
def test_sources_at_few_speeds_agree_with_the_same_in_a_list(folder, driven, speed, supply):
    study = sources_at(
        folder,
        ("speed_rpm = [2900.0]", f"speed_rpm = [{speed}, 2900.0]"),
        ("= [50.0]", f"= [{supply}, 50.0]"),
    )
    few = run_made_up(study)
    for own in (speed, 2900.0):
        assert_same_at_speed(few, driven, own)
    assert few["level_unmodelled"].item() == pytest.approx(driven["level_unmodelled"].item())


@pytest.mark.long
def test_supply_is_unknown_at_a_catalogue_speed_apart(folder):
    """One line; without supply frequencies other sources run at any speed."""
    apart = ("speed_rpm = [2900.0]", "speed_rpm = [2800.0]")
    with pytest.raises(ParameterError, match="2900 rpm"):
        run_made_up(sources_at(folder, apart))
    unmoved = '[sources.torque_ripple]\nkind = "torque-ripple"\n\n'
    unmoved += '[sources.motor]\nkind = "motor-pulsation"\n'
    supply = "supply_frequency_hz = [50.0]\n"
    more = ("random_samples = 4", "random_samples = 12")  # three must be below the catalogue
    results = run_made_up(sources_at(folder, apart, (unmoved, ""), (supply, ""), more))
    assert results["sound_source"].values.tolist() == ["moving_parts", "gas", "keys"]


# --- size ----------------------------------------------------------------------------------------


@pytest.mark.long
def test_time_series_of_many_speeds_only_on_request(folder, tmp_path, many):
    series = {"force", "moment", "shaft_speed", "shaft_acceleration"}
    assert series <= set(many)
    range_of_101 = "speed_rpm = { start = 2800.0, stop = 3000.0, step = 2.0 }\nmaximum_order = 4"
    without = run_at(folder, range_of_101)
    assert not series & set(without)
    assert "crank_angle" not in without.coords
    kept = run_at(folder, range_of_101 + "\nkeep_time_series = true")
    assert series <= set(kept)
    dropped = run_at(folder, "speed_rpm = [2900.0]\nkeep_time_series = false")
    page = outputs.write_report(dropped, tmp_path).read_text()
    assert "operation.keep_time_series" in page
    assert not (tmp_path / "figures" / "force_over_revolution.svg").exists()
    _, again = outputs.write_report_again(tmp_path / "results.nc", tmp_path / "again")
    assert again["report"].read_text() == page


@pytest.mark.filterwarnings("ignore:.*usual is")
def test_result_above_2_gib_is_refused_before_the_second_speed(tmp_path, monkeypatch):
    told, motions = [], []
    study = study_at(
        tmp_path,
        "speed_rpm = { start = 1000.0, stop = 1999.0, step = 1.0 }\ncrank_angle_samples = 512",
    )
    forces = forces_stage.force_variables

    def counted(part, *others):
        motions.append(part.operation.speed_rpm)
        return forces(part, *others)

    monkeypatch.setattr(forces_stage, "force_variables", counted)
    with pytest.raises(ParameterError, match=r"1000 speeds takes .* GiB; allowed 2 GiB"):
        pipeline.run(study, lambda task, *_: told.append(task))
    assert motions == [(1000.0,)]
    assert any(task.startswith("result of ") for task in told)


def test_size_told_is_that_of_the_result(tmp_path, many):
    study = study_at(tmp_path, "speed_rpm = { start = 2600.0, stop = 3500.0, step = 300.0 }")
    by_speed = sum(array.nbytes for array in many.data_vars.values() if "speed" in array.dims)
    first = many.drop_vars(["pressure_line", "order_level", "level_modelled", "level_total"])
    # The changes and the coordinates are left out of the estimate, a part in a thousand.
    assert size.result_bytes(study, first) == pytest.approx(by_speed, rel=2e-3)
