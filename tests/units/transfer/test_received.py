"""Pressure of wrenches, gathered by case and by who makes them."""

import numpy as np
import xarray as xr

from vibroacoustics.transfer.received import by_case_and_source


def test_wrenches_of_one_source_add_up_in_each_case():
    pressure = xr.DataArray(
        np.arange(2 * 3 * 2 * 1 * 2).reshape(2, 3, 2, 1, 2) * (1.0 + 1.0j),
        {"option": ["none", "hood"], "source": ["rotor", "hum", "oldham"], "speed": [50.0, 60.0]},
        ("option", "source", "speed", "receiver", "order"),
    )
    sources = {"rotor": "moving_parts", "oldham": "moving_parts", "hum": "motor", "gone": "gas"}
    gathered = by_case_and_source(pressure, sources)
    assert set(gathered) == {(s, o) for s in (50.0, 60.0) for o in ("none", "hood")}
    case = gathered[60.0, "hood"]
    assert set(case) == {"moving_parts", "motor"}
    at = pressure.sel(option="hood", speed=60.0)
    moving = at.sel(source="rotor") + at.sel(source="oldham")
    np.testing.assert_array_equal(case["moving_parts"], moving.values)
    np.testing.assert_array_equal(case["motor"], at.sel(source="hum").values)
