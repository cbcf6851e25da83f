"""Orders whose sound by path is kept: 1, 2 and the loudest without an option above -40 dB(A)."""

import numpy as np
import pytest
import xarray as xr

from vibroacoustics.base.vocabulary import REFERENCE_OPTION, WEIGHTINGS
from vibroacoustics.levels.contribution_choice import loudest_orders


def levels(of_order):
    """Levels of orders 0 to 20, the rest silent but for a balancer; 60 dB without a weighting."""
    values = np.full((len(WEIGHTINGS), 1, 2, 1, 21), 60.0)
    weighted = values[WEIGHTINGS.index("A")]
    weighted[...] = -120.0
    for order, level in of_order.items():
        weighted[0, 1, 0, order] = level
    weighted[0, 0, 0, 20] = 80.0  # with an option alone
    return xr.Dataset(
        {"order_level": (("weighting", "speed", "option", "receiver", "order"), values)},
        coords={"option": ["balancer", REFERENCE_OPTION]},
    )


@pytest.mark.parametrize(("level_dba", "is_kept"), [(-39.0, True), (-41.0, False)])
def test_an_order_is_kept_that_is_above_minus_40_db(level_dba, is_kept):
    assert loudest_orders(levels({7: level_dba})) == [1, 2, *[7] * is_kept]


def test_the_twelve_loudest_orders_are_kept():
    """The steady part is no order; 1 and 2 are kept however quiet they are."""
    rising = {order: float(order) for order in range(3, 21)}
    assert loudest_orders(levels({0: 90.0, **rising})) == [1, 2, *range(11, 21)]
