"""Consistency between the tables of a study."""

from collections.abc import Callable, Iterable
from functools import partial
from typing import Final

from ..base.errors import ParameterError
from ..base.units import shaft_frequency_hz
from ..base.vocabulary import REFERENCE_OPTION
from ..machine.cavities import SPACES
from ..machine.frame import Frame
from ..machine.option import Option
from ..machine.shell_structure import ShellStructure, ShellVariation
from ..machine.stopping import Stopping, TurningBack
from .criterion import CRITERIA
from .machines import machines_problems
from .scoring import check_given, check_scales
from .tables import StudyTables

LEAST_ORDERS: Final = 2
"""Orders that every result holds."""
ROUNDING: Final = 1e-9


def check_consistent(study: StudyTables) -> None:
    """Refuse tables that are right alone and contradict each other.

    Parameters
    ----------
    study : whose tables are valid each

    Raises
    ------
    ValueError
        With the key, the value and what is allowed; an argument for each refusal.
    """
    reference = study.options.get(REFERENCE_OPTION)
    if reference is None or reference.kind != REFERENCE_OPTION:
        raise ValueError('options: an option named none with kind = "none" is required')
    _raise_all(partial(_check_fits, study, name, option) for name, option in study.options.items())
    checks = (
        _check_catalogue, _check_orders, _check_sources, _check_sound_power, _check_room,
        _check_spectrum, _check_rating, _check_criteria, _check_machines,
    )  # fmt: skip
    _raise_all(
        (
            lambda: check_given(study.given, study.options),
            lambda: check_scales(study.scoring, study.given, study.options),
            lambda: _check_measured(study),
            *(partial(check, study) for check in checks),
        )
    )


def _raise_all(checks: Iterable[Callable[[], None]]) -> None:
    """Refuse with what each of some checks, of which none needs another, refuses."""
    problems: list[str] = []
    for check in checks:
        try:
            check()
        except ValueError as error:
            problems += map(str, error.args)
    if problems:
        raise ValueError(*problems)


def _check_measured(study: StudyTables) -> None:
    if study.measured is not None:
        names, speeds = list(study.receivers), study.operation.speed_rpm
        if problems := list(study.measured.problems(names, speeds)):
            raise ValueError(*problems)


def _check_machines(study: StudyTables) -> None:
    """Refuse several machines that are one, or stand at one position."""
    tables = (study.machines, study.base_frame, study.common_receivers, study.receivers)
    if problems := list(machines_problems(*tables)):
        raise ValueError(*problems)


def _check_spectrum(study: StudyTables) -> None:
    """Refuse a measured spectrum that does not fit the study, or weighs nothing."""
    spectrum, operation = study.evidence.spectrum, study.operation
    if spectrum is None:
        return
    points = (operation.point, study.catalogue_point)
    problems = [
        f"evidence.spectrum.{problem}"
        for problem in spectrum.problems(
            list(study.receivers),
            operation.speed_rpm,
            points,
            study.radiation.maximum_frequency_hz,
        )
    ]
    if study.machine.overall_noise is None:
        problems.append(
            "evidence.spectrum: needs machine.overall_noise, relative to which unmodelled noise "
            "is sampled"
        )
    if not study.ranges:
        problems.append(
            "evidence.spectrum: no value that the study reads has a range, so that no samples "
            "are weighted; name its sources"
        )
    if study.measured is not None and study.measured.baseline is not None:
        problems.append("evidence.spectrum: omit it or measured.baseline, which weighs alone")
    at_published = spectrum.operating_point not in (None, operation.point)
    if at_published and spectrum.speed_rpm != study.catalogue_speed_rpm:
        problems.append(
            f"evidence.spectrum.speed_rpm = {spectrum.speed_rpm:g} rpm: at the point of the "
            f"published level it must be {study.catalogue_speed_rpm:g} rpm"
        )
    if problems:
        raise ValueError(*problems)


def _check_catalogue(study: StudyTables) -> None:
    """Refuse a microphone of the overall noise that is none, or stands elsewhere."""
    if study.catalogue_receiver not in study.receivers:
        raise ValueError(
            f"catalogue_receiver = {study.catalogue_receiver}: not among the receivers "
            f"({', '.join(study.receivers)})"
        )
    published = study.machine.overall_noise
    if published is None:
        if study.catalogue_machine is not None:
            raise ValueError(
                f"catalogue_point = {study.catalogue_point}: the machine's file gives no "
                "overall_noise, so that there is no such point"
            )
        return
    microphone = study.receivers[study.catalogue_receiver]
    distance = study.machine.shell.distance_m(microphone.x_m, microphone.y_m, microphone.height_m)
    if not 0.95 <= distance / published.distance_m <= 1.05:
        raise ValueError(
            f"catalogue_receiver = {study.catalogue_receiver}: stands {distance:.3g} m from the "
            f"shell; the overall noise holds at {published.distance_m:g} m"
        )


def _check_sound_power(study: StudyTables) -> None:
    """Refuse a sound power by ISO 3744 where there is more than a hard floor."""
    surroundings = study.radiation.surroundings
    if study.sound_power and (
        surroundings.walls or surroundings.cabinet or surroundings.is_outdoors
    ):
        raise ValueError(
            "sound_power: ISO 3744 measures over a hard floor alone; radiation.surroundings "
            f"has {'ground or a barrier' if surroundings.is_outdoors else 'walls or a cabinet'}"
        )


def _check_rating(study: StudyTables) -> None:
    """Refuse a window before which there is no microphone."""
    windows = {} if study.rating is None else study.rating.windows
    problems = [
        f"rating.windows.{name}.receiver = {window.receiver}: not among the receivers "
        f"({', '.join(study.receivers)})"
        for name, window in windows.items()
        if window.receiver not in study.receivers
    ]
    if problems:
        raise ValueError(*problems)


def _check_criteria(study: StudyTables) -> None:
    """Refuse criteria, objectives and constraints that need a table which the study lacks."""
    named = {f"scoring.criteria.{name}": name for name in study.scoring.criteria}
    if study.design is not None:
        for table in ("objectives", "constraints"):
            for key, wanted in getattr(study.design, table).items():
                named[f"design.{table}.{key}.figure = {wanted.figure}"] = wanted.figure
    problems = [
        f"{where}: {criterion().needed}"
        for where, name in named.items()
        if (criterion := CRITERIA.get(name))
        and criterion.table
        and getattr(study, criterion.table, None) is None
    ]
    if problems:
        raise ValueError(*problems)


def _check_room(study: StudyTables) -> None:
    """Refuse a room that does not hold the machine, or beside which other walls stand."""
    if study.room is None:
        return
    surroundings = study.radiation.surroundings
    if surroundings.walls or surroundings.cabinet or surroundings.is_outdoors:
        raise ValueError(
            "room: the machine is put into it from a hard floor alone; radiation.surroundings has "
            f"{'ground or a barrier' if surroundings.is_outdoors else 'walls or a cabinet'}"
        )
    if not surroundings.floor:
        raise ValueError("room: needs radiation.surroundings.floor = true")
    if study.measured is not None and study.measured.sound is not None:
        raise ValueError(
            "room: is computed from the shell's motion; measured.sound holds at its microphones "
            "alone"
        )
    for name in study.room.listeners:
        if name in study.receivers:
            raise ValueError(
                f"room.listeners.{name}: a microphone has this name, receivers.{name}; give "
                "another, so that sounds and tables distinguish them"
            )
    try:
        study.room.check_holds(study.machine.shell)
    except ValueError as error:
        raise ValueError(f"room.{error}") from None


def _check_orders(study: StudyTables) -> None:
    """Refuse more orders than the radiation or the crank angles can resolve."""
    speeds = {*study.operation.speed_rpm, study.catalogue_speed_rpm}
    fastest, slowest = max(speeds), min(speeds)
    orders, samples = study.highest_order(slowest), study.operation.crank_angle_samples
    if 2 * orders >= samples:
        is_stated = study.operation.maximum_order is not None
        twice = f"maximum_order = {orders}" if is_stated else f"{orders} orders at {slowest:g} rpm"
        raise ValueError(
            f"operation.crank_angle_samples = {samples}: must be above {2 * orders}, twice {twice}"
        )
    order = max(study.highest_order(fastest), LEAST_ORDERS)
    highest, allowed = order * shaft_frequency_hz(fastest), study.radiation.maximum_frequency_hz
    if highest > allowed * (1.0 + ROUNDING):
        raise ValueError(
            f"radiation.maximum_frequency_hz = {allowed:g} Hz: order {order} reaches "
            f"{highest:g} Hz; raise it, or lower operation.maximum_order"
        )


def _check_sources(study: StudyTables) -> None:
    """Refuse sources that the machine, or what an option makes of it, cannot have."""
    if "moving_parts" in study.sources:
        raise ValueError("sources.moving_parts: are always there; choose another name")
    changed = {
        f"options.{name}.change: ": option.applied_to(study.machine)
        for name, option in study.options.items()
        if option.applied_to(study.machine) is not study.machine
    }
    for name, source in study.sources.items():
        for where, machine in {"": study.machine, **changed}.items():
            if reason := source.why_not(machine):
                raise ValueError(f"{where}sources.{name}.kind = {source.kind}: {reason}")
    published, operation = study.catalogue_speed_rpm, study.operation
    if operation.supply_frequency_hz and published not in operation.speed_rpm:
        raise ValueError(
            "operation.speed_rpm: must include the speed of the overall noise, "
            f"{published:g} rpm, whose supply_frequency_hz is not known otherwise"
        )
    twice = 2.0 * max(study.operation.supply_frequency_hz or (0.0,))
    if study.sources and twice > study.radiation.maximum_frequency_hz:
        raise ValueError(
            f"radiation.maximum_frequency_hz = {study.radiation.maximum_frequency_hz:g} Hz: "
            f"twice the supply frequency is {twice:g} Hz"
        )
    bends = study.machine.has_table(ShellStructure) and study.machine.has_table(ShellVariation)
    if study.drives_shell and not bends:
        raise ValueError(
            "sources: drive an elastic shell; the machine has no tables structure and variation"
        )
    if study.drives_shell and study.shell_modes is not None and study.machine.has_table(Frame):
        raise ValueError(
            "shell_modes: measured modes do not hold the wall's flexibility at the welds of a "
            'frame; leave it out: machine.without = ["frame"]'
        )
    if study.shell_modes is not None and _gas_flows_into(study):
        raise ValueError(
            "shell_modes: measured modes do not show what gas in the shell does to its wall; "
            f"leave the gas out: machine.without = {_gas_flows_into(study)}"
        )
    if study.operation.stopping and not study.machine.has_table(Stopping):
        raise ValueError("operation.stopping: the machine has no table stopping")
    _check_turning_back(study)


def _check_turning_back(study: StudyTables) -> None:
    if not study.operation.turning_back:
        return
    if not study.operation.stopping:
        raise ValueError("operation.turning_back: needs operation.stopping = true")
    if not study.machine.has_table(TurningBack):
        raise ValueError("operation.turning_back: the machine has no table turning_back")


def _gas_flows_into(study: StudyTables) -> list[str]:
    read = {name for source in study.sources.values() for name in source.tables_read(study.machine)}
    return sorted(read & set(SPACES))


def _check_fits(study: StudyTables, name: str, option: Option) -> None:
    """Refuse an option that the machine has no part for, or that changes what all share."""
    for member in option.members:
        needed = member.needs
        if needed is not None and study.machine.capability(needed) is None:
            raise ValueError(
                f"options.{name}.kind = {member.kind}: needs {needed.words}; the machine is "
                f"{study.machine.kind}"
            )
    try:
        changed = option.built_into(study.machine)
    except ParameterError as error:
        raise ValueError(f"options.{name}: {error}") from None
    for table in ("shell", "overall_noise"):
        if getattr(changed, table) != getattr(study.machine, table):
            raise ValueError(
                f"options.{name}.change.{table}: all options radiate from one shell and share "
                "one overall noise; make a study of its own"
            )
