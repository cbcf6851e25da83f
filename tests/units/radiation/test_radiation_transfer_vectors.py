"""Transfer vectors: both sides joined, labelled, interpolated."""

import json
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from sphere_sound import sphere_pressure

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.machine.shell import Shell
from vibroacoustics.radiation.interpolation import interpolant
from vibroacoustics.radiation.machine_side import MachineSide, near_fields
from vibroacoustics.radiation.patterns import rigid_body
from vibroacoustics.radiation.scene import position_m, scene
from vibroacoustics.radiation.sound_field import SoundField
from vibroacoustics.radiation.task import Microphones
from vibroacoustics.radiation.transfer_vectors import (
    cache_key_material,
    interpolate_transfer_vector,
    transfer_vectors,
)
from vibroacoustics.study.body import MeshBody
from vibroacoustics.study.radiation import RadiationSettings
from vibroacoustics.study.receivers import Receiver
from vibroacoustics.study.sound_power import MapSettings
from vibroacoustics.study.surroundings import Surroundings, Wall

SHELL = Shell(
    outer_diameter_m=0.165, height_m=0.417, centre_of_mass_height_m=0.2, floor_clearance_m=0.02
)
RECEIVERS = {
    "side": Receiver(x_m=0.9, y_m=-0.5, height_m=0.4),
    "front": Receiver(x_m=0.0, y_m=0.9, height_m=0.25),
}
SETTINGS = RadiationSettings(
    method="cut-cells",
    near_field_spacing_m=0.035, room_spacing_m=0.06, maximum_frequency_hz=1000.0,
    frequency_step_hz=50.0,
)  # fmt: skip
CLOSED = SETTINGS.model_copy(update={"room_solver": "closed-form"})
MAP = MapSettings(horizontal_m=(-0.6, 0.6), vertical_m=(0.0, 0.8), spacing_m=0.1)
SOUND_FIELD = SoundField(map=MAP, line_frequency_hz=(50.0, 425.0))


@pytest.fixture(scope="module")
def dataset():
    return transfer_vectors(SHELL, RECEIVERS, SETTINGS)


WALL_M = 1.2
MIRRORED = {**RECEIVERS, "image": Receiver(x_m=0.9, y_m=-2.0 * WALL_M + 0.5, height_m=0.4)}
"""With the image of `side` in a wall at y = -1.2 m."""


@pytest.fixture(scope="module")
def closed():
    return transfer_vectors(SHELL, MIRRORED, CLOSED, SOUND_FIELD)


@pytest.mark.slow
def test_dims_units_and_coordinates(dataset):
    for name in ("transfer_vector", "transfer_vector_closed_form", "transfer_vector_error"):
        assert dataset[name].dims == ("receiver", "dof", "frequency")
        assert dataset[name].shape == (2, 6, 20)
        assert dataset[name].attrs["units"] == "Pa s m-1"
    assert dataset["green_difference"].attrs["units"] == "dB"
    np.testing.assert_allclose(dataset["frequency"], 50.0 * np.arange(1, 21))
    np.testing.assert_allclose(dataset["distance"][0], np.sqrt(0.9**2 + 0.5**2 + 0.18**2))


@pytest.mark.slow
def test_kwave_and_closed_form_agree(dataset):
    """0.2 dB where a receiver hears more than 1 % of what the loudest one hears of that motion."""
    simulated = np.abs(dataset["transfer_vector"])
    expected = np.abs(dataset["transfer_vector_closed_form"])
    loud = (expected > 0.01 * expected.max("receiver")) & (expected > 0)
    difference = 20 * np.log10(simulated.where(loud) / expected.where(loud))
    assert float(np.abs(difference).max()) < 0.2
    assert float(np.abs(dataset["green_difference"]).max()) < 0.1


@pytest.mark.slow
def test_error_is_that_of_the_finer_grid(dataset):
    """Real, positive where anything is heard; two cells on the radius leave a fifth or so."""
    error, value = dataset["transfer_vector_error"], np.abs(dataset["transfer_vector"])
    heard = value > 0.1 * value.max("receiver")
    assert np.all(np.isreal(error.values))
    assert np.all(error.values >= 0.0)
    assert np.all(error.values[(heard & (value > 0)).values] > 0.0)
    share = (error / value).where(heard & (value > 0))
    assert float(share.sel(dof=["tx", "ty", "tz"]).max()) < 0.3


@pytest.mark.slow
def test_closed_form_room_is_the_closed_form(closed, dataset):
    assert not {"transfer_vector_closed_form", "green_difference"} & set(closed)
    assert "k-wave" not in closed.attrs["solver"]
    # The same runs of the machine side: only the order of sums may differ.
    expected = dataset["transfer_vector_closed_form"]
    ours = closed["transfer_vector"].sel(receiver=list(RECEIVERS))
    np.testing.assert_allclose(ours, expected, atol=1e-9 * float(np.abs(expected).max()))
    assert closed.attrs["room_solver"] == "closed-form"
    assert "map_transfer_vector" not in dataset


@pytest.mark.slow
def test_symmetry_of_the_cylinder(dataset):
    """In the plane x = 0 nothing is heard of motion along x, nor of rotation about the axis."""
    loudest = np.abs(dataset["transfer_vector"]).max(("receiver", "frequency"))
    front = np.abs(dataset["transfer_vector"].sel(receiver="front"))
    assert float((front.sel(dof="tx") / loudest.sel(dof="tx")).max()) < 2e-3
    assert not dataset["transfer_vector"].sel(dof="rz").values.any()


@pytest.mark.slow
def test_map_is_no_number_inside_the_box(closed):
    """Points on the axis, in the machine, are NaN; those half a metre off are not."""
    field = np.abs(closed["map_transfer_vector"]).sel(dof="tz").isel(line_frequency=0)
    x, z = field["map_x"], field["map_z"]
    inside = (np.abs(x) < 0.0825) & (z > -0.2) & (z < 0.217)
    far = np.maximum(np.abs(x), z - 0.217) > 0.3
    assert inside.any()
    assert np.all(np.isnan(field.values[inside.values]))
    assert np.all(field.values[far.values] > 0.0)
    assert np.isnan(closed["map_transfer_vector"].values).mean() < 0.5


@pytest.mark.slow
def test_interpolation_is_exact_between_the_table(closed):
    """Against the transform of the same run at frequencies off the table, 10 Hz to 990 Hz."""
    wanted = np.array([10.0, 17.3, 48.3, 96.7, 262.5, 487.5, 737.5, 990.0])
    surroundings = scene(SHELL, SETTINGS)
    patterns = [rigid_body("tx"), rigid_body("tz")]
    near = near_fields(surroundings, 0.035, 1000.0)
    microphones = Microphones(position_m(SHELL, RECEIVERS["side"])[None, :])
    side = MachineSide(surroundings, near, patterns, wanted, [microphones])
    (direct,) = side.closed[0].pressure
    interpolated = interpolate_transfer_vector(
        closed["transfer_vector"], xr.DataArray(wanted, dims="order")
    )
    assert interpolated.dims == ("receiver", "dof", "order")
    ours = interpolated.sel(receiver="side", dof=["tx", "tz"]).values
    np.testing.assert_allclose(20 * np.log10(np.abs(ours / direct)), 0.0, atol=0.05)


@pytest.mark.long
def test_absorbing_wall_adds_its_weaker_image(closed):
    """Its echo is not scattered again, so it adds what a microphone at the image hears.

    Times the square root of the energy that comes back, to rounding; the run is the same.
    """
    absorption = 0.75
    walls = {"-y": Wall(distance_m=WALL_M, absorption_ratio=absorption)}
    settings = CLOSED.model_copy(update={"surroundings": Surroundings(walls=walls)})
    side = {"side": RECEIVERS["side"]}
    found = transfer_vectors(SHELL, side, settings)["transfer_vector"].isel(receiver=0)
    free = closed["transfer_vector"]
    expected = free.sel(receiver="side") + np.sqrt(1.0 - absorption) * free.sel(receiver="image")
    np.testing.assert_allclose(found, expected, atol=1e-9 * float(np.abs(expected).max()))
    assert float(np.abs(found / free.sel(receiver="side") - 1).sel(dof="tz").max()) > 0.1


def test_interpolation_of_an_exact_sphere():
    """Closed form at 1 m: below 0.01 dB from 10 Hz to 2.5 kHz on a 25 Hz table."""
    table, wanted = 25.0 * np.arange(1, 101), np.linspace(10.0, 2490.0, 173)
    values = [sphere_pressure(1, 0.0825, 1.0, np.ones(1), f)[:, 0] for f in (table, wanted)]
    ours = interpolant(table, values[0], np.array(1.0))(wanted)
    np.testing.assert_allclose(20 * np.log10(np.abs(ours / values[1])), 0.0, atol=0.01)
    np.testing.assert_allclose(np.angle(ours / values[1]), 0.0, atol=1e-3)


def test_transfer_vectors_to_some_receivers_are_rows_of_those_to_all():
    table, wanted = np.arange(100.0, 1001.0, 100.0), np.array([0.0, 50.0, 333.0, 1000.0])
    random = np.random.default_rng(2)
    values = random.normal(size=(3, 2, table.size)) + 1j * random.normal(size=(3, 2, table.size))
    to_all = interpolant(table, values, np.array([[1.0], [2.0], [0.5]]))
    some = to_all.to([2, 0])
    np.testing.assert_array_equal(some(wanted), to_all(wanted)[[2, 0]])
    np.testing.assert_array_equal(some.to([1])(wanted), to_all(wanted)[[0]])


def test_interpolation_at_zero_and_on_the_table():
    table = 25.0 * np.arange(1, 41)
    values = sphere_pressure(0, 0.1, 1.0, np.ones(1), table)[:, 0]
    assert interpolant(table, values, np.array(1.0))(np.zeros(1))[0] == 0
    np.testing.assert_allclose(interpolant(table, values, np.array(1.0))(table), values)


@pytest.mark.parametrize("frequency", [1000.1, -1.0])
def test_frequencies_off_the_table_are_refused(frequency):
    table = 25.0 * np.arange(1, 41)
    with pytest.raises(ParameterError, match="cover 0 to 1000 Hz"):
        interpolant(table, table + 0j, np.array(1.0))(np.array([frequency]))


@pytest.mark.parametrize("height_m", [0.03, 0.2, 0.43])
def test_receiver_in_the_shell_is_refused_before_any_run(height_m):
    receivers = {"inside": Receiver(x_m=0.0, y_m=0.0, height_m=height_m)}
    with pytest.raises(ParameterError, match=r"receivers\.inside: .* lies in the machine|inside"):
        transfer_vectors(SHELL, receivers, SETTINGS, progress=_no_run)


def test_receiver_too_close_is_refused_before_any_run():
    receivers = {"close": Receiver(x_m=0.15, y_m=0.0, height_m=0.2)}
    with pytest.raises(ParameterError, match=r"receivers\.close: the microphone must stand"):
        transfer_vectors(SHELL, receivers, SETTINGS, progress=_no_run)


def test_receiver_in_the_coarser_grids_box_is_refused_before_any_run():
    """Its box is wider where three cells are more than 40 mm; inside it the join gives nothing."""
    settings = RadiationSettings(
        method="cut-cells",
        near_field_spacing_m=0.05,
        room_spacing_m=0.005,
        maximum_frequency_hz=800.0,
    )
    receivers = {"close": Receiver(x_m=0.0825 + 0.225, y_m=0.0, height_m=0.2)}
    with pytest.raises(ParameterError, match=r"receivers\.close: "):
        transfer_vectors(SHELL, receivers, settings, progress=_no_run)


def test_receiver_behind_a_wall_is_refused_before_any_run():
    walls = {"+y": Wall(distance_m=0.6)}
    settings = SETTINGS.model_copy(update={"surroundings": Surroundings(walls=walls)})
    with pytest.raises(
        ParameterError, match=r"receivers\.front: the microphone lies behind the wall"
    ):
        transfer_vectors(SHELL, RECEIVERS, settings, progress=_no_run)


def _no_run(description, done, total):
    raise AssertionError(f"{description}: ran")


def test_cache_key_covers_what_shapes_the_result():
    material = cache_key_material(SHELL, RECEIVERS, SETTINGS)
    assert material["k_wave"] == "0.6.2"
    text = json.dumps(material, sort_keys=True)
    thicker = SHELL.model_copy(update={"outer_diameter_m": 0.17})
    finer = SETTINGS.model_copy(update={"room_spacing_m": 0.05})
    assert text != json.dumps(cache_key_material(thicker, RECEIVERS, SETTINGS), sort_keys=True)
    assert text != json.dumps(cache_key_material(SHELL, RECEIVERS, finer), sort_keys=True)
    assert text == json.dumps(cache_key_material(SHELL, dict(RECEIVERS), SETTINGS), sort_keys=True)


def test_cache_key_covers_the_source_in_subfolders(tmp_path, monkeypatch):
    """A change of the boundary elements, a folder below, never meets an old cache."""
    module = sys.modules[cache_key_material.__module__]
    copy = shutil.copytree(Path(module.__file__).parent, tmp_path / "radiation")
    monkeypatch.setattr(module, "__file__", str(copy / "transfer_vectors.py"))
    before = cache_key_material(SHELL, RECEIVERS, SETTINGS)["solver"]
    with (copy / "revolution" / "solving.py").open("a") as source:
        source.write("# changed")
    assert cache_key_material(SHELL, RECEIVERS, SETTINGS)["solver"] != before


def test_cache_key_covers_the_content_of_files(tmp_path):
    mesh, table = tmp_path / "body.stl", tmp_path / "bulge.csv"
    mesh.write_bytes(b"one")
    table.write_text("1\n")
    body = MeshBody(kind="mesh", file=str(mesh), patterns={"bulge": str(table)})
    settings = SETTINGS.model_copy(update={"body": body})

    def text():
        return json.dumps(cache_key_material(SHELL, RECEIVERS, settings), sort_keys=True)

    first = text()
    assert first == text()
    mesh.write_bytes(b"two")
    second = text()
    table.write_text("2\n")
    assert len({first, second, text()}) == 3
    mesh.unlink()
    assert text() not in {first, second}


def test_cache_key_covers_surroundings_and_sound_field():
    walls = Surroundings(walls={"-x": Wall(distance_m=1.0)})
    texts = {
        json.dumps(cache_key_material(SHELL, RECEIVERS, settings, field), sort_keys=True)
        for settings in (SETTINGS, CLOSED, SETTINGS.model_copy(update={"surroundings": walls}))
        for field in (SoundField(), SOUND_FIELD)
    }
    assert len(texts) == 6
