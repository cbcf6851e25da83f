"""Induction motor with a capacitor, by its circuit."""

import math

from pydantic import Field

from ...base.parameters import Parameters

OHM = Field(gt=0.0, le=1e5)


class CapacitorMotor(Parameters):
    """A single-phase motor with a capacitor before its auxiliary winding.

    Resistances and reactances are per phase at line frequency, those of the rotor and of
    magnetising referred to the main winding; core loss is neglected.
    """

    line_voltage_v: float = Field(gt=0.0, le=1e5)
    """Root mean square."""
    line_frequency_hz: float = Field(ge=1.0, le=1e3)
    pole_pairs: int = Field(ge=1, le=50)
    main_resistance_ohm: float = OHM
    main_leakage_ohm: float = OHM
    auxiliary_resistance_ohm: float = OHM
    auxiliary_leakage_ohm: float = OHM
    magnetising_ohm: float = OHM
    rotor_resistance_ohm: float = OHM
    rotor_leakage_ohm: float = OHM
    turns_ratio: float = Field(gt=0.0, le=10.0)
    """Effective turns of the auxiliary winding over those of the main winding."""
    capacitance_f: float = Field(gt=0.0, le=1.0)

    @property
    def line_rad_per_s(self) -> float:
        return 2.0 * math.pi * self.line_frequency_hz

    @property
    def synchronous_speed_rad_per_s(self) -> float:
        return self.line_rad_per_s / self.pole_pairs


class TurningRotor(Parameters):
    inertia_kg_m2: float = Field(gt=0.0, le=1e3)
    """Inertia about the shaft's axis, of all that turns with it."""
