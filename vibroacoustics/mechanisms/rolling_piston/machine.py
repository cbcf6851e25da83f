"""A rolling-piston compressor: its kind and what it does."""

from collections.abc import Iterable, Mapping
from typing import ClassVar, Final, Self

from ...base.curves import Curve
from ...base.registry import register
from ...machine.derived import ROUND_INERTIAS, Derived
from ...machine.limits import Limit
from ...machine.machine import Machine
from ...machine.usual import Usual
from ...mechanics.bushings import AttachedBodies
from ...mechanics.capabilities import Capability
from ...mechanics.moving_parts import Revolution
from ...mechanics.rolling_piston import RollingHistories, RollingPiston
from ...mechanics.torque_control import ControlledMotor, TorqueControl
from .parameters import SIZES, RollingPistonTables


@register
class RollingPistonMachine(RollingPistonTables):
    """The shaft is upright, the vane along x; with two cylinders the first one is the upper."""

    kind: ClassVar[str] = "rolling-piston"
    template: ClassVar[str] = "rolling_piston.toml"
    template_with_sources: ClassVar[str] = "rolling_piston_sources.toml"
    axes: ClassVar[str] = "along the vane (x), across (y) and along the shaft (z)"
    orders: ClassVar[str] = (
        "One cylinder compresses once a revolution: the gas torque swings the shaft's speed and "
        "the rotor's reaction rolls the machine at order 1. Two cylinders leave even orders alone. "
        "Orders are multiples of the mean shaft frequency in time."
    )
    labels: ClassVar[Mapping[str, str]] = {
        "volumetric_efficiency_percent": "Delivered gas over that of the displaced volume",
        "leakage_percent": "Gas that leaks to the suction side over that of the displaced volume",
        "residual_torque_1x_n_m": "Motor torque less load at order 1 of the crank angle, peak",
        "residual_torque_2x_n_m": "Motor torque less load at order 2 of the crank angle, peak",
        "residual_torque_3x_n_m": "Motor torque less load at order 3 of the crank angle, peak",
        "motor_peak_current_a": "Largest phase current of the motor, peak",
        "roller_spin_rpm": "Mean spin of the roller",
        "least_tip_force_n": "Least force of the vane's tip on the roller",
        "vane_jump_speed_rpm": "Speed above which the vane's tip leaves the roller",
        "largest_landing_speed_m_per_s": "Largest landing speed of the vane's tip on the roller",
        "friction_w": "Friction of films, vane tip and vane slot",
    }  # fmt: skip
    derived: ClassVar[tuple[Derived, ...]] = ROUND_INERTIAS
    reads: ClassVar[frozenset[str]] = Machine.reads | {"accumulator"}
    limits: ClassVar[tuple[Limit, ...]] = (*Machine.limits, *SIZES)

    @property
    def capabilities(self) -> tuple[Capability, ...]:
        """Rolling pistons, and the motor where an inverter sets its torque."""
        gas, cylinder = self.gas, self.cylinder
        piston = RollingPiston(
            self._histories,
            gas.discharge_density_kg_per_m3,
            gas.discharge_sound_speed_m_per_s,
            cylinder.middle_height_m,
        )
        return (piston, ControlledMotor(self._under)) if self.drive.is_inverter else (piston,)

    def _histories(self, speed_rpm: float, samples: int) -> RollingHistories:
        from .revolution import rolling_histories

        return rolling_histories(self, speed_rpm, samples)

    def _under(self, control: TorqueControl) -> Self:
        return self.model_copy(update={"drive": self.drive.model_copy(update={"control": control})})

    @property
    def attached(self) -> AttachedBodies:
        """The accumulator on its bracket, and bodies of an option."""
        bodies = super().attached
        return bodies if self.accumulator is None else self.accumulator.attached + bodies

    def revolution(self, speed_rpm: float, samples: int) -> Revolution:
        """Steady revolution of the moving parts; see `rolling_piston_revolution`."""
        from .revolution import rolling_piston_revolution

        return rolling_piston_revolution(self, speed_rpm, samples)

    def curves(self, speed_rpm: float) -> Iterable[Curve]:
        """Volumes, pressures, torques, vane and roller; see `rolling_piston_curves`."""
        from .curves import rolling_piston_curves

        return rolling_piston_curves(self, speed_rpm)

    def usual(self) -> Iterable[Usual]:
        """Sizes of small parts that general rules do not know."""
        yield from super().usual()
        yield from USUAL

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """Effects that the model neglects."""
        return _LEAVES_OUT


_LEAVES_OUT: Final = (
    "The gas is ideal with a constant exponent, without heat from the walls, and compresses at the "
    "mean speed. The suction chamber is at suction pressure. Oil and gas that leak from the shell "
    "over vane and roller faces are neglected, and so is the momentum of the gas.",
    "The vane's tip is a point in the vane's mid-plane. Where it leaves the roller no gas passes "
    "it, and it lands without rebound. Friction at tip and slot is Coulomb's; the roller does not "
    "touch the bore.",
    "Shaft and rotor are rigid; cylinders of a twin have the same gas and the same suction. "
    "Magnetic forces and the bending of the overhung rotor are neglected.",
)
USUAL: Final = (
    Usual("gas.clearance_volume_m3", 5e-9, 1e-5, "port and recess of a discharge valve"),
    Usual("valve.mass_kg", 5e-5, 0.02, "free part of a reed"),
    Usual("valve.seat_stiffness_n_per_m", 1e4, 1e8, "seat and stop with their oil"),
    Usual("vane.spring_stiffness_n_per_m", 50.0, 2e4, "springs behind a vane"),
    Usual("accumulator.stiffness_n_per_m", 1e4, 1e8, "brackets of strap and tube"),
)
