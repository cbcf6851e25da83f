"""Several machines in one study: each an ordinary run, all together at common receivers."""

from dataclasses import replace
from functools import partial
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from beating import measured_beat
from scipy.io import wavfile
from support import ROOT, assert_refused, command_here, made_up_radiation

import vibroacoustics as va
from vibroacoustics.commands import several_machines
from vibroacoustics.machine.housing import Housing
from vibroacoustics.mechanics.bushings import RigidBody
from vibroacoustics.radiation.transfer_vectors import pressure_per_velocity
from vibroacoustics.results.several_machines import sound_of
from vibroacoustics.sound.files import at_gain, wav_bytes
from vibroacoustics.sound.rendering import SAMPLE_RATE_HZ
from vibroacoustics.sound.together import rendered_together
from vibroacoustics.study.machine_studies import machine_studies, turn_of
from vibroacoustics.transfer.base_frame import FRAME, MachinesOnFrame, Standing
from vibroacoustics.transfer.feet import Stand
from vibroacoustics.transfer.machine import on_mounts

TWO = ROOT / "tests" / "studies" / "two_tiny.toml"
BASE_FRAME = {
    "base_frame.position_mm": [20.0, -10.0],
    "base_frame.height_mm": 60.0,
    "base_frame.top_height_mm": 100.0,
    "base_frame.body": {
        "mass_kg": 25.0, "inertia_xx_kg_m2": 0.9, "inertia_yy_kg_m2": 2.0, "inertia_zz_kg_m2": 2.7,
    },
    "base_frame.mounts": {
        "pitch_mm": 600.0, "lateral_stiffness_n_per_mm": 40.0, "vertical_stiffness_n_per_mm": 90.0,
        "loss_factor_ratio": 0.1,
    },
}  # fmt: skip
SPEEDS = {"west": 2900.0, "east": 2880.0}


@pytest.fixture(scope="module")
def study() -> va.Study:
    return va.load_study(TWO)


@pytest.fixture(scope="module")
def tree(study: va.Study) -> xr.DataTree:
    return va.run_machines(study, radiation=made_up_radiation)


@pytest.fixture(scope="module")
def on_frame(study: va.Study) -> xr.DataTree:
    return va.run_machines(study.replace(BASE_FRAME), radiation=made_up_radiation)


def pascal(tree: xr.DataTree, receiver: str, line: str) -> complex:
    labels = {"common_receiver": receiver, "machine_line": line}
    return complex(tree["machines_pressure_line"].sel(labels).item())


def test_each_machine_is_an_ordinary_run(study, tree):
    studies = machine_studies(study)
    assert list(studies) == list(tree.children) == ["west", "east"]
    assert studies["east"].operation.speed_rpm == (2880.0,)
    assert list(studies["west"].options) == ["none"]
    alone = va.run(studies["east"], radiation=made_up_radiation)
    for name in ("pressure_line", "level_total", "force_order"):
        xr.testing.assert_equal(alone[name], tree["east"][name])


def test_receivers_are_in_the_axes_of_each_machine(study):
    """A machine at (-0.2, 0) m sees x more; one at (0.2, 0) turned by 90° has its x along y."""
    west, east = (each.receivers for each in machine_studies(study).values())
    assert (west["front"].x_m, west["front"].y_m) == (0.2, 1.0)
    assert (east["front"].x_m, east["front"].y_m) == (1.0, 0.2)
    assert (east["side"].x_m, east["side"].y_m) == (0.0, -1.0)
    assert {each["front"].height_m for each in (west, east)} == {0.23}
    assert east["front_1m"].x_m == 1.0825  # of the published level, about the machine itself


def test_incoherent_levels_add_by_energy(tree):
    root = tree.to_dataset()
    each = []
    for name, option in (("west", "none"), ("east", "counterweight-half")):
        at = {"speed": SPEEDS[name], "option": option}
        levels = tree[name]["level_total"].sel(at).sel(receiver=["front", "side"]).values
        assert np.abs(root["machine_level"].sel(machine=name) - levels).max() < 1e-9
        each.append(levels)
    energy = 10.0 * np.log10(sum(10.0 ** (level / 10.0) for level in each))
    assert np.abs(root["machines_level"].values - energy).max() < 1e-9
    bands = [
        tree[name][variable].sel(speed=SPEEDS[name], receiver="side").sel(option=option).values
        for name, option in (("west", "none"), ("east", "counterweight-half"))
        for variable in ("noise_band_level", "unmodelled_band_level")
    ]
    noise = 10.0 * np.log10(sum(10.0 ** (level / 10.0) for level in bands))
    together = root["machines_noise_band_level"].sel(common_receiver="side").values
    assert np.abs(together - noise[noise > -200.0]).max() < 1e-9
    parts = root["beat_line_level"].values
    energies = 10.0 * np.log10((10.0 ** (parts / 10.0)).sum(axis=-1))
    loud = energies > -200.0
    assert np.abs(root["beat_energy_level"].values - energies)[loud].max() < 1e-9


def test_highest_level_has_every_beat_at_its_maximum(tree):
    """Of the sound at `side`: each order's lines add as |p1| + |p2|, noise by its power."""
    root, total = tree.to_dataset(), 0.0
    sound = sound_of(root, "side")
    weighting = va.levels.a_weighting
    peaks = dict(zip(sound.lines.name, np.abs(sound.lines.pressure_pa), strict=True))
    hertz = dict(zip(sound.lines.name, sound.lines.frequency_hz, strict=True))
    gains = {name: 10.0 ** (weighting(hertz[name]) / 20.0) for name in hertz}
    for order in range(1, 17):
        pair = [peaks[f"{name}: order {order}"] * gains[f"{name}: order {order}"]
                for name in SPEEDS]  # fmt: skip
        total += 0.5 * (sum(pair) ** 2 if order < 16 else sum(peak**2 for peak in pair))
    gain = 10.0 ** (weighting(sound.bands.centre_hz) / 10.0)
    total += np.sum(sound.bands.pressure_pa**2 * gain)
    level = 10.0 * np.log10(total / 20e-6**2)
    assert root["machines_highest_level"].sel(common_receiver="side").item() == pytest.approx(
        level, abs=1e-6
    )


def test_rendered_sound_beats(tree):
    """A minute as WAV: order n beats at n/3 Hz within 0.001 Hz, to |p1| + |p2| within 0.1 dB.

    The peaks are made up, as the tiny machine has orders 1 and 2 alone; noise is the study's.
    """
    sound = sound_of(tree.to_dataset(), "front")
    random = np.random.default_rng(7)
    size = 0.02 * (0.2 + random.random(len(sound.lines.name)))
    made_up = size * np.exp(2j * np.pi * random.random(size.size))
    sound = replace(sound, lines=replace(sound.lines, pressure_pa=made_up))
    pressure = rendered_together(sound, SPEEDS.values(), 60.0)
    scale = float(np.abs(pressure).max())
    content = wav_bytes(at_gain(pressure, scale), SAMPLE_RATE_HZ, scale)
    rate, samples = wavfile.read(BytesIO(content))
    peaks = dict(zip(sound.lines.name, size, strict=True))
    for order in range(1, 16):
        hertz = [order * speed / 60.0 for speed in SPEEDS.values()]
        beat, largest, smallest = measured_beat(samples.astype(float) * scale, rate, *hertz)
        assert abs(beat - order / 3.0) < 1e-3, order
        pair = [peaks[f"{name}: order {order}"] for name in SPEEDS]
        assert abs(20.0 * np.log10(largest / sum(pair))) < 0.1, order
        assert abs(smallest - abs(pair[0] - pair[1])) < 0.01 * sum(pair), order


def test_levels_of_a_beat_are_those_of_phasors(tree):
    at = tree.to_dataset().sel(common_receiver="side", beat="east: order 1, west: order 1")
    pair = [abs(pascal(tree, "side", f"{name}: order 1")) for name in SPEEDS]
    assert min(pair) > 1e-6
    for name, peak in (("highest", sum(pair)), ("lowest", abs(pair[0] - pair[1]))):
        level = 20.0 * np.log10(peak / np.sqrt(2.0) / 20e-6)
        assert at[f"beat_{name}_level"].item() == pytest.approx(level, abs=1e-6)


def test_sound_lasts_whole_beats(tree):
    sound = sound_of(tree.to_dataset(), "front")
    assert rendered_together(sound, SPEEDS.values(), 10.0).size == 9 * 48000
    assert rendered_together(sound, (2900.0, 2899.0), 10.0).size == 480000


@pytest.mark.parametrize("driving", ["west", "east"])
def test_all_housings_on_a_frame_radiate(study, on_frame, driving):
    """Pressure of a line is the sum of transfer vectors times velocities of all housings."""
    placed = study.replace(BASE_FRAME)
    frame = placed.base_frame
    body = frame.body
    moments = [body.inertia_xx_kg_m2, body.inertia_yy_kg_m2, body.inertia_zz_kg_m2]
    centre = np.array([*frame.position_m, frame.height_m])
    standing = {}
    for name, each in machine_studies(placed).items():
        machine = each.options[placed.machines[name].option].built_into(each.machine)
        assert machine.shell.floor_clearance_m == pytest.approx(0.125)
        origin = np.array([*placed.machines[name].position_m, -machine.shell.floor_z_m])
        standing[name] = Standing(on_mounts(machine), origin, turn_of(placed.machines[name]))
    rigid = RigidBody(FRAME, body.mass_kg, np.diag(moments), centre)
    machines = MachinesOnFrame(rigid, Stand(frame.mounts, -frame.height_m), standing)
    at = {"speed": SPEEDS[driving], "option": placed.machines[driving].option}
    results = on_frame[driving].to_dataset()
    hertz = results["order_frequency"].sel(speed=at["speed"]).values
    wrench = np.concatenate([results[name].sel(at).sum("source").transpose("axis", "order").values
                             for name in ("force_order", "moment_order")])  # fmt: skip
    port = standing[driving].body.mechanism_port
    motion = machines.motion(driving, {port: wrench}, hertz)
    velocity = machines.housing_velocity(motion, hertz)
    total = np.zeros(hertz.size, dtype=complex)
    for name, moves in velocity.items():
        vectors = pressure_per_velocity(on_frame[name]["transfer_vector"])(hertz)
        row = list(on_frame[name]["receiver"].values).index("side")
        total += np.einsum("mf,fm->f", vectors[row], moves)
    known = on_frame["machine_line"].values.tolist()
    lines = [f"{driving}: order {order}" for order in range(1, hertz.size)]
    mine = np.array([pascal(on_frame, "side", line) if line in known else 0.0 for line in lines])
    assert np.abs(mine - total[1:]).max() < 1e-9 * np.abs(total).max()
    force = on_frame["base_floor_force"].sel(machine_line=lines[0]).values
    assert np.abs(force - machines.floor_force(motion, hertz)[1]).max() < 1e-9 * np.abs(force).max()
    modes = machines.isolation.natural_modes()[0]
    assert on_frame["base_natural_frequency"].values == pytest.approx(modes, rel=1e-9)


def test_a_frame_that_does_not_move_changes_nothing(study, tree):
    """Its mass of 1e14 kg leaves 1e-12 of the motion; its mounts are the stiffest allowed."""
    rigid = dict.fromkeys(("inertia_xx_kg_m2", "inertia_yy_kg_m2", "inertia_zz_kg_m2"), 1e14)
    stiff = {"base_frame.mounts": {
        "pitch_mm": 600.0, "lateral_stiffness_n_per_mm": 1e6, "vertical_stiffness_n_per_mm": 1e6,
        "loss_factor_ratio": 0.1,
    }}  # fmt: skip
    frame = study.replace(BASE_FRAME | stiff | {"base_frame.top_height_mm": 0.0}).base_frame
    huge = frame.model_copy(update={"body": Housing.model_construct(mass_kg=1e14, **rigid)})
    still = study.model_copy(update={"base_frame": huge}).remember(*study._as_read())
    fixed = va.run_machines(still, radiation=made_up_radiation)
    names = tree["machine_line"].values
    before, after = (
        each["machines_pressure_line"].sel(machine_line=names).values for each in (tree, fixed)
    )
    assert np.abs(after - before).max() < 1e-9 * np.abs(before).max()


def test_files_are_a_tree(study, tree, tmp_path, monkeypatch):
    runs = partial(va.run_machines, radiation=made_up_radiation)
    monkeypatch.setattr(several_machines, "run_machines", runs)
    outcome = several_machines.run_and_write(study, tmp_path)
    read = va.open_machines(tmp_path)
    assert list(read.children) == ["west", "east"]
    xr.testing.assert_equal(read["machines_level"], tree["machines_level"])
    xr.testing.assert_equal(read["east"]["level_total"], tree["east"]["level_total"])
    names = {path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*")}
    assert {"machines.nc", "machines.html", "machines.csv", "beats.csv", "machine_lines.csv",
            "west/report.html", "east/results.nc"} <= names  # fmt: skip
    assert len([name for name in names if name.endswith(".wav")]) == 2
    text = "\n".join(outcome.lines())
    assert "Together at front" in text
    page = (tmp_path / "machines.html").read_text()
    assert "Beats at front" in page
    beats = (tmp_path / "beats.csv").read_text().splitlines()
    assert len(beats) == 1 + 2 * 15
    assert beats[0].startswith("microphone,lines,beat_hz,first_level_db")
    with pytest.raises(va.StorageError, match=r"machines\.nc"):
        va.open_machines(tmp_path / "west")


def test_one_machine_is_not_several(study):
    with pytest.raises(va.ParameterError, match="several machines run by"):
        va.run(study, radiation=made_up_radiation)
    with pytest.raises(va.ParameterError, match="machines: is missing"):
        va.run_machines(va.load_study(ROOT / "tests" / "studies" / "tiny.toml"))


@pytest.mark.parametrize(
    ("before", "after", "words"),
    [
        ('option = "counterweight-half"', 'option = "hood"', "machines.east: option = hood: unk"),
        ("speed_rpm = 2880.0", "speed_rpm = 28.8", "machines.east.speed_rpm = 28.8 rpm: out of"),
        ("speed_rpm = 2880.0", "speed_hz = 48.0", "machines.east.speed_hz"),
        ("angle_deg = 90.0", "angel_deg = 90.0", "machines.east.angel_deg: unknown key"),
        ("[200.0, 0.0]", "[-200.0, 0.0]", "machines.east.position_mm = [-200, 0] mm: is the pos"),
        ("[200.0, 0.0]", "[-100.0, 0.0]", "machines.east.position_mm: is 100 mm from machines.w"),
        ("[200.0, 0.0]", "[200.0]", "machines.east.position_mm"),
        ("[machines.east]", "[machines.beat]", "machines.beat: rename it"),
        ("[machines.east]", '[machines."a/b"]', "machines.a/b: rename it"),
        ("angle_deg = 90.0", 'file = "nothing.toml"', "nothing.toml: no such file"),
        ("[common_receivers.side]", "[common_receivers.front_1m]", "common_receivers.front_1m: is"),
        ("[machines.east]", "[common_receivers.x]\n[machines.east]", "common_receivers.x.x_mm"),
        ("angle_deg = 90.0", "", "[base_frame]\nheight_mm = 60.0"),
    ],
)  # fmt: skip
def test_refusals_are_one_line(tmp_path: Path, before: str, after: str, words: str) -> None:
    text = TWO.read_text().replace('"tiny.toml"', f'"{ROOT}/tests/studies/tiny.toml"')
    if words.startswith("[base_frame]"):
        text, words = f"{text}\n{words}\n", "base_frame.position_mm: is missing"
    file = tmp_path / "two.toml"
    file.write_text(text.replace(before, after))
    outcome = command_here("run", file, "--out", tmp_path / "out")
    assert_refused(outcome, words)
    assert "Traceback" not in outcome.stderr
    assert not (tmp_path / "out").exists()


def test_tables_of_several_machines_need_machines() -> None:
    tiny = va.load_study(ROOT / "tests" / "studies" / "tiny.toml")
    with pytest.raises(va.ParameterError, match=r"base_frame: needs the tables machines\.NAME"):
        tiny.replace(BASE_FRAME)
    with pytest.raises(va.ParameterError, match=r"machines\.a: is the only one"):
        tiny.replace({"machines.a": {"position_mm": [0.0, 0.0], "speed_rpm": 2900.0}})


def test_a_machine_may_have_its_file_and_its_study(study: va.Study, tmp_path: Path) -> None:
    machine = ROOT / "data" / "machines" / "copeland_zp41k3e.toml"
    other = tmp_path / "other.toml"
    text = (ROOT / "tests" / "studies" / "tiny.toml").read_text()
    other.write_text(text.replace("../../data", str(ROOT / "data")).replace("= 16", "= 12"))
    files = {"machines.west.file": str(machine), "machines.east.file": str(other)}
    west, east = machine_studies(study.replace(files)).values()
    assert west.operation.maximum_order == 16
    assert east.operation.maximum_order == 12
    assert list(east.receivers) == ["front_1m", "front", "side"]


def test_check_states_the_cost_of_each_machine() -> None:
    outcome = command_here("check", TWO)
    assert outcome.returncode == 0, outcome.stderr
    assert [f"machine {name}:" in outcome.stdout for name in SPEEDS] == [True, True]
    assert outcome.stdout.count("processor time") == 2
    assert outcome.stdout.endswith("two_tiny.toml: nothing is wrong\n")
