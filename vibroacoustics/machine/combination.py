"""Options joined to one: changes of the machine in their order, what each adds together."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import combinations
from typing import ClassVar, Final

import numpy as np

from ..base.errors import ParameterError
from ..mechanics.added import Added, InsertionLoss, RingForce
from ..mechanics.bushings import NO_BODIES, AttachedBodies
from ..mechanics.moving_parts import Revolution
from .machine import AnyMachine, Machine
from .option import OPTIONS, AnyOption, Figures, Option

SEPARATOR: Final = " + "
"""Separator of the names of options in the name of their combination."""
_SUMMED: Final = ("_kg", "_w")
"""Units of figures that add up: masses and powers."""


def joined_names(name: str) -> tuple[str, ...]:
    """Return the names of the options that a combination joins, or the name of a single option.

    Parameters
    ----------
    name : name of an option of a study, such as `twin + weight`
    """
    return tuple(name.split(SEPARATOR))


class Combination(Option):
    """Several options of a study at once.

    Changes of the machine are applied in the order of the names. Every option then acts on the
    changed machine as if it were alone; moving parts, bodies, forces and masses add up.
    """

    kind: ClassVar[str] = "combination"
    names: tuple[str, ...]
    parts: tuple[AnyOption, ...]
    """Options of these names."""
    machine: AnyMachine | None = None
    """Machine with the changed values of all redesigns among them; None without one."""

    @property
    def members(self) -> tuple[Option, ...]:
        """Options that are joined."""
        return self.parts

    @property
    def labels(self) -> Mapping[str, str]:  # type: ignore[override]
        """Plain words of all options for their reported figures."""
        return {name: text for part in self.parts for name, text in part.labels.items()}

    @property
    def changes_machine(self) -> bool:  # type: ignore[override]
        """Whether one of them is a redesign."""
        return any(part.changes_machine for part in self.parts)

    @property
    def to_be_built(self) -> bool:  # type: ignore[override]
        """Whether somebody would build all of them."""
        return all(part.to_be_built for part in self.parts)

    def rejoined(self, options: Mapping[str, Option]) -> "Combination":
        """Return the combination with the present options of its names.

        Parameters
        ----------
        options : options of the study by name; where one is missing the parts stay
        """
        if not all(name in options for name in self.names):
            return self
        return self.model_copy(update={"parts": tuple(options[name] for name in self.names)})

    def applied_to(self, machine: Machine) -> Machine:
        """Return the machine with the changes of all options, in their order."""
        changed = machine if self.machine is None else self.machine
        for part in self.parts:
            changed = changed if part.changes_machine else part.applied_to(changed)
        return changed

    def attached(self, machine: Machine) -> AttachedBodies:
        """Return the bodies of all options."""
        return sum((part.attached(machine) for part in self.parts), NO_BODIES)

    def added(self, machine: Machine, revolution: Revolution) -> Added:
        """Return what all options add."""
        each = []
        for part in self.parts:
            with OPTIONS.fenced(part.kind, ParameterError):
                each.append(part.added(machine, revolution))
        return together(self.names, each)

    def insertion_loss(self) -> InsertionLoss | None:
        """Return the insertion loss of the one option that has one."""
        losses = (part.insertion_loss() for part in self.parts)
        return next((loss for loss in losses if loss is not None), None)

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Return what the models of all options neglect."""
        return tuple(text for part in self.parts for text in part.leaves_out(inner_sources))

    def sentences(self, figures: Figures) -> tuple[str, ...]:
        """Return what the reported figures of all options mean."""
        return tuple(text for part in self.parts for text in part.sentences(figures))


def together(names: Sequence[str], each: Sequence[Added]) -> Added:
    """Join what options add: parts side by side, sums of forces, moments, masses and powers.

    Parameters
    ----------
    names : names of the options
    each : contribution of each of them

    Raises
    ------
    ParameterError
        Two add a second Oldham ring, act on the ring in ways that do not add up, or report a figure
        of one name.
    """
    for pair in combinations(zip(names, each, strict=True), 2):
        (name, added), (other_name, other) = pair
        if reason := _why_not(added, other):
            raise ParameterError(f"{name} and {other_name} {reason}")
    total = each[0]
    for other in each[1:]:
        total = _sum(total, other)
    return total


def _why_not(first: Added, other: Added) -> str | None:
    """Say why two options exclude each other; None where they do not."""
    if first.rings and other.rings:
        return "both add a second Oldham ring; join one of them only"
    if first.on_ring is not None and other.on_ring is not None and not _alike(first, other):
        return "both act on the Oldham ring, one from the housing; their forces do not add up"
    reported = [name for name in first.figures if name in other.figures and not _adds_up(name)]
    if reported:
        return f"both report {reported[0]}; join one of them only"
    return None


def _alike(first: Added, other: Added) -> bool:
    kinds = [(ring.from_housing, ring.inertial) for ring in (first.on_ring, other.on_ring) if ring]
    return len(set(kinds)) == 1


def _adds_up(figure: str) -> bool:
    return figure.endswith(_SUMMED)


def _sum(first: Added, other: Added) -> Added:
    """Two options that do not exclude each other."""
    shared = first.figures.keys() & other.figures.keys()
    figures = {**first.figures, **other.figures}
    figures |= {name: first.figures[name] + other.figures[name] for name in shared}
    return Added(
        first.parts + other.parts,
        figures,
        _sum_on_ring(first.on_ring, other.on_ring),
        first.rings + other.rings,
        first.on_scroll_n_m + other.on_scroll_n_m,
    )


def _sum_on_ring(first: RingForce | None, other: RingForce | None) -> RingForce | None:
    if first is None or other is None:
        return first or other
    return replace(first, force_n=np.asarray(first.force_n + other.force_n))


def members_by_name(name: str, option: Option) -> dict[str, Option]:
    """Return the options that an option joins by their names, or the option itself.

    Parameters
    ----------
    name : name of the option in its study
    option : option of this name
    """
    names = option.names if isinstance(option, Combination) else (name,)
    return dict(zip(names, option.members, strict=True))
