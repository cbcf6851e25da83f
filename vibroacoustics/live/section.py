"""Sliders, spectrum and sound of the page, where a browser runs its script, and their data."""

import json
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.arrays import ComplexArray
from ..base.registry import register
from ..base.units import split_key
from ..base.vocabulary import REFERENCE_OPTION
from ..levels.baseline import left_of_squares
from ..levels.measured_points import BASELINE_BANDS
from ..report.blocks import Block, Live, Text
from ..report.sections import Section, hold
from ..report.sections.unknowns import file_unit, named
from ..report.shown_speeds import chosen_speeds, few_speeds
from ..results.stored_study import catalogue_receiver, options
from ..uncertainty.slider_variables import HOOD
from .lines import Lines, lines_at
from .mounts import is_over_frequency, put_matrices, stiffness_over_frequency
from .moving import Moving, moving_of
from .numbers import FEW_BITS, LOAD_BITS, NOISE_BITS, Numbers
from .transmission import beside


def case_of(numbers: Numbers, lines: Lines, moving: Moving | None, speed: int) -> dict[str, Any]:
    """One speed with all options.

    Arrays are the numbers of their first elements in `numbers`, by option where nothing else is
    said: `rest` and `modelled` (microphone), beside the lines, `noise` (microphone, band),
    `pressure` beside that of the loads (microphone, line), `load` (line, 6), `weight` (line; force,
    moment; axis), `factor` (line); `vector` of all options (line, microphone, 6) and, by machine,
    `stiffness` over frequency (line, 21); with a baseline what the model leaves of it, `left`
    (microphone, line) and whether with its `phase`. A line that is no order has zeros. Where
    nothing moves there are `pressure`, as it sounds, and `modelled` with its lines.
    """
    case: dict[str, Any] = {
        "frequency": [round(float(hertz), 9) for hertz in lines.frequency_hz],
        "order": [None if np.isnan(order) else float(order) for order in lines.order],
        "rest": [numbers.put(of_option) for of_option in lines.continuous],
        "noise": [numbers.put(of_option, NOISE_BITS) for of_option in lines.noise],
    }
    if moving is None:
        return case | {
            "modelled": [
                numbers.put(values) for values in lines.modelled_continuous + lines.of_model
            ],
            "pressure": [numbers.put(values, FEW_BITS) for values in lines.pressure],
        }
    case["modelled"] = [numbers.put(of_option) for of_option in lines.modelled_continuous]
    return case | _moving_case(numbers, lines, moving, speed)


def _moving_case(numbers: Numbers, lines: Lines, moving: Moving, speed: int) -> dict[str, Any]:
    of_run, machines = moving.transmission, moving.machines
    load = [_by_line(lines, component) for component in of_run.load[speed]]
    factor = [machines.amplitude_factor(name, lines.frequency_hz) for name in machines.option]
    of_loads = np.array([_by_line(lines, component).T for component in of_run.pressure[speed]])
    others = beside(lines.modelled, of_loads)
    case: dict[str, Any] = {
        "vector": numbers.put(_by_line(lines, of_run.vector[speed]), FEW_BITS),
        "load": [numbers.put(component, LOAD_BITS) for component in load],
        "factor": [numbers.put_unless(values, 1.0) for values in factor],
        "pressure": [numbers.put_unless(other, 0.0, FEW_BITS) for other in others],
    }
    if np.any(lines.measured):
        none = list(machines.option).index(REFERENCE_OPTION)
        case["left"] = numbers.put(_left(lines, none), LOAD_BITS)
        case["phase"] = numbers.put(lines.has_phase)
    if moving.unit_loads is not None:
        weight = [_by_line(lines, component) for component in moving.unit_loads[speed]]
        case["weight"] = [numbers.put(component, LOAD_BITS) for component in weight]
    if any(map(is_over_frequency, machines.different)):
        at_lines = (
            stiffness_over_frequency(stiffness, lines.frequency_hz)
            for stiffness in machines.different
        )
        case["stiffness"] = [numbers.put(values, LOAD_BITS) for values in at_lines]
    return case


def _left(lines: Lines, none: int) -> ComplexArray:
    """Measured orders less the model without an option, (receiver, line), Pa.

    A difference of peaks where the phase is known, else of energies, as `changed_orders` has it.
    """
    before = lines.modelled[none]
    squares = left_of_squares(np.abs(lines.measured) ** 2, np.abs(before) ** 2)
    return np.where(lines.has_phase, lines.measured - before, np.sqrt(squares))


def _by_line(lines: Lines, values: ComplexArray) -> ComplexArray:
    """Values at the lines, of which the orders come first; zero at other lines."""
    by_order = np.moveaxis(values, -1, 0)
    is_kept = np.isfinite(lines.order) & (lines.order < len(by_order))
    chosen = np.where(is_kept, lines.order, 0).astype(int)
    shape = (-1, *[1] * (values.ndim - 1))
    return np.asarray(by_order[chosen] * is_kept.reshape(shape))


_DIMS = ("slider_machine", "receiver", "noise_band")
_CHOSEN: Final = ("m", "m2", "m3", "kg", "kg_m2", "rad")
"""Units, SI, of what a designer chooses: lengths, areas, volumes, masses, inertias, angles."""


def has_sliders(results: xr.Dataset) -> bool:
    """Return whether the run computed sliders at one of its speeds that are shown."""
    return "slider_value" in results and float(results["slider_speed"]) in results["speed"].values


def sliders_of(numbers: Numbers, shown: xr.Dataset) -> dict[str, Any]:
    """Return the sliders: their nodes in the units of files, and changes of levels in dB.

    Arrays are the numbers of their first elements in `numbers`: `before` by option (sample,
    microphone, band), `change` by slider (node, sample, microphone, band). `own` is the position at
    which the samples keep their own values, `error` by option and microphone that of several
    sliders together.
    """
    before = shown["slider_band_level"].transpose("option", *_DIMS)
    error = shown["slider_addition_error"].transpose("option", "receiver").values
    return {
        "speed": shown["speed"].values.tolist().index(float(shown["slider_speed"])),
        "samples": shown.sizes["slider_machine"],
        "before": [numbers.put(before.sel(option=name), NOISE_BITS) for name in options(shown)],
        "error": error.round(3).tolist(),
        "list": [_slider(numbers, shown.sel(slider=name)) for name in shown["slider"].values],
    }


def _is_chosen(name: str) -> bool:
    unit = split_key(name.rpartition(".")[2])[1]
    return unit is not None and unit.si_suffix in _CHOSEN


def _slider(numbers: Numbers, slider: xr.Dataset) -> dict[str, Any]:
    name, values = str(slider["slider"].values), slider["slider_value"].values
    is_hood = name == HOOD
    words, (unit, factor) = ("insertion loss of a hood", ("dB", 1.0))
    if not is_hood:
        words, (unit, factor) = named(name), file_unit(slider, name)
    start = np.interp(float(slider["slider_start"]), values, np.arange(values.size))
    change = slider["slider_band_change"].transpose("slider_node", *_DIMS)
    ends = [float(f"{end / factor:.3g}") for end in (values[0], values[-1])]
    return {
        "name": words[0].upper() + words[1:],
        "unit": unit,
        "values": (values / factor).tolist(),
        "own": round(float(start), 1),
        "sampled": "none" if is_hood else f"as sampled, {ends[0]:g} to {ends[1]:g} {unit}".strip(),
        "chosen": is_hood or _is_chosen(name),
        "change": numbers.put(change, FEW_BITS),
        "error": round(float(slider["slider_interpolation_error"]), 3),
    }


MOST_MICROPHONES: Final = 10
HEADROOM: Final = 2.0
"""Full scale over the largest pressure of the nominal options: sliders may be louder."""
_CREST: Final = 4.0
"""Peak over effective value of the noise that full scale leaves room for."""


def live_data(results: xr.Dataset) -> str:
    """JSON for the script of the page.

    Lines are those of all sources together at the speeds and microphones that are shown. The page
    holds loads of the moving parts, matrices of the mounts, pressure per velocity and the pressure
    of other sources. With a baseline or measured sound by force nothing varies, and it holds the
    pressure of each option.
    """
    shown = _shown(results)
    middle_hz = {band.nominal_hz: band.middle_hz for band in BASELINE_BANDS}
    bands = np.array([middle_hz[nominal] for nominal in shown["noise_band"].values.tolist()])
    moving = None if has_sliders(shown) else moving_of(shown)
    numbers = Numbers()
    page: dict[str, Any] = {
        "speeds": shown["speed"].values.tolist(),
        "microphones": [str(name) for name in shown["receiver"].values],
        "options": options(shown),
        "bands": bands.tolist(),
    }
    if has_sliders(shown):
        page["sliders"] = sliders_of(numbers, shown)
    if moving is not None and moving.weight is not None:
        page["weight"] = moving.weight._asdict()
    if moving is not None:
        page["mounts"] = [put_matrices(matrices) for matrices in moving.mounts]
        page["mounts_move"] = moving.mounts_move
        page["machine"] = [moving.machines.number(name) for name in page["options"]]
    always = frozenset() if moving is None else moving.orders()
    lines = [lines_at(shown, speed, bands, always) for speed in page["speeds"]]
    page["cases"] = [case_of(numbers, of_case, moving, s) for s, of_case in enumerate(lines)]
    page["full_scale_pa"] = full_scale_pa(lines)
    page["numbers"] = numbers.text
    return json.dumps(page, separators=(",", ":"), allow_nan=False)


def full_scale_pa(lines: list[Lines]) -> float:
    """Pressure of a digital sample of 1, the same for all: 1, 2 or 5 times a power of ten."""
    peak = max(
        float(
            np.max(
                np.abs(of_case.pressure).sum(axis=-1) + _CREST * np.sqrt(of_case.noise.sum(axis=-1))
            )
        )
        for of_case in lines
    )
    wanted = HEADROOM * max(peak, 1e-6)
    exponent = f"{wanted:e}".split("e")[1]
    sizes = (float(f"{digit}e{exponent}") for digit in (1, 2, 5, 10))
    return next(size for size in sizes if size >= wanted)


def _shown(results: xr.Dataset) -> xr.Dataset:
    """Results at few speeds and microphones, those of the published level first."""
    few = few_speeds(results)
    names = [str(name) for name in few["receiver"].values]
    names.sort(key=lambda name: name != catalogue_receiver(results))
    return few.sel(receiver=names[:MOST_MICROPHONES])


def _blocks(results: xr.Dataset) -> list[Block]:
    return [
        Text(
            "In report.html, where a browser runs its script, levels, spectrum and sound follow "
            f"sliders, at computed speeds and at {MOST_MICROPHONES} microphones at most. "
            f"{_values_words(results)}",
            "note",
        ),
        *chosen_speeds(results, "comparison.csv"),
        Live(live_data(results)),
    ]


def _values_words(results: xr.Dataset) -> str:
    if not has_sliders(results):
        return "They are those of the pipeline with the nominal values."
    return (
        "Levels begin at the median of the samples. Sliders add their median change in "
        f"{results.sizes['slider_machine']} weighted samples at "
        f"{float(results['slider_speed']):g} rpm."
    )


register(Section("live", "Try it", _blocks, hold("noise_band_level", "pressure_line"), 25.0))
