"""Impulse responses of a room as sounds, all at one gain."""

from collections.abc import Collection, Sequence
from dataclasses import replace
from itertools import product
from typing import Final

import numpy as np
import xarray as xr

from ..base.errors import ParameterError
from ..report.analysis import Analysis
from ..report.file_names import file_name
from ..report.responses import analysis_of_impulse_responses
from ..sound.files import at_gain, wav_bytes
from ..sound.gain import next_full_scale
from ..sound.rendering import SAMPLE_RATE_HZ

UNITS: Final = {"t": "Pa/(m/s²)", "r": "Pa/(rad/s²)"}
"""Of translations and rotations."""


def impulse_analysis(
    responses: xr.DataArray,
    listeners: Sequence[str] | None = None,
    full_scale: float | None = None,
) -> Analysis:
    """Return an analysis with a WAV file for each listener and motion, named by the gain of all.

    Parameters
    ----------
    responses : of `impulse_responses`
    listeners : names; all where nothing is given
    full_scale : value at full scale; none for the next of 1, 2, 5, 10, … of all listeners

    Raises
    ------
    ParameterError
        A name is unknown, or a response exceeds full scale.
    """
    known = [str(name) for name in responses["listener"].values]
    check_asked(known, listeners, full_scale)
    highest = float(np.abs(responses).max())
    scale = next_full_scale(highest) if full_scale is None else full_scale
    names, contents = {}, {}
    for listener, dof in product(listeners or known, map(str, responses["dof"].values)):
        sound = at_gain(responses.sel(listener=listener, dof=dof).values, scale)
        name = f"{file_name(listener)}_{dof}_{scale:g}Pa.wav"
        names[listener, dof] = name
        contents[name] = wav_bytes(sound, SAMPLE_RATE_HZ, scale, UNITS[dof[0]])
    return replace(analysis_of_impulse_responses(responses, scale, names), further=contents)


def check_asked(
    known: Collection[str], listeners: Sequence[str] | None, full_scale: float | None
) -> None:
    """Refuse what is known to be wrong before anything is computed.

    Raises
    ------
    ParameterError
        A name is unknown, or the full scale is not above 0.
    """
    for name in listeners or ():
        if name not in known:
            raise ParameterError(
                f"microphone = {name}: unknown in this room; available: {', '.join(known)}"
            )
    if full_scale is not None and not full_scale > 0.0:
        raise ParameterError(f"full scale = {full_scale:g} Pa: must be above 0")
