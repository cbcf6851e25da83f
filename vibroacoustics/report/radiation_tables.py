"""Analyses of a housing's radiation at unit velocity, and of impulse responses of a room."""

from collections.abc import Mapping, Sequence
from itertools import product
from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.arrays import Array
from ..base.decibel import level_of_amplitude
from .analysis import Analysis, origin
from .blocks import Block, Part, Pictures, Text
from .charts.svg import Picture, picture
from .conditions import kwave_claim
from .figures.directivity import directivity
from .figures.maps import names, silent_dofs, transfer_vectors, unit_level_db, unit_level_map
from .kwave_words import kwave_line
from .tables import Table, columns_of, records, table_of

TABLE_FREQUENCIES_HZ: Final = (50.0, 100.0, 250.0, 500.0, 1000.0, 2000.0)
_CORRECTIONS: Final = ("background", "environment")


def analysis_of_radiation(radiated: xr.Dataset) -> Analysis:
    """Return the analysis of a housing's radiation."""
    frequency = radiated["frequency"].values
    wanted = [hertz for hertz in TABLE_FREQUENCIES_HZ if frequency[0] <= hertz <= frequency[-1]]
    nearest = sorted({int(np.argmin(np.abs(frequency - hertz))) for hertz in wanted}) or [0]
    head = tuple(f"{frequency[index]:g} Hz" for index in nearest)
    tables = [_level_table(radiated, nearest, head)]
    if "unit_sound_power_level" in radiated:
        tables.append(_power_table(radiated["unit_sound_power_level"], nearest, head))
    blocks: tuple[Block, ...] = (*tables, Text(kwave_line(radiated)))
    figures = Pictures(tuple(radiation_figures(radiated)))
    return Analysis(
        "transfer_vectors",
        **origin(radiated, "Housing"),
        about="Sound of the housing at unit velocity.",
        parts=(
            Part("levels", "Levels at unit velocity", blocks),
            Part("figures", "Over frequency and direction", (figures,)),
        ),
        shown=blocks,
        claims=(kwave_claim(radiated),),
    )


def _level_table(radiated: xr.Dataset, nearest: list[int], head: tuple[str, ...]) -> Table:
    field = radiated["transfer_vector"].transpose("receiver", "dof", "frequency")
    shape = (-1, len(nearest))
    levels = unit_level_db(field.values)[:, :, nearest].reshape(shape).tolist()
    cells = [[rounding.level(level) for level in row] for row in levels]
    if "transfer_vector_error" in radiated:
        head = (*head, "error dB")
        errors = _error_db(field, radiated["transfer_vector_error"]).ravel().tolist()
        cells = [[*row, rounding.fixed(error, 2)] for row, error in zip(cells, errors, strict=True)]
    of_rows = product(names(field, "receiver"), names(field, "dof"))
    rows = tuple((*of_row, *row) for of_row, row in zip(of_rows, cells, strict=True))
    caption = "Level at 1 mm/s (t), 1 mrad/s (r) rms, dB re 20 µPa; error: median estimate"
    return Table(caption, ("Microphone", "dof", *head), rows, frozenset({0, 1}))


def _error_db(field: xr.DataArray, error: xr.DataArray) -> Array:
    """Median over the frequencies of 20 lg(1 + error/|T|), (receiver, dof); NaN if silent."""
    size = np.abs(field.values)
    ordered = error.transpose(*field.dims).values
    with np.errstate(divide="ignore", invalid="ignore"):
        in_db = level_of_amplitude(1.0 + ordered / size)
    median = np.median(in_db, axis=-1)
    dofs = names(field, "dof")
    median[:, [dof in silent_dofs(np.moveaxis(size, 1, 0), dofs) for dof in dofs]] = np.nan
    return np.asarray(median)


def _power_table(power: xr.DataArray, nearest: list[int], head: tuple[str, ...]) -> Table:
    ordered = power.transpose("dof", "frequency")
    rows = tuple(
        (dof, *(rounding.level(float(values[k])) for k in nearest))
        for dof, values in zip(names(ordered, "dof"), ordered.values, strict=True)
    )
    caption = (
        "Sound power level at 1 mm/s (t), 1 mrad/s (r) rms, dB re 1 pW; "
        f"{power.attrs['arrangement']}, S = {power.attrs['surface_m2']:.2f} m²"
    )
    stand = sum(power.attrs[f"test_stand_{name}_correction_db"] for name in _CORRECTIONS)
    if stand:
        caption += f"; the test stand's microphones read K1 + K2 = {stand:.1f} dB more"
    return Table(caption, ("dof", *head), rows)


def radiation_figures(radiated: xr.Dataset) -> list[Picture]:
    """The figures that the dataset has variables for."""
    makers = {
        "transfer_vector": transfer_vectors,
        "map_transfer_vector": unit_level_map,
        "directivity_transfer_vector": directivity,
    }
    return [picture(make(radiated)) for name, make in makers.items() if name in radiated]


def analysis_of_impulse_responses(
    responses: xr.DataArray, full_scale: float, sounds: Mapping[tuple[str, str], str]
) -> Analysis:
    """Return the largest value of each response, and its file.

    Parameters
    ----------
    responses : result of `impulse_responses`
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
