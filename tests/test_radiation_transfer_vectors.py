"""Transfer vectors: both sides joined, labelled, interpolated."""

import json

import numpy as np
import pytest
import xarray as xr

from vibroacoustics.errors import ParameterError
from vibroacoustics.parameters.radiation import RadiationSettings
from vibroacoustics.parameters.receivers import Receiver
from vibroacoustics.parameters.shell import Shell
from vibroacoustics.radiation.exact import box_green, sphere_pressure
from vibroacoustics.radiation.interpolation import interpolate
from vibroacoustics.radiation.join import join
from vibroacoustics.radiation.near_field import NearField
from vibroacoustics.radiation.patterns import rigid_body
from vibroacoustics.radiation.transfer_vectors import (
    cache_key_material,
    cylinder,
    interpolate_transfer_vector,
    transfer_vectors,
)

SHELL = Shell(
    outer_diameter_m=0.165, height_m=0.417, centre_of_mass_height_m=0.2, floor_clearance_m=0.02
)
RECEIVERS = {
    "side": Receiver(x_m=0.8, y_m=-0.5, height_m=0.4),
    "front": Receiver(x_m=0.0, y_m=0.9, height_m=0.25),
}
SETTINGS = RadiationSettings(
    near_field_spacing_m=0.0165, room_spacing_m=0.06, maximum_frequency_hz=1000.0
)


@pytest.fixture(scope="module")
def dataset():
    return transfer_vectors(SHELL, RECEIVERS, SETTINGS)


@pytest.mark.slow
def test_dims_units_and_coordinates(dataset):
    assert dataset["transfer_vector"].dims == ("receiver", "dof", "frequency")
    assert dataset["transfer_vector"].shape == (2, 6, 40)
    assert dataset["transfer_vector"].attrs["units"] == "Pa s m-1"
    assert dataset["green_difference"].attrs["units"] == "dB"
    np.testing.assert_allclose(dataset["frequency"], 25.0 * np.arange(1, 41))
    np.testing.assert_allclose(dataset["distance"][0], np.sqrt(0.8**2 + 0.5**2 + 0.18**2))


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
def test_symmetry_of_the_cylinder(dataset):
    """In the plane x = 0 nothing is heard of motion along x, nor of rotation about the axis."""
    loudest = np.abs(dataset["transfer_vector"]).max(("receiver", "frequency"))
    front = np.abs(dataset["transfer_vector"].sel(receiver="front"))
    assert float((front.sel(dof="tx") / loudest.sel(dof="tx")).max()) < 2e-3
    assert not dataset["transfer_vector"].sel(dof="rz").values.any()


@pytest.mark.slow
def test_interpolation_is_exact_between_the_table(dataset):
    """Against the transform of the same run at frequencies off the table, 10 Hz to 990 Hz."""
    wanted = np.array([10.0, 17.3, 48.3, 96.7, 262.5, 487.5, 737.5, 990.0])
    near = NearField(cylinder(SHELL), SETTINGS.near_field_spacing_m, 1000.0, SHELL.floor_z_m)
    position = np.array([0.8, -0.5, SHELL.floor_z_m + 0.4])
    green = box_green(near.box, position, wanted, SHELL.floor_z_m)
    interpolated = interpolate_transfer_vector(
        dataset["transfer_vector_closed_form"], xr.DataArray(wanted, dims="order")
    )
    assert interpolated.dims == ("receiver", "dof", "order")
    for dof in ("tx", "tz"):
        direct = join(near.box, near.radiate(rigid_body(dof), wanted), green)
        ours = interpolated.sel(receiver="side", dof=dof).values
        np.testing.assert_allclose(20 * np.log10(np.abs(ours / direct)), 0.0, atol=0.05)


def test_interpolation_of_an_exact_sphere():
    """Closed form at 1 m: below 0.01 dB from 10 Hz to 2.5 kHz on a 25 Hz table."""
    table, wanted = 25.0 * np.arange(1, 101), np.linspace(10.0, 2490.0, 173)
    values = [sphere_pressure(1, 0.0825, 1.0, np.ones(1), f)[:, 0] for f in (table, wanted)]
    ours = interpolate(table, values[0], np.array(1.0), wanted)
    np.testing.assert_allclose(20 * np.log10(np.abs(ours / values[1])), 0.0, atol=0.01)
    np.testing.assert_allclose(np.angle(ours / values[1]), 0.0, atol=1e-3)


def test_interpolation_at_zero_and_on_the_table():
    table = 25.0 * np.arange(1, 41)
    values = sphere_pressure(0, 0.1, 1.0, np.ones(1), table)[:, 0]
    assert interpolate(table, values, np.array(1.0), np.zeros(1))[0] == 0
    np.testing.assert_allclose(interpolate(table, values, np.array(1.0), table), values)


@pytest.mark.parametrize("frequency", [1000.1, -1.0])
def test_frequencies_off_the_table_are_refused(frequency):
    table = 25.0 * np.arange(1, 41)
    with pytest.raises(ParameterError, match="cover 0 to 1000 Hz"):
        interpolate(table, table + 0j, np.array(1.0), np.array([frequency]))


def test_receiver_in_the_shell_is_refused_before_any_run():
    receivers = {"inside": Receiver(x_m=0.0, y_m=0.0, height_m=0.2)}
    with pytest.raises(ParameterError, match=r"receivers\.inside: the microphone must stand"):
        transfer_vectors(SHELL, receivers, SETTINGS)


def test_cache_key_covers_what_shapes_the_result():
    material = cache_key_material(SHELL, RECEIVERS, SETTINGS)
    assert material["k_wave"] == "0.6.2"
    text = json.dumps(material, sort_keys=True)
    thicker = SHELL.model_copy(update={"outer_diameter_m": 0.17})
    finer = SETTINGS.model_copy(update={"room_spacing_m": 0.05})
    assert text != json.dumps(cache_key_material(thicker, RECEIVERS, SETTINGS), sort_keys=True)
    assert text != json.dumps(cache_key_material(SHELL, RECEIVERS, finer), sort_keys=True)
    assert text == json.dumps(cache_key_material(SHELL, dict(RECEIVERS), SETTINGS), sort_keys=True)
