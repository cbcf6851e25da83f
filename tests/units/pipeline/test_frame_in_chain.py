"""Sources of a machine with a frame: balance of their loads, switches, samples, refusals."""

import numpy as np
import pytest
from sources_study import SOURCES_STUDY, case_of, on_parts, path_of, run_made_up, with_tables
from support import ROOT

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.machine.frame import (
    BEARING_HOUSING,
    FIXED_SCROLL,
    ORBITING_SCROLL,
    STATOR,
)
from vibroacoustics.mechanics.ports import HOUSING
from vibroacoustics.sources.cases import loads_of
from vibroacoustics.study.loading import load_study
from vibroacoustics.transfer.frame.of_machine import frame_on_shell

WITHOUT = 'without = ["frame"]\n'
TEXT = SOURCES_STUDY.read_text(encoding="utf-8")
MACHINE = ROOT / "data" / "machines" / "copeland_zp41k3e.toml"


def load_text(folder, text):
    (folder / "study.toml").write_text(text.replace("../../data", str(ROOT / "data")))
    return load_study(folder / "study.toml")


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    assert TEXT.count(WITHOUT) == 1
    return load_text(tmp_path_factory.mktemp("framed"), TEXT.replace(WITHOUT, ""))


@pytest.fixture(scope="module")
def loads(study):
    return loads_of(study, case_of(study))


def test_gas_is_a_pair_but_for_the_rotors_inertia(loads):
    """Sum of all forces and moments about the centre of mass; what is left turns the shaft."""
    gas = loads["gas"]
    parts = np.array([*on_parts(gas.lines).values()])
    total, largest = parts.sum(axis=0), abs(parts).max()
    assert largest > 2000.0
    assert abs(total[:5]).max() < 1e-9 * largest
    assert total[5] == pytest.approx(gas.shaft_torque_n_m, abs=1e-9 * largest)
    assert abs(total[5, 1]) > 0.01
    half = 0.5 * gas.shaft_torque_n_m
    for scroll in (FIXED_SCROLL, ORBITING_SCROLL):
        assert gas.lines[scroll][5] == pytest.approx(half, abs=1e-9 * largest)


def test_radial_force_closes_at_the_flanks(study, loads):
    """Then what is left is tangential: across the line from the shaft to where it acts."""
    tangential = loads["gas"].lines[FIXED_SCROLL]
    fixed = with_tables(study, frame={"radially_compliant": False})
    both = loads_of(fixed, case_of(fixed))["gas"].lines[FIXED_SCROLL]
    assert both[5] == pytest.approx(tangential[5], abs=1e-9)
    assert np.abs(both[:2, :8] - tangential[:2, :8]).max() > 100.0
    assert both[2] == pytest.approx(tangential[2], abs=1e-9)


def test_motor_turns_the_stator_alone(loads):
    for load in (loads["torque_ripple"].lines, *(tone.loads for tone in loads["motor"].tones)):
        assert set(load) == {HOUSING, STATOR}
        for wrench in load.values():
            assert not wrench[:5].any()
        assert abs(load[STATOR][5]).max() > 0.0


def test_keys_hand_on_the_inertia_of_the_ring_at_its_height(study, loads):
    """What gas presses through them is the gas source's; moments are the forces' at the ring."""
    total = sum(loads["keys"].lines.values())
    omega = 2.0 * np.pi * 2900.0 / 60.0
    machine = study.machine
    inertia = machine.oldham.mass_kg * machine.kinematics.orbit_radius_m * omega**2
    assert total[0, 1] == pytest.approx(inertia, rel=2e-3)
    height = machine.oldham.height_m
    assert total[4] == pytest.approx(height * total[0], abs=1e-9)
    assert total[3] == pytest.approx(-height * total[1], abs=1e-9)
    alone = study.model_copy(update={"machine": study.machine.model_copy(update={"frame": None})})
    without = loads_of(alone, case_of(alone))["keys"].lines[BEARING_HOUSING][5]
    pressed = 0.5 * loads["gas"].shaft_torque_n_m
    assert loads["keys"].lines[FIXED_SCROLL][5] == pytest.approx(without - pressed, abs=1e-9)


def test_keys_stand_on_the_part_that_the_machine_says(study):
    other = with_tables(study, frame={"keys_on": "bearing-housing"})
    of_each = [loads_of(s, case_of(s))["keys"].lines for s in (study, other)]
    np.testing.assert_array_equal(of_each[0][FIXED_SCROLL], of_each[1][BEARING_HOUSING])
    assert BEARING_HOUSING not in of_each[0]
    assert FIXED_SCROLL not in of_each[1]


def test_frame_changes_the_sound_and_is_sampled(study):
    alone = {"sources": {"gas": study.sources["gas"]}, "options": {"none": study.options["none"]}}
    operation = study.operation.model_copy(update={"stopping": False})
    results = run_made_up(study.model_copy(update={**alone, "operation": operation}))
    names = set(results["uncertain_parameter"].values.tolist())
    assert {"frame.bolts.lateral_stiffness_n_per_m", "shaft.bearing_stiffness_n_per_m"} <= names
    by_sample = results["source_level_by_sample"].sel(sound_source="gas", option="none")
    assert np.all(np.isfinite(by_sample.values))
    assert np.ptp(by_sample.values) > 1.0
    assert results["source_level"].sel(sound_source="gas", option="none").max() > 0.0


def test_a_frame_as_stiff_as_can_be_is_quieter_than_separate_joints(study):
    """The pair of gas forces closes inside; only the overhang's share reaches the shell."""
    machine = study.machine
    stiff = {
        "bolts": machine.frame.bolts.model_copy(
            update={"lateral_stiffness_n_per_m": 1e12, "guide_stiffness_n_per_m": 1e12}
        ),
        "pin_stiffness_n_per_m": 1e12,
    }
    path = path_of(study)
    framed = frame_on_shell(with_tables(study, frame=stiff).machine, path)
    parts = on_parts(loads_of(study, case_of(study))["gas"].lines).values()
    gas = np.concatenate([load[:, 2] for load in parts])
    frequency = np.array([2.0 * 2900.0 / 60.0])
    forces = framed.contact_forces(frequency)[0] @ gas
    on_modes = framed.modal_forces @ forces
    separate = path.forces_of_parts()[..., 0] @ gas
    assert np.linalg.norm(on_modes) < 0.5 * np.linalg.norm(separate)


def test_an_option_may_change_the_frame(tmp_path):
    """Stiffer bolts by redesign: the sources' loads stay, their sound changes."""
    change = """
[options.locked]
kind = "redesign"
[options.locked.change.frame.bolts]
lateral_stiffness_n_per_mm = { value = 4e5, source = "test" }
[receivers.front_1m]"""
    text = TEXT.replace(WITHOUT, "").replace("[receivers.front_1m]", change)
    start, stop = text.index("[sources.keys]"), text.index("[radiation]")
    study = load_text(tmp_path, (text[:start] + text[stop:]).replace("stopping = true", ""))
    options = {name: study.options[name] for name in ("none", "locked")}
    one = study.model_copy(update={"options": options, "ranges": ()})
    level = run_made_up(one)["source_level"].sel(sound_source="gas", receiver="front_1m")
    assert abs(level.sel(option="locked") - level.sel(option="none")).item() > 0.1


# --- bad input -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("new", "words"),
    [
        ('without = ["frames"]\n', ["machine.without = frames", "no such table"]),
        ('without = "frame"\n', ["machine.without = 'frame'", "list"]),
        ('without = ["shaft"]\n', ["frame: needs the table shaft"]),
        (
            '[machine.override.frame.stator]\nmass_kg = { value = 30.0, source = "test" }\n',
            ["housing.mass_kg = 35 kg", "in a shell"],
        ),
        (
            '[machine.override.frame]\nkeys_on = "shaft"\n',
            ["frame.keys_on = 'shaft'", "fixed-scroll"],
        ),
        ('[shell_modes]\nfile = "modes.uff"\n', ["shell_modes", 'machine.without = ["frame"]']),
    ],
)
def test_bad_frames_are_one_line(tmp_path, new, words):
    with pytest.raises(ParameterError) as refusal:
        load_text(tmp_path, TEXT.replace(WITHOUT, new))
    lines = str(refusal.value).splitlines()
    assert any(all(word in line for word in words) for line in lines), lines
