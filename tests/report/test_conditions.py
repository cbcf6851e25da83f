"""Each condition of each kind of claim, taken away once: headline, CSV and JSON all show it."""

import json
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from command_lines import write_inputs
from hammer_records import write as write_hammer
from replay_study import replay_study
from support import command_here, made_up_radiation, tiny_run
from test_report_sources import with_sources

import vibroacoustics as va
from vibroacoustics.base.vocabulary import stamp
from vibroacoustics.commands.balancing.page import analysis_of_balancing
from vibroacoustics.commands.balancing.template import TEMPLATE
from vibroacoustics.commands.hammer_tables import analysis_of_hammer
from vibroacoustics.commands.permits.page import analysis_of_permit
from vibroacoustics.commands.permits.template import TEMPLATE as PERMIT
from vibroacoustics.commands.tone_tables import analysis_of_tones
from vibroacoustics.measured import function_check
from vibroacoustics.measured.band import without_bands
from vibroacoustics.measured.function_check import CheckedFunctions
from vibroacoustics.measured.recorded_tones import recorded_tones
from vibroacoustics.measured.tone_claims import ChannelSound, claims_of_channel
from vibroacoustics.permits.file import load_permit
from vibroacoustics.report import (
    analysis_of_blocked_forces,
    analysis_of_campaign,
    analysis_of_data_sheet,
    analysis_of_designs,
    analysis_of_orders,
    analysis_of_prediction,
    analysis_of_replay,
    analysis_of_sound_power,
)
from vibroacoustics.report.analysis import Analysis
from vibroacoustics.report.conditions import study_claims
from vibroacoustics.report.designs.page import analysis_of_no_designs
from vibroacoustics.report.sections.verdict.words import sentences
from vibroacoustics.report.tables import to_ascii, to_csv
from vibroacoustics.results.claim_kinds import FUNCTIONS, KINDS
from vibroacoustics.results.conditional import with_claims
from vibroacoustics.sound.loudness import Loudness
from vibroacoustics.sound.mean_audibility import MeanAudibility

RNG = np.random.default_rng(5)
RATE_HZ = 25600.0
Pair = tuple[Analysis, Analysis]


def power(
    microphones: int = 10,
    background: int | None = 10,
    background_pa: float = 0.01,
    dead: bool = False,
    rate_hz: float = RATE_HZ,
    area_m2: float | None = 1e6,
) -> Analysis:
    """Sound power of white noise of 0.1 Pa on a hemisphere of 1 m."""
    noise = RNG.standard_normal((10, 6400))
    gain = np.where(dead & (np.arange(10) == 3), 1e-3, 0.1)[:, None]
    names, units = [f"m{number}" for number in range(10)], ["Pa"] * 10

    def recording(signal: np.ndarray, count: int) -> xr.Dataset:
        return va.label_recording(signal[:count], rate_hz, names[:count], units[:count])

    still = [] if background is None else [recording(background_pa * noise, background)]
    running = [recording(gain * noise, microphones)]
    surface = va.MeasurementSurface.hemisphere(1.0)
    return analysis_of_sound_power(va.sound_power(running, surface, still, area_m2))


whole_power = cache(power)


def powers(**lacking: Any) -> Pair:
    return whole_power(), power(**lacking)


@pytest.fixture(scope="module")
def inputs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("inputs")
    write_inputs(folder)
    return folder


@pytest.fixture(scope="module")
def heard() -> xr.Dataset:
    noise = 0.1 * RNG.standard_normal(4 * 8000)
    return recorded_tones(va.label_recording([noise], 8000.0, ["front"], ["Pa"]))


def sounds(heard: xr.Dataset, **lacking: Any) -> Pair:
    """Tones with the claims of a sound that meets all conditions, and of one that does not."""
    mean = MeanAudibility(3.0, 1.0, np.zeros(12), (None,) * 12)
    met = ChannelSound("front", Loudness(20.0, 1.5), mean, 1.0, 0.0, 48000.0)
    both = (met, replace(met, **lacking))
    whole, fallen = (with_claims(heard, list(claims_of_channel(each))) for each in both)
    return analysis_of_tones(whole), analysis_of_tones(fallen)


@cache
def whole_study() -> xr.Dataset:
    results = with_sources({"none": 60.0, "good": 40.0}).drop_dims("prior_sample")
    return _with_prior_weight(results, np.full(40, 1.0 / 40.0))


def study(change: Callable[[xr.Dataset], xr.Dataset]) -> Pair:
    """First screen of a study with 40 effective samples, and of one that lacks something."""
    whole = whole_study()
    return tuple(
        Analysis("report", "", "", "", "", (), sentences(each), claims=study_claims(each))
        for each in (whole, change(whole))
    )  # type: ignore[return-value]


def _with_prior_weight(results: xr.Dataset, weight: np.ndarray) -> xr.Dataset:
    coords = {"prior": results["prior"].values, "prior_sample": np.arange(1, weight.size + 1)}
    values = np.tile(weight, (coords["prior"].size, 1))
    return results.assign(prior_sample_weight=stamp("prior_sample_weight", values, coords))


def few_samples(results: xr.Dataset) -> xr.Dataset:
    weight = np.r_[np.full(12, 1.0 / 12.0), np.zeros(28)]
    return _with_prior_weight(results.drop_dims("prior_sample"), weight)


def wide_change(results: xr.Dataset) -> xr.Dataset:
    return results.assign(change_total_90_percent=results["change_total_90_percent"] + 12.0)


def no_change(results: xr.Dataset) -> xr.Dataset:
    return results.assign(decrease_probability=0.0 * results["decrease_probability"])


def sheet(**changes: Any) -> Pair:
    """Data sheet with samples and a published level, and one that lacks something."""
    made = va.data_sheet(tiny_run(), "none")
    whole = {"uncertainty_k_db": 2.5, "level_dba": 60.2}
    pair = [
        made.model_copy(update={"sound_power": made.sound_power.model_copy(update=each)})
        for each in (whole, whole | changes)
    ]
    return analysis_of_data_sheet(pair[0]), analysis_of_data_sheet(pair[1])


def designs(inputs: Path, *, is_allowed: bool = True) -> Pair:
    search = va.optimise(va.load_study(inputs / "designs.toml"), radiation=made_up_radiation)
    whole = analysis_of_designs(search.assign_attrs(is_sampled=1))
    if not is_allowed:
        return whole, analysis_of_no_designs(search)
    return whole, analysis_of_designs(search.assign_attrs(is_sampled=0))


def orders(first: int) -> Pair:
    """Orders at three speeds, of which those from the first on have too few blocks."""
    time_s = np.arange(12 * 2000) / 2000.0
    rpm = np.select([time_s < 4.0, time_s < 8.0], [1500.0, 1800.0], 2100.0)
    sound = np.cos(np.cumsum(rpm) * 2.0 * np.pi / 60.0 / 2000.0)
    recording = va.label_recording([sound, rpm], 2000.0, ["mic", "rpm"], ["Pa", "rpm"])
    settings = va.OrderAnalysis(va.SpeedChannel("rpm"), (1.0,), maximum_order=4.0)
    results = va.analyse_orders(recording, settings)
    coherence = results["channel_order_coherence"]
    has_blocks = xr.DataArray(np.arange(results.sizes["speed"]) < first, dims="speed")
    short = results.assign(channel_order_coherence=coherence.where(has_blocks))
    return analysis_of_orders(results), analysis_of_orders(short)


def runs(folder: Path) -> Pair:
    time_s = np.arange(6400) / 3200.0
    files = [
        va.export_recording(
            va.label_recording([gain * np.cos(96.0 * np.pi * time_s)], 3200.0, ["a"], ["Pa"]),
            folder / f"run{gain}.csv",
        )
        for gain in (1.0, 1.2)
    ]
    campaign = va.Campaign(
        speed={"nominal_rpm": 2880.0},
        analysis={"orders": (1.0,), "maximum_order": 4.0},
        files={"run{run}.csv": {}},
    )
    whole = va.analyse_campaign(files, campaign.run_of)
    width = whole["equivalent_mean_interval"]
    return analysis_of_campaign(whole), analysis_of_campaign(
        whole.assign(equivalent_mean_interval=width * np.nan)
    )


def replayed(lacking: str) -> Pair:
    rate_hz, speed_hz = 4096.0, 2900.0 / 60.0
    time_s = np.arange(int(4.0 * rate_hz)) / rate_hz
    sound = np.cos(2.0 * np.pi * speed_hz * time_s)
    recording = va.label_recording([sound], rate_hz, ["mic"], ["Pa"])
    results = replay_study([2900.0])
    speed = va.NominalSpeed(2900.0)
    summary = va.replay(recording, results, "ring", {"mic": "front"}, speed).summary
    other = summary
    if lacking == "samples":
        ends = [f"replayed_total_level_{end}" for end in ("low", "high")]
        other = summary.assign({end: summary[end] * np.nan for end in ends})
    else:
        lines = map(str, summary["line"].values)
        other = summary.assign(replayed_line_change=summary["replayed_line_change"] * np.nan)
        other = other.assign_attrs(unchanged=json.dumps({"mic": dict.fromkeys(lines, "weak")}))
    return analysis_of_replay(summary, {}), analysis_of_replay(other, {})


def bands(inputs: Path) -> Pair:
    predicted = va.predict(inputs / "bench.toml")
    fallen = without_bands(predicted, ["panel_2: passivity"])
    return analysis_of_prediction(predicted), analysis_of_prediction(fallen)


def truncations(inputs: Path) -> Pair:
    blocked = va.blocked_forces(inputs / "in_situ" / "in_situ.toml")
    few = blocked.assign(left_out_error=blocked["left_out_error"] * np.nan)
    return analysis_of_blocked_forces(blocked), analysis_of_blocked_forces(few)


def balancing(folder: Path, line: str) -> Pair:
    """The template, and the same without lines that begin so."""
    pair = []
    kept = "\n".join(row for row in TEMPLATE.splitlines() if not row.startswith(line))
    for text in (TEMPLATE, kept.replace("[runs.repeat]\n\n", "\n")):
        (folder / "balancing.toml").write_text(text)
        pair.append(analysis_of_balancing(va.balance_runs(folder / "balancing.toml"), []))
    return pair[0], pair[1]


def hammered(folder: Path, single: bool = False, **lacking: Any) -> Pair:
    """A clean hammer test, and one with a single hit of a point, or with faults."""
    write_hammer(folder)
    whole = va.hammer_test(folder / "hammer.toml")
    if single:
        lacking["pairs"] = (replace(whole.pairs[0], hits=1), *whole.pairs[1:])
    return analysis_of_hammer(whole), analysis_of_hammer(replace(whole, **lacking))


def permits(folder: Path, old: str, new: str) -> Pair:
    pair = []
    for text in (PERMIT, PERMIT.replace(old, new)):
        (folder / "permit.toml").write_text(text)
        pair.append(analysis_of_permit(load_permit(folder / "permit.toml")))
    return pair[0], pair[1]


Case = Callable[..., Pair]
QUIET = Loudness(0.05, np.nan)
CASES: dict[tuple[str, str], Case] = {
    ("grade", "background"): lambda **_: powers(background=None),
    ("grade", "room"): lambda **_: powers(area_m2=None),
    ("grade", "microphones"): lambda **_: powers(microphones=6, background=6),
    ("grade", "background positions"): lambda **_: powers(background=4),
    ("grade", "sound"): lambda **_: powers(dead=True),
    ("grade", "bands"): lambda **_: powers(rate_hz=16000.0),
    ("grade", "margin"): lambda **_: powers(background_pa=0.06),
    ("grade", "K2A"): lambda **_: powers(area_m2=10.0),
    ("sound power level", "background"): lambda **_: powers(background=None),
    ("sound power level", "room"): lambda **_: powers(area_m2=None),
    ("sound power level", "margin"): lambda **_: powers(background_pa=0.06),
    ("sound power level", "sound"): lambda **_: powers(dead=True),
    ("sound power level", "bands"): lambda **_: powers(rate_hz=16000.0),
    ("80 % interval", "samples"): lambda **_: study(lambda r: r.drop_vars("sample_weight")),
    ("80 % interval", "effective samples"): lambda **_: study(few_samples),
    ("change of the level", "change"): lambda **_: study(no_change),
    ("change of the level", "interval"): lambda **_: study(wide_change),
    ("radiation", "k-Wave"): lambda **_: study(lambda r: r.drop_vars("green_difference")),
    ("ranking", "samples"): lambda **_: study(lambda r: r.drop_vars("sample_weight")),
    ("K_WA", "samples"): lambda **_: sheet(uncertainty_k_db=None),
    ("L_WA", "published level"): lambda **_: sheet(unmodelled_kind="none"),
    ("promise of a design", "constraints"): lambda inputs, **_: designs(inputs, is_allowed=False),
    ("promise of a design", "samples"): lambda inputs, **_: designs(inputs),
    ("coherence", "any speed"): lambda **_: orders(0),
    ("coherence", "every speed"): lambda **_: orders(1),
    ("95 % interval of the mean", "runs"): lambda folder, **_: runs(folder),
    ("level with the option", "lines"): lambda **_: replayed("lines"),
    ("level with the option", "samples"): lambda **_: replayed("samples"),
    ("90 % band", "faults"): lambda inputs, **_: bands(inputs),
    ("choice of the truncation", "responses"): lambda inputs, **_: truncations(inputs),
    ("frequency responses", "hits"): lambda folder, **_: hammered(folder, single=True),
    ("frequency responses", "records"): lambda folder, **_: hammered(folder, faults=("f is cut",)),
    ("balance quality grade", "mass"): lambda folder, **_: balancing(folder, "mass_kg"),
    ("balance quality grade", "scatter"): lambda folder, **_: balancing(
        folder, 'readings.1480 = { drive_end = "4.66@39"'
    ),
    ("probability", "deviation"): lambda folder, **_: permits(
        folder, "deviation_db = 1.5", "deviation_db = 0.0"
    ),
    ("least distance", "distance"): lambda folder, **_: permits(
        folder, "night_power_dba = 52.0", "night_power_dba = 140.0"
    ),
}
for _kind in ("loudness", "sharpness"):
    for _condition, _lacking in {
        "bands": {"loudness": Loudness(20.0, 1.5, 6300.0)},
        "third octaves below 300 Hz": {"loudness": Loudness(np.nan, np.nan)},
        "steady level": {"variation_db": 6.0},
    }.items():
        CASES[_kind, _condition] = lambda heard, lacking=_lacking, **_: sounds(heard, **lacking)
for _key, _lacking in {
    ("sharpness", "sound below the missing bands"): {"loudness": Loudness(20.0, np.nan, 200.0)},
    ("sharpness", "audible sound"): {"loudness": QUIET},
    ("tonal adjustment", "range"): {"rate_hz": 16000.0},
    ("tonal adjustment", "spectra"): {"mean": MeanAudibility(3.0, 1.0, np.zeros(3), (None,) * 3)},
    ("tonal adjustment", "steady lines"): {"drift_octaves": 1.0},
}.items():
    CASES[_key] = lambda heard, lacking=_lacking, **_: sounds(heard, **lacking)
EVERY = [(kind, each) for kind in KINDS if kind is not FUNCTIONS for each in kind.conditions]


def rows(analysis: Analysis, kind: str, condition: str) -> list[dict[str, Any]]:
    """Rows of a condition in the JSON."""
    table = analysis.json()["tables"][f"{analysis.name}_conditions"]
    listed = [dict(zip(table, row, strict=True)) for row in zip(*table.values(), strict=True)]
    return [row for row in listed if (row["claim"], row["condition"]) == (kind, condition)]


def test_every_condition_has_its_case() -> None:
    assert set(CASES) == {(kind.name, each.name) for kind, each in EVERY}


@pytest.mark.parametrize(("kind", "condition"), EVERY, ids=lambda each: each.name)
def test_a_claim_falls_with_each_condition(
    kind: Any, condition: Any, inputs: Path, heard: xr.Dataset, tmp_path: Path
) -> None:
    case = CASES[kind.name, condition.name]
    whole, fallen = case(inputs=inputs, heard=heard, folder=tmp_path)
    (before, *_), (after, *_) = (rows(each, kind.name, condition.name) for each in (whole, fallen))
    assert (before["met"], after["met"]) == ("yes", "no")
    assert before["effect"] == after["effect"] == condition.effect
    assert before["statement"] != after["statement"]
    claim = next(
        each
        for each in fallen.claims
        if (each.kind, each.subject) == (kind.name, after["subject"] or "")
    )
    csv = to_csv(fallen.every_table()[f"{fallen.name}_conditions.csv"]).decode()
    assert f"{after['statement']}" in csv.replace('""', '"')
    assert all(to_ascii(reason) in fallen.text() for reason in claim.reasons)
    assert bool(claim.reasons) == (condition.effect != "lower value")
    if condition.effect == "no value":
        assert after["statement"].startswith(f"no {kind.name} without ")
    if condition.effect in {"at least", "at most"}:
        assert after["statement"].startswith((condition.effect, "about"))


@pytest.mark.parametrize(
    ("column", "words"),
    [("passivity", "passivity not tested at p1"),
     ("reciprocity_residual", "reciprocity not tested at p1")],
)  # fmt: skip
def test_functions_name_what_was_not_tested(
    column: str, words: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    row = {"point": "p1", "passivity": 0.5, "causality": 0.3, "reciprocity_residual": 0.0}
    checked = CheckedFunctions([row | {column: np.nan}], ())
    monkeypatch.setattr(function_check, "check_functions", lambda _: checked)
    (tmp_path / "bench.toml").touch()
    text = command_here("check-functions", tmp_path / "bench.toml").stdout
    assert f"no fault was found ({words})" in text
    told = command_here("check-functions", tmp_path / "bench.toml", "--json").stdout
    assert words in told
