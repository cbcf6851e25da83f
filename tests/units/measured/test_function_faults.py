"""Faults of hammer tests: seeded mistakes are named at their points, clean tests have none."""

import re

import numpy as np
import pytest

import vibroacoustics as va
from vibroacoustics.measured.faults import function_faults
from vibroacoustics.measured.function_check import check_functions
from vibroacoustics.measured.grouped import by_key
from vibroacoustics.measured.physics_tests import parallel_mass_kg
from vibroacoustics.report import analysis_of_prediction

FREQUENCY = np.arange(10.0, 801.0, 2.0)
OMEGA = 2.0 * np.pi * FREQUENCY
NODES = [va.Node(number, "+z") for number in range(1, 6)]
BODY_KG = 20.0


def beam():
    """Simply supported beam: mass-normalised shapes, angular frequencies, loss factors."""
    x, order = np.array([0.07, 0.21, 0.36, 0.58, 0.83]), np.arange(1, 9)
    return np.sin(np.pi * np.outer(x, order)) / 2**0.5, 195.0 * order**2, np.full(8, 0.02)


def plate():
    """Simply supported plate of 0.9 m by 0.5 m."""
    x, y = np.array([(0.1, 0.13), (0.52, 0.2), (0.33, 0.4), (0.71, 0.37), (0.62, 0.09)]).T
    m, n = np.array([(m, n) for m in range(1, 6) for n in range(1, 4)]).T
    shapes = np.sin(np.pi * np.outer(x, m) / 0.9) * np.sin(np.pi * np.outer(y, n) / 0.5)
    return 0.8 * shapes, 89.0 * ((m / 0.9) ** 2 + (n / 0.5) ** 2), np.full(15, 0.03)


def body():
    """Freely hung body of 20 kg, elastic from 310 Hz."""
    x, y = np.array([(-0.12, -0.1), (0.12, -0.1), (0.12, 0.1), (-0.12, 0.1), (0.03, 0.05)]).T
    rigid = np.column_stack([np.full(5, BODY_KG**-0.5), y * 0.3**-0.5, -x * 0.4**-0.5])
    elastic = 0.2 * np.random.default_rng(5).normal(size=(5, 6))
    hz = np.array([2.0, 2.5, 3.0, 310.0, 390.0, 470.0, 560.0, 690.0, 750.0])
    return np.hstack([rigid, elastic]), 2.0 * np.pi * hz, np.array([0.1] * 3 + [0.02] * 6)


STRUCTURES = {"beam": beam(), "plate": plate(), "body": body()}


def accelerance(structure, hits=None):
    """Accelerances by modal sum, shape (response, hit, frequency)."""
    shapes, natural, loss = STRUCTURES[structure]
    modal = 1.0 / (natural**2 * (1.0 + 1j * loss) - OMEGA[:, None] ** 2)
    hits = shapes if hits is None else hits
    return -(OMEGA**2) * np.einsum("im,fm,jm->ijf", shapes, modal, hits)


def noisy(values, share, seed):
    rng = np.random.default_rng(seed)
    error = rng.normal(size=values.shape) + 1j * rng.normal(size=values.shape)
    return values * (1.0 + share * error / 2**0.5)


def faults_of(values, mass_kg=None):
    functions = [
        va.MeasuredFunction(
            "frequency response", FREQUENCY, values[i, j], NODES[i], NODES[j], "m/s²", "N"
        )
        for i in range(5)
        for j in range(5)
    ]
    return function_faults(by_key(functions), 0.0, mass_kg, (NODES, 20.0, 80.0))


def with_mistake(structure, mistake, point):
    """Accelerances with 3 % noise and a mistake at a point."""
    shapes = STRUCTURES[structure][0]
    hits = shapes.copy()
    if mistake == "moved":
        hits[point] = 0.3 * shapes[point] + 0.7 * shapes[(point + 1) % 5]
    values = noisy(accelerance(structure, hits), 0.03, point)
    factors = {"upside down": -1.0, "g": 1.0 / 9.80665, "mm": 1000.0,
               "delay": np.exp(-1j * OMEGA * 0.001)}  # fmt: skip
    values[point] = values[point] * factors.get(mistake, 1.0)
    if mistake == "swapped":
        other = (point + 2) % 5
        values[[point, other]] = values[[other, point]]
    if mistake == "double":
        values[:, point] *= 1.0 + 0.5 * np.exp(-1j * OMEGA * 0.012)
    if mistake == "late force":
        values[:, point] *= np.exp(1j * OMEGA * 0.001)
    whole = {"pull": -1.0, "all in g": 1.0 / 9.80665, "late hammer": np.exp(1j * OMEGA * 0.001),
             "late sensors": np.exp(-1j * OMEGA * 0.001)}  # fmt: skip
    values = values * whole.get(mistake, 1.0)
    return values.conj() if mistake == "conjugated" else values


NAMES = {"upside down": "polarity", "g": "factor", "mm": "factor", "delay": "delay",
         "late force": "delay", "swapped": "swapped", "double": "double-hit",
         "moved": "reciprocity"}  # fmt: skip
EVERYWHERE = {"pull": "polarity", "conjugated": "convention", "late hammer": "delay",
              "late sensors": "delay"}  # fmt: skip
LATE = {
    "delay": "sensor is 1 ms late",
    "late force": "force of the hits here is 1 ms late",
    "late hammer": "force channel of all",
    "late sensors": "channel of responses of all",
}


@pytest.mark.parametrize("mistake", NAMES)
@pytest.mark.parametrize("structure", STRUCTURES)
def test_mistake_at_a_point_is_named_there(structure, mistake):
    for point in (1, 4):
        found = faults_of(with_mistake(structure, mistake, point))
        nodes = {NODES[point]} | ({NODES[(point + 2) % 5]} if mistake == "swapped" else set())
        assert [(fault.name, set(fault.nodes)) for fault in found] == [(NAMES[mistake], nodes)]
        assert found[0].words.startswith(LATE.get(mistake, ""))


@pytest.mark.parametrize("mistake", EVERYWHERE)
@pytest.mark.parametrize("structure", STRUCTURES)
def test_mistake_of_all_points_is_named(structure, mistake):
    found = faults_of(with_mistake(structure, mistake, 0))
    assert [(fault.name, fault.nodes) for fault in found] == [(EVERYWHERE[mistake], ())]
    assert found[0].words.startswith(LATE.get(mistake, ""))
    if mistake in LATE:
        delay_ms = float(re.search(r"about ([\d.]+) ms late", found[0].words)[1])
        assert delay_ms == pytest.approx(1.0, abs=0.2)


def test_mass_line_finds_a_wrong_mass_and_a_common_factor():
    for values, mass_kg in (
        (accelerance("body"), 30.0),
        (with_mistake("body", "all in g", 0), BODY_KG),
    ):
        assert [fault.name for fault in faults_of(values, mass_kg)] == ["mass"]


def test_parallel_mass_is_that_of_the_body():
    x, y = np.array([(0.2, 0.1), (-0.3, 0.0), (0.1, -0.4), (0.5, 0.5)]).T
    motion = np.column_stack([np.ones(4), y, -x])
    accelerances = motion @ np.diag([1.0 / 7.0, 1.0 / 0.2, 1.0 / 0.5]) @ motion.T
    assert parallel_mass_kg(accelerances[None] + 0j) == pytest.approx(7.0, rel=1e-9)


def test_forty_clean_tests_have_no_fault():
    for seed in range(40):
        structure = list(STRUCTURES)[seed % 3]
        share = (0.01, 0.03, 0.05, 0.1)[seed % 4]
        values = noisy(accelerance(structure), share, seed)
        assert faults_of(values, BODY_KG if structure == "body" else None) == []


def two_point_bench(folder, mistake="", operating=""):
    """Machine of 12 kg on a mount on a mode of 30 kg, heard by its motion; returns the file."""
    omega = 2.0 * np.pi * (hz := np.arange(10.0, 400.0, 2.0))
    mount = 2.0e5 * (1.0 + 0.1j)

    def solved(stiffness):
        base = 30.0 * ((2.0 * np.pi * 90.0) ** 2 * (1.0 + 0.04j) - omega**2)
        matrix = np.array([[stiffness - 12.0 * omega**2, -stiffness + 0.0 * omega],
                           [-stiffness + 0.0 * omega, base + stiffness]])  # fmt: skip
        return np.linalg.inv(matrix.transpose(2, 0, 1)) * -(omega[:, None, None] ** 2)

    measured, softer = solved(mount), solved(0.25 * mount)
    sound = [10.0 * each[:, 1] for each in (measured, softer)]
    values = measured.copy()
    if mistake == "upside down":
        values[:, 1] *= -1.0
    values = {"conjugated": values.conj(), "reversed": -values}.get(mistake, values)
    running = measured[:, :, 0].conj() if operating == "conjugated" else measured[:, :, 0]
    nodes, front = [va.Node(1, "+z"), va.Node(2, "+z")], va.Node(101)
    kind = "frequency response"
    functions = [va.MeasuredFunction(kind, hz, values[:, i, j], nodes[i], nodes[j], "m/s²", "N")
                 for i in (0, 1) for j in (0, 1)]  # fmt: skip
    functions += [va.MeasuredFunction(kind, hz, sound[0][:, j], front, nodes[j], "Pa", "N")
                  for j in (0, 1)]  # fmt: skip
    spectra = [va.MeasuredFunction("spectrum", hz, running[:, i], nodes[i], None, "m/s²")
               for i in (0, 1)]  # fmt: skip
    spectra.append(va.MeasuredFunction("spectrum", hz, sound[0][:, 0], front, None, "Pa"))
    va.export_functions(functions, folder / "hammer.uff")
    va.export_functions(spectra, folder / "running.uff")
    (folder / "bench.toml").write_text("""
title = "Two points"
[measured]
frequency_responses = ["hammer.uff"]
operating = ["running.uff"]
relative_error_percent = 1.0
draws = 50
[measured.points]
machine = { node = 1, direction = "+z" }
base = { node = 2, direction = "+z" }
[measured.microphones]
front = { node = 101 }
[mounts.only]
ends = ["machine", "base"]
stiffness_n_per_mm = 200.0
loss_factor_percent = 10.0
[changes.softer.mounts.only]
stiffness_n_per_mm = 50.0
loss_factor_percent = 10.0
""")
    power = [np.sum(np.abs(each[:, 0]) ** 2) for each in sound]
    return folder / "bench.toml", 10.0 * np.log10(power[1] / power[0])


def change_of(predicted, end=""):
    at = {"option": "softer", "receiver": "front", "weighting": "Z"}
    return predicted[f"predicted_total_change{end}"].sel(at).item()


def test_right_data_of_two_points_predict_the_truth(tmp_path):
    path, truth_db = two_point_bench(tmp_path)
    assert change_of(va.predict(path)) == pytest.approx(truth_db, abs=1e-6)
    assert check_functions(path).faults == ()


@pytest.mark.parametrize(
    ("mistake", "line"),
    [
        ("conjugated", "convention at all points"),
        ("reversed", "polarity at all points"),
        ("upside down", r"polarity at base \(2\+z\)"),
    ],
)
def test_wrong_data_of_two_points_are_refused_or_have_no_band(tmp_path, mistake, line):
    path, _ = two_point_bench(tmp_path, mistake)
    with pytest.raises(va.ParameterError, match=line):
        va.predict(path)
    despite = va.predict(path, despite=[line.split()[0]])
    assert np.isnan(change_of(despite, "_low"))
    assert np.isnan(change_of(despite, "_high"))
    words = analysis_of_prediction(despite).text()
    assert words.count("unknown") == 4
    assert re.search(f"No bands: fault accepted, {line}", words)


def test_operating_phases_against_the_hammer_test_are_refused(tmp_path):
    path, _ = two_point_bench(tmp_path, operating="conjugated")
    with pytest.raises(va.ParameterError, match=r"operating at all points: .*conjugate"):
        va.predict(path)
    assert len(check_functions(path).faults) == 1


def test_unknown_names_of_faults_are_refused(tmp_path):
    path, _ = two_point_bench(tmp_path, "reversed")
    with pytest.raises(va.ParameterError, match="--despite sign: must be one of convention"):
        va.predict(path, despite=["sign"])
