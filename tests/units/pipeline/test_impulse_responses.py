"""Impulse responses of a study's room, with vectors that are made up, and their files."""

import numpy as np
import pytest
from rooms_made_up import KITCHEN, made_up_vectors
from scipy.io import wavfile
from support import TINY, assert_refused, command_here

import vibroacoustics as va
from vibroacoustics.base.vocabulary import RIGID_BODY_DOFS
from vibroacoustics.commands import outputs
from vibroacoustics.commands.listening import impulse_analysis
from vibroacoustics.radiation.rooms import of_study as rooms
from vibroacoustics.sound.room_paths import paths_of
from vibroacoustics.stages import room


@pytest.fixture(scope="module")
def study():
    return va.load_study(TINY).replace({"room": KITCHEN})


@pytest.fixture(scope="module")
def vectors(study):
    return made_up_vectors(study.room.listeners, highest_hz=2000.0)


@pytest.fixture(scope="module")
def responses(study, vectors):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(room, "vectors_of", lambda *_: (vectors, False))
        return va.impulse_responses(study)


def test_they_are_the_vectors_below_the_seam_and_the_levels_above(study, vectors, responses):
    """0.01 j f per velocity, at all places: 0.01/2π per acceleration, where waves are alone.

    Made-up waves start at 0 s, ahead of the direct sound. What the responses cut off there ripples
    by 3.3 % at single frequencies, and by less than 0.1 % in the mean.
    """
    assert responses.dims == ("listener", "dof", "time")
    assert list(responses["dof"].values) == list(RIGID_BODY_DOFS)
    assert responses["time"].values[1] == pytest.approx(1.0 / 48000.0)
    written = np.abs(np.fft.rfft(responses.values, 2**16)) ** 2
    hertz = np.fft.rfftfreq(2**16, 1.0 / 48000.0)
    low = (hertz > 100.0) & (hertz < 300.0)
    relative = written[..., low] / (0.01 / (2.0 * np.pi)) ** 2
    np.testing.assert_allclose(relative, 1.0, atol=0.04)
    np.testing.assert_allclose(relative.mean(axis=-1), 1.0, atol=0.002)
    pressure = rooms.pressure_at_positions(vectors)
    paths = paths_of(study.room, study.machine.shell, vectors, pressure).paths
    for middle in (1000.0, 1258.9):
        within = (hertz > middle * 10.0**-0.05) & (hertz < middle * 10.0**0.05)
        at = hertz[within]
        square = np.full((22, at.size), (0.01 / (2.0 * np.pi)) ** 2)
        wanted = paths.at_listeners(square, at).mean(axis=-1)
        off_db = 10.0 * np.log10(written[..., within].mean(axis=-1) / wanted[:, None])
        assert np.abs(off_db).max() < 0.1


def test_files_state_their_gain_and_unit(tmp_path, responses):
    analysis = impulse_analysis(responses, ["table"])
    outputs.write_analysis(analysis, None, tmp_path)
    paths = [tmp_path / name for name in analysis.further]
    scale = float(paths[0].stem.rpartition("_")[2].removesuffix("Pa"))
    assert [path.name for path in paths] == [
        f"table_{dof}_{scale:g}Pa.wav" for dof in RIGID_BODY_DOFS
    ]
    assert scale >= np.abs(responses).max() > 0.4 * scale  # of all listeners
    rate, samples = wavfile.read(paths[2])
    assert (rate, samples.dtype) == (48000, np.float32)
    expected = responses.sel(listener="table", dof="tz")
    np.testing.assert_allclose(scale * samples, expected, atol=1e-7 * scale)
    for path, unit in ((paths[2], "Pa/(m/s²)"), (paths[3], "Pa/(rad/s²)")):
        assert (
            f"vibroacoustics: {scale!r} {unit} at full scale".encode("latin-1") in path.read_bytes()
        )


def test_the_command_writes_and_refuses_in_one_line(tmp_path, study, vectors, monkeypatch):
    monkeypatch.setattr("vibroacoustics.study.loading.load_study", lambda _: study)
    out = tmp_path / "responses"
    asked = ("impulse-responses", TINY, "--out", out, "--microphone")
    monkeypatch.setattr(room, "vectors_of", lambda *_: pytest.fail("is computed"))
    assert_refused(command_here(*asked, "cook"), "microphone = cook", "available: table, doorway")
    assert_refused(command_here(*asked, "doorway", "--full-scale", -1), "must be above 0")
    monkeypatch.setattr(room, "vectors_of", lambda *_: (vectors, False))
    outcome = command_here(*asked, "doorway", "--full-scale", 1)
    assert outcome.returncode == 0, outcome.stderr
    names = [file.name for file in sorted(out.glob("*.wav"))]
    assert names == sorted(f"doorway_{dof}_1Pa.wav" for dof in RIGID_BODY_DOFS)
    assert_refused(command_here(*asked, "doorway", "--full-scale", 1e-9), "--full-scale = 1e-09 Pa")


def test_a_study_without_a_room_has_none(tmp_path):
    outcome = command_here("impulse-responses", TINY, "--out", tmp_path)
    assert_refused(outcome, "room: the study has none")
