"""Curves and their dataset: what is refused, names of axes, units in which they are read."""

import numpy as np
import pytest

from vibroacoustics.base.curves import (
    Curve,
    CurveAxis,
    angle_axis,
    axis_words,
    curves_dataset,
    shown,
    shown_label,
)
from vibroacoustics.base.errors import ParameterError

ANGLE = angle_axis(np.array([0.0, 1.0, 2.0]))
FILMS = CurveAxis("film", ["upper", "lower"])


def curve(name="film", values=None, axes=(FILMS, ANGLE), **more):
    words = {"title": "A film", "unit": "um", "source": "a test", **more}
    return Curve(name, values=np.ones((2, 3)) if values is None else values, axes=axes, **words)


def test_dataset_says_all_that_a_picture_needs():
    values = 1e-6 * np.arange(6.0).reshape(2, 3)
    dataset = curves_dataset([curve("thinnest_film", values)], {"machine": "M"})
    film = dataset["thinnest_film"]
    assert film.dims == ("film", "crank_angle")
    assert film.attrs["units"] == "m"
    assert film.attrs["source"] == "a test"
    np.testing.assert_allclose(shown(film), 1e6 * values)
    assert shown_label(film) == "Thinnest film, µm"
    assert shown_label(film["crank_angle"]) == "Crank angle, °"
    assert axis_words(film["film"]) == ["upper", "lower"]
    np.testing.assert_allclose(shown(film["crank_angle"]), np.rad2deg([0.0, 1.0, 2.0]))
    assert dataset.attrs == {"machine": "M"}


def test_numbers_as_names_of_lines_have_their_unit():
    axes = (CurveAxis("error", np.array([-1e-5, 0.0]), "um"), ANGLE)
    dataset = curves_dataset([curve(axes=axes)], {})
    assert axis_words(dataset["error"]) == ["−10 µm", "0 µm"]


def test_axis_of_other_values_gets_a_number():
    other = angle_axis(np.array([0.0, 0.5, 1.0]))
    parts = [curve("a"), curve("b", axes=(FILMS, other)), curve("c", axes=(FILMS, other))]
    dataset = curves_dataset(parts, {})
    assert [dataset[name].dims[1] for name in "abc"] == [
        "crank_angle", "crank_angle_2", "crank_angle_2",
    ]  # fmt: skip


def test_two_curves_of_one_name_are_refused():
    with pytest.raises(ParameterError, match="curve a: two have this name"):
        curves_dataset([curve("a"), curve("a")], {})


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"name": "thin film"}, "as a word of letters"),
        ({"title": ""}, "must be said"),
        ({"source": ""}, "must be said"),
        ({"values": np.ones((3, 2))}, r"values of shape \(3, 2\) over axes of \(2, 3\)"),
        ({"values": np.full((2, 3), np.nan)}, "must be finite"),
        ({"unit": "umm"}, "unit umm: unknown, did you mean"),
        ({"axes": ()}, "0 axes; allowed 1 to 3"),
        ({"picture": "orbit"}, "needs x and y"),
        (
            {"axes": (FILMS, CurveAxis("crank_angle", np.array([0.0, 1.0, np.inf]), "deg"))},
            "finite",
        ),
        ({"axes": (FILMS, CurveAxis("crank_angle", np.arange(3.0)))}, "unit : unknown"),
    ],
)
def test_curves_that_cannot_be(change, message):
    with pytest.raises(ParameterError, match=message):
        curve(**change)
