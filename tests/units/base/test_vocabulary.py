"""The vocabulary: what passes and what does not."""

import numpy as np
import pytest
import xarray as xr

from vibroacoustics.base.errors import PluginError, SchemaError
from vibroacoustics.base.registry import register
from vibroacoustics.base.vocabulary import (
    COORDINATES,
    VARIABLES,
    Coordinate,
    Variable,
    check,
    label_coordinates,
    stamp,
)

FREQUENCY = {"mode": [f"mode_{number}" for number in range(1, 7)]}


def _frequencies(values=None):
    return stamp("natural_frequency", np.arange(6.0) if values is None else values, FREQUENCY)


def _with_attrs(dataset, **attrs):
    changed = dataset.copy()
    changed["natural_frequency"].attrs = attrs
    return changed


def test_stamp_gives_dims_unit_and_name():
    labelled = _frequencies()
    assert labelled.dims == ("mode",)
    assert labelled.attrs["units"] == "Hz"
    assert labelled.attrs["long_name"]
    assert labelled.name == "natural_frequency"


def test_stamp_names_the_phasor_convention():
    labelled = stamp("transfer_vector", np.zeros((1, 6, 3), complex))
    assert "exp(+j w t)" in labelled.attrs["phasor"]
    assert "rad" in labelled.attrs["note"]


def test_stamp_keeps_further_attributes():
    assert stamp("level_unmodelled", 56.0, source="catalogue").attrs["source"] == "catalogue"


def test_stamp_refuses_unknown_names_and_shapes():
    with pytest.raises(SchemaError, match="roughness is not in the vocabulary"):
        stamp("roughness", 1.0)
    with pytest.raises(SchemaError, match=r"natural_frequency: has 2 dimensions"):
        stamp("natural_frequency", np.zeros((2, 2)))


def test_check_returns_a_good_dataset():
    dataset = xr.Dataset({"natural_frequency": _frequencies()})
    assert check(dataset, required=["natural_frequency"]) is dataset


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda d: d.rename(natural_frequency="pitch"), "pitch is not in the vocabulary"),
        (lambda d: d.rename(mode="dof"), r"natural_frequency: dims are \('dof',\)"),
        (lambda d: _with_attrs(d, units="rad/s"), "unit is 'rad/s', must be 'Hz'"),
        (_with_attrs, "unit is None, must be 'Hz'"),
        (lambda d: d.astype(complex), "must not be complex"),
        (lambda d: d.assign_coords(colour=1), "coordinate colour is not in the vocabulary"),
    ],
)
def test_check_refuses(change, message):
    with pytest.raises(SchemaError, match=message):
        check(change(xr.Dataset({"natural_frequency": _frequencies()})))


def test_check_refuses_a_real_phasor():
    real = stamp("transfer_vector", np.zeros((1, 6, 3)))
    with pytest.raises(SchemaError, match="transfer_vector: must be complex"):
        check(xr.Dataset({"transfer_vector": real}))


def test_check_refuses_a_missing_variable():
    with pytest.raises(SchemaError, match="variable force is missing"):
        check(xr.Dataset(), required=["force"])


def test_units_do_not_survive_arithmetic_unseen():
    """xarray's own sum keeps or drops attributes; either way the check notices a wrong one."""
    wrong = _frequencies() * 2.0
    wrong.attrs["units"] = "N"
    with pytest.raises(SchemaError):
        check(xr.Dataset({"natural_frequency": wrong}))


def test_label_coordinates():
    dataset = label_coordinates(xr.Dataset(coords={"speed": [2900.0], "order": [0, 1]}))
    assert dataset["speed"].attrs == {"units": "rpm", "long_name": "shaft speed"}
    with pytest.raises(SchemaError, match="colour"):
        label_coordinates(xr.Dataset(coords={"colour": [1]}))


def test_every_dim_of_the_vocabulary_is_a_coordinate_of_it():
    used = {dim for variable in VARIABLES.values() for dim in variable.dims}
    used |= {dim for variable in COORDINATES.values() for dim in variable.dims}
    assert used <= set(COORDINATES)


def test_every_variable_is_described():
    for name, variable in (*VARIABLES.items(), *COORDINATES.items()):
        assert variable.long_name, name
        assert variable.long_name.isascii(), name  # netCDF attributes are read by Octave
        assert variable.units.isascii(), name


def test_a_third_partys_variable_and_coordinate():
    register(Coordinate("roughness_band", ("roughness_band",), "Bark", "critical band"))
    register(Variable("roughness", ("roughness_band",), "asper Bark-1", "specific roughness"))
    coords = {"roughness_band": [0.5, 1.5]}
    dataset = check(xr.Dataset({"roughness": stamp("roughness", [1.0, 2.0], coords)}))
    assert label_coordinates(dataset)["roughness_band"].attrs["units"] == "Bark"
    assert VARIABLES.origin("roughness").file == "test_vocabulary.py"
    with pytest.raises(SchemaError, match=r"variable roughnes is not .*, did you mean roughness\?"):
        stamp("roughnes", [1.0, 2.0])


@pytest.mark.parametrize("noun", ["variable force", "coordinate speed"])
def test_name_of_a_built_in_one_is_refused(noun):
    kind = {"variable": Variable, "coordinate": Coordinate}[noun.split()[0]]
    with pytest.raises(PluginError, match=f"{noun}: is built in"):
        register(kind(noun.split()[1], ("speed",), "N", "mine"))


@pytest.mark.parametrize(
    ("dims", "units", "message"),
    [
        ("speed", "N", "roughness: dims = 'speed': must be a tuple of names"),
        (("speed",), "m/s²", "roughness: 'm/s²': must be text in ASCII"),
    ],
)
def test_malformed_variable_is_refused(dims, units, message):
    with pytest.raises(SchemaError, match=message):
        Variable("roughness", dims, units, "mine")
