"""Residual unbalance of the rotor as a source."""

from collections.abc import Mapping
from typing import ClassVar, Final

from ..base.parameters import Parameters
from ..base.registry import register
from ..machine.isolation import BalanceQuality
from ..machine.source import Case, Source
from ..mechanics.loads import Loads
from ..mechanics.moving_parts import circling, wrench

WRENCH: Final = "residual_unbalance"


@register
class ResidualUnbalance(Source):
    """Unbalance that a balance quality grade allows in two planes: without it counterweights are
    perfect."""

    kind: ClassVar[str] = "residual-unbalance"
    position: ClassVar[float] = 0.5
    label: ClassVar[str] = "residual unbalance of the rotor"
    labels: ClassVar[Mapping[str, str]] = {
        "residual_unbalance_g_mm": "Residual unbalance of the rotor, both planes",
    }
    tables: ClassVar[Mapping[str, type[Parameters]]] = {"balance_quality": BalanceQuality}

    def loads(self, case: Case, before: Mapping[str, Loads]) -> Loads:
        """m e ω² in each plane, turning with the shaft."""
        quality, rotation = case.machine.table(BalanceQuality), case.revolution.rotation
        lower_kg, upper_kg = quality.plane_masses_kg
        planes = (
            (lower_kg, quality.lower_plane_height_m, quality.lower_angle_rad),
            (upper_kg, quality.upper_plane_height_m, quality.upper_angle_rad),
        )
        eccentricity, frame = quality.eccentricity_m, case.machine.crank_frame
        parts = [
            circling(WRENCH, mass, eccentricity, height, rotation.crank_angle + angle, frame)
            for mass, height, angle in planes
        ]
        unbalance_g_mm = 1e6 * eccentricity * quality.rotor_mass_kg
        return Loads(
            wrenches={WRENCH: wrench(parts, rotation)},
            figures={"residual_unbalance_g_mm": unbalance_g_mm},
        )
