"""The cases of a study with sampled values: what moves otherwise turns anew."""

from dataclasses import replace
from functools import partial
from itertools import groupby
from typing import Final

from ..base.errors import ParameterError
from ..machine.cases import Cases
from ..machine.machine import Machine
from ..machine.option import Option
from ..machine.source import Case, CaseKey, Shared
from ..sources.cases import added_by, loads_of, without_time_series, wrench_lines
from ..study.samples import with_sample
from ..study.sampling import Sample
from ..study.study import Study

_SHELL: Final = {"shell", "structure", "variation", "frame", "shaft", "overall_noise", "remainder"}
"""Tables that say nothing of the motion."""


def sampled_cases(
    nominal: Cases, study: Study, sample: Sample, shared: Shared | None = None
) -> Cases:
    """Compute the cases with sampled values; they share no result with those of other samples.

    Where a sample changes what moves, or the machine on its mounts, revolution and what an option
    adds are computed anew, and what the wrenches of the moving parts sound like; other cases have
    the nominal wrenches.

    Parameters
    ----------
    nominal : with the nominal values
    study : with its machine and options
    sample : values by table and field
    shared : results that other cases of the sample have computed
    """
    sampled = Cases({}, {}, {})
    shared, machines = shared or Shared(), Shared()
    for _, of_speed in groupby(nominal.cases.items(), key=lambda item: item[0][0]):
        turned = Shared()  # let go with the speed: courses over crank angle are large
        for key, nominal_case in of_speed:
            option = study.option_of(key)
            compute = partial(sampled_machine, nominal_case.machine, study.machine, option, sample)
            machine = machines(id(nominal_case.machine), compute)
            case = replace(nominal_case, machine=machine, shared=shared)
            if moves_otherwise(machine, nominal_case.machine, study):
                case = _turned(case, study, key, turned)
            loads = loads_of(study, case)
            if case.revolution.wrenches:
                highest = study.highest_order(case.speed_rpm)
                sampled.wrenches[key] = wrench_lines(case, loads, highest)
            else:
                sampled.wrenches[key] = nominal.wrenches[key]
            sampled.cases[key], sampled.loads[key] = without_time_series(case, loads)
    return sampled


def sampled_machine(machine: Machine, nominal: Machine, option: Option, sample: Sample) -> Machine:
    """Return a machine with sampled values and the bodies that an option attaches to it.

    Parameters
    ----------
    machine : machine with the option
    nominal : machine of the study
    option : option of the case
    sample : values by table and field
    """
    with_values = with_sample(machine, nominal, sample)
    return with_values.carrying(option.attached(with_values))


def moves_otherwise(machine: Machine, nominal: Machine, study: Study) -> bool:
    """Whether two machines differ in more than the shell and what sources alone read."""
    fields = type(machine).model_fields
    of_sources = {name for source in study.sources.values() for name in source.tables_read(machine)}
    still = _SHELL | {name for name in of_sources & set(fields) if not fields[name].is_required()}
    return any(
        getattr(machine, name) != getattr(nominal, name) for name in fields if name not in still
    )


def _turned(case: Case, study: Study, key: CaseKey, turned: Shared) -> Case:
    """A case with the revolution of its machine, which options that leave the machine share."""
    turn = partial(case.machine.revolution, case.speed_rpm, study.operation.crank_angle_samples)
    revolution = turned(id(case.machine), turn)
    try:
        added = added_by(study.option_of(key), case.machine, revolution)
    except ParameterError as error:
        raise ParameterError(f"options.{key[1]}: {error}") from None
    return replace(case, revolution=revolution, added=added)
