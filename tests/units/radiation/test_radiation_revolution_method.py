"""Boundary elements as a study's method: its settings, microphones, maps and k-Wave's room."""

from types import SimpleNamespace

import numpy as np
import pytest
from pydantic import ValidationError

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.machine.shell import Shell
from vibroacoustics.radiation.revolution.method import join_box
from vibroacoustics.radiation.sound_field import SoundField
from vibroacoustics.radiation.transfer_vectors import transfer_vectors
from vibroacoustics.study.body import BoxBody, SphereBody
from vibroacoustics.study.radiation import RadiationSettings
from vibroacoustics.study.receivers import Receiver
from vibroacoustics.study.sound_power import DirectivitySettings, MapSettings, SoundPowerSettings
from vibroacoustics.study.surroundings import Surroundings, Wall

SHELL = Shell(
    outer_diameter_m=0.165, height_m=0.417, centre_of_mass_height_m=0.2, floor_clearance_m=0.02
)
RECEIVERS = {
    "side": Receiver(x_m=0.9, y_m=-0.5, height_m=0.4),
    "front": Receiver(x_m=0.0, y_m=0.9, height_m=0.25),
}
SETTINGS = RadiationSettings(
    method="revolution", room_solver="closed-form", room_spacing_m=0.06,
    maximum_frequency_hz=1000.0, frequency_step_hz=50.0,
)  # fmt: skip
SOUND_FIELD = SoundField(
    sound_power=SoundPowerSettings(arrangement="iso3744-hemisphere-10", radius_m=1.0),
    map=MapSettings(horizontal_m=(-0.6, 0.6), vertical_m=(0.0, 0.8), spacing_m=0.1),
    directivity=DirectivitySettings(radius_m=10.0, step_rad=0.5235987755982988),
    line_frequency_hz=(50.0, 425.0),
)


@pytest.fixture(scope="module")
def closed():
    return transfer_vectors(SHELL, RECEIVERS, SETTINGS, SOUND_FIELD)


@pytest.mark.long
def test_agrees_with_cut_cells():
    """Sideways motions to 1 kHz: within 0.3 dB of cells of 24 mm, extrapolated."""
    settings = SETTINGS.model_copy(
        update={"method": "cut-cells", "near_field_spacing_m": 0.024, "frequency_step_hz": 100.0}
    )
    receivers = {"side": RECEIVERS["side"]}
    cells = np.abs(transfer_vectors(SHELL, receivers, settings)["transfer_vector"])
    elements = transfer_vectors(
        SHELL, receivers, settings.model_copy(update={"method": "revolution"})
    )["transfer_vector"]
    for dof in ("tx", "ty"):
        difference = 20.0 * np.log10(np.abs(elements.sel(dof=dof)) / cells.sel(dof=dof))
        assert float(np.abs(difference).max()) < 0.3


@pytest.mark.long
def test_what_the_result_says(closed):
    assert closed.attrs["solver"] == "boundary elements, image sources"
    fine, coarse = map(int, closed.attrs["boundary_elements"].split(", coarser "))
    assert fine > coarse >= 20
    meridian_m = SHELL.height_m + SHELL.outer_diameter_m  # its mean element is between the two
    assert fine * closed.attrs["boundary_element_shortest_m"] < meridian_m
    assert fine * closed.attrs["boundary_element_longest_m"] > meridian_m
    solved, asked = map(int, closed.attrs["frequencies_solved"].split(" of "))
    assert 5 < solved < asked == 22
    # Whole numbers would come back from a file as such that JSON does not take.
    assert all(isinstance(value, str | float) for value in closed.attrs.values())
    assert "transfer_vector_closed_form" not in closed
    share = (closed["transfer_vector_error"] / np.abs(closed["transfer_vector"])).sel(
        dof=["tx", "ty", "tz"]
    )
    assert 0.0 < float(share.sel(receiver="side").max()) < 0.01
    assert not closed["transfer_vector"].sel(dof="rz").values.any()


def test_box_of_kwaves_correction_has_cells_of_at_most_a_spacing():
    """Closed, 40 mm off the body; on a floor without its bottom."""
    points = np.array([[0.0, -0.2], [0.08, -0.2], [0.08, 0.2], [0.0, 0.2]])
    radiator = SimpleNamespace(mesh=SimpleNamespace(points=points))
    for floor_z_m, low in ((None, -0.24), (-0.22, -0.22)):
        box = join_box(SimpleNamespace(radiators=[radiator], floor_z_m=floor_z_m), 0.05)
        apart = np.linalg.norm(box.outer - box.inner, axis=1)
        area = box.weights * apart
        assert 0.025 < apart.min() <= apart.max() <= 0.05
        assert area.max() <= 0.05**2
        ends = 2.0 if floor_z_m is None else 1.0
        assert area.sum() == pytest.approx(ends * 0.24**2 + 4.0 * 0.24 * (0.24 - low))


@pytest.mark.long
def test_map_measurement_surface_and_directivity(closed):
    """In the machine there is no number; a point of the map is what a microphone there gets."""
    field = closed["map_transfer_vector"].sel(dof="tz").isel(line_frequency=0)
    x, z = field["map_x"], field["map_z"]
    inner = (np.abs(x) < 0.08) & (z > -0.19) & (z < 0.21)
    outer = (np.abs(x) > 0.09) | (z < -0.205) | (z > 0.22)
    assert inner.any()
    assert np.all(np.isnan(field.values[inner.values]))
    assert np.all(np.abs(field.values[outer.values]) > 0.0)
    assert closed["surface_transfer_vector"].shape == (10, 6, 20)
    assert np.all(np.isfinite(closed["directivity_transfer_vector"]))
    place = {"x_m": 0.5, "y_m": 0.0, "height_m": 0.6}
    alone = transfer_vectors(SHELL, {"there": Receiver(**place)}, SETTINGS)["transfer_vector"]
    row = np.argmin(np.abs(field["map_x"].values - 0.5) + np.abs(field["map_z"].values - 0.38))
    expected = alone.sel(receiver="there", dof="tz", frequency=50.0)
    assert field.values.ravel()[row] == pytest.approx(complex(expected), rel=1e-6)


@pytest.mark.long
def test_kwave_room_is_the_boxs_correction(closed):
    """k-Wave's Green's function moves no level by more than it differs itself on the box."""
    receivers = {"side": RECEIVERS["side"]}
    settings = SETTINGS.model_copy(update={"room_solver": "k-wave"})
    both = transfer_vectors(SHELL, receivers, settings)
    largest = float(np.abs(both["green_difference"]).max())
    assert 1e-5 < largest < 0.1
    level = 20.0 * np.log10(
        np.abs(both["transfer_vector"]) / np.abs(both["transfer_vector_closed_form"])
    ).sel(dof=["tx", "ty", "tz"])
    assert 1e-6 < float(np.abs(level).max()) < 3.0 * largest
    np.testing.assert_allclose(
        both["transfer_vector_closed_form"].values,
        closed["transfer_vector"].sel(receiver=["side"]).values,
        rtol=5e-3,
        atol=1e-9,
    )


def test_a_sphere_has_a_meridian():
    settings = SETTINGS.model_copy(update={"body": SphereBody(kind="sphere", diameter_m=0.3)})
    vectors = transfer_vectors(SHELL, RECEIVERS, settings)["transfer_vector"]
    assert np.all(np.abs(vectors.sel(dof=["tx", "tz"], receiver="side")) > 0.0)


@pytest.mark.parametrize(
    "wrong",
    [
        {"body": BoxBody(kind="box", length_m=0.3, width_m=0.3, height_m=0.3)},
        {"surroundings": Surroundings(walls={"-x": Wall(distance_m=1.0)})},
    ],
)
def test_what_is_not_of_revolution_is_refused_by_name_and_left_to_cut_cells(wrong):
    with pytest.raises(ValidationError, match="needs a body of kind shell or sphere"):
        RadiationSettings(method="revolution", **wrong)
    assert not RadiationSettings(method="automatic", **wrong).revolution
    assert RadiationSettings(method="automatic").revolution


@pytest.mark.parametrize(
    ("place", "words"),
    [
        ({"x_m": 0.0, "y_m": 0.0, "height_m": 0.2}, "inside the machine"),
        ({"x_m": 0.083, "y_m": 0.0, "height_m": 0.2}, "on the wall of the machine"),
    ],
)
def test_microphones_in_the_machine_are_refused(place, words):
    with pytest.raises(ParameterError, match=words):
        transfer_vectors(SHELL, {"wrong": Receiver(**place)}, SETTINGS)
