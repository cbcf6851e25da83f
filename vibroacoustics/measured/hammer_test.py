"""Frequency responses of a hammer test from its time records."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Final

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError, gathered
from ..recordings import MeasuredFunction, Node, read_recording
from ..recordings.overload import overload
from .band import naming_settings
from .hammer_hits import Hit, Pulses, hits_of, longest_block, pulses, windowed_force
from .hammer_responses import (
    LARGEST_END,
    STEADY,
    Ending,
    block_ending,
    estimates,
    highest_frequency_hz,
    window_constant_s,
)
from .hammer_results import HammerFunction, HammerResults, HitOutcome
from .hammer_settings import HammerTest, Record, load_hammer_test, records_of

LEAST_BLOCK: Final = 64
"""Fewest samples of a block; assumed."""


@dataclass
class _Blocks:
    """Blocks of the hits at one point by one response, with their sample rate."""

    unit: str
    rate_hz: float
    force_n: list[Array] = field(default_factory=list)
    response: list[Array] = field(default_factory=list)
    window_s: list[float] = field(default_factory=list)


@dataclass(frozen=True)
class _Read:
    """Samples of a record and its pulses."""

    record: Record
    signal: Array
    units: list[str]
    rate_hz: float
    detected: Pulses


def hammer_test(path: str | Path) -> HammerResults:
    """Find frequency responses between points from time records of hammer hits.

    Hits are found in the force. Double and overloaded ones are omitted. H1, H2, coherence and
    scatter are of the others; docs/measured_changes.md, section Hammer records.

    Parameters
    ----------
    path : TOML file with the tables `hammer`, `channels`, `responses` and `hits`

    Raises
    ------
    ParameterError
        The file is wrong, or no hit can be used.
    StorageError
        A record cannot be read.

    Examples
    --------
    >>> test = va.hammer_test("bench/hammer.toml")
    >>> str(test.pairs[0].h1), test.pairs[0].hits
    ('frequency response 1+z/1+z', 3)
    """
    path = Path(path)
    test = load_hammer_test(path)
    with naming_settings(path):
        reads = gathered(lambda record: _read(record, test), [*records_of(test, path.parent)])
        block_s = test.hammer.block_s or _block_s(reads)
        hits: list[HitOutcome] = []
        blocks: dict[tuple[Node, Node], _Blocks] = {}
        for read in reads:
            hits += _cut(read, block_s, test.hammer.recorder_window_s, blocks)
        used = {pair: each for pair, each in blocks.items() if each.force_n}
        if not used:
            reasons = ", ".join(dict.fromkeys(hit.omitted for hit in hits)) or "none was found"
            raise ParameterError(f"hits: none can be used: {reasons}")
        return HammerResults(
            test.title, tuple(_pairs(used, test)), tuple(hits), tuple(_faults(used)),
            tuple(_reversed(reads)), block_s,
        )  # fmt: skip


def _read(record: Record, test: HammerTest) -> _Read:
    recording = read_recording(record.path, **record.reading)
    units = [str(unit) for unit in recording["channel_unit"].values]
    if units[0] != "N":
        raise ParameterError(
            f"{record.path}: {test.hammer.force_channel}: unit {units[0]}: must be that of a force"
        )
    signal = recording["signal"].values
    return _Read(record, signal, units, float(recording.attrs["sample_rate_hz"]), pulses(signal[0]))


def _block_s(reads: Sequence[_Read]) -> float:
    """Length that the blocks of all records can have; those of less than half are omitted."""
    lengths = [
        longest_block(read.detected, read.signal.shape[1], read.rate_hz) / read.rate_hz
        for read in reads
    ]
    return min(length for length in lengths if 2.0 * length > np.median(lengths))


def _reversed(reads: Sequence[_Read]) -> Iterator[str]:
    names = [read.record.path.name for read in reads if read.detected.is_reversed]
    if names:
        yield f"force pulls in {', '.join(names)}: it was reversed, as a hammer can only push"


def _cut(
    read: _Read, block_s: float, window_s: float | None, blocks: dict[tuple[Node, Node], _Blocks]
) -> Iterator[HitOutcome]:
    """Cut the blocks of the good hits of a record, and give the outcome of all."""
    length = round(block_s * read.rate_hz)
    sign = -1.0 if read.detected.is_reversed else 1.0
    reference = Node(read.record.hits.node, read.record.hits.direction)
    hits = hits_of(read.detected, length)
    for hit in hits:
        part = read.signal[:, max(hit.first, 0) : hit.first + length]
        omitted = _omitted(hit, part, length)
        clipped = []
        for number, (name, point) in enumerate(read.record.responses.items(), 1):
            pair = (Node(point.node, point.direction), reference)
            kept = blocks.setdefault(pair, _Blocks(read.units[number], read.rate_hz))
            if (read.units[number], read.rate_hz) != (kept.unit, kept.rate_hz):
                raise ParameterError(
                    f"{read.record.path}: {name}: has another unit or sample rate than records "
                    "before"
                )
            if not omitted and overload(part[number]) is not None:
                clipped.append(name)
            elif not omitted:
                peak = hit.peak - hit.first
                kept.force_n.append(sign * windowed_force(part[0], peak, read.detected.width))
                time_s = (hit.first + np.arange(length)) / read.rate_hz
                kept.response.append(part[number] * np.exp(time_s / (window_s or np.inf)))
                if len(hits) == 1 and window_s is None:
                    constant_s = window_constant_s(read.signal[number], hit.first, read.rate_hz)
                    kept.window_s.append(constant_s)
        if clipped:
            omitted = f"overload of {', '.join(clipped)}"
        peak_n = sign * float(read.signal[0, hit.peak] - np.median(part[0]))
        name = read.record.path.name
        yield HitOutcome(name, reference, hit.peak / read.rate_hz, peak_n, omitted)


def _omitted(hit: Hit, part: Array, length: int) -> str:
    """Reason why a hit is not used."""
    if hit.second:
        return f"double hit, second {100.0 * hit.second:.0f} %"
    if hit.first < 0:
        return "record begins in the hit"
    if part.shape[1] < max(length, LEAST_BLOCK):
        return "record ends before its block"
    return "overload of the force" if overload(part[0]) is not None else ""


def _spectra(blocks: _Blocks) -> tuple[Array, ComplexArray, ComplexArray]:
    """Frequencies above 0 Hz below half the sample rate, and spectra of the hits."""
    length = len(blocks.force_n[0])
    lines = slice(1, (length + 1) // 2)
    frequency_hz = np.fft.rfftfreq(length, 1.0 / blocks.rate_hz)[lines]
    force, response = (
        np.fft.rfft(np.array(each), axis=1)[:, lines] for each in (blocks.force_n, blocks.response)
    )
    return np.asarray(frequency_hz), force, response


def _pairs(used: dict[tuple[Node, Node], _Blocks], test: HammerTest) -> Iterator[HammerFunction]:
    """Functions of all pairs, at the frequencies that all have."""
    spectra = {pair: _spectra(blocks) for pair, blocks in used.items()}
    highest_hz = test.hammer.highest_frequency_hz or min(
        highest_frequency_hz(force, frequency_hz) for frequency_hz, force, _ in spectra.values()
    )
    for (response, reference), (frequency_hz, force, values) in spectra.items():
        kept = frequency_hz <= highest_hz
        if np.count_nonzero(kept) < 2:
            raise ParameterError(
                f"hammer.highest_frequency_hz = {highest_hz:g} Hz: must be {frequency_hz[1]:g} Hz "
                "or above"
            )
        estimate = estimates(force[:, kept], values[:, kept])
        h1 = MeasuredFunction(
            "frequency response", frequency_hz[kept], estimate.h1, response, reference,
            used[response, reference].unit, "N",
        )  # fmt: skip
        h2 = replace(h1, values=estimate.h2)
        yield HammerFunction(h1, h2, estimate.coherence, estimate.scatter, len(force))


def _faults(used: dict[tuple[Node, Node], _Blocks]) -> Iterator[str]:
    """Windows that are too short, and windows of the recorder, by the point of the hits."""
    for reference in dict.fromkeys(pair[1] for pair in used):
        each = [blocks for pair, blocks in used.items() if pair[1] == reference]
        medians = [float(np.median(blocks.window_s or [0.0])) for blocks in each]
        constants = [constant for constant in medians if constant]
        if constants:
            yield (
                f"hits at {reference}: noise falls within records, as under an exponential window "
                f"of about {min(constants):.2g} s, which adds damping: give it as "
                "hammer.recorder_window_s"
            )
        endings = [block_ending(np.array(blocks.response), blocks.rate_hz) for blocks in each]
        worst = max(endings, key=lambda ending: ending.share)
        length_s = len(each[0].force_n[0]) / each[0].rate_hz
        if worst.share > LARGEST_END:
            yield f"hits at {reference}: {_ending_words(worst, length_s)}"


def _ending_words(ending: Ending, length_s: float) -> str:
    if ending.share > STEADY:
        return (
            f"{ending.frequency_hz:.4g} Hz does not decay in blocks of {length_s:.3g} s: stop what "
            "hums or runs, or use longer blocks"
        )
    needed_s = length_s * np.log(LARGEST_END) / np.log(ending.share)
    return (
        f"blocks of {length_s:.3g} s are too short: at {ending.frequency_hz:.4g} Hz "
        f"{100.0 * ending.share:.0f} % is left at the end; record {needed_s:.2g} s a hit"
    )
