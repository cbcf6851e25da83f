"""Mass and moments of inertia of a rigid body."""

from pydantic import Field

from ..base.parameters import Contradictions, Parameters


class Housing(Parameters):
    """A rigid body; its principal axes are those of the machine."""

    mass_kg: float = Field(ge=0.1, le=1e4)
    inertia_xx_kg_m2: float = Field(gt=0.0, le=1e4)
    inertia_yy_kg_m2: float = Field(gt=0.0, le=1e4)
    inertia_zz_kg_m2: float = Field(gt=0.0, le=1e4)

    def contradictions(self) -> Contradictions:
        moments = sorted((self.inertia_xx_kg_m2, self.inertia_yy_kg_m2, self.inertia_zz_kg_m2))
        if moments[2] > moments[0] + moments[1]:
            yield (
                "inertia_*_kg_m2: the largest moment of inertia must not exceed the sum of the "
                f"others, got {moments[2]:g} > {moments[0]:g} + {moments[1]:g} kg m²"
            )
