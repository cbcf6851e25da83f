"""What pictures show, against modes, transfer vectors and levels evaluated on their own."""

from unittest.mock import patch

import numpy as np
import pytest
from sources_study import SOURCES_STUDY, made_up_modes, run_made_up
from support import ROOT

from vibroacoustics.levels import a_weighting
from vibroacoustics.levels.by_source import filled_thirds
from vibroacoustics.machine.cases import Cases
from vibroacoustics.machine.source import Shared
from vibroacoustics.mechanics.loads import in_shell, summed
from vibroacoustics.mechanics.ports import HOUSING
from vibroacoustics.radiation.revolution.method import by_revolution
from vibroacoustics.radiation.sound_field import SoundField
from vibroacoustics.radiation.transfer_vectors import task_of
from vibroacoustics.results.storage import without_cache
from vibroacoustics.stages.chain import Chain
from vibroacoustics.stages.directivity import Directivity
from vibroacoustics.stages.run_up import RunUp
from vibroacoustics.stages.samples import Samples
from vibroacoustics.stages.shown import Deflection
from vibroacoustics.stages.stage import Given, advanced, applying
from vibroacoustics.study.loading import load_study
from vibroacoustics.transfer.contributions import Transmission, velocities


@pytest.fixture(scope="module")
def chain(tmp_path_factory):
    """Of two sources with a frame, without samples; up to the scores."""
    text = SOURCES_STUDY.read_text(encoding="utf-8")
    text = text.replace('without = ["frame"]\n', "").replace("../../data", str(ROOT / "data"))
    file = tmp_path_factory.mktemp("shapes") / "study.toml"
    file.write_text(text[: text.index("[uncertainty]")] + text[text.index("[radiation]") :])
    study = load_study(file).replace({"sources.keys": None, "radiation.room_solver": "closed-form"})
    chain = Chain(study, lambda study, *_: (made_up_modes(study), False))
    with patch.object(Samples, "run", lambda *_: Given()):
        for stage in applying(study):
            if stage.name not in ("deflection", "directivity", "run-up", "stopping"):
                chain = advanced(chain, stage)
    return chain


def moving(chain, key, name):
    """Modes, and velocities of these and then of the rigid motions at a line, by modal sums."""
    cases, transmission = chain[Cases], chain[Transmission]
    path = transmission.path(Shared(), cases.cases[key].machine, cases.loads[key])
    lines = transmission.lines(key, cases)
    column, hertz = lines.names.index(name), lines.frequency_hz[lines.names.index(name)]
    loads = summed(
        {port: load[:, [column]] for port, load in of.items()} for of in lines.loads.values()
    )
    motion = velocities(path.shell, in_shell(loads), np.array([hertz]))[:, 0]
    motion[-6:] += path.body.response(loads[HOUSING][:, 0], hertz).velocity
    return path.shell.path.modes, motion


def velocity_at(modes, motion, points):
    """Of points by modes and rigid motions, (point, 3)."""
    elastic = sum(one * mode.velocity(points) for mode, one in zip(modes, motion, strict=False))
    return elastic + motion[-6:-3] + np.cross(motion[-3:], points)


def test_deflection_is_the_sum_of_modes_and_rigid_motion(chain):
    shown = advanced(chain, Deflection()).results
    for option in shown["shown_option"].values.tolist():
        of_option = shown.sel(shown_option=option)
        hertz = float(of_option["deflection_frequency"])
        modes, motion = moving(chain, (2900.0, option), str(of_option["deflection_line"].item()))
        for station, angle in ((3, 5), (12, 20), (20, 47)):
            at = of_option.isel(station=station, station_angle=angle)
            radius, turn = float(at["station_radius"]), float(at["station_angle"])
            height = float(at["station_height"])
            point = np.array([[radius * np.cos(turn), radius * np.sin(turn), height]])
            expected = velocity_at(modes, motion, point)[0] / (2j * np.pi * hertz)
            size = abs(of_option["deflection"].values).max()
            assert at["deflection"].values == pytest.approx(expected, abs=1e-6 * size)
        foot = of_option["foot_position"].values[1]
        expected = (motion[-6:-3] + np.cross(motion[-3:], foot)) / (2j * np.pi * hertz)
        assert of_option["deflection_foot"].values[1] == pytest.approx(expected, rel=1e-9)


def test_rings_lie_on_the_shell_and_the_elastic_part_is_seen(chain):
    shown, shell = advanced(chain, Deflection()).results, chain.study.machine.shell
    radius, height = shown["station_radius"].values, shown["station_height"].values
    assert radius.max() == shell.cylinder.radius_m
    assert radius[[0, -1]] == pytest.approx([0.0, 0.0])
    assert np.ptp(height) == pytest.approx(shell.height_m)
    of_none = shown.sel(shown_option="none")
    elastic = of_none["deflection"].std("station_angle").max() / abs(of_none["deflection"]).max()
    assert float(elastic) > 0.1


def test_the_line_is_the_loudest_one(chain):
    results = advanced(chain, Deflection()).results
    at = {"speed": 2900.0, "option": "none", "receiver": "front_1m"}
    pressure = results["pressure_line"].sel(at).sum("sound_source")
    hertz = results["tone_frequency"].sel(speed=2900.0).values[1:]
    audible = abs(pressure.values[1:]) * 10.0 ** (a_weighting(hertz) / 20.0)
    loudest = results["line"].values[1:][np.argmax(audible)]
    assert results["deflection_line"].sel(shown_option="none") == loudest


def test_forces_of_the_section_are_the_loads_at_the_heights_of_the_parts(chain):
    shown = advanced(chain, Deflection()).results.sel(shown_option="none")
    cases, machine = chain[Cases], chain.study.machine
    lines = chain[Transmission].lines((2900.0, "none"), cases)
    loads = summed(lines.loads.values())
    heights = {"housing": 0.0, "fixed_scroll": machine.frame.fixed_scroll.height_m}
    for line, name in (("order 1", "order 1"), ("loudest", shown["deflection_line"].item())):
        column = lines.names.index(name)
        for port, load in loads.items():
            at = shown.sel(section_line=line, load_port=port.name)
            assert at["section_force"].values == pytest.approx(load[:3, column], abs=1e-12)
            height = heights.get(port.name, at["load_port_height"].item())
            assert at["load_port_height"] == height
    assert abs(shown["section_force"]).max() > 1.0


def with_boundary_elements(chain):
    names = ["boundary elements, image sources"] * len(chain.study.receivers)
    return chain.having(results=chain.results.assign_coords(radiation_method=("receiver", names)))


class Combined:
    """One motion of the surface: that of all loads at a line, its real or imaginary part."""

    def __init__(self, name, modes, motion):
        self.name, self.modes, self.motion = name, modes, motion

    def velocity(self, points):
        """Real velocity at points."""
        return velocity_at(self.modes, self.motion, points).real


def test_directivity_is_the_sound_of_the_moving_shell(chain):
    """One boundary-element solution for the motion of all loads together, line by line."""
    study = chain.study
    with without_cache():
        around = advanced(with_boundary_elements(chain), Directivity()).results
    nominal = float(around["polar_band"][-1])
    (band,) = [one for one in filled_thirds(1200.0) if one.nominal_hz == nominal]
    radius = float(around["polar_radius"])
    turns = np.radians([20.0, 150.0, 60.0])
    points = radius * np.array(
        [[np.cos(turns[0]), np.sin(turns[0]), 0.0], [np.cos(turns[1]), np.sin(turns[1]), 0.0],
         [np.cos(turns[2]), 0.0, np.sin(turns[2])]]
    )  # fmt: skip
    shown = around["polar_level"].sel(shown_option="none", polar_band=nominal).values
    cases = chain[Cases]
    lines = chain[Transmission].lines((2900.0, "none"), cases)
    square = np.zeros(3)
    for name, hertz in zip(lines.names, lines.frequency_hz.tolist(), strict=True):
        if not band.lower_hz <= hertz < band.upper_hz:
            continue
        modes, motion = moving(chain, (2900.0, "none"), name)
        parts = [Combined("real", modes, motion), Combined("imaginary", modes, -1j * motion)]
        task = task_of(study.machine.shell, {}, study.radiation, SoundField(), parts)
        solved = by_revolution(study.machine.shell, task).side.finer_pressures(hertz, points)
        peak = solved[:, 6] + 1j * solved[:, 7]
        square += 0.5 * abs(peak) ** 2 * 10.0 ** (a_weighting(hertz) / 10.0)
    assert not [noise for load in cases.loads[2900.0, "none"].values() for noise in load.noise]
    expected = 10.0 * np.log10(square / 4e-10)
    found = [shown[0, 2], shown[0, 15], shown[1, 6]]
    assert found == pytest.approx(expected, abs=1e-5)


def test_directions_under_the_floor_have_no_level(chain):
    with without_cache():
        level = advanced(with_boundary_elements(chain), Directivity()).results["polar_level"]
    silent = np.isnan(level.isel(shown_option=0, polar_band=0).values)
    assert not silent[0].any()
    assert silent[1, 27]
    assert not silent[1, :19].any()


def test_given_radiation_has_no_directivity(chain):
    assert "polar_level" not in advanced(chain, Directivity()).results


def test_run_up_at_the_speed_of_the_study_is_its_level(chain):
    results = advanced(chain, RunUp()).results
    speeds = results["run_up_speed"].values
    assert speeds[[0, -1]] == pytest.approx([0.8 * 2900.0, 1.2 * 2900.0])
    at, own = {"run_up_speed": 2900.0}, {"speed": 2900.0, "option": "none"}
    for name, study_name in (
        ("run_up_source_level", "source_level"),
        ("run_up_level", "level_total"),
        ("run_up_unmodelled_level", "level_unmodelled"),
    ):
        expected = results[study_name]
        expected = expected.sel(own) if "speed" in expected.dims else expected
        found = results[name].sel(at)
        if "receiver" not in expected.dims:
            found = found.sel(receiver="front_1m")
        assert found.values == pytest.approx(expected.values, abs=1e-9)
    orders = results["run_up_order_level"].sel(at)
    expected = results["order_level"].sel(own).sel(weighting="A")
    held = orders["run_up_order"].values[orders["run_up_order"].values <= 16.0]
    assert held.size > 5
    expected = expected.sel(order=held).transpose("receiver", "order").values
    shown = orders.sel(run_up_order=held).transpose("receiver", "run_up_order").values
    assert shown == pytest.approx(expected, abs=1e-9)


def test_run_up_at_another_speed_is_the_level_of_a_study_at_that_speed(chain):
    """Its supply is in proportion to the speed."""
    results = advanced(chain, RunUp()).results
    speed = float(results["run_up_speed"][3])
    study = chain.study.replace(
        {
            "operation.speed_rpm": [2900.0, speed],
            "operation.supply_frequency_hz": [50.0, 50.0 * speed / 2900.0],
        }
    )
    with patch.object(Samples, "run", lambda *_: Given()):
        other = run_made_up(study)
    own = {"speed": speed, "option": "none"}
    shown = results.sel(run_up_speed=speed)
    expected = other["source_level"].sel(own).values
    assert shown["run_up_source_level"].values == pytest.approx(expected, abs=1e-6)
    assert shown["run_up_level"].values == pytest.approx(other["level_total"].sel(own).values)


def test_a_study_of_many_speeds_or_of_a_slow_machine_has_no_run_up(chain):
    study, speeds = chain.study, [2900.0 + 10.0 * number for number in range(6)]
    many = {"operation.speed_rpm": speeds, "operation.supply_frequency_hz": [50.0] * 6}
    assert RunUp().applies(study)
    assert not RunUp().applies(study.replace(many))
    slow = load_study(ROOT / "pipelines" / "estupinan_hermetic.toml")
    assert not RunUp().applies(slow)


def test_the_run_up_is_tried_before_there_are_ranks(chain):
    early = chain.having(results=chain.results.drop_vars("rank"))
    trial = RunUp().tried(early, chain.study)
    (cost,) = trial.costs
    assert cost.high_s > 0.0
    assert "run_up_level" in trial.chain.results
