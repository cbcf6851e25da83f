"""Sound power from levels: corrections, areas, settings, and what the method overstates."""

import numpy as np
import pytest
from pydantic import ValidationError
from support import PIPELINES

from vibroacoustics.base.decibel import energy_mean
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.base.vocabulary import stamp
from vibroacoustics.levels.sound_field import unit_sound_power
from vibroacoustics.levels.sound_power import (
    background_correction_db,
    box_area_m2,
    environment_correction_db,
    hemisphere_area_m2,
    sound_power_level,
    stand_corrections_db,
    surface_area_m2,
)
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.sound_power import DirectivitySettings, MapSettings, SoundPowerSettings


def test_energy_mean_of_two_levels():
    # 10 lg((1 + 10)/2) above the lower one
    assert energy_mean([60.0, 70.0]) == pytest.approx(60.0 + 10.0 * np.log10(5.5))
    assert energy_mean(np.full((10, 3), 41.0)) == pytest.approx(np.full(3, 41.0))


def test_background_correction_holds_from_6_to_15_db():
    assert background_correction_db(10.0) == pytest.approx(-10.0 * np.log10(0.9))
    assert background_correction_db(15.0) == pytest.approx(0.1396, abs=5e-5)
    assert background_correction_db(15.01) == 0.0
    limited = background_correction_db(np.array([0.0, 3.0, 5.9, 6.0]))
    np.testing.assert_array_equal(limited, limited[-1])  # an upper bound of the level


def test_environment_correction_refuses_a_live_room():
    surface = hemisphere_area_m2(1.0)
    assert environment_correction_db(surface, 4.0 * surface) == pytest.approx(10.0 * np.log10(2.0))
    with pytest.raises(ParameterError, match=r"K2 is 4\.8 dB.*allows 4 dB, from 16\.6 m²"):
        environment_correction_db(surface, 2.0 * surface)
    assert environment_correction_db(surface, 16.63) == pytest.approx(4.0, abs=0.002)


@pytest.mark.parametrize("distance", [0.25, 1.0])
def test_area_of_a_box_is_that_of_the_standard(distance):
    """Equation 9 with the half-sides a, b and the height c."""
    length, width, height = 0.7, 0.5, 1.1
    a, b, c = length / 2.0 + distance, width / 2.0 + distance, height + distance
    area = box_area_m2(length, width, height, distance)
    assert area == pytest.approx(4.0 * (a * b + b * c + c * a))


def test_sound_power_level_takes_off_both_corrections():
    assert sound_power_level(50.0, 10.0) == pytest.approx(60.0)
    assert sound_power_level(50.0, 10.0, 1.0, 2.0) == pytest.approx(57.0)


def test_area_of_a_study():
    box = (0.242, 0.242, 0.462)
    assert surface_area_m2(SoundPowerSettings(), *box) == pytest.approx(2.0 * np.pi)
    settings = SoundPowerSettings(arrangement="iso3744-box", distance_m=0.5)
    assert surface_area_m2(settings, *box) == pytest.approx(box_area_m2(*box, 0.5))


def test_unit_sound_power_is_that_of_a_uniform_field():
    """1 Pa s/m at 1 mm/s rms is 1 mPa rms, 33.98 dB, everywhere."""
    field = stamp(
        "surface_transfer_vector",
        np.full((10, 1, 2), 1.0 + 0.0j),
        {"dof": ["tx"], "frequency": [50.0, 100.0]},
    )
    level = unit_sound_power(field, SoundPowerSettings(), 2.0 * np.pi)
    expected = 20.0 * np.log10(1e-3 / 20e-6) + 10.0 * np.log10(2.0 * np.pi)
    np.testing.assert_allclose(level.values, [[expected, expected]])


def test_corrections_of_the_test_stand():
    assert stand_corrections_db(SoundPowerSettings(), 6.0) == (0.0, 0.0)
    settings = SoundPowerSettings(background_margin_db=10.0, absorption_area_m2=24.0)
    assert stand_corrections_db(settings, 6.0) == pytest.approx((0.458, 3.010), abs=5e-4)


# --- settings ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"radius_m": 0.5}, "greater than or equal to 1"),
        ({"arrangement": "iso3744-box", "radius_m": 2.0}, "radius_mm: has no meaning"),
        ({"distance_m": 1.0}, "distance_mm: has no meaning"),
        ({"arrangement": "en12102-box", "distance_m": 0.5}, "distance_mm = 500 mm: is 1000 mm"),
        ({"arrangement": "iso3744-box", "distance_m": 0.2}, "greater than or equal to 0.25"),
        ({"background_margin_db": 5.0}, "greater than or equal to 6"),
        ({"absorption_area_m2": 0.0}, "greater than 0"),
        ({"arrangement": "iso3745"}, "Input should be"),
    ],
)
def test_sound_power_settings_refuse(settings, words):
    with pytest.raises(ValidationError, match=words):
        SoundPowerSettings(**settings)


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"horizontal_m": (1.0, 1.0)}, r"horizontal_mm = \[1000, 1000\] mm: must rise"),
        ({"spacing_m": 0.005}, "gives 241001 points; allowed up to 20000"),
        ({"normal": "w"}, "Input should be"),
        ({"vertical_m": (0.0, 21.0)}, "less than or equal to 20"),
    ],
)
def test_map_settings_refuse(settings, words):
    with pytest.raises(ValidationError, match=words):
        MapSettings(**settings)


def test_directivity_step_divides_a_right_angle():
    assert DirectivitySettings(step_rad=np.pi / 12.0).step_rad == pytest.approx(np.pi / 12.0)
    with pytest.raises(ValidationError, match=r"step_deg = 7 °: must divide 90"):
        DirectivitySettings(step_rad=np.deg2rad(7.0))


STUDY = """
extends = "{base}"
[sound_power]
arrangement = "iso3744-box"
distance_mm = 500.0
background_margin_db = 12.0
absorption_area_m2 = 80.0
[map]
normal = "z"
coordinate_mm = 300.0
horizontal_mm = [-2000.0, 2000.0]
vertical_mm = [-1000.0, 1000.0]
spacing_mm = 100.0
[directivity]
radius_mm = 5000.0
step_deg = 15.0
"""


@pytest.fixture
def study_file(tmp_path):
    path = tmp_path / "study.toml"
    path.write_text(STUDY.format(base=PIPELINES / "copeland_thesis.toml"))
    return path


def test_study_file_asks_for_sound_power_map_and_directivity(study_file):
    study = load_study(study_file)
    assert study.sound_power == SoundPowerSettings(
        arrangement="iso3744-box",
        distance_m=0.5,
        background_margin_db=12.0,
        absorption_area_m2=80.0,
    )
    assert study.map.sizes == (40, 20)
    assert study.directivity.step_rad == pytest.approx(np.pi / 12.0)


def test_study_file_without_them(thesis_study):
    assert (thesis_study.sound_power, thesis_study.map, thesis_study.directivity) == (None,) * 3


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("distance_mm = 500.0", "distance_mm = 100.0",
         r"sound_power\.distance_mm = 100\.0 mm: out of range; allowed from 250 to 16000 mm"),
        ("background_margin_db = 12.0", "background_margin_db = 3.0",
         r"sound_power\.background_margin_db = 3\.0 dB: out of range; allowed from 6 to 100 dB"),
        ("absorption_area_m2 = 80.0", "absorption_area_m2 = 0.0",
         r"sound_power\.absorption_area_m2 = 0\.0 m²: out of range; allowed above 0 to 1e\+06 m²"),
        ("spacing_mm = 100.0", "spacing_mm = 9000.0",
         r"map\.spacing_mm = 9000\.0 mm: out of range"),
        ("spacing_mm = 100.0", "spacing_mm = 5.0", r"map: spacing_mm = 5 mm: gives 321201 points"),
        ("vertical_mm = [-1000.0, 1000.0]", "vertical_mm = [1000.0, -1000.0]",
         r"map: vertical_mm = \[1000, -1000\] mm: must rise"),
        ("step_deg = 15.0", "step_deg = 13.0", r"directivity: step_deg = 13 °: must divide"),
        ("[map]", "[map]\ncolour = 1", r"map\.colour: unknown key"),
    ],
)  # fmt: skip
def test_refusals_in_a_study_file(study_file, old, new, words):
    study_file.write_text(study_file.read_text().replace(old, new))
    with pytest.raises(ParameterError, match=words) as caught:
        load_study(study_file)
    assert len(str(caught.value).splitlines()) == 1
