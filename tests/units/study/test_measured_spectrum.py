"""Measured third octaves of a study: what is read, and what is refused in one line."""

from pathlib import Path

import numpy as np
import pytest
from sources_study import SOURCES_STUDY
from support import ROOT, TINY, command_here

from vibroacoustics import export_recording, label_recording
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.base.weighting import a_weighting
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.study import Study

ROWS = "frequency_hz,level_dba\n63,20.5\n80,30\n"
SETTINGS = "microphone = 'front_1m'\nspeed_rpm = 2900.0\n"
BASELINE = "[measured.baseline]\nfile = 'stand.csv'\n"


def study_of(
    folder: Path,
    csv: str = ROWS,
    settings: str = SETTINGS,
    base: Path = SOURCES_STUDY,
    further: str = "",
) -> Study:
    """A study that extends another, with a table of a measured spectrum."""
    (folder / "rows.csv").write_text(csv, encoding="utf-8")
    (folder / "stand.csv").write_text(
        "microphone,speed_rpm,band_hz,level_db\nfront_1m,2900,63,40\n"
    )
    file = folder / "study.toml"
    table = f"[evidence.spectrum]\nfile = 'rows.csv'\n{settings}"
    file.write_text(f"extends = '{base}'\n{table}\n{further}", encoding="utf-8")
    return load_study(file)


def test_weighted_levels_are_read_as_they_are_and_bands_omitted(tmp_path: Path) -> None:
    spectrum = study_of(tmp_path, settings=f"{SETTINGS}omitted_bands_hz = [63]\n").evidence.spectrum
    assert spectrum is not None
    assert (spectrum.band_hz, spectrum.level_dba) == ((80.0,), (30.0,))
    assert (spectrum.file, spectrum.microphone, spectrum.speed_rpm) == (
        "rows.csv",
        "front_1m",
        2900.0,
    )
    assert spectrum.deviation_db == 2.0


def test_unweighted_levels_are_weighted_at_the_exact_middle(tmp_path: Path) -> None:
    """31.5 Hz is called so; its exact middle is 10^1.5 Hz."""
    csv = "# my machine\nfrequency_hz,level_db\n31.5,60\n100,50\n"
    spectrum = study_of(tmp_path, csv).evidence.spectrum
    assert spectrum is not None
    expected = (60.0 + a_weighting(10.0**1.5), 50.0 + a_weighting(100.0))
    assert spectrum.level_dba == pytest.approx(expected, abs=1e-9)
    assert spectrum.level_dba[0] == pytest.approx(60.0 - 39.5, abs=0.1)  # IEC 61672-1, table 3


@pytest.mark.parametrize(
    ("csv", "weighted"),
    [
        ("frequency [Hz];level [dB(A)]\n63;20,5\n80;30,0\n", True),
        ("frequency,level_db\nHz,dB\n63,20.5\n80,30\n", False),
        ("frequency / Hz;level / dB\n63;20,5\n80;30\n", False),
    ],
)
def test_the_unit_says_whether_levels_are_weighted(
    tmp_path: Path, csv: str, weighted: bool
) -> None:
    spectrum = study_of(tmp_path, csv).evidence.spectrum
    assert spectrum is not None
    weighting = 0.0 if weighted else a_weighting(10.0**1.8)
    assert spectrum.level_dba[0] == pytest.approx(20.5 + weighting)


def test_values_are_replaced_and_kept_in_the_parameters(tmp_path: Path) -> None:
    study = study_of(tmp_path).replace({"evidence.spectrum.deviation_db": 3.0})
    assert study.parameters()["evidence"]["spectrum"]["deviation_db"] == 3.0
    assert study.parameters()["evidence"]["spectrum"]["level_dba"] == [20.5, 30.0]


REFUSED = [
    (ROWS, "microphone = 'lab'\nspeed_rpm = 2900.0\n", "microphone = lab: must be a receiver"),
    (ROWS, "microphone = 'front_1m'\nspeed_rpm = 2000.0\n", "speed_rpm = 2000 rpm: must be one of"),
    (ROWS, f"{SETTINGS}operating_point = 'ari'\n", "operating_point = ari: must be none"),
    (
        ROWS,
        f"{SETTINGS}deviation_db = 0.1\n",
        "deviation_db = 0.1 dB: out of range; allowed from 0.5 to 10 dB",
    ),
    (ROWS, f"{SETTINGS}omitted_bands_hz = [125]\n", "omitted_bands_hz = 125 Hz: .* no such band"),
    (ROWS, f"{SETTINGS}omitted_bands_hz = [63, 80]\n", "are empty"),
    (ROWS, f"{SETTINGS}tolerance_db = 2\n", "tolerance_db"),
    (ROWS, "microphone = 'front_1m'\n", "speed_rpm"),
    (f"{ROWS}4000,20\n", SETTINGS, "bands 4000 Hz: must be 25 to .* name them in omitted_bands_hz"),
    (f"{ROWS}20,20\n", SETTINGS, "bands 20 Hz: must be 25 to"),
    (f"{ROWS}63,20\n", SETTINGS, "band 63 Hz is given twice"),
    (f"{ROWS}70,20\n", SETTINGS, "band_hz = 70 Hz: must be the middle of a third octave"),
    (f"{ROWS}100,400\n", SETTINGS, "level = 400 dB: must be -100 to 200 dB"),
    ("frequency_hz\n63\n", SETTINGS, "level_db"),
    ("band,level_db\n63,20\n", SETTINGS, "frequency_hz"),
]


@pytest.mark.parametrize(("csv", "settings", "words"), REFUSED)
def test_refusals_name_the_key(tmp_path: Path, csv: str, settings: str, words: str) -> None:
    with pytest.raises(ParameterError, match=words):
        study_of(tmp_path, csv, settings)


def test_a_name_in_place_of_the_table_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "study.toml"
    file.write_text(f"extends = '{TINY}'\n[evidence]\nspectrum = 'rows.csv'\n")
    with pytest.raises(ParameterError, match=r"evidence\.spectrum = 'rows.csv': must be a table"):
        load_study(file)


def test_a_baseline_beside_it_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match=r"omit it or measured\.baseline, which weighs"):
        study_of(tmp_path, further=BASELINE)


def test_a_machine_without_a_published_level_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match=r"evidence\.spectrum: needs machine\.overall_noise"):
        study_of(tmp_path, further="[machine]\nwithout = ['overall_noise']\n")


def test_a_study_without_samples_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match="no value that the study reads has a range"):
        study_of(tmp_path, base=TINY)


def test_the_point_of_the_published_level_has_its_speed(tmp_path: Path) -> None:
    base = ROOT / "pipelines" / "copeland_sources.toml"
    settings = "microphone = 'front_1m'\nspeed_rpm = {} \noperating_point = 'ari'\n"
    further = "[operation]\npoint = 'en_5_50'\n"
    with_point = f"catalogue_point = 'ari'\nextends = '{base}'\n[evidence.spectrum]\n"
    for speed_rpm in (2900.0, 3500.0):
        (tmp_path / "rows.csv").write_text(ROWS)
        file = tmp_path / "study.toml"
        table = f"file = 'rows.csv'\n{settings.format(speed_rpm)}"
        file.write_text(f"{with_point}{table}{further}")
        if speed_rpm == 2900.0:
            spectrum = load_study(file).evidence.spectrum
            assert spectrum is not None
            assert spectrum.operating_point == "ari"
        else:
            with pytest.raises(ParameterError, match="published level it must be 2900 rpm"):
                load_study(file)


def levels_csv(folder: Path) -> str:
    """What `orders` writes of white noise of a microphone, beside another one."""
    noise = np.random.default_rng(2).standard_normal((2, 40960))
    recording = label_recording(noise, 10240.0, ["front", "back"], ["Pa", "Pa"])
    file = export_recording(recording, folder / "bench.nc")
    outcome = command_here("orders", file, "--rpm", "2900", "--out", folder / "out")
    assert outcome.returncode == 0, outcome.stderr
    return (folder / "out" / "levels.csv").read_text(encoding="utf-8")


def test_levels_of_orders_are_a_spectrum(tmp_path: Path) -> None:
    """Bands of the recording beyond those of the study do not weigh; levels are A-weighted."""
    csv = levels_csv(tmp_path)
    spectrum = study_of(tmp_path, csv, f"{SETTINGS}channel = 'front'\n").evidence.spectrum
    assert spectrum is not None
    assert spectrum.band_hz[0] == 25.0
    head, *rows = (line.split(",") for line in csv.splitlines())
    row = next(row for row in rows if row[:2] == ["front", "A"])
    level = dict(zip(spectrum.band_hz, spectrum.level_dba, strict=True))
    assert level[1000.0] == float(row[head.index("leq_1000_hz_db")])
    assert spectrum.within(900.0).band_hz[-1] == 800.0
    for channel in ("side", "=front"):
        with pytest.raises(ParameterError, match="must be one of 'front', 'back'"):
            study_of(tmp_path, csv, f"{SETTINGS}channel = '{channel}'\n")
    with pytest.raises(ParameterError, match=r"rows\.csv: is no levels\.csv of orders"):
        study_of(tmp_path, ROWS, f"{SETTINGS}channel = 'front'\n")
