"""Sound pressure by source at all lines, labelled."""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from ..base.vocabulary import stamped
from ..machine.source import CaseKey
from ..mechanics.received_sound import ReceivedSound
from .axes import LevelAxes

_ORDER = "order "
"""With what the names of lines begin that are orders."""


def line_pressure(axes: LevelAxes, received: Mapping[CaseKey, ReceivedSound]) -> xr.Dataset:
    """Pressure by source at all lines; tones of one name are one line, empty where it is none.

    Orders come first, from zero, the tones of all cases after them.

    Parameters
    ----------
    axes : speeds, options, sources and receivers
    received : sound of these cases, and of others
    """
    cases = {(s, o): received[s, o] for s in axes.speeds for o in axes.options}
    names = list(dict.fromkeys(name for sound in cases.values() for name in sound.lines.names))
    names.sort(key=lambda name: not name.startswith(_ORDER))  # orders first, else as they come
    column = {name: number for number, name in enumerate(names)}
    sizes = map(len, (axes.speeds, axes.options, axes.sources, axes.receivers, names))
    pressure = np.zeros(tuple(sizes), dtype=complex)
    frequency = np.full((len(axes.speeds), len(names)), np.nan)
    for (speed, option), sound in cases.items():
        s, o = axes.speeds.index(speed), axes.options.index(option)
        columns = [column[name] for name in sound.lines.names]
        pressure[s, o][..., columns] = sound.pressure
        frequency[s, columns] = sound.lines.frequency_hz
    orders = [
        float(name.removeprefix(_ORDER)) if name.startswith(_ORDER) else np.nan for name in names
    ]
    coords = {"tone_frequency": (("speed", "line"), frequency), "line_order": ("line", orders)}
    labelled = stamped({"pressure_line": pressure}, {**axes.by_source, "line": names})
    return labelled.assign_coords(coords)
