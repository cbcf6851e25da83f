"""Forces at once per revolution of sampled machines."""

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
"""Amplitudes by sample, and where those of the values as given are."""


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


def changed_first_order(nominal: Cases, sampled: Cases) -> dict[CaseKey, Array]:
    """Compute `first_order` of the cases that move otherwise than the nominal ones."""
    return {
        key: first_order(case, sampled.wrenches[key])
        for key, case in sampled.cases.items()
        if sampled.wrenches[key] is not nominal.wrenches[key]
    }


def unknown_first_order(cases: Iterable[CaseKey]) -> dict[CaseKey, Array]:
    """The same of a sample without solution: not a number."""
    return {key: np.full(len(_AMPLITUDES), np.nan) for key in cases}


def first_order_by_sample(
    sampled: Sequence[Mapping[CaseKey, Array]], given: xr.Dataset
) -> xr.Dataset:
    """Forces at 1x of every sample; those as given where a sample leaves the motion.

    Parameters
    ----------
    sampled : of the cases that move otherwise, by sample
    given : amplitudes of the values as given, by speed and option
    """
    of_given = [given[name].sel(order=1) for name in _AMPLITUDES.values()]
    amplitudes = [one.max("foot") if "foot" in one.dims else one for one in of_given]
    stacked = np.stack([one.transpose("speed", "option").values for one in amplitudes], axis=-1)
    keys = product(given["speed"].values.tolist(), given["option"].values.tolist())
    rows = dict(zip(keys, stacked.reshape(-1, len(_AMPLITUDES)), strict=True))
    values = [[one.get(key, row) for key, row in rows.items()] for one in sampled]
    by_sample: Array = np.array(values).reshape(len(sampled), *stacked.shape)
    coords = {
        "sample": np.arange(1, len(sampled) + 1),
        "speed": given["speed"].values,
        "option": given["option"].values,
    }
    return stamped(
        {f"{name}_by_sample": by_sample[..., n] for n, name in enumerate(_AMPLITUDES)}, coords
    )
