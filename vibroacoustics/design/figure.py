"""A figure of designs: what it needs of them, and its value at each speed and microphone."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar, Final

from ..base.arrays import Array
from ..base.registry import LAST, Registry
from ..study.criterion import CRITERIA
from ..study.design import Wanted
from .engine.needs import Need, ResponsesByNeed


@dataclass(frozen=True)
class Setting:
    """Settings of a figure beside the designs.

    Attributes
    ----------
    wanted : entry of the study's table
    speeds_rpm : speeds of the study, shape (speed,)
    unmodelled : function that gives the mean square beside the modelled sound, shape
        (design or 1, speed, receiver), Pa²
    """

    wanted: Wanted
    speeds_rpm: Array
    unmodelled: Callable[[], Array]


class DesignFigure:
    """Figure that designs are judged by; another is one file of `design.figures` or a plug-in.

    Examples
    --------
    >>> class HousingForce(va.DesignFigure):
    ...     name = "housing_force_n"
    ...     label = "Force of all moving parts"
    ...     def needs(self, wanted):
    ...         return (va.Need("force", wanted.order or 1),)
    ...     def values(self, responses, setting):
    ...         return responses[self.needs(setting.wanted)[0]]
    """

    name: ClassVar[str]
    """Key in study files; it ends in the unit."""
    label: ClassVar[str] = ""
    """Plain words, without the unit."""
    position: ClassVar[float] = LAST
    is_level: ClassVar[bool] = False
    """Whether it is a level: `values` are then powers over that of 0 dB, averaged as such."""
    is_change: ClassVar[bool] = False
    """Whether it is the change of `values` against the machine without an option."""
    of_speeds: ClassVar[bool] = True
    """Whether it has a value at each speed."""

    def needs(self, wanted: Wanted) -> tuple[Need, ...]:
        """Return the needs that it is computed from.

        Parameters
        ----------
        wanted : entry of the study's table
        """
        raise NotImplementedError

    def values(self, responses: ResponsesByNeed, setting: Setting) -> Array:
        """Compute it, shape (design, speed), (design, speed, receiver or foot) or (design,).

        Parameters
        ----------
        responses : responses of the designs by need
        setting : settings beside the designs
        """
        raise NotImplementedError


class OfCriterion(DesignFigure):
    """A criterion of scorings, which takes a run of the pipeline for every design."""

    def __init__(self, name: str) -> None:
        self.name = name  # type: ignore[misc]
        self.label = CRITERIA[name].label  # type: ignore[misc]

    def needs(self, wanted: Wanted) -> tuple[Need, ...]:
        """Its value."""
        return (Need("criterion", None, self.name),)

    def values(self, responses: ResponsesByNeed, setting: Setting) -> Array:
        """Criterion in the unit of its name, shape (design,)."""
        (need,) = self.needs(setting.wanted)
        return responses[need]


FIGURES: Final[Registry[type[DesignFigure]]] = Registry(
    "figure of designs", DesignFigure, "name", "design.figures", "vibroacoustics.figures"
)
