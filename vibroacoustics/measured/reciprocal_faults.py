"""Faults of single points, by what makes their functions reciprocal again."""

from collections.abc import Sequence
from itertools import combinations
from typing import Final

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..recordings import Node
from .fault import Fault
from .physics_tests import (
    lag,
    passivity,
    real_factor,
    reciprocity_residual,
    second_hit,
    share_giving_power,
)

SHORTEST_DELAY_S: Final = 1e-4
KNOWN_FACTORS: Final = {
    9.80665: "g and m/s²", 1000.0: "mm and m", 4.44822: "lbf and N", 25.4: "inch and mm",
    2.0**0.5: "RMS and peak",
}  # fmt: skip
"""Factors of units and of conventions that are taken for one another."""


class ResponseMatrix:
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

    def scale_references(self, node: Node, factor: complex | ComplexArray) -> None:
        """Multiply all functions of the hits at a node."""
        for pair in self.values:
            if pair[1] == node:
                self.values[pair] = self.values[pair] * factor

    def exchanged(self, node: Node, other: Node) -> "ResponseMatrix":
        """Return the functions with two sensors exchanged."""
        names = {node: other, other: node}
        values = {(names.get(r, r), c): value for (r, c), value in self.values.items()}
        matrix = ResponseMatrix(self.frequency_hz, values)
        matrix.ignored = self.ignored
        return matrix

    def driving_passivity(self, node: Node) -> float:
        """Return the `passivity` of a driving point; 0 where it is not measured."""
        return passivity(self.values[node, node]) if (node, node) in self.values else 0.0


def next_fault(
    matrix: ResponseMatrix, pairs: Sequence[tuple[Node, Node]], limit: float
) -> tuple[Fault, ResponseMatrix]:
    """Find the fault that explains most pairs that are not reciprocal, and correct it."""
    named = [node for pair in pairs for node in pair]
    most = max(map(named.count, named))
    worst = [node for node in dict.fromkeys(named) if named.count(node) == most]
    worst.sort(key=matrix.driving_passivity)
    for explain in (_polarity, _factor, _delay, _double_hit):
        for node in worst:
            fault = explain(matrix, node, limit)
            if fault is not None:
                is_ambiguous = len(worst) == 2 and (
                    fault.name == "factor"
                    or (fault.name == "delay" and not _decides(matrix, worst))
                )
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


def _decides(matrix: ResponseMatrix, nodes: Sequence[Node]) -> bool:
    """Whether the driving points of all nodes are measured: they show whose delay it is."""
    return all((node, node) in matrix.values for node in nodes)


def _polarity(matrix: ResponseMatrix, node: Node, limit: float) -> Fault | None:
    if matrix.residual(node, -1.0) > limit:
        return None
    matrix.scale_responses(node, -1.0)
    words = "sensor is upside down, or hits are in the pull direction; reverse its direction"
    return Fault("polarity", (node,), words)


def _factor(matrix: ResponseMatrix, node: Node, limit: float) -> Fault | None:
    factor = real_factor(*matrix.stacked(node))
    if matrix.residual(node, factor) > limit:
        return None
    matrix.scale_responses(node, 1.0 / factor)
    words = f"sensor is {abs(factor):.3g} times too large{likely_units(abs(factor))}"
    return Fault("factor", (node,), words)


def likely_units(factor: float) -> str:
    """Return the units that are likely taken for one another."""
    for unit_ratio, units in KNOWN_FACTORS.items():
        if abs(np.log(max(factor, 1.0 / factor) / unit_ratio)) < 0.1:
            return f"; check its unit ({units}) and calibration"
    return "; check its sensitivity"


def _delay(matrix: ResponseMatrix, node: Node, limit: float) -> Fault | None:
    """Delay of a sensor, or of the force of the hits at its point: its driving point decides."""
    estimate = lag(matrix.frequency_hz, *matrix.stacked(node))
    turn = np.exp(-2j * np.pi * matrix.frequency_hz * estimate.delay_s)
    shift = estimate.factor * turn
    if abs(estimate.delay_s) < SHORTEST_DELAY_S or matrix.residual(node, shift) > limit:
        return None
    driving = matrix.values.get((node, node))
    is_of_force = driving is not None and (
        share_giving_power(driving * turn) < share_giving_power(driving / turn)
    )
    matrix.scale_responses(node, 1.0 / estimate.factor)
    if is_of_force:
        matrix.scale_references(node, turn)
    else:
        matrix.scale_responses(node, 1.0 / turn)
    unknown = "sensor, or the force of the hits here," if driving is None else "sensor"
    return delayed((node,), "force of the hits here" if is_of_force else unknown, estimate.delay_s)


def delayed(nodes: tuple[Node, ...], channel: str, delay_s: float, about: str = "") -> Fault:
    """Return the fault of a channel that is late, or early."""
    words = (
        f"{channel} is {about}{1e3 * abs(delay_s):.2g} ms {'late' if delay_s > 0.0 else 'early'}"
    )
    return Fault("delay", nodes, f"{words}; align channels, or export them again")


def _double_hit(matrix: ResponseMatrix, node: Node, limit: float) -> Fault | None:
    values, reciprocal = matrix.stacked(node)
    estimate = second_hit(matrix.frequency_hz, reciprocal, values)
    comb = 1.0 + estimate.factor * np.exp(-2j * np.pi * matrix.frequency_hz * estimate.delay_s)
    if estimate.factor < 0.1 or matrix.residual(node, 1.0 / comb) > limit:
        return None
    matrix.scale_references(node, 1.0 / comb)
    words = (
        f"hits are double, the second after {1e3 * estimate.delay_s:.3g} ms; hit this point again"
    )
    return Fault("double-hit", (node,), words)
