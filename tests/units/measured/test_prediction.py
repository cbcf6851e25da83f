"""Changes predicted from the files of a made-up bench against the bench with these changes."""

from dataclasses import replace

import numpy as np
import pytest
from measured_bench import (
    AS_MEASURED,
    FREQUENCY,
    STIFFNESS,
    State,
    between,
    mounts,
    noisy,
    responses,
    spectra,
    state,
    write,
)
from typer.testing import CliRunner

import vibroacoustics as va
from vibroacoustics.commands import cli
from vibroacoustics.measured.change import absorber_stiffness, mass_stiffness

ALL = ("one", "two", "three", "four")
ONE_POINT = np.eye(8)


def mounts_text(names, stiffness, loss):
    return "".join(
        f"[changes.NAME.mounts.{name}]\nstiffness_n_per_mm = {stiffness}\n"
        f"loss_factor_percent = {loss}\n"
        for name in names
    )


MASS = '[changes.NAME.masses.plate]\npoints = ["machine_1"]\nmass_kg = 3.0\n'
ABSORBER = """[changes.NAME.absorbers.tuned]
points = ["panel_1"]
mass_kg = 0.5
stiffness_n_per_mm = 284.245
loss_factor_percent = 5.0
"""
B = mounts()
CASES = {
    "halved": (mounts_text(ALL, 100.0, 10.0), between(B, [0.5 * STIFFNESS] * 4, FREQUENCY)),
    "doubled": (mounts_text(ALL, 400.0, 10.0), between(B, [2.0 * STIFFNESS] * 4, FREQUENCY)),
    "lossy": (mounts_text(ALL, 200.0, 40.0), between(B, [2e5 * (1 + 0.4j)] * 4, FREQUENCY)),
    "removed": (mounts_text(ALL[:1], 0.0, 0.0), between(B[1:], [STIFFNESS] * 3, FREQUENCY)),
    "all removed": (mounts_text(ALL, 0.0, 0.0), between(B, [0.0] * 4, FREQUENCY)),
    "one changed": (
        mounts_text(ALL[:1], 100.0, 10.0),
        between(B, [0.5 * STIFFNESS] + [STIFFNESS] * 3, FREQUENCY),
    ),
    "mass": (
        MASS,
        AS_MEASURED + between(ONE_POINT[:1], mass_stiffness(FREQUENCY, 3.0)[:, None], FREQUENCY),
    ),
    "absorber": (
        ABSORBER,
        AS_MEASURED
        + between(
            ONE_POINT[4:5], absorber_stiffness(FREQUENCY, 0.5, 284245.0, 0.05)[:, None], FREQUENCY
        ),
    ),
}
CHANGES = "".join(text.replace("NAME", f'"{name}"') for name, (text, _) in CASES.items())
HALVED = CASES["halved"][0].replace("NAME", "halved")
BEFORE = state(FREQUENCY, AS_MEASURED)


def level(pressure):
    return 20.0 * np.log10(abs(pressure) / np.sqrt(2.0) / 20e-6)


TRUTH = {
    name: level(state(FREQUENCY, after).running[:, 8:].T) for name, (_, after) in CASES.items()
}


def measured_again(share, number):
    rng = np.random.default_rng(number)
    return State(noisy(BEFORE.frf, share, rng), noisy(BEFORE.running, share, rng))


@pytest.fixture(scope="module")
def exact(tmp_path_factory):
    return va.predict(write(tmp_path_factory.mktemp("bench"), CHANGES, BEFORE))


@pytest.mark.parametrize("name", CASES)
def test_without_noise_the_truth_comes_out(exact, name):
    predicted = exact["predicted_level"].sel(option=name).values
    assert np.abs(predicted - TRUTH[name]).max() < 1e-9
    before = exact["predicted_level"].sel(option="none").values
    assert np.abs(predicted - before).max() > 1.0  # the change is one


def held_and_errors(folder, share, count):
    """Whether the band holds each line, and the error of each, by change."""
    held = {name: [] for name in CASES}
    errors = {name: [] for name in CASES}
    for number in range(count):
        quality = f"relative_error_percent = {100.0 * share}"
        predicted = va.predict(write(folder, CHANGES, measured_again(share, number), quality))
        for name, truth in TRUTH.items():
            at = predicted.sel(option=name)
            held[name].append(
                (at["predicted_level_low"] <= truth) & (truth <= at["predicted_level_high"])
            )
            errors[name].append(abs(at["predicted_level"] - truth))
    return held, errors


def check_bands(held):
    for name, lines in held.items():
        assert np.size(lines) >= 400
        assert 0.86 < np.mean(lines) < 0.94, name


def check_errors(errors):
    """Of all mounts removed nothing but noise is left: 22 dB below what was measured."""
    for name, of_lines in errors.items():
        if name != "all removed":
            assert np.mean(np.array(of_lines) < 1.5) > 0.9, name


@pytest.mark.long
def test_with_three_percent_noise_nine_of_ten_lines_are_right_and_told(tmp_path):
    held, errors = held_and_errors(tmp_path, 0.03, 2)
    check_bands(held)
    check_errors(errors)


@pytest.mark.long
@pytest.mark.parametrize("share", [0.01, 0.03, 0.1])
def test_bands_hold_at_any_noise(tmp_path, share):
    held, errors = held_and_errors(tmp_path, share, 20)
    check_bands(held)
    if share < 0.05:
        check_errors(errors)


def test_directions_reciprocity_units_and_formats_make_no_difference(tmp_path, exact):
    """Mobilities with turned directions, half of them missing, frequencies from 0 Hz on."""
    turned = [
        replace(one, values=-one.values, response=one.response.opposite)
        if one.response.number == 11 else one
        for one in responses(BEFORE, "m/s")
        if not one.response.direction or one.response.number >= one.reference.number
    ]  # fmt: skip
    turned = [
        replace(one, frequency_hz=np.r_[0.0, one.frequency_hz], values=np.r_[0.0, one.values])
        for one in turned
    ]
    file = write(tmp_path, HALVED, BEFORE)
    va.export_functions(turned, tmp_path / "hammer.uff", text=True)
    va.export_functions(spectra(BEFORE, "m"), tmp_path / "running.csv")
    text = file.read_text()
    for node in ("node = 2", "node = 12"):
        text = text.replace(f'{node}, direction = "+z"', f'{node}, direction = "-z"')
    file.write_text(text)
    predicted = va.predict(file)["predicted_level"].sel(option="halved").values
    np.testing.assert_allclose(predicted, exact["predicted_level"].sel(option="halved"), atol=1e-9)


def test_cross_and_auto_spectra_stand_for_spectra(tmp_path, exact):
    """Referred to a microphone: mean squares of a phase that only the reference knows."""
    file = write(tmp_path, HALVED, BEFORE)
    reference = BEFORE.running[:, 8]
    node = va.Node(101)
    made = [va.MeasuredFunction("auto spectrum", FREQUENCY, abs(reference) ** 2 / 2 + 0j, node,
                                node, "Pa", "Pa")]  # fmt: skip
    made += [
        va.MeasuredFunction("cross spectrum", FREQUENCY, one.values * reference.conj() / 2,
                            one.response, node, one.response_unit, "Pa")
        for one in spectra(BEFORE)
    ]  # fmt: skip
    va.export_functions(made, tmp_path / "running.uff")
    file.write_text(file.read_text().replace("running.csv", "running.uff"))
    predicted = va.predict(file)["predicted_level"].sel(option="halved").values
    np.testing.assert_allclose(predicted, exact["predicted_level"].sel(option="halved"), atol=1e-9)


def in_file(folder, values):
    rows = "".join(f"{f:g},1,{k / 1e3:.17g},{eta:.17g}\n" for f, k, eta in values)
    folder.joinpath("mount.csv").write_text(
        f"frequency_hz,lateral_n_per_mm,vertical_n_per_mm,loss_factor\n{rows}"
    )
    return "".join(f'[changes.new.mounts.{n}.stiffness]\nfile = "mount.csv"\n' for n in ALL)


def test_a_constant_stiffness_from_a_file_is_a_constant_one(tmp_path, exact):
    new = in_file(tmp_path, [(0.0, 1e5, 0.1), (1000.0, 1e5, 0.1)])
    predicted = va.predict(write(tmp_path, new, BEFORE))["predicted_level"].sel(option="new")
    constant = exact["predicted_level"].sel(option="halved")
    np.testing.assert_allclose(predicted, constant, atol=1e-9)


def test_a_stiffness_over_frequency_is_that_of_the_bench(tmp_path):
    """The truth is the bench with mounts that are linear in frequency between the rows."""
    at = np.array([0.0, 400.0, 900.0])
    k, eta = np.array([0.5e5, 2.0e5, 3.0e5]), np.array([0.05, 0.3, 0.4])
    new = in_file(tmp_path, zip(at, k, eta, strict=True))
    predicted = va.predict(write(tmp_path, new, BEFORE))["predicted_level"].sel(option="new")
    stiffness = np.interp(FREQUENCY, at, k * (1.0 + 1j * eta))
    after = between(B, np.repeat(stiffness[:, None], 4, axis=1), FREQUENCY)
    np.testing.assert_allclose(
        predicted, level(state(FREQUENCY, after).running[:, 8:].T), atol=1e-9
    )


def test_without_an_error_there_is_no_band(tmp_path):
    quality = "relative_error_percent = 0.0\ndraws = 50"
    predicted = va.predict(write(tmp_path, HALVED, BEFORE, quality))
    np.testing.assert_allclose(predicted["predicted_level_high"], predicted["predicted_level_low"])


def test_repeats_and_coherence_give_the_error(tmp_path):
    """Five repeats of 3 % make a mean of 1.3 %; a coherence of 0.99 over 40 averages 1.6 %."""
    file = write(tmp_path, HALVED, BEFORE, "operating_averages = 40\ndraws = 50")
    for number in range(5):
        va.export_functions(responses(measured_again(0.03, number)), tmp_path / f"h{number}.uff")
    running = spectra(BEFORE)
    coherent = [
        va.MeasuredFunction("coherence", FREQUENCY, np.full(FREQUENCY.size, 0.99 + 0j),
                            one.response, va.Node(1, "+z"), "1")
        for one in running
    ]  # fmt: skip
    va.export_functions([*running, *coherent], tmp_path / "running.csv")
    names = ", ".join(f'"h{number}.uff"' for number in range(5))
    file.write_text(file.read_text().replace('"hammer.uff"', names))
    with pytest.raises(va.ParameterError, match="has no repeats and no coherence"):
        va.predict(file)  # a spectrum has no reference that a coherence could be of
    va.export_functions(by_force(running, coherent), tmp_path / "running.csv")
    predicted = va.predict(file).sel(option="halved")
    width = predicted["predicted_level_high"] - predicted["predicted_level_low"]
    assert 0.2 < float(width.median()) / 2.0 < 0.6


def by_force(running, coherent):
    """Cross spectra with the first point, its auto spectrum and the coherences."""
    node, force = va.Node(1, "+z"), running[0].values
    made = [va.MeasuredFunction("auto spectrum", FREQUENCY, abs(force) ** 2 / 2 + 0j, node, node,
                                "m/s²", "m/s²")]  # fmt: skip
    made += [
        replace(one, kind="cross spectrum", values=one.values * force.conj() / 2, reference=node,
                reference_unit="m/s²")
        for one in running
    ]  # fmt: skip
    return [*made, *coherent]


WRONG = [
    ("node = 13", "node = 99", "frequency response 1+z/99+z is in none of the files hammer.uff"),
    ("node = 101", "node = 105", "frequency response 105/1+z is in none of the files"),
    ('direction = "+z"', 'direction = "+w"', "measured.points.machine_1.direction = '+w'"),
    ('"panel_2"]', '"panel_9"]', "mounts.two.ends = panel_9: no such point"),
    ("changes.halved.mounts.one", "changes.halved.mounts.six", "mounts.six: no such mount"),
    ("= 200.0", "= -200.0", "mounts.one.stiffness_n_per_mm = -200.0 N/mm: out of range"),
    ("relative_error_percent = 3.0", "", "has no repeats and no coherence"),
    ("relative_error_percent = 3.0", "relative_error_percent = 3.0\nwindow = 1", "unknown key"),
    ('"hammer.uff"', '"hammers.uff"', "hammers.uff: no such file"),
    ('"hammer.uff"', '"running.csv"', "is in none of the files running.csv"),
    ("relative_error_percent = 3.0", "relative_error_percent = 3.0\nlowest_frequency_hz = 2e4",
     "no operating line lies within"),
    ("[changes.halved.mounts.one]\nstiffness_n_per_mm = 100.0", "[changes.halved.mounts.one]",
     "needs either stiffness_n_per_mm or a table stiffness"),
    ("stiffness_n_per_mm = 200.0", 'stiffness = { file = "no.csv" }', "no.csv: no such file"),
    ("[changes.halved", "[changes.none", "changes.none: is the name of the state as measured"),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "words"), WRONG)
def test_what_is_wrong_is_one_line_and_exit_code_2(tmp_path, old, new, words, monkeypatch, capsys):
    file = write(tmp_path, HALVED, BEFORE)
    file.write_text(file.read_text().replace(old, new))
    monkeypatch.setattr("sys.argv", ["vibroacoustics", "predict", str(file)])
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as ended:
        cli.main()
    assert ended.value.code == 2
    (line, *_) = capsys.readouterr().err.splitlines()
    assert words in line
    assert str(tmp_path) in line


def test_the_command_writes_results_table_report_and_figures(tmp_path):
    file = write(tmp_path, HALVED, measured_again(0.03, 1))
    outcome = CliRunner().invoke(cli.app, ["predict", str(file), "--out", str(tmp_path / "out")])
    assert outcome.exit_code == 0, outcome.output
    assert "halved  front       dB(A)" in outcome.output
    names = {path.name for path in (tmp_path / "out").iterdir()}
    assert {"prediction.nc", "prediction.csv", "prediction.md", "prediction_1_front.svg"} <= names
    predicted = va.open_results(tmp_path / "out" / "prediction.nc")
    rows = (tmp_path / "out" / "prediction.csv").read_text().splitlines()
    assert len(rows) == 1 + predicted.sizes["frequency"] * predicted.sizes["receiver"]
    assert "| halved | front | dB |" in (tmp_path / "out" / "prediction.md").read_text()
