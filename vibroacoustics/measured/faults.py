"""Faults of a hammer test: sensors, points and channels whose functions break physics."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from ..base.arrays import ComplexArray
from ..base.errors import ParameterError
from ..recordings import MeasuredFunction, Node
from ..recordings.measured_function import DERIVATIVES
from .fault import Fault
from .grouped import Key
from .physics_tests import (
    LEAST_GIVING,
    causality,
    driving_delay_s,
    parallel_mass_kg,
    share_giving_power,
    unexplained,
)
from .reciprocal_faults import (
    SHORTEST_DELAY_S,
    ResponseMatrix,
    delayed,
    likely_units,
    next_fault,
)

LARGEST_RESIDUAL: Final = 0.05
"""Largest share of power by which H12 and H21 differ: 32 % of the amplitude; assumed."""
LEAST_CAUSALITY, LEAST_PASSIVITY = -0.02, -0.1
"""Limits of a function that runs backwards and of a driving point that gives power; assumed."""
LEAST_LINES: Final = 16
"""Fewest even lines of an impulse response; assumed."""
LEAST_UNEXPLAINED: Final = 0.005
"""Share of the operating power above which phases are compared: noise of 5 to 7 %; assumed."""
MASS_TOLERANCE: Final = 0.25
"""Share by which the mass line may differ from the stated mass; assumed."""


def function_faults(
    responses: Mapping[Key, Sequence[MeasuredFunction]],
    noise_ratio: float = 0.0,
    mass_kg: float | None = None,
    mass_line: tuple[Sequence[Node], float, float] = ((), 0.0, 0.0),
) -> list[Fault]:
    """Find the faults of frequency responses; those of one node are searched for one by one.

    Parameters
    ----------
    responses : functions by kind and unsigned nodes; see `by_key`
    noise_ratio : relative error, RMS
    mass_kg : mass of the freely hung machine; None if it is not known
    mass_line : its nodes, and the lowest and highest frequency of its mass line, Hz
    """
    functions = _means(responses)
    if not functions:
        return []
    faults, functions = _of_convention(functions)
    matrix = _matrix(functions)
    faults += _of_all_forces(matrix)
    limit = max(LARGEST_RESIDUAL, 5.0 * noise_ratio**2)
    while pairs := matrix.bad_pairs(limit):
        fault, matrix = next_fault(matrix, pairs, limit)
        faults.append(fault)
    faults += _of_driving_points(matrix)
    return [*faults, *(() if mass_kg is None else _of_mass(matrix, mass_kg, *mass_line))]


def point_measures(
    responses: Mapping[Key, Sequence[MeasuredFunction]], names: Mapping[Node, str]
) -> list[dict[str, str | float]]:
    """Return passivity, causality and reciprocity of each point as they were measured.

    Parameters
    ----------
    responses : functions by kind and unsigned nodes; see `by_key`
    names : names of points by node
    """
    functions = _means(responses)
    matrix, shares = _matrix(functions), _causalities(functions)
    rows: list[dict[str, str | float]] = []
    for node in dict.fromkeys(reference for _, reference in functions):
        causal = [share for pair, share in shares.items() if pair[1] == node]
        has_driving, has_partners = (node, node) in matrix.values, bool(matrix.partners(node))
        rows.append({
            "point": names.get(node, str(node)),
            "passivity": matrix.driving_passivity(node) if has_driving else np.nan,
            "causality": float(np.mean(causal)) if causal else np.nan,
            "reciprocity_residual": matrix.residual(node) if has_partners else np.nan,
        })  # fmt: skip
    return rows


def _matrix(functions: Mapping[tuple[Node, Node], MeasuredFunction]) -> ResponseMatrix:
    """Mobilities at the frequencies of the first function."""
    first = next(iter(functions.values())).frequency_hz
    return ResponseMatrix(
        first,
        {
            pair: np.interp(first, function.frequency_hz, function.with_response_in("m/s").values)
            for pair, function in functions.items()
            if function.response_unit in DERIVATIVES and function.reference_unit == "N"
        },
    )


def _means(
    responses: Mapping[Key, Sequence[MeasuredFunction]],
) -> dict[tuple[Node, Node], MeasuredFunction]:
    means = {}
    for (kind, response, reference), repeats in responses.items():
        first = repeats[0]
        same = [each.values for each in repeats if each.values.shape == first.values.shape]
        if kind == "frequency response" and reference is not None and first.values.size > 1:
            means[response, reference] = replace(first, values=np.mean(same, axis=0))
    return means


def _causalities(
    functions: Mapping[tuple[Node, Node], MeasuredFunction],
) -> dict[tuple[Node, Node], float]:
    """Causality of each function with enough even lines."""
    return {
        pair: causality(function.values)
        for pair, function in functions.items()
        if function.values.size >= LEAST_LINES
        and np.ptp(np.diff(function.frequency_hz)) < 0.01 * np.ptp(function.frequency_hz[:2])
    }


def _of_convention(
    functions: dict[tuple[Node, Node], MeasuredFunction],
) -> tuple[list[Fault], dict[tuple[Node, Node], MeasuredFunction]]:
    """Find conjugated functions, of all points or of the hits of one; and turn them."""
    shares = _causalities(functions)
    references = dict.fromkeys(reference for _, reference in shares)
    turned = [
        node for node in references
        if np.mean([value for pair, value in shares.items() if pair[1] == node]) < LEAST_CAUSALITY
    ]  # fmt: skip
    if not turned:
        return [], functions
    nodes = () if len(turned) == len(references) else tuple(turned)
    words = (
        "impulse responses run backwards in time; conjugate these functions, or export them with "
        "the time convention exp(jωt)"
    )
    right = {
        pair: replace(function, values=function.values.conj()) if pair[1] in turned else function
        for pair, function in functions.items()
    }
    return [Fault("convention", nodes, words)], right


def _of_all_forces(matrix: ResponseMatrix) -> list[Fault]:
    """Find a force channel that is late in all hits, and correct its functions.

    Reciprocity does not show it: driving points do, of which most give power.
    """
    driving = [value for (node, other), value in matrix.values.items() if node == other]
    giving = [value for value in driving if share_giving_power(value) > LEAST_GIVING]
    if 2 * len(giving) <= len(driving):
        return []
    delay_s = driving_delay_s(matrix.frequency_hz, driving)
    if abs(delay_s) < SHORTEST_DELAY_S:
        return []
    for node in dict.fromkeys(reference for _, reference in matrix.values):
        matrix.scale_references(node, np.exp(-2j * np.pi * matrix.frequency_hz * delay_s))
    channel = "force channel" if delay_s > 0.0 else "channel of responses"
    return [delayed((), f"{channel} of all hits", abs(delay_s), "about ")]


def _of_driving_points(matrix: ResponseMatrix) -> Iterator[Fault]:
    """Driving points that give power, which no structure does."""
    shares = {
        response: matrix.driving_passivity(response)
        for response, reference in matrix.values
        if response == reference
    }
    wrong = [node for node, share in shares.items() if share < LEAST_PASSIVITY]
    if 2 * len(wrong) > len(shares) and max(shares.values()) < -LEAST_PASSIVITY:
        words = "driving points give power; the force channel is in the pull direction: reverse it"
        yield Fault("polarity", (), words)
        return
    for node in wrong:
        words = "driving point gives power; reverse the sensor, or hit where the sensor is"
        yield Fault("polarity", (node,), words)


def _of_mass(
    matrix: ResponseMatrix,
    mass_kg: float,
    nodes: Sequence[Node],
    lowest_hz: float,
    highest_hz: float,
) -> Iterator[Fault]:
    """Mass line that differs from the mass of the machine."""
    missing = [(i, j) for i in nodes for j in nodes if (i, j) not in matrix.values]
    if missing:
        raise ParameterError(
            "measured.free_machine.points: needs functions of all pairs; "
            f"{missing[0][0]}/{missing[0][1]} is in no file"
        )
    frequency = matrix.frequency_hz
    kept = (frequency >= lowest_hz) & (frequency <= highest_hz)
    if not np.any(kept):
        raise ParameterError(
            f"measured.free_machine: has no line from {lowest_hz:g} to {highest_hz:g} Hz"
        )
    mobility = np.array([[matrix.values[i, j][kept] for j in nodes] for i in nodes])
    accelerance = (2j * np.pi * frequency[kept] * mobility).transpose(2, 0, 1)
    measured_kg = abs(parallel_mass_kg(accelerance))
    factor = mass_kg / measured_kg
    if abs(np.log(factor)) > np.log1p(MASS_TOLERANCE):
        words = (
            f"mass line is that of {measured_kg:.3g} kg, the machine has {mass_kg:.3g} kg"
            f"{likely_units(factor)}, or mass_kg"
        )
        yield Fault("mass", (), words)


def operating_faults(
    compliances: Sequence[ComplexArray], response: ComplexArray, nodes: Sequence[Node]
) -> list[Fault]:
    """Find operating responses whose phases contradict the hammer test.

    Parameters
    ----------
    compliances : responses per force at each interface that the source may be beyond, shape
        (frequency, response, force)
    response : operating responses, shape (frequency, response)
    nodes : nodes of the responses
    """
    usable = [each for each in compliances if each.shape[1] > each.shape[2]]
    if not usable:
        return []

    def least(values: ComplexArray) -> float:
        return min(unexplained(compliance, values) for compliance in usable)

    tried: list[tuple[ComplexArray, Fault]] = []
    words = "phases fit the hammer test only if they are conjugated; conjugate the spectra"
    tried.append((response.conj(), Fault("operating", (), words)))
    words = "phase fits the hammer test only if it is reversed; reverse the operating sensor"
    for number, node in enumerate(nodes):
        sign = np.where(np.arange(len(nodes)) == number, -1.0, 1.0)
        tried.append((response * sign, Fault("operating", (node,), words)))
    shares, present = [least(values) for values, _ in tried], least(response)
    best = int(np.argmin(shares))
    is_better = present > LEAST_UNEXPLAINED and shares[best] < present / 3.0
    return [tried[best][1]] if is_better else []
