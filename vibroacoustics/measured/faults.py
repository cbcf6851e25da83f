"""Faults of a hammer test: sensors, points and channels whose functions break physics."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations
from typing import Final, NamedTuple

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError
from ..recordings import MeasuredFunction, Node
from ..recordings.measured_function import DERIVATIVES
from .grouped import Key
from .physics_tests import (
    causality,
    lag,
    parallel_mass_kg,
    passivity,
    real_factor,
    reciprocity_residual,
    second_hit,
    unexplained,
)  # fmt: skip

FAULTS: Final = (
    "convention", "polarity", "swapped", "factor", "delay", "double-hit", "reciprocity", "mass",
    "operating",
)  # fmt: skip
"""Names of faults."""
LARGEST_RESIDUAL: Final = 0.05
"""Largest share of power by which H12 and H21 differ: 32 % of the amplitude; assumed."""
LEAST_CAUSALITY, LEAST_PASSIVITY = -0.02, -0.1
"""Limits of a function that runs backwards and of a driving point that gives power; assumed."""
SHORTEST_DELAY_S: Final = 1e-4
LEAST_LINES: Final = 16
"""Fewest even lines of an impulse response; assumed."""
LEAST_UNEXPLAINED: Final = 0.005
"""Share of the operating power above which phases are compared: noise of 5 to 7 %; assumed."""
MASS_TOLERANCE: Final = 0.25
"""Share by which the mass line may differ from the stated mass; assumed."""
KNOWN_FACTORS: Final = {
    9.80665: "g and m/s²", 1000.0: "mm and m", 4.44822: "lbf and N", 25.4: "inch and mm",
    2.0**0.5: "RMS and peak",
}  # fmt: skip
"""Factors of units and of conventions that are taken for one another."""


class Fault(NamedTuple):
    """Fault of measured functions.

    Attributes
    ----------
    name : one of `FAULTS`
    nodes : sensors or points that have it; empty if all have
    words : description of the fault and its remedy
    """

    name: str
    nodes: tuple[Node, ...]
    words: str

    def line(self, names: Mapping[Node, str]) -> str:
        """Return the fault with the names of its points.

        Parameters
        ----------
        names : names of points by node
        """
        labels = [f"{names[node]} ({node})" if node in names else str(node) for node in self.nodes]
        return f"{self.name} at {' and '.join(labels) or 'all points'}: {self.words}"


class _Matrix:
    """Mobilities by response and reference, corrected by each fault that is estimate."""

    def __init__(self, frequency_hz: Array, values: dict[tuple[Node, Node], ComplexArray]) -> None:
        self.frequency_hz, self.values = frequency_hz, values
        self.ignored: set[frozenset[Node]] = set()

    def pair(self, node: Node, other: Node) -> tuple[ComplexArray, ComplexArray]:
        """Return both functions of two nodes, with large values weighted less."""
        values, reciprocal = self.values[node, other], self.values[other, node]
        weight = np.maximum(np.abs(values * reciprocal), 1e-300) ** -0.25
        return values * weight, reciprocal * weight

    def partners(self, node: Node) -> list[Node]:
        """Return nodes whose functions with this one are measured in both directions."""
        return [
            other
            for response, other in self.values
            if response == node != other
            and (other, node) in self.values
            and frozenset((node, other)) not in self.ignored
        ]

    def stacked(self, node: Node) -> tuple[ComplexArray, ComplexArray]:
        """Return the functions of a node as response and as reference, (partner, frequency)."""
        pairs = [self.pair(node, other) for other in self.partners(node)]
        return np.array([pair[0] for pair in pairs]), np.array([pair[1] for pair in pairs])

    def residual(self, node: Node, factor: complex | ComplexArray = 1.0) -> float:
        """Return the largest residual of a node's pairs with a factor on its reciprocal ones."""
        return max(
            reciprocity_residual(values, reciprocal, factor)
            for values, reciprocal in zip(*self.stacked(node), strict=True)
        )

    def bad_pairs(self, limit: float) -> list[tuple[Node, Node]]:
        """Return pairs of nodes that are not reciprocal."""
        nodes = dict.fromkeys(node for pair in self.values for node in pair)
        return [
            (node, other)
            for node, other in combinations(nodes, 2)
            if other in self.partners(node)
            and reciprocity_residual(*self.pair(node, other)) > limit
        ]

    def scale_responses(self, node: Node, factor: complex | ComplexArray) -> None:
        """Multiply all functions that a sensor has measured."""
        for pair in self.values:
            if pair[0] == node:
                self.values[pair] = self.values[pair] * factor

    def exchanged(self, node: Node, other: Node) -> "_Matrix":
        """Return the functions with two sensors exchanged."""
        names = {node: other, other: node}
        values = {(names.get(r, r), c): value for (r, c), value in self.values.items()}
        matrix = _Matrix(self.frequency_hz, values)
        matrix.ignored = self.ignored
        return matrix

    def driving_passivity(self, node: Node) -> float:
        """Return the `passivity` of a driving point; 0 where it is not measured."""
        return passivity(self.values[node, node]) if (node, node) in self.values else 0.0


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
    limit = max(LARGEST_RESIDUAL, 5.0 * noise_ratio**2)
    while pairs := matrix.bad_pairs(limit):
        fault, matrix = _next_fault(matrix, pairs, limit)
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


def _matrix(functions: Mapping[tuple[Node, Node], MeasuredFunction]) -> _Matrix:
    """Mobilities at the frequencies of the first function."""
    first = next(iter(functions.values())).frequency_hz
    return _Matrix(
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


def _next_fault(
    matrix: _Matrix, pairs: Sequence[tuple[Node, Node]], limit: float
) -> tuple[Fault, _Matrix]:
    """Find the fault that explains most pairs that are not reciprocal, and correct it."""
    named = [node for pair in pairs for node in pair]
    most = max(map(named.count, named))
    worst = [node for node in dict.fromkeys(named) if named.count(node) == most]
    worst.sort(key=matrix.driving_passivity)
    for explain in (_polarity, _factor, _delay, _double_hit):
        for node in worst:
            fault = explain(matrix, node, limit)
            if fault is not None:
                is_ambiguous = len(worst) == 2 and fault.name in ("factor", "delay")
                return (fault._replace(nodes=tuple(worst)) if is_ambiguous else fault), matrix
    for node, other in combinations(dict.fromkeys(named), 2):
        exchanged = matrix.exchanged(node, other)
        if not {node, other} & {each for pair in exchanged.bad_pairs(limit) for each in pair}:
            words = "functions fit with these two exchanged; check cables and names of both points"
            return Fault("swapped", (node, other), words), exchanged
    nodes = (worst[0],) if len(worst) == 1 else pairs[0]
    matrix.ignored |= {frozenset(pair) for pair in pairs if set(nodes) & set(pair)}
    words = (
        "functions differ with sensor and hammer exchanged; check that hits are at the sensor and "
        "in its direction, and measure again"
    )
    return Fault("reciprocity", tuple(nodes), words), matrix


def _polarity(matrix: _Matrix, node: Node, limit: float) -> Fault | None:
    if matrix.residual(node, -1.0) > limit:
        return None
    matrix.scale_responses(node, -1.0)
    words = "sensor is upside down, or hits are in the pull direction; reverse its direction"
    return Fault("polarity", (node,), words)


def _factor(matrix: _Matrix, node: Node, limit: float) -> Fault | None:
    factor = real_factor(*matrix.stacked(node))
    if matrix.residual(node, factor) > limit:
        return None
    matrix.scale_responses(node, 1.0 / factor)
    words = f"sensor is {abs(factor):.3g} times too large{_likely(abs(factor))}"
    return Fault("factor", (node,), words)


def _likely(factor: float) -> str:
    """Return the units that are likely taken for one another."""
    for unit_ratio, units in KNOWN_FACTORS.items():
        if abs(np.log(max(factor, 1.0 / factor) / unit_ratio)) < 0.1:
            return f"; check its unit ({units}) and calibration"
    return "; check its sensitivity"


def _delay(matrix: _Matrix, node: Node, limit: float) -> Fault | None:
    estimate = lag(matrix.frequency_hz, *matrix.stacked(node))
    shift = estimate.factor * np.exp(-2j * np.pi * matrix.frequency_hz * estimate.delay_s)
    if abs(estimate.delay_s) < SHORTEST_DELAY_S or matrix.residual(node, shift) > limit:
        return None
    matrix.scale_responses(node, 1.0 / shift)
    words = f"channel is {1e3 * estimate.delay_s:.3g} ms late; align channels, or export them again"
    return Fault("delay", (node,), words)


def _double_hit(matrix: _Matrix, node: Node, limit: float) -> Fault | None:
    values, reciprocal = matrix.stacked(node)
    estimate = second_hit(matrix.frequency_hz, reciprocal, values)
    comb = 1.0 + estimate.factor * np.exp(-2j * np.pi * matrix.frequency_hz * estimate.delay_s)
    if estimate.factor < 0.1 or matrix.residual(node, 1.0 / comb) > limit:
        return None
    for pair in matrix.values:
        if pair[1] == node:
            matrix.values[pair] = matrix.values[pair] / comb
    words = (
        f"hits are double, the second after {1e3 * estimate.delay_s:.3g} ms; hit this point again"
    )
    return Fault("double-hit", (node,), words)


def _of_driving_points(matrix: _Matrix) -> Iterator[Fault]:
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
    matrix: _Matrix, mass_kg: float, nodes: Sequence[Node], lowest_hz: float, highest_hz: float
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
            f"{_likely(factor)}, or mass_kg"
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


def refuse(faults: Sequence[Fault], despite: Sequence[str], names: Mapping[Node, str]) -> None:
    """Stop at faults that are not accepted.

    Parameters
    ----------
    faults : faults found
    despite : names of faults that are accepted
    names : names of points by node

    Raises
    ------
    ParameterError
        A line for each fault whose name is not in `despite`, or a name is unknown.
    """
    for name in despite:
        if name not in FAULTS:
            raise ParameterError(f"--despite {name}: must be one of {', '.join(FAULTS)}")
    lines = [
        f"{fault.line(names)}; or accept it by --despite {fault.name}"
        for fault in faults
        if fault.name not in despite
    ]
    if lines:
        raise ParameterError(*lines)
