"""The data sheet: known sound power and vibration, empty bands, K, files, refusals."""

import json
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from data_sheets import BANDS, NAMES, POWER_DB, modelled_power_db, results_of, study_of
from pydantic import ValidationError
from sources_study import sources_run
from support import assert_refused, command_here, tiny_run

import vibroacoustics as va
from vibroacoustics.base.errors import ParameterError, SchemaError
from vibroacoustics.base.vocabulary import stamp
from vibroacoustics.declaration.facts import peak_to_peak, point_velocity
from vibroacoustics.report.data_sheet import analysis_of_data_sheet, headline
from vibroacoustics.report.tables import records
from vibroacoustics.results import storage
from vibroacoustics.results.data_sheet import DataSheet
from vibroacoustics.sound.tone_spectra import tone_variables


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> xr.Dataset:
    """Of a monopole with a baseline of known sound power."""
    return results_of(study_of(tmp_path_factory.mktemp("monopole")))


@pytest.fixture(scope="module")
def tiny() -> xr.Dataset:
    return tiny_run()


@pytest.fixture(scope="module")
def file(tiny: xr.Dataset, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return storage.write_results(tiny, tmp_path_factory.mktemp("tiny") / "results.nc")


def _column(sheet: DataSheet, name: str) -> np.ndarray:
    return np.array([getattr(band, name) for band in sheet.sound_power.bands], dtype=float)


def test_known_sound_power_in_every_band(results: xr.Dataset) -> None:
    sheet = va.data_sheet(results, "none", microphones=NAMES)
    assert _column(sheet, "total_db") == pytest.approx(POWER_DB, abs=1e-9)  # of 0.3 dB
    assert sheet.sound_power.unmodelled_kind == "baseline"
    known = 2.0 * np.pi * 2.0**2
    assert sheet.sound_power.surface_m2 == pytest.approx(known, rel=0.01)


def test_modelled_part_is_the_closed_form_and_empty_outside(results: xr.Dataset) -> None:
    sheet = va.data_sheet(results, "none", microphones=NAMES)
    modelled, expected = _column(sheet, "modelled_db"), modelled_power_db(results, "none")
    np.testing.assert_allclose(modelled, expected, atol=1e-3)
    inside = np.array([band.upper_hz <= 500.0 for band in BANDS])
    assert np.isfinite(modelled[inside]).all()
    assert np.isnan(modelled[~inside]).all()
    rest = 10.0 * np.log10(10.0 ** (POWER_DB / 10.0) - np.nan_to_num(10.0 ** (expected / 10.0)))
    np.testing.assert_allclose(_column(sheet, "unmodelled_db"), rest, atol=1e-3)


def test_option_changes_the_measured_power_by_its_modelled_part(results: xr.Dataset) -> None:
    before, after = (
        np.nan_to_num(10.0 ** (modelled_power_db(results, option) / 10.0))
        for option in ("none", "lanchester")
    )
    expected = 10.0 * np.log10(10.0 ** (POWER_DB / 10.0) - before + after)
    sheet = va.data_sheet(results, "lanchester", microphones=NAMES)
    np.testing.assert_allclose(_column(sheet, "total_db"), expected, atol=1e-3)


def test_nothing_beside_the_model_leaves_bands_empty_never_zero(tiny: xr.Dataset) -> None:
    silent = tiny.assign(
        unmodelled_band_level=tiny["unmodelled_band_level"] * 0.0 - 300.0,
        total_band_level=tiny["sources_band_level"],
    )
    sheet = va.data_sheet(silent, "none")
    total, rest = _column(sheet, "total_db"), _column(sheet, "unmodelled_db")
    beyond = np.array([band.band_hz > 800.0 for band in sheet.sound_power.bands])
    assert np.isnan(total[beyond]).all()
    assert np.isnan(rest).all()
    page = analysis_of_data_sheet(sheet).html().decode()
    below = _column(sheet, "modelled_below_db")
    empty = np.isnan(_column(sheet, "modelled_db"))
    _, highest_hz = sheet.sound_power.model_range_hz
    covered = np.array([band.lower_hz < highest_hz for band in BANDS])
    assert highest_hz == 1000.0
    assert (below[empty & covered] == -40.0).all()
    assert np.isnan(below[~empty | ~covered]).all()
    assert page.count("model: below −40") == np.count_nonzero(empty & covered) > 0
    assert page.count("<td>not modelled") == np.count_nonzero(~covered)
    rows = records(next(iter(analysis_of_data_sheet(sheet).tables.values())))
    of_band = [row for row in rows if row["item"] == "2000 Hz"]
    assert [row["value"] for row in of_band] == [""] * 4
    band = json.loads(sheet.model_dump_json())["sound_power"]["bands"][13]
    names = ("modelled_db", "modelled_below_db", "unmodelled_db", "total_db")
    assert band == {"band_hz": 2000.0, **dict.fromkeys(names)}


def test_unmodelled_noise_is_that_of_the_published_level(tiny: xr.Dataset) -> None:
    sheet = va.data_sheet(tiny, "none")
    power = sheet.sound_power
    level = tiny["level_total"].sel(option="none").item()
    square = 1.0825**2 + 0.24**2
    assert power.level_dba == pytest.approx(level + 10.0 * np.log10(2.0 * np.pi * square))
    assert power.unmodelled_kind == "unmodelled noise"
    assert power.prior == "none: nothing was sampled"
    assert "ISO 3744 asks for ten" in power.determined


def _sampled(tiny: xr.Dataset, spread_db: np.ndarray, weight: np.ndarray) -> xr.Dataset:
    """The results with samples of the level that differ from the nominal one by a spread."""
    coords = {"sample": np.arange(1, spread_db.size + 1)}
    by_receiver = {name: tiny[name].values for name in ("speed", "option", "receiver")}
    modelled = tiny["level_modelled"].sel(weighting="A").transpose("speed", "option", "receiver")
    levels = {
        "level_total_by_sample": tiny["level_total"].values,
        "level_modelled_by_sample": modelled.values,
    }
    by_sample = {
        name: stamp(name, level[None] + spread_db[:, None, None, None], coords | by_receiver)
        for name, level in levels.items()
    }
    priors, both = {"prior": ["flat", "near"]}, np.tile(weight, (2, 1))
    of_samples = {
        "sample_weight": stamp("sample_weight", both, priors | coords),
        "prior_sample_weight": stamp(
            "prior_sample_weight", both, priors | {"prior_sample": coords["sample"]}
        ),
        "sampled_value": stamp(
            "sampled_value", spread_db[:, None], coords | {"uncertain_parameter": ["gas.a"]}
        ),
    }
    return tiny.assign(**by_sample, **of_samples)


def test_level_is_the_median_and_k_what_95_percent_of_the_samples_stay_below(
    tiny: xr.Dataset,
) -> None:
    """Samples weighted to 4 dB below the nominal values, as a published level weights them."""
    given = va.data_sheet(tiny, "none").sound_power
    assert given.uncertainty_k_db is None
    assert given.declared is None
    count, deviation_db, below_db = 8000, 1.2, 4.0
    random = np.random.default_rng(2).standard_normal(count)
    # Half of the samples are at the nominal values and count nothing.
    spread = np.where(np.arange(count) % 2, deviation_db * random - below_db, 0.0)
    weight = np.where(np.arange(count) % 2, 2.0 / count, 0.0)
    sampled = _sampled(tiny, spread, weight)
    power = va.data_sheet(sampled, "none").sound_power
    error_db = 4.0 * 1.2533 * deviation_db / np.sqrt(count / 2)  # of a median, four deviations
    assert power.level_dba == pytest.approx(given.level_dba - below_db, abs=error_db)
    assert power.modelled_dba == pytest.approx(given.modelled_dba - below_db, abs=error_db)
    assert power.nominal_dba == given.nominal_dba == given.level_dba
    assert f"with the nominal values it is {given.nominal_dba:.1f} dB" in power.uncertainty_words
    assert power.model_spread_db == pytest.approx(1.645 * deviation_db, abs=0.1)
    both_db = np.hypot(deviation_db, 1.5)  # of ISO 3744, grade 2
    assert power.uncertainty_k_db == pytest.approx(1.645 * both_db, abs=0.1)
    assert "a deviation of 1.5 dB" in power.uncertainty_words
    assert "assumed" not in power.uncertainty_words
    assert power.prior.startswith("unmodelled noise anywhere from 26 dB below")
    assert power.declared is not None
    level_db, k_db = power.declared
    exact = power.level_dba + power.uncertainty_k_db
    assert exact <= level_db + k_db < exact + 1.0
    said = headline(va.data_sheet(sampled, "none"))
    assert f"L_WA = {level_db} dB, K_WA = {k_db} dB" in said
    assert "single machine" in said
    batch = va.data_sheet(sampled, "none", batch_deviation_db=2.0)
    of_batch_db = np.sqrt(deviation_db**2 + 1.5**2 + 2.0**2)
    assert batch.sound_power.level_dba == power.level_dba
    assert batch.sound_power.uncertainty_k_db == pytest.approx(1.645 * of_batch_db, abs=0.1)
    assert "production, an assumed deviation of 2 dB" in batch.sound_power.uncertainty_words
    assert "batch" in headline(batch)


@pytest.mark.parametrize("deviation_db", [0.0, -1.0, 10.5, np.nan])
def test_deviations_of_a_batch_that_cannot_be_are_refused(
    tiny: xr.Dataset, deviation_db: float
) -> None:
    with pytest.raises(ParameterError, match="must be above 0, to 10 dB"):
        va.data_sheet(tiny, "none", batch_deviation_db=deviation_db)


def test_k_of_samples_that_hardly_differ_is_that_of_measuring(tiny: xr.Dataset) -> None:
    """1.645 · 1.5 dB where samples differ a little; none where they do not."""
    weight = np.full(100, 0.01)
    same = va.data_sheet(_sampled(tiny, np.zeros(100), weight), "none")
    assert same.sound_power.uncertainty_k_db is None
    assert "no K_WA without samples that differ" in headline(same)
    level = va.data_sheet(tiny, "none").sound_power.level_dba
    shift = np.floor(level) + 0.6 - level  # 0.6 dB above a whole decibel rounds up
    little = va.data_sheet(_sampled(tiny, shift + np.linspace(-0.2, 0.2, 100), weight), "none")
    assert little.sound_power.declared == (np.floor(level) + 1, 3)  # 0.6 + 1.645 · 1.5 dB


def test_displacement_of_the_feet_is_the_force_over_the_stiffness(tiny: xr.Dataset) -> None:
    """A second way: what the mounts pass on over what they are."""
    at = tiny.sel(option="none", speed=2900.0)
    force = at["foot_force_order"].sum("source").transpose("foot", "axis", "order").values
    stiffness = np.array([20e3, 20e3, 50e3])[:, None] * (1.0 + 0.1j)
    orders = at["order"].values[1:].astype(float)
    expected = peak_to_peak(force[:, :, 1:] / stiffness, orders)
    sheet = va.data_sheet(tiny, "none")
    motions = [one for one in sheet.vibration if one.point in tiny["foot"].values]
    found = [one.displacement_peak_to_peak_m for one in motions]
    np.testing.assert_allclose(found, expected.ravel(), rtol=1e-3, atol=1e-12)
    assert max(found) > 1e-6


def test_one_order_has_the_ratios_of_a_sine() -> None:
    assert peak_to_peak(np.array([3e-6j]), np.array([1.0])) == pytest.approx(6e-6, rel=1e-3)
    both = peak_to_peak(np.array([1.0, 1.0]), np.array([1.0, 2.0]))
    assert both == pytest.approx(2.0 + 1.125, rel=5e-3)  # cos a + cos 2a: from 2 to -9/8


def test_point_of_a_turning_body_moves_across_its_arm() -> None:
    turning = np.zeros((6, 1), dtype=complex)
    turning[5] = 2.0
    assert point_velocity(turning, np.array([0.3, 0.0, 0.1]))[:, 0] == pytest.approx([0.0, 0.6, 0])


def test_named_point_counts_from_axis_and_floor(tiny: xr.Dataset) -> None:
    sheet = va.data_sheet(tiny, "none", points_m={"at rest": (0.0, 0.0, 0.19 + 0.025)})
    velocity = tiny["velocity_order"].sel(option="none", speed=2900.0).sum("source")
    for one in sheet.vibration[-3:]:
        peaks = velocity.sel(dof=f"t{one.direction}").values[1:]
        rms = np.sqrt(0.5 * np.sum(np.abs(peaks) ** 2))
        assert one.point == "at rest"
        assert one.velocity_rms_m_per_s == pytest.approx(rms, rel=1e-9)


def test_operating_point_and_mounting(tiny: xr.Dataset) -> None:
    sheet = va.data_sheet(tiny, "counterweight-half")
    facts = {one.name: (one.value, one.unit) for one in (*sheet.operating, *sheet.mounting)}
    assert facts["shaft speed"] == (2900.0, "rpm")
    assert facts["suction pressure"] == (15.0, "bar")
    assert facts["operating point"] == ("values of the machine's file", "")
    assert facts["refrigerant"] == ("R410A", "")
    assert "the 10 microphones of ISO 3744: the study has 1" in sheet.not_available
    assert facts["vertical stiffness of a mount"] == (50.0, "N/mm")
    assert facts["mass on the mounts"] == (35.0, "kg")
    assert facts["feet"] == (4.0, "")
    assert facts["floor"] == ("hard to sound, rigid under the feet", "")


def test_source_of_the_pressures_and_point_of_operation(tiny: xr.Dataset) -> None:
    study = json.loads(tiny.attrs["parameters"])
    source = "derived: evaporating at 7.2 °C, condensing at 54.4 °C"
    record = {**study["records"][0], "field": "gas.suction_pressure_bar", "source": source}
    study["records"].append(record)
    study["operation"]["point"] = "ari"
    sheet = va.data_sheet(tiny.assign_attrs(parameters=json.dumps(study)), "none")
    facts = {one.name: one.value for one in sheet.operating}
    assert facts["source of the suction pressure"] == source
    assert facts["operating point"] == "ari"


def test_files_of_a_sheet(tiny: xr.Dataset, file: Path, tmp_path: Path) -> None:
    done = command_here(
        "datasheet", file, "--option", "counterweight-half",
        "--point", "discharge=0,80,350", "--out", tmp_path / "sheets",
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    stem = tmp_path / "sheets" / "data_sheet_counterweight-half_2900_rpm"
    again = DataSheet.model_validate_json(stem.with_suffix(".json").read_bytes())
    points = {"discharge": (0.0, 1e-3 * 80.0, 1e-3 * 350.0)}
    assert again == va.data_sheet(tiny, "counterweight-half", points_m=points)
    page = stem.with_suffix(".html").read_text(encoding="utf-8")
    assert "predicted, not measured" in page
    assert "discharge" in page
    assert "nan" not in stem.with_suffix(".csv").read_text(encoding="utf-8")
    with pytest.raises(ValidationError):
        DataSheet.model_validate_json(stem.with_suffix(".json").read_bytes()[:-3])


def test_page_shows_every_band_and_point(tiny: xr.Dataset) -> None:
    page = analysis_of_data_sheet(va.data_sheet(tiny, "none")).html().decode()
    for band in BANDS:
        assert f'<th scope="row" class="words">{band.nominal_hz:g}</th>' in page
    for point in ("front_<wbr>left", "top of the shell"):
        assert point in page
    assert page.count("predicted, not measured") >= 2


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--option", "hood"], "option = hood: must be one of none, counterweight-half"),
        (["--speed", "3000"], "speed_rpm = 3000 rpm: must be one of 2900 rpm"),
        (
            ["--microphone", "front_1m", "--microphone", "back"],
            "microphones = back: must be one of front_1m",
        ),
        (
            ["--microphone", "front_1m", "--microphone", "front_1m"],
            "microphones: must be given, each once",
        ),
        (["--point", "top=1,2"], "--point top=1,2: must be three numbers up to 20000 mm"),
        (["--point", "top=1,2,x"], "--point: 'x' is no number"),
    ],
)
def test_bad_words_are_one_line(file: Path, tmp_path: Path, words: list[str], message: str) -> None:
    done = command_here("datasheet", file, *words, "--out", tmp_path / "out")
    assert_refused(done, message)
    assert not (tmp_path / "out").exists()


def test_walls_and_older_results_are_refused(tiny: xr.Dataset) -> None:
    study = json.loads(tiny.attrs["parameters"])
    study["radiation"]["surroundings"]["walls"] = {"-x": {"distance_m": 0.5}}
    with pytest.raises(ParameterError, match="has walls or a cabinet"):
        va.data_sheet(tiny.assign_attrs(parameters=json.dumps(study)), "none")
    with pytest.raises(SchemaError, match="run the study again"):
        va.data_sheet(tiny.drop_vars("noise_band_level"), "none")


def test_without_a_floor_the_sphere_about_the_centre_of_mass(tiny: xr.Dataset) -> None:
    study = json.loads(tiny.attrs["parameters"])
    study["radiation"]["surroundings"]["floor"] = False
    free = va.data_sheet(tiny.assign_attrs(parameters=json.dumps(study)), "none")
    square = 1.0825**2 + (0.24 - 0.215) ** 2
    assert free.sound_power.surface_m2 == pytest.approx(4.0 * np.pi * square)


def _judged_again(results: xr.Dataset) -> xr.Dataset:
    """The results with the tones of their present lines and noise."""
    tones = tone_variables(results)
    others = results.drop_vars([*tones.data_vars, "judged_tone", "judged_tone_frequency"])
    return others.merge(tones)


def test_tones_that_stand_out_are_stated_at_their_microphone(results: xr.Dataset) -> None:
    """An order far above the noise; with the measured bands above it there is none."""
    sheet = va.data_sheet(results, "none", microphones=["p1", "p2"])
    assert sheet.tones == ()
    quiet = results.drop_vars("baseline_band_level")
    quiet["unmodelled_band_level"] = quiet["unmodelled_band_level"] * 0.0 + 20.0
    quiet = _judged_again(quiet)
    stated = va.data_sheet(quiet, "none", microphones=["p1", "p2"]).tones
    assert stated
    (tone,) = [one for one in stated if one.name == "order 5"]
    assert tone.frequency_hz == pytest.approx(100.0)
    assert tone.microphone in ("p1", "p2")
    level = results["order_level"].sel(option="none", receiver=tone.microphone, order=5)
    assert tone.level_db >= level.sel(weighting="Z").item() - 1e-6
    assert 0.0 <= tone.excess_db <= 60.0
    assert tone.probability == 1.0
    page = (
        analysis_of_data_sheet(va.data_sheet(quiet, "none", microphones=["p1", "p2"]))
        .html()
        .decode()
    )
    assert "Prominent tones (ECMA-418-1" in page


def test_tones_without_noise_are_not_judged(results: xr.Dataset) -> None:
    """Without noise every tone would stand out infinitely far."""
    bare = results.drop_vars("baseline_band_level")
    for name in ("unmodelled_band_level", "noise_band_level"):
        bare[name] = bare[name] * 0.0 - 300.0
    bare = _judged_again(bare)
    sheet = va.data_sheet(bare, "none", microphones=["p1", "p2"])
    assert sheet.tones == ()
    assert sheet.tones_not_judged > 1
    page = analysis_of_data_sheet(sheet).html().decode()
    assert f"{sheet.tones_not_judged} audible tones without noise in the critical band" in page


def test_a_sampled_machine_has_the_medians_of_its_samples() -> None:
    """L_WA of the power in every sample, bands of the medians, tones by their probability."""
    run = sources_run()
    (speed,) = run["speed"].values
    sheet = va.data_sheet(run, "none")
    power = sheet.sound_power
    at = run.sel(option="none", speed=speed)
    levels, weight = at["level_total_by_sample"].values, run["sample_weight"].values[0]
    area = 2.0 * np.pi * np.array([_distance_squared(run, name) for name in power.microphones])
    by_sample = 10.0 * np.log10((10.0 ** (levels / 10.0) * area).mean(axis=1))
    order = np.argsort(by_sample)
    middle = np.searchsorted(np.cumsum(weight[order]), 0.5)
    near = by_sample[order][middle - 2 : middle + 3]
    assert near[0] <= power.level_dba <= near[-1]
    assert power.uncertainty_k_db > power.model_spread_db > 0.0
    total = 10.0 ** (at["total_band_level"].sel(noise_band=1000.0).values / 10.0)
    (band,) = [band for band in power.bands if band.band_hz == 1000.0]
    assert band.total_db == pytest.approx(10.0 * np.log10(np.mean(total * area)))
    chance = at["tone_probability"].max("receiver")
    listed = {str(name) for name in run["judged_tone"].values[chance.values > 0.5]}
    assert {tone.name for tone in sheet.tones} == listed
    assert sheet.any_tone_probability == at["any_tone_probability"].max().item()
    for tone in sheet.tones:
        assert tone.probability > 0.5
        assert tone.excess_low_db is None or tone.excess_low_db <= tone.excess_db
        assert tone.excess_db <= tone.excess_high_db <= 60.0


def _distance_squared(results: xr.Dataset, name: str) -> float:
    """From the axis on the floor to a microphone, m²."""
    at = json.loads(results.attrs["parameters"])["receivers"][name]
    return float(at["x_m"] ** 2 + at["y_m"] ** 2 + at["height_m"] ** 2)


def test_a_sheet_of_example_values_says_so_first(results: xr.Dataset) -> None:
    study = json.loads(results.attrs["parameters"])
    for record in study["records"][:2]:
        record["example"] = "2900"
    own = results.assign_attrs(parameters=json.dumps(study))
    sheet = va.data_sheet(own, "none")
    first = f"2 of {len(study['records'])} values that this study reads are the example's."
    assert sheet.example == first
    assert analysis_of_data_sheet(sheet).summary[0] == first
    assert not va.data_sheet(results, "none").example
