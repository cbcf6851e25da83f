"""Speeds and orders of which sound by path is kept."""

from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from vibroacoustics.base.vocabulary import REFERENCE_OPTION, WEIGHTINGS
from vibroacoustics.levels.contribution_choice import chosen_speeds, loudest_orders


def study(speed_rpm, published_rpm):
    return SimpleNamespace(
        operation=SimpleNamespace(speed_rpm=speed_rpm), catalogue_speed_rpm=published_rpm
    )


@pytest.mark.parametrize(
    ("published_rpm", "middle_rpm"), [(1400.0, 1400.0), (None, 2900.0), (1000.0, 2900.0)]
)
def test_slowest_fastest_and_published_speed_or_a_middle_one(published_rpm, middle_rpm):
    """The mean of all is 2600 rpm."""
    speeds = [900.0, 1400.0, 2900.0, 3600.0, 4200.0]
    assert chosen_speeds(study(speeds, published_rpm)) == [900.0, middle_rpm, 4200.0]
    assert chosen_speeds(study(speeds[:3], published_rpm)) == speeds[:3]


def test_the_loudest_orders_are_kept_and_the_first_two():
    """Ten of 30 by their level weighted by A, at the speed at which each is loudest."""
    random = np.random.default_rng(5)
    level = random.uniform(0.0, 60.0, (len(WEIGHTINGS), 30, 2, 2, 1))
    a_weighted = level[WEIGHTINGS.index("A")]
    a_weighted[[1, 2]] = -30.0
    dims = ("weighting", "order", "speed", "option", "receiver")
    options = {"option": ["balancer", REFERENCE_OPTION]}
    found = loudest_orders(xr.Dataset({"order_level": (dims, level)}, options))
    highest = a_weighted[:, :, 1].max(axis=(1, 2))
    others = sorted(range(3, 30), key=lambda order: highest[order])
    assert found == sorted([1, 2, *others[-10:]])
