"""k-Wave at some microphones and frequencies, the closed form at the others."""

import json

import numpy as np
import pytest

from vibroacoustics.machine.shell import Shell
from vibroacoustics.radiation.transfer_vectors import cache_key_material, transfer_vectors
from vibroacoustics.report.kwave_words import kwave_sentence, kwave_to_hz, method_difference_db
from vibroacoustics.study.radiation import RadiationSettings
from vibroacoustics.study.receivers import Receiver

SHELL = Shell(
    outer_diameter_m=0.165, height_m=0.417, centre_of_mass_height_m=0.2, floor_clearance_m=0.02
)
RECEIVERS = {
    "side": Receiver(x_m=0.9, y_m=-0.5, height_m=0.4),
    "front": Receiver(x_m=0.1, y_m=0.9, height_m=0.25),
}
SEAM_HZ = 600.0
MACHINE_SIDE = {"revolution": "boundary elements", "cut-cells": "cut cells"}


@pytest.fixture(
    params=["revolution", pytest.param("cut-cells", marks=pytest.mark.long)], scope="module"
)
def both(request):
    """k-Wave at one of two microphones, up to a seam; and the name of the method."""
    settings = RadiationSettings(
        method=request.param, near_field_spacing_m=0.035, room_spacing_m=0.06,
        maximum_frequency_hz=1000.0, frequency_step_hz=100.0,
    )  # fmt: skip
    with pytest.MonkeyPatch.context() as patch:
        for module in ("task", "receiver_methods"):
            patch.setattr(f"vibroacoustics.radiation.{module}.KWAVE_LIMIT_HZ", SEAM_HZ)
        yield transfer_vectors(SHELL, RECEIVERS, settings, kwave_receivers=["side"]), request.param


def test_says_what_computed_which_microphone(both):
    vectors, method = both
    methods = dict(zip(vectors["receiver"].values, vectors["radiation_method"].values, strict=True))
    assert methods == {
        "side": f"{MACHINE_SIDE[method]}, k-Wave to 600 Hz, image sources above",
        "front": f"{MACHINE_SIDE[method]}, image sources",
    }
    above, other = vectors["radiation_method_reason"].values
    assert above == "above, the grid of k-Wave would be too large"
    assert other == 'k-Wave computes side (kwave_receivers = "catalogue")'
    assert "k-wave-python" in vectors.attrs["solver"]
    assert vectors.attrs["room_engine"]


def test_k_wave_is_where_it_is_asked_for(both):
    vectors, _ = both
    gap = np.isfinite(vectors["green_difference"])
    assert gap.sel(receiver="side", frequency=slice(0.0, SEAM_HZ)).all()
    assert int(gap.sum()) == 6
    other = vectors["transfer_vector"].where(~gap, 0.0)
    closed = vectors["transfer_vector_closed_form"].where(~gap, 0.0)
    np.testing.assert_array_equal(other, closed)
    loud = vectors.sel(receiver="side", dof=["tx", "ty", "tz", "rx", "ry"]).sel(
        frequency=slice(0.0, SEAM_HZ)
    )
    assert np.all(loud["transfer_vector"] != loud["transfer_vector_closed_form"])


def test_motion_that_is_silent_by_symmetry_stays_silent(both):
    """A body of revolution that turns about its axis moves no air."""
    vectors, _ = both
    turning = vectors.sel(receiver="side", dof="rz")
    loudest = np.abs(vectors.sel(receiver="side")["transfer_vector"]).max("dof")
    assert np.all(np.abs(turning["transfer_vector"]) <= 1e-5 * loudest)
    np.testing.assert_array_equal(
        turning["transfer_vector"], turning["transfer_vector_closed_form"]
    )


def test_seam_and_difference_are_within_a_tenth_of_a_decibel(both):
    vectors, _ = both
    difference = method_difference_db(vectors)
    assert difference.shape == (1, 6, 6)
    assert 1e-6 < np.abs(difference).max() < 0.1
    sentence = kwave_sentence(vectors)
    assert "k-Wave computed the room at side from 100 to 600 Hz" in sentence
    assert sentence.endswith("dB at the limit of 600 Hz.")
    assert kwave_to_hz(vectors) == {"side": SEAM_HZ}


def test_without_k_wave_the_sentence_says_so(both):
    vectors, _ = both
    words = "k-Wave did not run"
    assert words in kwave_sentence(vectors.drop_vars("green_difference"))
    assert words in kwave_sentence(
        vectors.assign(green_difference=vectors["green_difference"] * np.nan)
    )


def test_the_microphones_of_k_wave_are_in_the_key_of_the_cache():
    settings = RadiationSettings()
    keys = [
        json.dumps(cache_key_material(SHELL, RECEIVERS, one, kwave_receivers=names), sort_keys=True)
        for one in (settings, settings.model_copy(update={"room_solver": "closed-form"}))
        for names in (["side"], ["side", "front"], None)
    ]
    assert keys[1] == keys[2]
    assert keys[3] == keys[4] == keys[5]
    assert len(set(keys)) == 3
