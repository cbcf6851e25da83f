"""`auto` in a study, and refusals of a study and its machine in one go."""

from pathlib import Path

import pytest
from support import PIPELINES, command_here

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.commands.starter import starting_files
from vibroacoustics.study.automatic import samples_for
from vibroacoustics.study.loading import load_study

ALL_AUTO = {
    "operation.crank_angle_samples": "auto",
    "operation.maximum_order": "auto",
    "radiation.maximum_frequency_hz": "auto",
    "radiation.frequency_step_hz": "auto",
    "radiation.near_field_spacing_mm": "auto",
    "radiation.room_spacing_mm": "auto",
}


def written(folder: Path, kind: str) -> tuple[Path, Path]:
    for name, content in starting_files(kind).items():
        (folder / name).write_bytes(content)
    return folder / "study.toml", folder / "machine.toml"


def changed(file: Path, old: str, new: str) -> None:
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1))


def test_twenty_orders_of_the_fastest_speed_and_three_angles_a_cycle() -> None:
    """3500 rpm have 58.3 Hz: 20 orders reach 1167 Hz; 1200 Hz hold 24 orders at 2900 rpm."""
    study = load_study(PIPELINES / "copeland_thesis.toml").replace(ALL_AUTO)
    assert study.radiation.maximum_frequency_hz == 1200.0
    assert study.operation.maximum_order is None
    assert study.highest_order(2900.0) == 24
    assert study.operation.crank_angle_samples == 256
    assert study.radiation.near_field_spacing_m is None


def test_orders_set_the_frequency() -> None:
    """Order 40 of 3500 rpm is at 2333 Hz."""
    orders = {**ALL_AUTO, "operation.maximum_order": 40}
    study = load_study(PIPELINES / "copeland_thesis.toml").replace(orders)
    assert study.radiation.maximum_frequency_hz == 2400.0


@pytest.mark.parametrize(("orders", "samples"), [(0, 256), (85, 256), (86, 512), (171, 1024)])
def test_angles_are_a_power_of_two_with_three_a_cycle(orders: int, samples: int) -> None:
    assert samples_for(orders) == samples
    assert samples >= 3 * orders


def test_errors_of_study_and_machine_come_together(tmp_path: Path) -> None:
    study, machine = written(tmp_path, "table")
    changed(machine, "pitch_mm = {", "pitch_mil = {")
    changed(study, "share_ratio", "shar_ratio")
    changed(study, "[800.0, 950.0, 1200.0]", "[800.0, 1.0]")
    with pytest.raises(ParameterError) as refusal:
        load_study(study)
    lines = refusal.value.args
    assert len(lines) == 3
    assert "machine.toml: mounts.pitch_mil: unknown key" in lines[0]
    assert "options.counterweight-half.shar_ratio: unknown key" in lines[1]
    assert "operation: speed_rpm = 1 rpm: allowed 60 to 60000 rpm" in lines[2]


def test_a_wrong_speed_is_refused_as_such(tmp_path: Path) -> None:
    study, _ = written(tmp_path, "oldham-scroll")
    changed(study, "[2900.0, 3500.0]", "[2900.0, 0.01]")
    with pytest.raises(ParameterError) as refusal:
        load_study(study)
    (line,) = refusal.value.args
    assert "operation: speed_rpm = 0.01 rpm" in line


@pytest.mark.slow
def test_second_check_has_nothing_left(tmp_path: Path) -> None:
    study, machine = written(tmp_path, "table")
    changed(machine, "pitch_mm = {", "pitch_mil = {")
    changed(study, "share_ratio", "shar_ratio")
    assert command_here("check", study).returncode == 2
    changed(machine, "pitch_mil = {", "pitch_mm = {")
    changed(study, "shar_ratio", "share_ratio")
    assert "nothing is wrong" in command_here("check", study).stdout
