"""A scroll compressor with mini-cranks: links, their errors, whether they close; masses, loads."""

from dataclasses import astuple, dataclass
from math import inf
from typing import Any, Final, Literal

from pydantic import Field

from ...base.parameters import Contradictions, Parameters
from ...machine.limits import Limit
from ...machine.machine import Machine
from ...mechanics.capabilities import HEIGHT, BalancePlanes, CrankFrame

LINK = Field(gt=0.0, le=10.0)
ERROR = Field(default=0.0, ge=-1e-3, le=1e-3)

SMALLEST_MARGIN_M: Final = 1e-9
"""Margin below which a four-bar that is no parallelogram is at a change point to rounding: angular
accelerations grow without bound and so do their rounding errors."""
LARGEST_MISFIT: Final = 0.1
"""Misfit over the crank: three mini-cranks are taken to first order in the errors."""


@dataclass(frozen=True)
class Links:
    """Link lengths with their errors.

    Attributes
    ----------
    crank_m : l1, eccentricity of the crankshaft, the driver
    scroll_m : l2, from crank pin to mini-crank pin
    minicrank_m : l3
    bracket_m : l4, from crankshaft to mini-crank axis
    """

    crank_m: float
    scroll_m: float
    minicrank_m: float
    bracket_m: float

    def __str__(self) -> str:
        """Names and lengths as a machine file writes them."""
        lengths = (self.crank_m, self.scroll_m, self.minicrank_m, self.bracket_m)
        shown = ", ".join(f"{1e3 * length:.7g}" for length in lengths)
        return f"crank_mm, scroll_mm, minicrank_mm, bracket_mm = {shown} mm"

    @property
    def is_parallelogram(self) -> bool:
        return self.crank_m == self.minicrank_m and self.scroll_m == self.bracket_m

    @property
    def slack_m(self) -> float:
        """Third condition, l1 + l3 ≤ l2 + l4, which any scroll with small cranks meets."""
        return self.scroll_m + self.bracket_m - self.crank_m - self.minicrank_m


def closing_margins(links: Links) -> tuple[float, float]:
    """Return the margins of the links in the two collinear positions of crank and bracket, m.

    Both must hold for the crank to turn: l1 + l2 ≤ l3 + l4 and l1 + l4 ≤ l3 + l2 (Zhao et al.
    2013, eq. 19 and 20; the paper's "or" is an error). A negative margin is the clearance that
    the joints must have.

    Returns
    -------
    inner, outer : l3 + l4 - l1 - l2 with the crank pin between the axes (θ1 = 0), and
        l3 + l2 - l1 - l4 with the crank pin beyond (θ1 = 180°)
    """
    l1, l2, l3, l4 = links.crank_m, links.scroll_m, links.minicrank_m, links.bracket_m
    return l3 + l4 - l1 - l2, l3 + l2 - l1 - l4


def why_open(links: Links) -> str | None:
    """Say why rigid links with one mini-crank stop the crankshaft; None where they do not."""
    margin = min(*closing_margins(links), links.slack_m)
    if links.is_parallelogram or margin >= SMALLEST_MARGIN_M:
        return None
    short = margin <= -SMALLEST_MARGIN_M
    reason = f"{-1e6 * margin:.4g} µm are missing" if short else "they only just reach"
    return f"{links}: the links do not close over a revolution of the crankshaft; {reason}"


def why_misfit(links: Links) -> str | None:
    """Say why three mini-cranks cannot hold the scroll by small strains; None where they can."""
    misfit = abs(links.minicrank_m - links.crank_m) + abs(links.bracket_m - links.scroll_m)
    if misfit <= LARGEST_MISFIT * links.crank_m:
        return None
    return (
        f"{links}: with minicranks = 3 crank and mini-crank, scroll and bracket must fit within "
        f"{1e3 * LARGEST_MISFIT * links.crank_m:.4g} mm; they differ by {1e3 * misfit:.4g} mm"
    )


class FourBar(Parameters):
    """Nominal links and their errors: crankshaft l1, scroll l2, mini-crank l3, bracket l4."""

    crank_m: float = LINK
    scroll_m: float = LINK
    minicrank_m: float = LINK
    bracket_m: float = LINK
    crank_error_m: float = ERROR
    scroll_error_m: float = ERROR
    minicrank_error_m: float = ERROR
    bracket_error_m: float = ERROR
    branch: Literal[1, -1]
    """M of equation (5): branch in which the mechanism is assembled."""
    minicranks: Literal[1, 3]
    """1 is the paper's rigid four-bar; of 3, at 120° to each other and on elastic pins, the first
    has the errors."""

    def contradictions(self) -> Contradictions:
        why_not = why_open if self.minicranks == 1 else why_misfit
        if min(astuple(self.links)) <= 0.0:
            yield f"{self.links}: must be positive with their errors"
        if reason := why_not(self.links):
            yield reason

    @property
    def links(self) -> Links:
        """Nominal lengths and errors added up."""
        return Links(
            self.crank_m + self.crank_error_m,
            self.scroll_m + self.scroll_error_m,
            self.minicrank_m + self.minicrank_error_m,
            self.bracket_m + self.bracket_error_m,
        )


def _spare_m(machine: Any) -> float:
    """Length of the mini-crank beyond the crank, less what closing needs; rigid links only."""
    bar: FourBar = machine.four_bar
    if bar.minicranks != 1:
        return inf
    return bar.links.minicrank_m - bar.links.crank_m - 2.0 * SMALLEST_MARGIN_M


def _crank_error_m(machine: Any) -> tuple[float, float]:
    """The crank must be shorter than the mini-crank."""
    return -inf, machine.four_bar.crank_error_m + _spare_m(machine)


def _bracket_error_m(machine: Any) -> tuple[float, float]:
    """Scroll and bracket may differ by what the mini-crank is longer than the crank."""
    bar, spare = machine.four_bar, _spare_m(machine)
    even = bar.bracket_error_m + bar.links.scroll_m - bar.links.bracket_m
    return even - spare, even + spare


CLOSING: Final = (
    Limit("four_bar.crank_error_m", _crank_error_m),
    Limit("four_bar.bracket_error_m", _bracket_error_m),
)
"""Errors with which the crank turns (Zhao et al. 2013, eq. 19 and 20, both of them)."""


MASS = Field(gt=0.0, le=1e3)


class Masses(Parameters):
    crank_pin_mass_kg: float = Field(ge=0.0, le=1e3)
    """m1, of what turns on the radius of the crank besides the scroll."""
    scroll_mass_kg: float = MASS
    """m2, with its centre of mass at the crank pin."""
    scroll_inertia_kg_m2: float = Field(gt=0.0, le=1e4)
    """J2, about the crank pin."""
    minicrank_inertia_kg_m2: float = Field(ge=0.0, le=1e4)
    """J3 of each, about its own axis."""
    minicrank_mass_kg: float = Field(ge=0.0, le=1e3)
    """m3 of each, with its centre of mass at the pin in the scroll."""
    minicrank_balance_ratio: float = Field(ge=0.0, le=2.0)
    """Share of m3 l3 that a counterweight on the mini-crank itself takes."""
    rotor_inertia_kg_m2: float = Field(gt=0.0, le=1e6)
    """Inertia of all that turns with the crankshaft, the scroll's mass at the crank pin
    included."""
    motor_slope_ratio: float = Field(ge=-3.0, le=1.0)
    """Relative change of the motor's torque per relative change of speed."""

    def of_all(self, minicranks: int) -> "Masses":
        """Return the masses of all mini-cranks as one, less what their own counterweights
        balance."""
        unbalanced_share = 1.0 - self.minicrank_balance_ratio
        return self.model_copy(
            update={
                "minicrank_inertia_kg_m2": minicranks * self.minicrank_inertia_kg_m2,
                "minicrank_mass_kg": minicranks * unbalanced_share * self.minicrank_mass_kg,
                "minicrank_balance_ratio": 0.0,
            }
        )


class ScrollLoads(Parameters):
    tangential_force_n: float = Field(ge=0.0, le=1e7)
    """Mean tangential gas force F_t."""
    ripple_ratio: float = Field(ge=0.0, le=1.0)
    """Amplitude of its once-per-revolution part over the mean."""
    radial_force_n: float = Field(ge=0.0, le=1e7)
    """Radial gas force F_r, towards the axis of the crankshaft."""
    overturning_arm_m: float = Field(ge=0.0, le=1.0)
    """Overturning moment M_m over F_t."""
    plate_friction: float = Field(ge=0.0, le=0.5)
    """µ_d between orbiting and fixed scroll."""
    friction_angle_rad: float = Field(ge=-7.0, le=7.0)
    """γ - η, from the line of the overturning moment to the direction of friction."""


class MiniCrankTables(Machine):
    """Values of the machine and the axes of its mechanism."""

    four_bar: FourBar
    masses: Masses
    loads: ScrollLoads
    crankshaft_height_m: float = HEIGHT
    """Height of the shaft's axis from the centre of mass at rest."""
    links_offset_m: float = HEIGHT
    """Offset of the links' plane along the shaft from the centre of mass at rest."""
    counterweights: BalancePlanes
    """Counterweights of the crankshaft; heights along the shaft from the links' plane. Their mass
    moments follow from (10)."""

    @property
    def crank_frame(self) -> CrankFrame:
        """Axes in the plane of the links."""
        return self.plane(0.0)

    def plane(self, height_m: float) -> CrankFrame:
        """Axes of the mechanism about the shaft's axis, at a height along it from the links.

        From the mini-crank's axis upwards is a positive crank angle.
        """
        along = self.links_offset_m + height_m
        return CrankFrame(
            stroke=(1.0, 0.0, 0.0),
            across=(0.0, 0.0, 1.0),
            shaft=(0.0, -1.0, 0.0),
            origin_m=(0.0, -along, self.crankshaft_height_m),
        )
