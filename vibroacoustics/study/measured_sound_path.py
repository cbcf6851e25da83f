"""Hammer tests from the machine, or the floor under its feet, to the microphones."""

from collections import Counter
from collections.abc import Iterator, Sequence

from pydantic import Field

from ..base.parameters import Contradictions, Parameters
from .measured_shell import Hit

_POSITION = ("x_m", "y_m", "z_m")


class ForcePoint(Hit):
    """Point at which a hammer hit: the machine at a position, or the floor under a foot."""

    foot: str | None = None
    """Its name; none on the machine."""
    x_m: float | None = Field(default=None, ge=-10.0, le=10.0)
    y_m: float | None = Field(default=None, ge=-10.0, le=10.0)
    z_m: float | None = Field(default=None, ge=-10.0, le=10.0)
    """Height from the centre of mass at rest."""

    def contradictions(self) -> Contradictions:
        stated = [name for name in _POSITION if getattr(self, name) is not None]
        if (self.foot is None) != (len(stated) == len(_POSITION)) or (self.foot and stated):
            yield "needs either foot or x_mm, y_mm and z_mm"


class MicrophoneNode(Parameters):
    """Node of a microphone in the measured functions."""

    node: int = Field(ge=0, le=999_999_999)


class MeasuredSoundPath(Parameters):
    """Sound pressure per force, in place of radiation and room."""

    frequency_responses: tuple[str, ...] = Field(min_length=1)
    units: dict[str, str] = Field(default_factory=dict)
    points: dict[str, ForcePoint] = Field(min_length=1)
    microphones: dict[str, MicrophoneNode] = Field(min_length=1)
    """Microphones by the study's receiver."""

    def contradictions(self) -> Contradictions:
        kinds = {point.foot is None for point in self.points.values()}
        if len(kinds) > 1:
            yield "points: some are on the machine, some under feet; must be one"
        counted = Counter(
            (point.foot, point.direction[1]) for point in self.points.values() if point.foot
        )
        for (foot, axis), count in counted.items():
            if count > 1:
                yield f"points: {count} points along {axis} under {foot}, must be one"

    @property
    def is_at_feet(self) -> bool:
        """Whether the floor under the feet was hit, not the machine."""
        return next(iter(self.points.values())).foot is not None

    def problems(self, receivers: Sequence[str]) -> Iterator[str]:
        """Yield why it does not fit a study."""
        for name in receivers:
            if name not in self.microphones:
                yield f"measured.sound.microphones.{name}: is missing, the study has this receiver"
        for name in self.microphones:
            if name not in receivers:
                yield (
                    f"measured.sound.microphones.{name}: not among the receivers "
                    f"({', '.join(receivers)})"
                )
