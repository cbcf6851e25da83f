"""What the page holds of a run for its script."""

import json
import zlib

import numpy as np
import pytest
import xarray as xr
from pages import page_of
from support import PIPELINES, tiny_run
from test_report import make_results

import vibroacoustics as va
from vibroacoustics.balancers.counterweight import Counterweight
from vibroacoustics.live.lines import Lines
from vibroacoustics.live.mounts import mount_matrices
from vibroacoustics.live.moving import moving_of, unit_loads, weight_of
from vibroacoustics.live.numbers import FEW_BITS, NOTHING, Numbers
from vibroacoustics.live.section import full_scale_pa, live_data
from vibroacoustics.mechanics.moving_parts import derivative, wrench
from vibroacoustics.mechanics.rotation import Rotation
from vibroacoustics.orders.spectrum import order_spectrum_at_speed
from vibroacoustics.report.blocks import Live, Part
from vibroacoustics.report.live.assets import live_script, live_style, packed, unpacking_script
from vibroacoustics.report.sections import SECTIONS
from vibroacoustics.transfer import on_mounts

SPEED = np.array([2900.0])


def test_scripts_and_style_take_a_quarter_of_the_room():
    scripts = unpacking_script() + packed(live_script().encode())
    assert len((scripts + live_style()).encode()) < 50_000
    assert unpacked(packed(live_script().encode())).decode() == live_script()


@pytest.fixture(scope="module")
def results() -> xr.Dataset:
    return tiny_run()


def unpacked(text: str) -> bytes:
    """By the definition: digits of base 85, the letters from ( to ~ without < and backslash."""
    letters = [chr(code) for code in range(40, 127) if chr(code) not in "<\\"]
    digits = [letters.index(one) for one in text] + [84] * (-len(text) % 5)
    words = np.array(digits).reshape(-1, 5) @ 85 ** np.arange(4, -1, -1)
    return zlib.decompress(words.astype(">u4").tobytes()[: 4 * len(text) // 5])


def read(text: str) -> np.ndarray:
    planes = np.frombuffer(unpacked(text), dtype=np.uint8)
    return planes.reshape(4, -1).T.copy().view("<f4").ravel()


@pytest.mark.parametrize("size", range(9))
def test_letters_hold_any_bytes(size):
    content = np.random.default_rng(size).bytes(1000 + size)
    text = packed(content)
    assert unpacked(text) == content
    assert not set(text) & set("<&\"'\\")
    assert len(text) <= 1.25 * len(zlib.compress(content, 9)) + 1


def test_numbers_come_back_and_equal_ones_are_kept_once():
    numbers = Numbers()
    values = np.geomspace(1e-9, 1e9, 500) * np.resize([1.0, -1.0], 500)
    few = numbers.put(values, FEW_BITS)
    both = numbers.put(np.array([1.0 + 2.0j, -3.0j]))
    assert numbers.put(np.array([[1.0 + 2.0j], [-3.0j]])) == both
    assert numbers.put_unless(np.ones(3), 1.0) == NOTHING
    known = read(numbers.text)
    assert known.size == 504
    np.testing.assert_allclose(known[few : few + 500], values, rtol=2.0**-16)
    assert np.max(np.abs(known[few : few + 500] / values - 1.0)) > 2.0**-18
    np.testing.assert_array_equal(known[both:], [1.0, 2.0, 0.0, -3.0])


@pytest.mark.parametrize("name", ["copeland_thesis", "dagilis_slider_link"])
def test_matrices_make_the_receptance_of_other_mounts(name):
    machine = va.load_study(PIPELINES / f"{name}.toml").machine
    matrices = mount_matrices(machine)
    lateral, vertical, loss = matrices.values
    assert lateral == machine.mounts.lateral_stiffness_n_per_m
    lateral, vertical, loss = 1.7 * lateral, 0.6 * vertical, loss + 0.1
    springs = lateral * matrices.lateral + vertical * matrices.vertical
    omega = 2.0 * np.pi * 31.0
    dynamic = springs + matrices.elastic - omega**2 * matrices.mass + 1j * (
        loss * springs + matrices.elastic_loss + omega * matrices.damping
    )  # fmt: skip
    changed = {
        "lateral_stiffness_n_per_m": lateral,
        "vertical_stiffness_n_per_m": vertical,
        "loss_factor_ratio": loss,
    }
    mounts = machine.mounts.model_copy(update=changed)
    other = on_mounts(machine.model_copy(update={"mounts": mounts}))
    np.testing.assert_allclose(
        np.linalg.inv(dynamic), other.isolation.receptance(31.0), rtol=1e-9, atol=1e-18
    )


def test_a_weight_on_an_uneven_shaft_is_that_of_its_option():
    machine = va.load_study(PIPELINES / "mayekawa_wbhe.toml").machine
    angle = 2.0 * np.pi * np.arange(256) / 256
    speed = 80.0 * (1.0 + 0.1 * np.cos(angle) + 0.02 * np.sin(2.0 * angle))
    rotation = Rotation(speed, speed * derivative(speed, 1))
    coords = {"crank_angle": angle, "order": np.arange(9)}
    motion = {"shaft_speed": speed, "shaft_acceleration": rotation.acceleration_rad_per_s2}
    at = xr.Dataset({name: ("crank_angle", values) for name, values in motion.items()}, coords)
    weight = weight_of(machine, np.array([40.0]), SPEED)
    mass, turn, height = 0.3, 1.1, 0.04
    option = Counterweight(mass_kg=mass, radius_m=weight.radius_m, angle_rad=turn, height_m=height)
    revolution = va.Revolution(2900.0, rotation, {})
    made = wrench(option.added(machine, revolution).parts, rotation)
    expected = order_spectrum_at_speed(np.concatenate(made), speed, 8)
    ahead, moment = mass * weight.radius_m * unit_loads(machine, at, weight)
    shaft = np.array(weight.shaft)
    force = np.cos(turn) * ahead + np.sin(turn) * np.cross(shaft[:, None], ahead, axis=0)
    arm = np.array(weight.origin_m) + height * shaft
    size = np.abs(expected).max()
    np.testing.assert_allclose(force, expected[:3], atol=1e-8 * size)
    np.testing.assert_allclose(
        np.cross(arm[:, None], force, axis=0) + moment, expected[3:], atol=1e-8 * size
    )
    assert np.abs(moment).max() > 1e-3 * size


def test_a_page_holds_the_energy_of_its_lines_and_the_rest(results):
    page = json.loads(live_data(results))
    (case,) = page["cases"]
    assert case["order"] == [1.0]
    assert page["weight"]["radius_m"] == 0.025
    numbers, microphones = read(page["numbers"]), len(page["microphones"])
    rest = np.array([numbers[first : first + microphones] for first in case["rest"]])
    level = 10.0 * np.log10(rest / 4e-10)
    total = results["level_total"].values[0]
    assert np.all(level < total)
    np.testing.assert_allclose(level, total, atol=0.2)


def test_full_scale_has_room_for_all():
    peak = np.array([[[0.003 + 0.004j, 0.01]]])
    noise = np.array([[[0.0002, 0.0002]]])
    nothing = np.zeros(0)
    no_phase = np.zeros(0, dtype=bool)
    lines = Lines(nothing, nothing, peak, peak, nothing, no_phase, nothing, nothing, noise)
    assert full_scale_pa([lines]) == pytest.approx(0.2)  # 2 (0.015 + 4 × 0.02) = 0.19


def test_nothing_moves_over_sound_measured_by_force(results):
    parameters = json.loads(results.attrs["parameters"])
    parameters["measured"] = {"sound": {"file": "a.csv"}}
    other = results.assign_attrs(parameters=json.dumps(parameters))
    assert moving_of(results) is not None
    assert moving_of(other) is None


def test_nothing_moves_where_the_machine_is_not_known_or_another(results):
    for table, values in (({"kind": "a third party's"}, {}), ({}, {"mass_kg": 50.0})):
        parameters = json.loads(results.attrs["parameters"])
        parameters["machine"] |= table
        parameters["machine"]["housing"] |= values
        assert moving_of(results.assign_attrs(parameters=json.dumps(parameters))) is None


def test_results_without_noise_have_no_such_section(results):
    section = SECTIONS["live"]
    assert section.applies(results)
    assert not section.applies(make_results({"none": 1.0}))


def test_names_cannot_end_the_script_and_markdown_leaves_it_out():
    evil = '{"a": "</script><script>alert(1)</script>"}'
    page = page_of(Part("live", "Try it", (Live(evil),)))
    text = page.html().decode()
    assert evil not in text
    assert "\\u003c/script>" in text
    assert "alert" not in page.markdown().decode()
