"""Every public thing has an example, and the examples run.

They run in a folder that holds what the commands write, of a small study and of a recording.
"""

import doctest
import inspect
import json
import os
import sys
from collections.abc import Iterator
from pathlib import Path

import hammer_records
import in_situ_bench
import measured_bench
import numpy as np
import pytest
import pyuff
import xarray as xr
from pictures import draw_nothing
from sources_study import SOURCES_STUDY, run_made_up
from support import ROOT

import vibroacoustics as va
from vibroacoustics.base import registry
from vibroacoustics.base.vocabulary import RIGID_BODY_DOFS, label_coordinates, stamp
from vibroacoustics.commands.balancing.template import TEMPLATE
from vibroacoustics.commands.permits.template import TEMPLATE as PERMIT
from vibroacoustics.results import storage

PUBLIC = {f"va.{name}": getattr(va, name) for name in va.__all__}
PUBLIC |= {f"va.plot.{name}": getattr(va.plot, name) for name in va.plot.__all__}
FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
LONG = {"va.impulse_responses"}
"""Waves in a whole room."""
REFUSE_NOTHING = {"va.circling", "va.constant_rotation", "va.wrenches_of_parts"}
GRID = np.meshgrid(np.linspace(-1.0, 1.0, 5), np.linspace(0.0, 1.0, 4))
LINE_HZ = np.array([48.0])


@pytest.fixture(scope="module")
def workplace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the package's data and with results of each kind."""
    folder = tmp_path_factory.mktemp("workplace")
    for name in ("data", "pipelines"):
        (folder / name).symlink_to(ROOT / name)
    few = {"uncertainty": None, "options.twin-oldham": None, "sources.keys": None}
    results = run_made_up(va.load_study(SOURCES_STUDY).replace(few))
    storage.write_results(results.merge(_differences(results)), folder / "results.nc")
    storage.write_results(_in_a_room(results), folder / "kitchen.nc")
    storage.write_results(_radiated(), folder / "transfer_vectors.nc")
    recording = _run_up()
    speed = va.SpeedChannel("speed")
    orders = va.analyse_orders(recording, va.OrderAnalysis(speed, (1.0, 2.0), 8.0, with_map=True))
    tracked = va.track_orders(recording, speed, (1.0, 2.0), 2.0)
    datasets = {
        "orders.nc": orders,
        "compared_orders.nc": va.compare(orders, orders),
        "tracked_orders.nc": tracked,
        "speed_map.nc": va.speed_frequency_map(recording, speed, 8.0, 400.0),
    }
    for name, dataset in datasets.items():
        storage.write_results(dataset, folder / name)
    _write_modes(folder / "modes.uff")
    inner = va.curves(va.load_study(ROOT / "pipelines" / "copeland_thesis.toml"))
    storage.write_results(inner, folder / "curves.nc")
    storage.write_results(_predicted(folder / "bench"), folder / "prediction.nc")
    hammer_records.write(folder / "bench")
    (folder / "fan").mkdir()
    (folder / "fan" / "balancing.toml").write_text(TEMPLATE)
    (folder / "heat_pump").mkdir()
    (folder / "heat_pump" / "permit.toml").write_text(PERMIT)
    (folder / "in_situ").mkdir()
    in_situ = in_situ_bench.write(folder / "in_situ", in_situ_bench.BELOW)
    storage.write_results(va.blocked_forces(in_situ), folder / "blocked_forces.nc")
    return folder


def _predicted(folder: Path) -> xr.Dataset:
    folder.mkdir()
    softer = "".join(
        f"[changes.softer.mounts.{name}]\nstiffness_n_per_mm = 100.0\nloss_factor_percent = 10.0\n"
        for name in ("one", "two", "three", "four")
    )
    before = measured_bench.state(measured_bench.FREQUENCY, measured_bench.AS_MEASURED)
    return va.predict(measured_bench.write(folder, softer, before))


def _differences(results: xr.Dataset) -> xr.Dataset:
    """What only k-Wave, a map and a baseline give."""
    gap = np.zeros((results.sizes["receiver"], results.sizes["frequency"]))
    by_speed = {"speed": results["speed"], "option": results["option"]}
    shape = (results.sizes["speed"], results.sizes["option"], *GRID[0].shape)
    at = {"receiver": results["receiver"], "frequency": results["frequency"]}
    level = stamp("map_level", np.broadcast_to(30.0 - 9.0 * GRID[1], shape), by_speed)
    gaps = stamp("green_difference", gap, at)
    in_bands = by_speed | {"receiver": results["receiver"], "baseline_band": [100.0, 125.0]}
    measured = np.full((*shape[:2], results.sizes["receiver"], 2), 60.0)
    bands = stamp("baseline_band_level", measured, in_bands)
    around = {
        "shown_option": results["shown_option"].values, "polar_band": [500.0],
        "polar_plane": ["horizontal"], "polar_direction": [0.0, 2.0, 4.0],
    }  # fmt: skip
    polar = stamp("polar_level", np.full((len(around["shown_option"]), 1, 1, 3), 40.0), around)
    radius = stamp("polar_radius", 1.1, {})
    named = {one.name: one for one in (gaps, level, bands, polar, radius)}
    return xr.Dataset(named, coords=_plane())


def _in_a_room(results: xr.Dataset) -> xr.Dataset:
    """What is drawn of a room."""
    listener = {"x_m": 2.0, "y_m": 2.2, "height_m": 1.2}
    room = {"size_m": [4.0, 3.0, 2.5], "foot_m": [3.5, 0.4], "furniture": {}}
    parameters = {**json.loads(results.attrs["parameters"]), "room": room}
    room["listeners"] = {"table": listener}
    on_plane = {"room_map_y": [0.5, 1.5, 2.5], "room_map_x": [1.0, 2.0, 3.0]}
    at_seam = {"listener": ["table"], "seam_band": [400.0, 500.0, 630.0]}
    levels = stamp("room_map_level", np.array(3 * [[40.0, 42.0, 44.0]]), on_plane)
    seam = [
        stamp(name, np.array([[-8.0, -7.0, -9.0]]), at_seam)
        for name in ("room_gain_waves", "room_gain_diffuse", "room_gain_difference")
    ]
    place = {"height_m": 1.2, "speed_rpm": 2900.0, "highest_band_hz": 400.0}
    band = {"seam_band": at_seam["seam_band"]}
    gain = stamp("room_place_gain", np.array([-1.0, 0.0, 1.0]), band)
    return xr.Dataset(
        {one.name: one for one in (levels.assign_attrs(place), gain, *seam)},
        attrs={"parameters": json.dumps(parameters)},
    )


def _plane() -> dict[str, tuple[tuple[str, str], np.ndarray]]:
    places = {"map_x": GRID[0], "map_y": 0.0 * GRID[0], "map_z": GRID[1]}
    return {name: (("map_row", "map_column"), values) for name, values in places.items()}


def _radiated() -> xr.Dataset:
    """A field that grows with the frequency, everywhere alike."""
    dofs, frequency = list(RIGID_BODY_DOFS), np.array([50.0, 200.0, 1000.0])
    polar, azimuth = np.linspace(0.0, np.pi / 2.0, 4), np.linspace(0.0, 1.5 * np.pi, 4)
    coords = {"receiver": ["front", "left"], "dof": dofs, "frequency": frequency}
    lines = {"dof": dofs, "line_frequency": LINE_HZ}
    sizes = np.broadcast_to(0.1 * frequency + 0j, (2, 6, 3))
    on_map = np.broadcast_to((2.0 + GRID[0] + 0j)[..., None, None], (*GRID[0].shape, 6, 1))
    around = {**lines, "polar_angle": polar, "azimuth": azimuth}
    variables = {
        "transfer_vector": stamp("transfer_vector", sizes, coords),
        "map_transfer_vector": stamp("map_transfer_vector", on_map, lines),
        "directivity_transfer_vector": stamp(
            "directivity_transfer_vector", np.ones((4, 4, 6, 1), complex), around
        ),
    }
    return label_coordinates(xr.Dataset(variables, coords=_plane()))


def _run_up() -> xr.Dataset:
    rate_hz = 1024.0
    time = np.arange(int(6.0 * rate_hz)) / rate_hz
    angle = 2.0 * np.pi * (20.0 * time + 2.0 * time**2)
    signal = np.cos(angle) + 0.3 * np.cos(2.0 * angle)
    rpm = 60.0 * (20.0 + 4.0 * time)
    names, units = ["ring", "front", "speed"], ["m/s²", "Pa", "rpm"]
    return va.label_recording([signal, 0.02 * signal, rpm], rate_hz, names, units)


def _write_modes(path: Path) -> None:
    nodes = np.arange(1, 6)
    sets = [
        pyuff.prepare_164(
            units_code=1, units_description="SI", temp_mode=1, length=1.0, force=1.0, temp=1.0,
            temp_offset=273.15,
        ),
        pyuff.prepare_15(
            node_nums=nodes, x=0.1 * nodes, y=0.0 * nodes, z=0.0 * nodes, color=0 * nodes + 1,
            def_cs=0 * nodes, disp_cs=0 * nodes,
        ),
    ]  # fmt: skip
    for number in (1, 2):
        shape = np.sin(number * nodes)
        sets.append(
            pyuff.prepare_55(
                model_type=1, id1="shell", analysis_type=2, data_ch=2, spec_data_type=8,
                data_type=2, n_data_per_node=3, load_case=1, mode_n=number, freq=100.0 * number,
                modal_m=1.0, modal_damp_vis=0.01, modal_damp_his=0.0, node_nums=nodes,
                r1=shape, r2=shape, r3=shape,
            )
        )  # fmt: skip
    pyuff.UFF(str(path)).write_sets(sets, "overwrite")


@pytest.fixture
def in_workplace(workplace: Path) -> Iterator[None]:
    """The folder as the working folder; what an example registers is forgotten after it."""
    before, modules = os.getcwd(), set(sys.modules)
    known = [(each, dict(each._things), dict(each._origins)) for each in _filled()]
    os.chdir(workplace)
    yield
    os.chdir(before)
    for each, things, origins in known:
        each._things, each._origins = things, origins
    for name in set(sys.modules) - modules:
        if name.startswith("plugin_"):
            del sys.modules[name]


def _filled() -> list[registry.Registry]:
    for each in registry._REGISTRIES:
        len(each)  # fills it
    return registry._REGISTRIES


def _examples(name: str, thing: object) -> list[doctest.DocTest]:
    globs = {"va": va, "np": np, "__name__": "notebook"}
    if inspect.ismodule(thing):
        return [doctest.DocTestParser().get_doctest(thing.__doc__ or "", globs, name, None, 0)]
    tests = doctest.DocTestFinder(recurse=False).find(thing, name, globs=globs)
    methods = vars(thing).items() if isinstance(thing, type) else ()
    for key, method in methods:
        if inspect.isfunction(method) and not key.startswith("_"):
            tests += doctest.DocTestFinder(recurse=False).find(method, f"{name}.{key}", globs=globs)
    return tests


@pytest.mark.usefixtures("in_workplace")
@pytest.mark.parametrize(
    "name", [pytest.param(one, marks=[pytest.mark.long] * (one in LONG)) for one in PUBLIC]
)
def test_examples_run(name, monkeypatch):
    draw_nothing(monkeypatch)
    tests = _examples(name, PUBLIC[name])
    assert tests[0].examples, "has no example"
    runner = doctest.DocTestRunner(optionflags=FLAGS)
    report: list[str] = []
    for test in tests:
        runner.run(test, out=report.append)
    assert not runner.summarize(verbose=False).failed, "".join(report)


def test_a_wrong_example_is_seen():
    test = doctest.DocTestParser().get_doctest(">>> 1 + 1\n3\n", {}, "wrong", None, 0)
    assert doctest.DocTestRunner().run(test, out=lambda _: None).failed == 1


def test_docstrings_of_functions_describe_what_they_take():
    """Parameters where there are any; errors where the function can refuse its input."""
    for name, thing in PUBLIC.items():
        if inspect.isfunction(thing) and inspect.signature(thing).parameters:
            for title in ("Parameters",) if name in REFUSE_NOTHING else ("Parameters", "Raises"):
                assert title in (thing.__doc__ or ""), f"{name}: no section {title}"
