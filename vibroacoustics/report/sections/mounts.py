"""The housing on its mounts."""

from typing import Final

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.arrays import Array
from ...base.registry import register
from ...results import labels
from ...results.stored_study import first_order_hz, options, parameters, speeds
from ..blocks import Block, Pictures, Text
from ..figures.radiation import mount_transmissibility
from ..shown_speeds import chosen_speeds, few_speeds
from ..tables import Table
from . import Section

DOMINANT: Final = 0.02
"""Degrees of freedom with a smaller share of the mode's kinetic energy are not named."""


def modes_table(results: xr.Dataset) -> Table:
    """Natural frequencies and what the housing does in each mode."""
    frequency = results["natural_frequency"]
    rows = tuple(
        (
            str(mode).replace("_", " ").capitalize(),
            rounding.fixed(frequency.sel(mode=mode).item()),
            shape_words(results, str(mode)),
        )
        for mode in frequency["mode"].values
    )
    head = ("Mode", "Natural frequency, Hz", "Motion by share of kinetic energy")
    kinds = [option["kind"] for option in parameters(results)["options"].values()]
    which = ", machine as it is" if "redesign" in kinds else ""
    return Table(f"Rigid-body modes on the mounts{which}", head, rows, frozenset({0, 2}))


def attached_table(results: xr.Dataset) -> Table | None:
    """Natural frequencies with the bodies that options attach; None where none attaches any."""
    if "option_natural_frequency" not in results:
        return None
    frequency, energy = results["option_natural_frequency"], results["option_mode_energy"]
    rows = tuple(
        (
            str(option),
            str(mode).removeprefix("mode_"),
            rounding.fixed(hertz.item()),
            _energy_words(np.nan_to_num(energy.sel(which).values), energy),
        )
        for option in frequency["option"].values
        for mode in frequency["option_mode"].values
        if np.isfinite(hertz := frequency.sel(which := {"option": option, "option_mode": mode}))
    )
    head = ("Option", "Mode", "Natural frequency, Hz", "Motion by share of kinetic energy")
    caption = "Rigid-body modes on the mounts with attached bodies"
    return Table(caption, head, rows, frozenset({0, 3}))


def shape_words(results: xr.Dataset, mode: str) -> str:
    """The dominant motions of a mode, by their share of its kinetic energy."""
    if "mode_energy" not in results:
        return rounding.NOTHING
    energy = results["mode_energy"].sel(mode=mode)
    return _energy_words(energy.values, energy)


def _energy_words(shares: Array, shape: xr.DataArray) -> str:
    """Dominant motions by their share of the energy, (body, motion), of the bodies of a shape."""
    bodies, dofs = (shape[dim].values for dim in shape.dims[-2:])
    words = []
    for index in np.argsort(-shares, axis=None, kind="stable"):
        body, dof = np.unravel_index(index, shares.shape)
        if shares[body, dof] > DOMINANT:
            who = f"{bodies[body]} " if len(bodies) > 1 else ""
            motion = labels.DOF_WORDS[str(dofs[dof])]
            words.append(f"{who}{motion} {100.0 * shares[body, dof]:.0f} %")
    return ", ".join(words)


def block_table(results: xr.Dataset) -> Table | None:
    """Largest displacement of a suspended block at its springs; None where it has none."""
    if "spring_displacement" not in results:
        return None
    largest_mm = 1e3 * results["spring_displacement"].transpose("option", "speed")
    rows = tuple(
        (option, *map(rounding.significant, values))
        for option, values in zip(options(results), largest_mm.values.tolist(), strict=True)
    )
    caption = (
        "Displacement of the block against the shell at its springs, mm: largest of the four "
        "springs and of a revolution, without the sag. Start and stop are not modelled"
    )
    return Table(caption, ("Option", *(f"At {speed:g} rpm" for speed in speeds(results))), rows)


def isolation_sentence(results: xr.Dataset) -> str:
    """Compare the 1x line with the natural frequencies."""
    shaft, modes = first_order_hz(results), results["natural_frequency"].values
    where = f"1× lies at {rounding.span(shaft, rounding.fixed)} Hz"
    highest = rounding.fixed(float(modes.max()))
    if shaft.min() > np.sqrt(2.0) * modes.max():
        return f"{where}, well above the highest mode at {highest} Hz: the mounts isolate."
    if shaft.min() > modes.max():
        return f"{where}, just above the highest mode at {highest} Hz: resonance is near."
    return f"{where}, the highest mode at {highest} Hz: the 1× line can meet a resonance."


def _blocks(results: xr.Dataset) -> list[Block]:
    block = block_table(few_speeds(results))
    return [
        Text(isolation_sentence(results)),
        *filter(None, (modes_table(results), attached_table(results))),
        *(chosen_speeds(results, "results.nc") if block else []),
        *([block] if block else []),
        Pictures((mount_transmissibility(results),)),
    ]


register(Section("mounts", "Mounts", _blocks, position=60.0))
