"""A study on a measured floor."""

from ..base.errors import ParameterError
from ..machine.floor import FloorMobility
from ..machine.machine import Machine
from ..machine.option import Option
from ..study.study import Study
from ..transfer import on_mounts
from .floor_functions import read_floor


def on_measured_floor(study: Study) -> Study:
    """The study with the measured mobility under the feet of its machine, in every option."""
    settings = None if study.measured is None else study.measured.floor
    if settings is None:
        return study
    mobility = read_floor(settings, on_mounts(study.machine).stand.names)
    at_catalogue = study.catalogue_machine
    return study.model_copy(
        update={
            "machine": _on(mobility, study.machine, "machine"),
            "catalogue_machine": at_catalogue and _on(mobility, at_catalogue, "machine"),
            "options": {
                name: _option_on(mobility, option, study.machine, f"options.{name}.change")
                for name, option in study.options.items()
            },
        }
    )


def _option_on(mobility: FloorMobility, option: Option, machine: Machine, where: str) -> Option:
    changed = option.applied_to(machine)
    if changed is machine:
        return option
    return option.model_copy(update={"machine": _on(mobility, changed, where)})


def _on(mobility: FloorMobility, machine: Machine, where: str) -> Machine:
    if machine.floor is not None or machine.floor_mobility is not None:
        table = "floor" if machine.floor is not None else "floor_mobility"
        raise ParameterError(f"measured.floor: {where}.{table}: is a floor too; leave one out")
    reason = mobility.why_not_under(on_mounts(machine).stand.names)
    if reason:
        raise ParameterError(f"measured.floor: {where}: {reason}")
    return machine.model_copy(update={"floor_mobility": mobility})
