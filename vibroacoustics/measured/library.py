"""Measured functions by their nodes, along positive directions, with their random errors."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import chain
from pathlib import Path
from typing import Final

import numpy as np

from ..base.arrays import Array, ComplexArray, IndexArray
from ..base.errors import ParameterError, VibroacousticsError
from ..recordings import MeasuredFunction, Node
from .band import error_of_coherence, error_of_repeats
from .fault import Fault, refuse
from .faults import function_faults, operating_faults, point_measures
from .grouped import Key, by_key, read_each, unsigned
from .settings import Measured

SAME_FREQUENCY: Final = 2e-5
"""Share by which files of one axis may differ: they state six digits."""

Estimate = tuple[ComplexArray, Array]
"""Values and RMS of their complex error, each of shape (frequency,)."""


class Library:
    """Measured functions by kind and unsigned nodes, with their errors at the operating lines."""

    def __init__(self, settings: Measured, folder: Path, despite: Sequence[str] = ()) -> None:
        self._settings, self._despite = settings, despite
        names = (*settings.frequency_responses, *settings.operating)
        files = read_each(names, settings.units, folder)
        count = len(settings.frequency_responses)
        self._responses = by_key(list(chain.from_iterable(files[:count])))
        self._operating = by_key(list(chain.from_iterable(files[count:])))
        self.frequency_hz = self._lines()
        self.faults: list[Fault] = []
        self._accept(self._faults_of_responses())
        self._estimates: list[Estimate] = []
        self._numbers: dict[tuple[str, str], int] = {}

    @property
    def estimates(self) -> tuple[ComplexArray, Array]:
        """Values and errors of all functions that were asked for."""
        values, errors = zip(*self._estimates, strict=True)
        return np.array(values), np.array(errors)

    @property
    def _names(self) -> dict[Node, str]:
        """Names of points and microphones by unsigned node."""
        settings = self._settings
        return {
            unsigned(Node(point.node, point.direction)): name
            for name, point in (*settings.points.items(), *settings.microphones.items())
        }

    @property
    def _named_responses(self) -> dict[Key, list[MeasuredFunction]]:
        """Frequency responses between the named nodes."""
        names = self._names
        return {key: each for key, each in self._responses.items() if {*key[1:]} <= {*names}}

    def point_measures(self) -> list[dict[str, str | float]]:
        """Return passivity, causality and reciprocity of each point that was hit."""
        return point_measures(self._named_responses, self._names)

    def _faults_of_responses(self) -> list[Fault]:
        """Faults of the frequency responses between the named nodes."""
        settings, names, named = self._settings, self._names, self._named_responses
        noise_ratio, free = settings.relative_error_ratio or 0.0, settings.free_machine
        if free is None:
            return function_faults(named, noise_ratio)
        nodes = [node for node, name in names.items() if name in free.points]
        line = (nodes, free.lowest_frequency_hz, free.highest_frequency_hz)
        return function_faults(named, noise_ratio, free.mass_kg, line)

    def _accept(self, faults: Sequence[Fault]) -> None:
        refuse(faults, self._despite, self._names)
        self.faults += faults

    @property
    def remarks(self) -> list[str]:
        """A line for each fault that was accepted."""
        return [fault.line(self._names) for fault in self.faults]

    def compare_operating(
        self,
        compliance: IndexArray,
        operating: IndexArray,
        nodes: Sequence[Node],
        sides: Sequence[Sequence[int]],
    ) -> None:
        """Compare phases of operating responses with the hammer test.

        Parameters
        ----------
        compliance : numbers of functions, shape (response, force)
        operating : numbers of operating responses, shape (response,)
        nodes : nodes of the responses
        sides : columns of forces at the interface; several where the source may be beyond any

        Raises
        ------
        ParameterError
            They contradict each other, and this fault is not accepted.
        """
        if self.faults:
            return
        values = self.estimates[0].T
        matrices = [values[:, compliance[:, side]] for side in sides]
        faults = operating_faults(matrices, values[:, operating], nodes)
        self._accept(faults)

    def response(self, response: Node, reference: Node, unit: str) -> int:
        """Number of a frequency response; of receptances the reciprocal one will do.

        Raises
        ------
        ParameterError
            It was not measured, or in other units.
        """
        nodes = [(response, reference)] + [(reference, response)] * (unit == "m")
        keys: list[Key] = [("frequency response", *pair) for pair in nodes]
        key = next((key for key in keys if key in self._responses), None)
        if key is None:
            raise ParameterError(
                f"frequency response {response}/{reference} is in none of the files "
                f"{', '.join(self._settings.frequency_responses)}"
            )
        return self._number("response", key, unit)

    def operating(self, node: Node, unit: str) -> int:
        """Number of an operating response.

        Raises
        ------
        ParameterError
            It was not measured, or in another unit.
        """
        key = self._operating_key(node)
        if key is None:
            raise ParameterError(
                f"operating spectrum {node}, or its cross spectrum with a reference that has an "
                f"auto spectrum, is in none of the files {', '.join(self._settings.operating)}"
            )
        return self._number("operating", key, unit)

    def _number(self, group: str, key: Key, unit: str) -> int:
        label = (group, str(key))
        if label not in self._numbers:
            make = self._response_estimate if group == "response" else self._operating_estimate
            try:
                self._estimates.append(make(key, unit))
            except VibroacousticsError as error:
                raise type(error)(f"{key[0]} {_pair(key)}: {error}") from None
            self._numbers[label] = len(self._estimates) - 1
        return self._numbers[label]

    def _response_estimate(self, key: Key, unit: str) -> Estimate:
        functions = self._responses[key]
        for function in functions:
            if function.reference_unit != "N":
                raise ParameterError(f"reference in {function.reference_unit}: must be a force, N")
        repeats = [_at(self.frequency_hz, f.with_response_in(unit)) for f in functions]
        return self._estimate(np.array(repeats), key, self._responses, self._settings.averages)

    def _operating_estimate(self, key: Key, unit: str) -> Estimate:
        functions = self._operating[key]
        if key[0] == "spectrum":
            factor = 1.0 if self._settings.spectra == "peak" else np.sqrt(2.0)
            repeats = np.array([f.with_response_in(unit).values * factor for f in functions])
        else:
            repeats = np.array([self._by_reference(f, unit) for f in functions])
        kept = self._kept(functions[0])
        averages = self._settings.operating_averages
        return self._estimate(repeats[:, kept], key, self._operating, averages)

    def _by_reference(self, function: MeasuredFunction, unit: str) -> ComplexArray:
        """Peak phasor relative to the reference: √2 S_xy / √S_xx."""
        assert function.reference is not None  # noqa: S101 - a cross spectrum has one
        reference = unsigned(function.reference)
        auto = self._operating[("auto spectrum", reference, reference)][0].values.real
        if np.any(auto <= 0.0):
            raise ParameterError(f"auto spectrum {reference}: must be above zero")
        phasor = replace(
            function, kind="spectrum", values=function.values / np.sqrt(auto), reference=None
        )
        return np.asarray(np.sqrt(2.0) * phasor.with_response_in(unit).values)

    def _operating_key(self, node: Node) -> Key | None:
        if ("spectrum", node, None) in self._operating:
            return ("spectrum", node, None)
        for kind, response, reference in self._operating:
            if (kind, response) == ("cross spectrum", node) and (
                "auto spectrum", reference, reference,
            ) in self._operating:  # fmt: skip
                return (kind, response, reference)
        return None

    def _estimate(
        self,
        repeats: ComplexArray,
        key: Key,
        functions: Mapping[Key, Sequence[MeasuredFunction]],
        averages: int | None,
    ) -> Estimate:
        """Mean and error: of repeats, else of the coherence, else as stated."""
        mean = repeats.mean(axis=0)
        coherence = functions.get(("coherence", *key[1:]))
        if len(repeats) > 1:
            return mean, error_of_repeats(repeats)
        if coherence is not None and averages is not None:
            share = _at(self.frequency_hz, coherence[0]).real
            return mean, error_of_coherence(mean, share, averages)
        if self._settings.relative_error_ratio is None:
            raise ParameterError(
                "has no repeats and no coherence with measured.averages: give them, or "
                "measured.relative_error_percent"
            )
        return mean, self._settings.relative_error_ratio * np.abs(mean)

    def _lines(self) -> Array:
        """Operating lines above zero and within the range of frequency and of every response."""
        functions = [f for each in self._operating.values() for f in each]
        first = functions[0].frequency_hz
        for function in functions:
            other = function.frequency_hz
            if other.shape != first.shape or not np.allclose(other, first, rtol=SAME_FREQUENCY):
                raise ParameterError(
                    f"operating {function}: has other frequencies than {functions[0]}"
                )
        lines = first[self._kept(functions[0])]
        if lines.size == 0:
            raise ParameterError(
                "no operating line lies within the frequencies of all frequency responses and "
                "measured.lowest_frequency_hz to highest_frequency_hz"
            )
        return np.asarray(lines)

    def _kept(self, function: MeasuredFunction) -> Array:
        """Lines of an operating function that count."""
        responses = [f.frequency_hz for each in self._responses.values() for f in each]
        low = max(*(f[0] for f in responses), self._settings.lowest_frequency_hz)
        high = min(*(f[-1] for f in responses), self._settings.highest_frequency_hz)
        lines = function.frequency_hz
        slack = SAME_FREQUENCY
        return np.asarray((lines >= low * (1.0 - slack)) & (lines <= high * (1.0 + slack)))


def _at(frequency_hz: Array, function: MeasuredFunction) -> ComplexArray:
    """Values at some frequencies; straight lines between those that were measured."""
    return np.asarray(np.interp(frequency_hz, function.frequency_hz, function.values))


def _pair(key: Key) -> str:
    return f"{key[1]}" if key[2] is None else f"{key[1]}/{key[2]}"
