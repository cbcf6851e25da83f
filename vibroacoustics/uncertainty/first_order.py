"""Forces at once per revolution of drawn machines."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import product
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.units import shaft_frequency_hz
from ..base.vocabulary import stamped
from ..machine.cases import Cases
from ..machine.source import Case, CaseKey
from ..mechanics.ellipse import semi_major_axis
from ..mechanics.loads import PortLoads, summed
from ..transfer import on_mounts

_AMPLITUDES: Final = {
    "force_1x": "force_amplitude",
    "moment_1x": "moment_amplitude",
    "foot_force_1x": "foot_force_amplitude",
}
"""Amplitudes by draw, and where those of the values as given are."""


def first_order(case: Case, wrenches: Mapping[str, PortLoads]) -> Array:
    """Force N and moment N m on the housing and largest force N into a foot at 1x, peak.

    Parameters
    ----------
    case : machine and speed
    wrenches : lines of the wrenches over crank angle by source
    """
    phasor = summed(wrenches.values())[case.machine.mechanism_port][:, 1]
    frequency = np.array([shaft_frequency_hz(case.speed_rpm)])
    foot_force = on_mounts(case.machine).response(phasor[None], frequency).foot_force
    halves = (semi_major_axis(phasor[:3], 0), semi_major_axis(phasor[3:], 0))
    return np.array([*halves, semi_major_axis(foot_force[0], -1).max()])


def changed_first_order(nominal: Cases, drawn: Cases) -> dict[CaseKey, Array]:
    """Compute `first_order` of the cases that move otherwise than the nominal ones."""
    return {
        key: first_order(case, drawn.wrenches[key])
        for key, case in drawn.cases.items()
        if drawn.wrenches[key] is not nominal.wrenches[key]
    }


def unknown_first_order(cases: Iterable[CaseKey]) -> dict[CaseKey, Array]:
    """The same of a draw without solution: not a number."""
    return {key: np.full(len(_AMPLITUDES), np.nan) for key in cases}


def first_order_by_draw(drawn: Sequence[Mapping[CaseKey, Array]], given: xr.Dataset) -> xr.Dataset:
    """Forces at 1x of every draw; those as given where a draw leaves the motion.

    Parameters
    ----------
    drawn : of the cases that move otherwise, by draw
    given : amplitudes of the values as given, by speed and option
    """
    of_given = [given[name].sel(order=1) for name in _AMPLITUDES.values()]
    amplitudes = [one.max("foot") if "foot" in one.dims else one for one in of_given]
    stacked = np.stack([one.transpose("speed", "option").values for one in amplitudes], axis=-1)
    keys = product(given["speed"].values.tolist(), given["option"].values.tolist())
    rows = dict(zip(keys, stacked.reshape(-1, len(_AMPLITUDES)), strict=True))
    values = [[one.get(key, row) for key, row in rows.items()] for one in drawn]
    by_draw: Array = np.array(values).reshape(len(drawn), *stacked.shape)
    coords = {
        "draw": np.arange(1, len(drawn) + 1),
        "speed": given["speed"].values,
        "option": given["option"].values,
    }
    return stamped(
        {f"{name}_by_draw": by_draw[..., n] for n, name in enumerate(_AMPLITUDES)}, coords
    )
