"""Gas in the cylinder of a small reciprocating compressor."""

from pydantic import Field, model_validator

from ..base.parameters import Parameters


class CylinderGas(Parameters):
    """Polytropic cycle between two pressures with valves that open without loss."""

    suction_pressure_pa: float = Field(gt=0.0, le=1e8)
    discharge_pressure_pa: float = Field(gt=0.0, le=1e8)
    exponent_ratio: float = Field(ge=1.0, le=2.0)
    """Polytropic exponent."""
    clearance_ratio: float = Field(gt=0.0, le=1.0)
    """Clearance volume over swept volume."""

    @model_validator(mode="after")
    def _compresses(self) -> "CylinderGas":
        if self.discharge_pressure_pa <= self.suction_pressure_pa:
            raise ValueError(
                f"discharge_pressure_bar = {1e-5 * self.discharge_pressure_pa:g} bar: must exceed "
                f"suction_pressure_bar = {1e-5 * self.suction_pressure_pa:g} bar"
            )
        reached = (1.0 + 1.0 / self.clearance_ratio) ** self.exponent_ratio
        if self.discharge_pressure_pa >= reached * self.suction_pressure_pa:
            raise ValueError(
                f"discharge_pressure_bar = {1e-5 * self.discharge_pressure_pa:g} bar: must be "
                f"less than {1e-5 * reached * self.suction_pressure_pa:g} bar, the compression at "
                f"clearance_ratio = {self.clearance_ratio:g}"
            )
        return self
