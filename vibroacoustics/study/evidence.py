"""Evidence on a machine, published or measured, to compare results with."""

from pydantic import Field

from ..base.parameters import Parameters
from .measured_spectrum import MeasuredSpectrum


class PublishedForce(Parameters):
    """Force of a moving part at once per revolution, peak."""

    part: str
    speed_rpm: float = Field(gt=0.0)
    force_1x_n: float
    deviation_n: float = Field(ge=0.0)
    """Standard uncertainty of what is published."""
    proportional_to: str = ""
    """Values of the machine's file, dotted, apart by blanks; their ranges make the force's."""
    source: str


class Evidence(Parameters):
    """Published values beside which a report sets its results, and a measured spectrum."""

    forces: tuple[PublishedForce, ...] = ()
    spectrum: MeasuredSpectrum | None = None
    """Spectrum that weights the samples together with the published level."""
