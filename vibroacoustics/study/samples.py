"""Random values of a machine, from the ranges of what is not known."""

import warnings
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice
from operator import attrgetter
from typing import Any, Final, TypeVar

from pydantic import ValidationError

from ..base.errors import ParameterError
from ..base.field_reads import unrecorded_reads
from ..base.parameters import Parameters
from ..machine.machine import Machine
from .sampling import Sample, latin_hypercubes, narrowed
from .study import Study

MOST_ROUNDS: Final = 20
"""Most rounds of sampling anew for samples that contradict themselves."""

Table = TypeVar("Table", bound=Parameters)


@dataclass(frozen=True)
class SampleSet:
    """Samples that the machine and its sources can take.

    Attributes
    ----------
    samples : number of samples that the study wants
    refused : why others were not taken, one line each
    """

    samples: list[Sample]
    refused: tuple[str, ...]

    @property
    def tried(self) -> int:
        """All samples, with those that were not taken."""
        return len(self.samples) + len(self.refused)


def batches_of_samples(study: Study) -> Iterator[list[Sample]]:
    """Latin hypercubes of samples, one after another, without those that contradict themselves."""
    for hypercube in latin_hypercubes(study.ranges, study.uncertainty):
        sampled = (fitting(study, plain) for plain in hypercube)
        yield [sample for sample in sampled if _why_not(study, sample) is None]


def samples_of(study: Study) -> SampleSet:
    """The samples of a study: those that contradict themselves are sampled anew.

    First the ranges that other values limit are narrowed (`Machine.limits`): such a value is
    sampled evenly from what the others leave of its range. Where all values fit together the
    samples are the Latin hypercube itself.

    Raises
    ------
    ParameterError
        Nearly no sample fits together.
    """
    wanted, ranges = study.uncertainty.random_samples, study.ranges
    if not ranges:
        return SampleSet([], ())
    hypercubes = latin_hypercubes(ranges, study.uncertainty)
    samples: list[Sample] = []
    refused: list[str] = []
    for hypercube in islice(hypercubes, MOST_ROUNDS):
        for plain in hypercube:
            sample = fitting(study, plain)
            reason = _why_not(study, sample)
            if reason is not None:
                refused.append(reason)
            elif len(samples) < wanted:
                samples.append(sample)
        if len(samples) == wanted:
            return SampleSet(samples, tuple(refused))
    raise ParameterError(
        f"{study.source_file}: uncertainty: {len(refused)} of {len(samples) + len(refused)} "
        f"samples contradict themselves, most often {_most_often(refused)}; narrow the ranges"
    )


def fitting(study: Study, sample: Sample) -> Sample:
    """A sample with the values that others limit moved into what these leave of their ranges."""
    sampled, machine = dict(sample), study.machine
    ranges = {limits.name: limits for limits in study.ranges}
    for limit in machine.limits:
        limits = ranges.get(limit.name)
        if limits is None:
            continue
        values = {
            f"{table}.{field}".lstrip("."): value for (table, field), value in sampled.items()
        }
        others = _unchecked(machine, values | _derived(machine, values, sampled))
        key = (limits.table, limits.field)
        sampled[key] = narrowed(limits, sampled[key], *limit.rule(others))
    return sampled


def warn_of_contradictions(study: Study) -> None:
    """Tell in one line how many samples contradict themselves, and in what."""
    sample_set = samples_of(study)
    if sample_set.refused:
        share = len(sample_set.refused) / sample_set.tried
        warnings.warn(
            f"{study.source_file}: {len(sample_set.refused)} of {sample_set.tried} samples "
            f"({100.0 * share:.0f} %) contradict themselves and are sampled anew, most often "
            f"{_most_often(sample_set.refused)}",
            stacklevel=3,
        )


def with_sample(machine: Machine, nominal: Machine, sample: Sample) -> Machine:
    """A machine with sampled values and what follows from them.

    What an option has changed of the given machine stays changed.

    Parameters
    ----------
    machine : machine with an option
    nominal : nominal machine of the study
    sample : values by table and field
    """
    changed = {
        f"{table}.{field}".lstrip("."): value
        for (table, field), value in sample.items()
        if _read(machine, table, field) == _read(nominal, table, field)
    }
    if not changed:
        return machine
    return _replaced(machine, changed | _derived(machine, changed, sample))


def _derived(machine: Machine, changed: Mapping[str, float], sample: Sample) -> dict[str, float]:
    """Values that follow from the sampled values of a machine, in the order of `derived`.

    They are not checked before: sampled values may contradict a given one that follows from them.
    """
    follows: dict[str, float] = {}
    sampled = _unchecked(machine, changed)
    for derived in machine.derived:
        table, _, field = derived.name.rpartition(".")
        value = _read(machine, table, field)
        if (table, field) in sample or value is None:
            continue
        before, after = derived.rule(machine), derived.rule(sampled)
        if before is not None and after is not None and before != after:
            follows[derived.name] = value * after / before
            sampled = _unchecked(sampled, {derived.name: follows[derived.name]})
    return follows


def _read(machine: Machine, table: str, field: str) -> Any:
    """A value of a machine; none where an option leaves the table out."""
    try:
        return attrgetter(f"{table}.{field}".lstrip("."))(machine)
    except AttributeError:
        return None


def _unchecked(table: Table, values: Mapping[str, Any]) -> Table:
    """A table with other values by dotted name, as they are."""
    fields, inner = _by_table(values)
    for first, within in inner.items():
        fields[first] = _unchecked(getattr(table, first), within)
    return table.model_copy(update=fields)


def _replaced(table: Table, values: Mapping[str, Any]) -> Table:
    """A table with other values by dotted name, validated as a file is."""
    direct, inner = _by_table(values)
    with unrecorded_reads():
        fields: dict[str, Any] = {**dict(iter(table)), **direct}
    for first, within in inner.items():
        fields[first] = _replaced(fields[first], within)
    try:
        return type(table).model_validate(fields)
    except ValidationError as error:
        details = error.errors()[0]
        field = ".".join(map(str, details["loc"]))
        message = str(details.get("ctx", {}).get("error", details["msg"]))
        raise ParameterError(f"{field}: {message}" if field else message) from None


def _by_table(values: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, dict[str, Any]]]:
    """Values of a table itself, and those of the tables in it by the table's name."""
    direct: dict[str, Any] = {}
    inner: dict[str, dict[str, Any]] = {}
    for name, value in values.items():
        first, _, further = name.partition(".")
        if further:
            inner.setdefault(first, {})[further] = value
        else:
            direct[first] = value
    return direct, inner


def _why_not(study: Study, sample: Sample) -> str | None:
    """Say why the machine or a source cannot take a sample; none where they can."""
    try:
        machine = with_sample(study.machine, study.machine, sample)
    except ParameterError as error:
        return str(error)
    reasons = ((name, source.why_not(machine)) for name, source in study.sources.items())
    return next((f"sources.{name}: {reason}" for name, reason in reasons if reason), None)


def _most_often(reasons: Sequence[str]) -> str:
    """The reason that comes most often, whatever its numbers, with the numbers of one sample."""
    words = Counter(reason.partition(" = ")[0] for reason in reasons)
    ((first, _),) = words.most_common(1)
    return next(reason for reason in reasons if reason.partition(" = ")[0] == first)
