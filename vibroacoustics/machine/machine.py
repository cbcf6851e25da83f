"""Machine: mass, mounts, shell, noise, the errors of its source document.

Heights are those of the machine's frame: z up, zero at the centre of mass at rest.
"""

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Annotated, ClassVar, Final, Self, TypeVar

from pydantic import Field, PrivateAttr, SerializeAsAny

from ..base.arrays import Array
from ..base.curves import Curve
from ..base.errors import ParameterError
from ..base.parameters import AnyOf, Contradictions, KindOfParameters, Parameters
from ..base.registry import Registry
from ..base.units import shaft_frequency_hz
from ..mechanics.bushings import NO_BODIES, AttachedBodies, check_joined
from ..mechanics.capabilities import UPRIGHT, Capability, CrankFrame
from ..mechanics.moving_parts import MovingPart, Revolution
from ..mechanics.ports import HOUSING, BodyPort
from .cavities import SPACES
from .derived import INERTIAS, Derived
from .feet import FOOT_NAMES, Feet, Mounts, MountStiffness, values_not_read
from .floor import Floor, FloorMobility
from .gas_in_shell import DischargeGas, ShellGas
from .housing import Housing
from .isolation import BalanceQuality, doubts_of_isolation, total_stiffness
from .limits import OF_EVERY_MACHINE, Limit
from .remainder import UNMODELLED_KEYS, OverallNoise, UnmodelledNoise
from .shell import Shell
from .shell_structure import ShellStructure
from .speed_growth import Growth
from .suspension import BLOCK, Suspension
from .usual import Scale, Usual, of_density, of_mounts

_IN_A_CYLINDER: Final[tuple[type[Parameters], ...]] = (ShellStructure, ShellGas, *SPACES.values())
"""Tables whose models take the shell as a cylinder."""
PART_MASS = Field(gt=0.0, le=100.0)


class Erratum(Parameters):
    """An error in the source document: what is printed, what is right."""

    item: str
    printed: str
    finding: str


C = TypeVar("C", bound=Capability)
T = TypeVar("T", bound=Parameters)


class Machine(KindOfParameters):
    """A kind of machine: its parameters, its steady revolution, and the words that fit it only.

    A further kind is a folder of `mechanisms` whose class is registered; it edits no other file.

    Examples
    --------
    >>> class LoneRotor(va.Machine):
    ...     kind = "lone-rotor"
    ...     unbalance_mass_kg: float
    ...     unbalance_radius_m: float
    ...     def revolution(self, speed_rpm, samples):
    ...         rotation = va.constant_rotation(speed_rpm, samples)
    ...         spot = va.circling("heavy_spot", self.unbalance_mass_kg, self.unbalance_radius_m,
    ...                            0.0, rotation.crank_angle)
    ...         return va.Revolution(speed_rpm, rotation, va.wrenches_of_parts([spot], rotation))
    """

    name: str = Field(min_length=1)
    refrigerant: str | None = Field(None, min_length=1)
    """Refrigerant by its number, such as R410A; the data sheet states it."""
    housing: Housing
    """Rigid body on the mounts; moving parts included, a suspended block not."""
    mounts: Mounts
    shell: Shell
    overall_noise: OverallNoise | None = None
    """Published level; without it levels hold the modelled sources only."""
    remainder: UnmodelledNoise = UnmodelledNoise()
    feet: Feet | None = None
    """Anywhere; four in a square, as `mounts` says, where there are none."""
    mount_stiffness: MountStiffness | None = None
    """Stiffness over frequency, of mounts that give none of their own."""
    floor: Floor | None = None
    """Compliant floor under the feet; rigid where neither this table nor the next is given."""
    floor_mobility: FloorMobility | None = None
    suspension: Suspension | None = None
    """Springs between the block with the mechanism and the shell; none where both are one."""
    discharge_gas: DischargeGas | None = None
    """Gas of a reciprocating compressor; a source reads it."""
    shell_gas: ShellGas | None = None
    """Gas in the shell around the block."""
    balance_quality: BalanceQuality | None = None
    """Balance quality of its rotor; a study that names no residual unbalance neglects it."""
    errata: tuple[Erratum, ...] = ()
    _attached: AttachedBodies = PrivateAttr(NO_BODIES)

    axes: ClassVar[str] = "x, y and z"
    """Axes x, y and z on this machine."""
    orders: ClassVar[str] = "Orders are multiples of the mean shaft frequency in time."
    """Origin of the orders of the force."""
    labels: ClassVar[Mapping[str, str]] = {}
    """Plain words for its reported figures, where the name does not say it."""
    derived: ClassVar[tuple[Derived, ...]] = INERTIAS
    """Values that follow from others, where they are not sampled themselves."""
    runs_up: ClassVar[bool] = True
    """Whether a revolution is quick enough for the many speeds of a run-up."""
    speed_growth: ClassVar[Growth | None] = None
    """Growth of the level of such machines with speed, where a file gives none; none where
    nothing is known of the kind."""

    template: ClassVar[str | None] = None
    """Shipped study with which `new` begins a machine of the kind; none where there is none."""
    template_with_sources: ClassVar[str | None] = None
    """Template of a study with sources of sound."""

    reads: ClassVar[frozenset[str]] = frozenset(
        {
            "overall_noise",
            "suspension",
            "remainder",
            "feet",
            "mount_stiffness",
            "floor",
            "floor_mobility",
        }
    )
    """Tables that may be left out and that the machine itself reads where it has them."""

    limits: ClassVar[tuple[Limit, ...]] = OF_EVERY_MACHINE
    """Limits that other values set to a value's range, in the order of sampling."""

    def contradictions(self) -> Contradictions:
        if self.floor is not None and self.floor_mobility is not None:
            yield "floor, floor_mobility: give one of them"
        feet = FOOT_NAMES if self.feet is None else tuple(self.feet.by_name)
        reason = self.floor_mobility and self.floor_mobility.why_not_under(feet)
        if reason:
            yield f"floor_mobility: {reason}"
        if self.shell.profile_m is not None:
            for name, table in self:
                if isinstance(table, _IN_A_CYLINDER):
                    yield (
                        f"shell.profile_mm, {name}: an elastic wall and gas in the shell are "
                        "modelled in a cylinder with caps alone; remove one of them"
                    )

    def usual(self) -> Iterable[Usual]:
        """Ranges that other values set, beside those of `usual.toml`; outside it is doubted."""
        scale = self.scale
        yield of_density(scale)
        feet = () if self.feet is None else tuple(self.feet.by_name)
        for table in ("mounts", *(f"feet.{name}" for name in feet)):
            yield from of_mounts(table, scale.mass_kg, len(feet) or 4)
        if scale.block_kg:
            yield from of_mounts("suspension.springs", scale.block_kg, 4)

    @property
    def scale(self) -> Scale:
        """Shell and masses with which sizes are compared."""
        block = 0.0 if self.suspension is None else self.suspension.block.mass_kg
        return Scale(self.shell, self.housing.mass_kg + block, block)

    def doubts(self) -> Iterable[str]:
        """Yield what is doubtful otherwise, with the dotted name of the value, a line each."""
        return ()

    def doubts_at(self, speeds_rpm: Sequence[float]) -> Iterable[str]:
        """Yield what is doubtful at the speeds of a study: mounts near order 1, a line each."""
        lowest, scale = min(speeds_rpm), self.scale
        feet = () if self.feet is None else tuple(self.feet.by_name.values())
        hertz = shaft_frequency_hz(lowest)
        stiffness = total_stiffness(self.mounts, feet, self.mount_stiffness, hertz)
        yield from doubts_of_isolation("mounts", stiffness, scale.mass_kg, lowest)
        if self.suspension is not None:
            stiffness = total_stiffness(self.suspension.springs, (), None, hertz)
            name = "suspension.springs"
            yield from doubts_of_isolation(name, stiffness, scale.block_kg, lowest)

    def revolution(self, speed_rpm: float, samples: int) -> Revolution:
        """One steady revolution: force and moment of the moving parts by source.

        Parameters
        ----------
        speed_rpm : mean over time
        samples : uniform crank angles

        Raises
        ------
        ParameterError, SolverError
            The machine cannot run so.
        """
        raise NotImplementedError

    def moving_parts(self, crank_angle: Array) -> tuple[MovingPart, ...]:
        """Moving parts whose path is given by the crank angle alone; none where it is not.

        Parameters
        ----------
        crank_angle : shape (samples,), rad
        """
        return ()

    def curves(self, speed_rpm: float) -> Iterable[Curve]:
        """Yield inner curves at a speed: forces, pressures, films, torques and the like.

        Parameters
        ----------
        speed_rpm : mean over time

        Raises
        ------
        ParameterError, SolverError
            The machine cannot run so.
        """
        return ()

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Effects that the model of this kind neglects, a sentence or two each."""
        return ()

    @property
    def attached(self) -> AttachedBodies:
        """Bodies that an option attaches to it."""
        return self._attached

    def carrying(self, attached: AttachedBodies) -> Self:
        """The machine with bodies of an option in place of those that it carries.

        Raises
        ------
        ParameterError
            They do not fit its own bodies.
        """
        if attached == self._attached:
            return self
        for bushing in attached.bushings:
            if bushing.other_body is None:
                raise ParameterError(
                    f"bushing {bushing.name}: other_body = None: must be a body; only feet are on "
                    "the ground"
                )
        ports = dict.fromkeys((HOUSING.name, self.mechanism_port.name))
        check_joined([*ports, *(body.name for body in attached.bodies)], attached.bushings)
        machine = self.model_copy()
        machine._attached = attached
        return machine

    @property
    def mechanism_port(self) -> BodyPort:
        """The body with the mechanism, on which moving parts and motor act."""
        return HOUSING if self.suspension is None else BLOCK

    @property
    def body_names(self) -> tuple[str, ...]:
        """Names of its rigid bodies: that on the feet, a suspended block, those of an option."""
        block = () if self.suspension is None else (BLOCK.name,)
        return (HOUSING.name, *block, *(body.name for body in self.attached.bodies))

    @property
    def unread(self) -> frozenset[str]:
        """Values without effect beside the machine's other tables, dotted, in SI."""
        of_mounts = values_not_read(self.feet, self.mount_stiffness)
        return of_mounts if self.overall_noise is not None else of_mounts | UNMODELLED_KEYS

    @property
    def crank_frame(self) -> CrankFrame:
        """Axes of stroke and shaft."""
        return UPRIGHT

    @property
    def capabilities(self) -> tuple[Capability, ...]:
        """Capabilities that options can work on."""
        return ()

    def capability(self, needed: type[C]) -> C | None:
        """The part of a type that options can work on; none where the machine has none."""
        return next((part for part in self.capabilities if isinstance(part, needed)), None)

    def table(self, wanted: type[T]) -> T:
        """The machine's table of a type.

        Raises
        ------
        ParameterError
            The machine has none.
        """
        table = self._table(wanted)
        if table is None:
            name = re.sub("(?<!^)(?=[A-Z])", " ", wanted.__name__).lower()
            raise ParameterError(f"machine {self.name}: has no table of {name}")
        return table

    def has_table(self, wanted: type[Parameters]) -> bool:
        """Whether the machine has a table of a type."""
        return self._table(wanted) is not None

    def _table(self, wanted: type[T]) -> T | None:
        """The machine's table of a type; a plain loop, as sources ask a thousand times a sample."""
        for value in self.__dict__.values():
            if isinstance(value, wanted):
                return value
        return None

    def require(self, needed: type[C]) -> C:
        """The part of a type that options can work on.

        Raises
        ------
        ParameterError
            The machine has none.
        """
        part = self.capability(needed)
        if part is None:
            raise ParameterError(f"needs {needed.words}; the machine is {self.kind}")
        return part


MACHINES: Final[Registry[type[Machine]]] = Registry(
    "kind of machine", Machine, "kind", "mechanisms", "vibroacoustics.machines"
)
AnyMachine = Annotated[SerializeAsAny[Machine], AnyOf(MACHINES)]
