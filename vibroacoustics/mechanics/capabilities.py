"""Capabilities of a machine for options: its shaft's axes, a slider, an Oldham ring."""

from dataclasses import dataclass
from typing import ClassVar, Final, NamedTuple

from pydantic import Field

from ..base.parameters import Contradictions, Parameters

HEIGHT = Field(ge=-2.0, le=2.0)


class BalancePlanes(Parameters):
    """Two balance planes on the shaft and the radius at which weights sit there.

    Examples
    --------
    >>> planes = va.BalancePlanes(upper_height_m=0.1, lower_height_m=-0.1, radius_m=0.03)
    >>> planes.upper_height_m - planes.lower_height_m
    0.2
    """

    upper_height_m: float = HEIGHT
    lower_height_m: float = HEIGHT
    radius_m: float = Field(gt=0.0, le=0.5)

    def contradictions(self) -> Contradictions:
        if self.upper_height_m - self.lower_height_m < 1e-3:
            yield (
                f"upper_height_mm = {1e3 * self.upper_height_m:g} mm: must be at least 1 mm above "
                f"lower_height_mm = {1e3 * self.lower_height_m:g} mm"
            )

    @property
    def counted_down(self) -> "BalancePlanes":
        """Planes where heights count down the shaft."""
        return BalancePlanes(
            upper_height_m=-self.lower_height_m,
            lower_height_m=-self.upper_height_m,
            radius_m=self.radius_m,
        )


class CrankFrame(NamedTuple):
    """Axes of a mechanism: stroke, a quarter turn of the crank later, shaft; right-handed.

    Each is a unit vector x, y, z of the machine.

    Examples
    --------
    >>> lying = va.CrankFrame(stroke=(0.0, 0.0, 1.0), across=(1.0, 0.0, 0.0), shaft=(0.0, 1.0, 0.0))
    >>> angle = va.constant_rotation(3000.0, 4).crank_angle
    >>> weight = va.circling("weight", 0.1, 0.02, 0.0, angle, lying)
    >>> weight.position_m[:, 0].tolist()  # at crank angle zero along the stroke
    [0.0, 0.0, 0.02]
    """

    stroke: tuple[float, float, float] = (1.0, 0.0, 0.0)
    across: tuple[float, float, float] = (0.0, 1.0, 0.0)
    shaft: tuple[float, float, float] = (0.0, 0.0, 1.0)
    origin_m: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """A point of the shaft, from the centre of mass at rest."""


UPRIGHT: Final = CrankFrame()
"""Stroke along x, shaft along z through the centre of mass."""


class Capability:
    """Part of a machine that an option can work on; a kind of machine may define its own.

    Examples
    --------
    >>> class Pulley(va.Capability):
    ...     words = "a pulley on the shaft"
    >>> machine = va.load_machine("data/machines/mayekawa_wbhe.toml")
    >>> machine.require(Pulley)
    Traceback (most recent call last):
        ...
    vibroacoustics.base.errors.ParameterError: needs a pulley on the shaft; ... reciprocating
    """

    words: ClassVar[str]
    """Words for it in a refusal."""


@dataclass(frozen=True)
class Slider(Capability):
    """A mass that slides to and fro with the crank.

    To first order its place is `amplitude_m` cos θ along the stroke from its middle.

    Examples
    --------
    >>> machine = va.load_study("pipelines/mayekawa_wbhe.toml").machine
    >>> machine.require(va.Slider).mass_kg > 0.0
    True
    """

    words: ClassVar[str] = "a mass that slides to and fro"
    mass_kg: float
    amplitude_m: float
    height_m: float
    """Height of the plane in which it slides, along the shaft from the frame's origin."""
    planes: BalancePlanes
    """Planes for weights on the shaft; heights along the shaft from the frame's origin."""
    frame: CrankFrame


@dataclass(frozen=True)
class OldhamRing(Capability):
    """A ring that keeps an orbiting scroll from turning; x = `stroke_m` cos θ.

    Examples
    --------
    >>> machine = va.load_study("pipelines/copeland_thesis.toml").machine
    >>> machine.require(va.OldhamRing).stroke_m
    0.00675
    """

    words: ClassVar[str] = "an Oldham ring"
    mass_kg: float
    stroke_m: float
    """Amplitude of its stroke, the radius of the scroll's orbit."""
    height_m: float
    """Height from the centre of mass at rest."""
