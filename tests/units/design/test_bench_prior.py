"""Influence coefficients of a study before any run: Newton's law, one trial run, refusals."""

import numpy as np
import pytest
from sources_study import SOURCES_STUDY
from support import PIPELINES
from trial_run_files import at

import vibroacoustics as va
from vibroacoustics.design.balance import MOTION, counterweights_of, influence_of_weights
from vibroacoustics.design.bench.prior import _along, influence_of_study
from vibroacoustics.design.engine.sound_path import SoundPaths
from vibroacoustics.measured.trial_runs.measured_runs import measured_runs
from vibroacoustics.measured.trial_runs.settings import Sensor, load_trial_runs
from vibroacoustics.stages.radiation import KeptRadiation
from vibroacoustics.transfer.machine import on_mounts

OPTION = "upper + lower"
WEIGHT = (
    'kind = "counterweight"\nmass_g = 10.0\nradius_mm = 20.0\nangle_deg = 0.0\nheight_mm = {}\n'
)
RUNS = """
amplitudes = "peak"
phases = "lead"
angles = "with rotation"
trial_weights = "removed"
[study]
file = "machine.toml"
option = "upper + lower"
samples = 30
[planes.lower]
radius_mm = 20.0
[planes.upper]
radius_mm = 20.0
[sensors.foot]
unit = "N"
foot = "front_left"
axis = "z"
scatter = 0.02
[sensors.high]
unit = "mm/s"
position_mm = [0.0, 0.0, 150.0]
axis = "x"
scatter = 0.02
[sensors.low]
unit = "m/s²"
position_mm = [100.0, 0.0, -150.0]
axis = "y"
scatter = 0.02
"""


def paths():
    return SoundPaths(KeptRadiation())


def test_foot_forces_and_motion_are_newtons_law():
    """ω² m r of a rotating weight less the forces on the feet is -ω² M x: one real M, known."""
    study = va.load_study(PIPELINES / "copeland_thesis.toml").replace({
        "operation.speed_rpm": [1500.0, 2900.0],
        "options.upper": {"kind": "counterweight", "mass_g": 10.0, "radius_mm": 20.0,
                          "angle_deg": 25.0, "height_mm": 60.0},
    })  # fmt: skip
    weights = counterweights_of(study, "upper")
    _, influence = influence_of_weights(
        study, "upper", weights, (MOTION, "foot_force_n"), paths()
    )  # fmt: skip
    motion, force = influence[:, :6, 0], influence[:, 6:, 0].reshape(2, -1, 3).sum(axis=1)
    squares = (np.array([1500.0, 2900.0])[:, None] * np.pi / 30.0) ** 2
    applied = squares * np.array([1.0, -1.0j])  # cos and sin of the crank angle
    mass = (force[:, :2] - applied) / (squares * motion[:, :2])
    assert mass == pytest.approx(np.full((2, 2), mass[0, 0].real), rel=1e-6)
    assert 20.0 < mass[0, 0].real < 60.0


def test_motion_of_a_foot_gives_its_force():
    """Force over displacement is the stiffness of the mount, the same at each foot."""
    study = va.load_study(PIPELINES / "copeland_thesis.toml").replace({
        "operation.speed_rpm": [2900.0],
        "options.upper": {"kind": "counterweight", "mass_g": 10.0, "radius_mm": 20.0,
                          "angle_deg": 25.0, "height_mm": 60.0},
    })  # fmt: skip
    weights = counterweights_of(study, "upper")
    _, influence = influence_of_weights(
        study, "upper", weights, (MOTION, "foot_force_n"), paths()
    )  # fmt: skip
    force = influence[0, 6:, 0].reshape(-1, 3)
    for number, axis in enumerate("xyz"):
        moved = [
            _along(Sensor(unit="m", position_m=tuple(position), axis=axis)) @ influence[0, :6, 0]
            for position in on_mounts(study.machine).foot_position.tolist()
        ]
        stiffness = force[:, number] / np.array(moved)
        np.testing.assert_allclose(stiffness, stiffness[0], rtol=1e-6)
        assert stiffness[0].real > 1e3


def files(folder, readings=None):
    """Study with two counterweights, and runs without and with one trial weight."""
    text = f'extends = "{SOURCES_STUDY}"\n'
    for name, height in (("upper", 60.0), ("lower", -60.0)):
        text += f"[options.{name}]\n{WEIGHT.format(height)}"
    (folder / "machine.toml").write_text(text + f'[options."{OPTION}"]\n')
    readings = np.ones((2, 3)) if readings is None else readings
    runs = ""
    for name, weight, values in zip(
        ("first", "upper"), ("", "weights.upper = { mass_g = 20.0, angle_deg = 0.0 }\n"), readings,
        strict=True,
    ):  # fmt: skip
        shown = ", ".join(
            f'{sensor} = "{at(value)}"'
            for sensor, value in zip(("foot", "high", "low"), values, strict=True)
        )
        runs += f"[runs.{name}]\n{weight}readings.2900 = {{ {shown} }}\n"
    path = folder / "runs.toml"
    path.write_text(RUNS + runs)
    return path


def test_a_machine_of_the_prior_needs_one_trial_run(tmp_path):
    """Each of five samples is the machine in turn, without scatter; others are the prior."""
    path = files(tmp_path)
    settings = load_trial_runs(path)
    prior = influence_of_study(settings, measured_runs(settings, tmp_path)).ensemble
    assert prior.samples.shape == (30, 3, 2)
    spread = prior.samples.std(axis=0) / np.abs(prior.samples.mean(axis=0))
    assert spread.max() > 0.02
    unbalance = 0.02 * np.array([0.010, 0.015j])
    trial = 0.02 * np.array([0.0, 0.020])
    without = []
    for truth in prior.samples[:5]:
        readings = np.array([truth @ unbalance, truth @ (unbalance + trial)])
        balanced = va.balance_runs(files(tmp_path, readings))
        remaining = np.abs(truth @ (unbalance + balanced.answers["least squares"]))
        without.append(np.linalg.norm(remaining) / np.linalg.norm(readings[0]))
    assert np.median(without) < 0.1


def test_a_tacho_off_the_x_axis_turns_the_coefficients(tmp_path):
    """A weight at the mark is at the tacho when the pulse comes, so it leads by its angle."""
    path = files(tmp_path)
    path.write_text(path.read_text().replace("samples = 30", "samples = 10\ntacho_deg = 40.0"))
    turned = load_trial_runs(path)
    plain = turned.model_copy(update={"study": turned.study.model_copy(update={"tacho_rad": 0.0})})
    runs = measured_runs(turned, tmp_path)
    ratio = influence_of_study(turned, runs).feet / influence_of_study(plain, runs).feet
    np.testing.assert_allclose(ratio, np.exp(1j * np.deg2rad(40.0)), rtol=1e-9)


def test_runs_alone_do_not_determine_both_planes(tmp_path):
    path = files(tmp_path)
    text = path.read_text()
    start, end = text.index("[study]"), text.index("[planes.lower]")
    path.write_text(text[:start] + text[end:])
    with pytest.raises(va.ParameterError, match=r"or a table \[study\]"):
        va.balance_runs(path)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("[planes.lower]", "[planes.middle]", "planes.middle: no counterweight of option"),
        ('option = "upper + lower"', 'option = "no"', "option = no: there is no such option"),
        ('foot = "front_left"\n', 'foot = "middle"\n', "sensors.foot.foot = middle: no such foot"),
        ('foot = "front_left"\naxis = "z"\n', "", "sensors.foot: is nothing of the study"),
        ('foot = "front_left"\naxis = "z"\n', 'foot = "front_left"\n', "axis: belongs to foot"),
        ('file = "machine.toml"', 'file = "other.toml"', "other.toml: no such file"),
    ],
)
def test_what_is_not_of_the_study_is_refused(old, new, words, tmp_path):
    path = files(tmp_path)
    path.write_text(path.read_text().replace(old, new))
    with pytest.raises(va.ParameterError) as caught:
        va.balance_runs(path)
    assert words in str(caught.value.args[0])
