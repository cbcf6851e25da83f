"""Analysis of impulse responses of a room."""

from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr

from ..base import rounding
from .analysis import Analysis, origin
from .blocks import Part, Text
from .tables import columns_of, records, table_of


def analysis_of_impulse_responses(
    responses: xr.DataArray, full_scale: float, sounds: Mapping[tuple[str, str], str]
) -> Analysis:
    """Return the largest value of each response, and its file.

    Parameters
    ----------
    responses : of `impulse_responses`
    full_scale : value at full scale
    sounds : name of the file by microphone and motion
    """
    rows: list[Sequence[str | float]] = [
        (name, dof, float(np.abs(responses.sel(listener=name, dof=dof)).max()), file)
        for (name, dof), file in sounds.items()
    ]
    data = columns_of(("microphone", "motion", "largest", "file"), rows)
    table = table_of(
        "Largest value of each response, Pa/(m/s²) or Pa/(rad/s²)",
        records(data),
        (
            ("Microphone", "microphone", str),
            ("Motion", "motion", str),
            ("Largest", "largest", rounding.three_digits),
            ("File", "file", str),
        ),
        frozenset({0, 1, 3}),
    )
    gain = Text(f"Full scale of all files: {full_scale:g}.")
    return Analysis(
        "impulse_responses",
        about="Sound pressure in the room after an impulse of the housing's acceleration.",
        parts=(Part("responses", "Responses", (table, gain)),),
        shown=(table, gain),
        tables={"impulse_responses.csv": data},
        **origin(responses.to_dataset(name="impulse_response"), "Room"),
    )
