"""A source: who drives the machine, with what it needs of the machine's tables."""

from collections.abc import Callable, Hashable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any, ClassVar, Final, TypeVar

from pydantic import SerializeAsAny

from ..base.curves import Curve
from ..base.parameters import AnyOf, KindOfParameters, Parameters
from ..base.registry import Registry
from ..base.units import orders_below, shaft_frequency_hz
from ..mechanics.added import Added
from ..mechanics.capabilities import Capability
from ..mechanics.loads import Loads
from ..mechanics.moving_parts import Revolution
from .machine import Machine

Result = TypeVar("Result")


@dataclass(frozen=True)
class Shared:
    """Results that the cases of one sample share, each computed once."""

    _known: dict[Hashable, Any] = field(default_factory=dict, repr=False)

    def __call__(self, key: Hashable, compute: Callable[[], Result]) -> Result:
        """The result of a key, computed where it is not known yet."""
        if key not in self._known:
            self._known[key] = compute()
        result: Result = self._known[key]
        return result


@dataclass(frozen=True)
class Case:
    """One speed and option, with one set of values.

    Attributes
    ----------
    machine : machine with the option, with the values of a sample
    added : by the option
    revolution : steady revolution of the nominal machine
    supply_frequency_hz : supply frequency of the motor, from the study or derived by a source; else
        none
    maximum_frequency_hz : lines and noise up to here
    shared : with the other cases of the sample

    Examples
    --------
    A source of your own gets a case and returns loads:

    >>> class Hammer(va.Source):
    ...     kind = "hammer"
    ...     def loads(self, case: va.Case, before):
    ...         samples = case.revolution.rotation.crank_angle.size
    ...         return va.Loads(figures={"hammer_samples_count": samples})
    """

    machine: Machine
    added: Added
    revolution: Revolution
    supply_frequency_hz: float | None
    maximum_frequency_hz: float
    shared: Shared = field(default_factory=Shared)

    @property
    def speed_rpm(self) -> float:
        return self.revolution.speed_rpm

    @property
    def shaft_frequency_hz(self) -> float:
        return shaft_frequency_hz(self.revolution.speed_rpm)

    @property
    def maximum_order(self) -> int:
        """Highest order up to the highest frequency."""
        return orders_below(self.maximum_frequency_hz, self.speed_rpm)


CaseKey = tuple[float, str]
"""Speed in rpm and option of a case."""


class Source(KindOfParameters):
    """Source of vibration and sound: its table in a study, its loads and its words.

    A further one is one folder of `sources`, or a file of a third party, whose class is registered.

    Examples
    --------
    >>> class Pulse(va.Source):
    ...     kind = "pulse"
    ...     label = "pulse along x"
    ...     peak_n: float
    ...     def loads(self, case, before):
    ...         force = np.zeros((3, case.revolution.rotation.crank_angle.size))
    ...         force[0, 0] = self.peak_n
    ...         return va.Loads(wrenches={"pulse": va.Wrench(force, 0.0 * force)})
    >>> Pulse(peak_n=3.0).kind
    'pulse'
    """

    tables: ClassVar[Mapping[str, type[Parameters]]] = {}
    """Tables of the machine that it reads."""
    needs: ClassVar[type[Capability] | None] = None
    """Capabilities that a machine must have for it beside the tables."""
    drives_shell: ClassVar[bool] = False
    """Whether it loads parts in an elastic shell."""
    label: ClassVar[str] = ""
    """Plain words for it; its name in the study where there are none."""
    labels: ClassVar[Mapping[str, str]] = {}
    """Plain words for its reported figures, where the name does not say it."""

    @classmethod
    def why_not(cls, machine: Machine) -> str | None:
        """Say why a machine cannot have this source; None where it can."""
        if cls.needs is not None and machine.capability(cls.needs) is None:
            return f"needs {cls.needs.words}; the machine is {machine.kind}"
        for name, table in cls.tables_read(machine).items():
            if not machine.has_table(table):
                return f"needs the machine's table {name}, which its file does not have"
        return None

    @classmethod
    def tables_read(cls, machine: Machine) -> Mapping[str, type[Parameters]]:
        """Tables of a machine that it reads: `tables`, and those that a choice in them asks for."""
        return cls.tables

    def loads(self, case: Case, before: Mapping[str, Loads]) -> Loads:
        """Return the loads of the source in one case.

        Parameters
        ----------
        case : speed, machine, option
        before : loads of the sources of lower position, by name

        Raises
        ------
        ParameterError, SolverError
            The source cannot act so.
        """
        raise NotImplementedError

    def supply_frequency_hz(self, case: Case, before: Mapping[str, Loads]) -> float | None:
        """Supply that the motor needs at the case's speed; None where the source knows of none.

        It is asked for the reference option, where the study gives no supply.

        Parameters
        ----------
        case : case of the reference option, without a supply
        before : see `loads`

        Raises
        ------
        ParameterError
            The motor cannot carry the load.
        """
        return None

    def curves(self, case: Case) -> Iterable[Curve]:
        """Yield inner curves of the source in one case.

        Parameters
        ----------
        case : speed, machine, option

        Raises
        ------
        ParameterError, SolverError
            The source cannot act so.
        """
        return ()


SOURCES: Final[Registry[type[Source]]] = Registry(
    "kind of source", Source, "kind", "sources", "vibroacoustics.sources"
)
AnySource = Annotated[SerializeAsAny[Source], AnyOf(SOURCES)]
