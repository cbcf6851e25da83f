"""A scroll compressor with mini-cranks: its kind and what it does."""

from collections.abc import Iterable, Mapping
from typing import ClassVar, Final

from ...base.curves import Curve
from ...base.registry import register
from ...machine.limits import Limit
from ...machine.machine import Machine
from ...machine.speed_growth import SCROLL_OR_SCREW, Growth
from ...mechanics.moving_parts import Revolution
from .links import CLOSING, MiniCrankTables


@register
class MiniCrankMachine(MiniCrankTables):
    """The shaft lies along y and the bracket's line along x, as the weight in (15) has it."""

    kind: ClassVar[str] = "minicrank-scroll"
    template: ClassVar[str] = "zhao_minicrank.toml"
    speed_growth: ClassVar[Growth] = SCROLL_OR_SCREW
    labels: ClassVar[Mapping[str, str]] = {
        "minicrank_swing_deg": "Swing of the mini-crank, which does not turn",
        "minicrank_pin_force_n": "Largest force at the rigid pin of the mini-crank",
        "crank_pin_force_n": "Largest force at the rigid crank pin",
    }
    limits: ClassVar[tuple[Limit, ...]] = (*Machine.limits, *CLOSING)

    def revolution(self, speed_rpm: float, samples: int) -> Revolution:
        """Steady revolution of the moving parts; see `minicrank_revolution`."""
        from .revolution import minicrank_revolution

        return minicrank_revolution(self, speed_rpm, samples)

    def curves(self, speed_rpm: float) -> Iterable[Curve]:
        """Load, input torque and pin forces over the crank angle; see `minicrank_curves`."""
        from .curves import minicrank_curves

        return minicrank_curves(self, speed_rpm)

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Effects that the model neglects."""
        return _LEAVES_OUT


_LEAVES_OUT: Final = (
    "Links and bearings are rigid and without clearance where there is one mini-crank. It then "
    "rocks, and the scroll swings by some 4°, which the wraps forbid: the torque peaks and pin "
    "forces of such an option are those of the paper's model, not of a machine.",
    "Three mini-cranks hold the scroll on equal elastic pins, quasi-statically and to first "
    "order in the errors; the first has the errors, the others fit the crank.",
    "The gas load has one harmonic; twice-line torque of the motor is not modelled. The weight "
    "of what link errors leave unbalanced on the shaft is neglected in its torque: some mN m.",
)
