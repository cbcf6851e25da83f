"""A balancing option: what its file says, what it does to the machine, and its words."""

from collections.abc import Mapping
from typing import Annotated, ClassVar, Final

from pydantic import SerializeAsAny

from ..base.arrays import Array
from ..base.parameters import AnyOf, KindOfParameters
from ..base.registry import Registry
from ..mechanics.added import Added, InsertionLoss
from ..mechanics.bushings import NO_BODIES, AttachedBodies
from ..mechanics.capabilities import Capability
from ..mechanics.moving_parts import Revolution
from .machine import Machine

Figures = Mapping[str, Array]
"""Reported figures of an option by name, over the speeds at which it has them."""


class Option(KindOfParameters):
    """One way of balancing or quieting a machine.

    A further one is one file of `balancers`, or of a third party, whose class is registered: others
    ask what it adds, never which one it is.

    Examples
    --------
    >>> class CounterShaft(va.Option):
    ...     kind = "counter-shaft"
    ...     mass_kg: float
    ...     radius_m: float
    ...     def added(self, machine, revolution):
    ...         angle = -revolution.rotation.crank_angle  # it turns the other way
    ...         weight = va.circling("balancer", self.mass_kg, -self.radius_m, 0.0, angle)
    ...         return va.Added((weight,), {"added_mass_kg": self.mass_kg})
    >>> CounterShaft(mass_kg=0.1, radius_m=0.02).model_dump()
    {'kind': 'counter-shaft', 'mass_kg': 0.1, 'radius_m': 0.02}
    """

    needs: ClassVar[type[Capability] | None] = None
    """Tables that a machine must have for it."""
    changes_machine: ClassVar[bool] = False
    """Whether its table `change` gives values of the machine, filled in as the field `machine`."""
    to_be_built: ClassVar[bool] = True
    """Whether somebody would build it; not one that shows an error of a source."""
    labels: ClassVar[Mapping[str, str]] = {}
    """Plain words for its reported figures, where the name does not say it."""

    @property
    def members(self) -> tuple["Option", ...]:
        """Options that it consists of: itself, but for a combination."""
        return (self,)

    def applied_to(self, machine: Machine) -> Machine:
        """The machine as the option leaves it: itself, but for a redesign."""
        return machine

    def attached(self, machine: Machine) -> AttachedBodies:
        """Rigid bodies on bushings, such as a tuned mass damper; none where it attaches nothing.

        They move with the machine on its mounts. Their mass is added to the figure `added_mass_kg`.

        Parameters
        ----------
        machine : machine with the option, with the values of a sample
        """
        return NO_BODIES

    def built_into(self, machine: Machine) -> Machine:
        """The machine as the option leaves it, with the bodies that it attaches."""
        changed = self.applied_to(machine)
        return changed.carrying(self.attached(changed))

    def added(self, machine: Machine, revolution: Revolution) -> Added:
        """Return what the option adds, with the figure `added_mass_kg`; nothing where not
        overridden.

        Parameters
        ----------
        machine : machine with the option
        revolution : revolution of that machine

        Raises
        ------
        ParameterError, SolverError
            It cannot be built so, or finds no steady motion.
        """
        return Added(figures={"added_mass_kg": 0.0})

    def insertion_loss(self) -> InsertionLoss | None:
        """Return the insertion loss for airborne sound; none where there is none."""
        return None

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Effects that its model neglects, a sentence or two each."""
        return ()

    def sentences(self, figures: Figures) -> tuple[str, ...]:
        """Explain its reported figures, for the report."""
        return ()


OPTIONS: Final[Registry[type[Option]]] = Registry(
    "kind of option", Option, "kind", "balancers", "vibroacoustics.options"
)
AnyOption = Annotated[SerializeAsAny[Option], AnyOf(OPTIONS)]
