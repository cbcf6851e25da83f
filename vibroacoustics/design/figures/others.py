"""Reported figures of options and machines, and resonances of the mounts."""

import numpy as np

from ...base.arrays import Array
from ...base.errors import ParameterError
from ...base.registry import register
from ...base.units import shaft_frequency_hz
from ...study.design import Wanted
from ..engine.needs import Need, ResponsesByNeed
from ..figure import DesignFigure, Setting


@register
class AddedMass(DesignFigure):
    """Mass that the option adds."""

    name = "added_mass_kg"
    label = "Added mass"
    position = 20.0

    def needs(self, wanted: Wanted) -> tuple[Need, ...]:
        """The option's figure."""
        return (Need("figure", None, "added_mass_kg"),)

    def values(self, responses: ResponsesByNeed, setting: Setting) -> Array:
        """Mass, kg."""
        return responses[self.needs(setting.wanted)[0]]


@register
class Reported(DesignFigure):
    """Any figure that the machine, the option or a source reports, in its unit."""

    name = "reported"
    label = "Reported figure"
    position = 21.0

    def needs(self, wanted: Wanted) -> tuple[Need, ...]:
        """The figure of the name."""
        if wanted.reported is None:
            raise ParameterError('reported: is missing; name the figure, as "stroke_amplitude_mm"')
        return (Need("figure", None, wanted.reported),)

    def values(self, responses: ResponsesByNeed, setting: Setting) -> Array:
        """Figure in the unit of its name."""
        return responses[self.needs(setting.wanted)[0]]


@register
class ResonanceMargin(DesignFigure):
    """Distance of the rigid motions' natural frequencies from the range of speeds."""

    name = "resonance_margin_ratio"
    label = "Distance of the mounts' resonances from the speeds"
    position = 22.0
    of_speeds = False

    def needs(self, wanted: Wanted) -> tuple[Need, ...]:
        """Natural frequencies."""
        return (Need("natural"),)

    def values(self, responses: ResponsesByNeed, setting: Setting) -> Array:
        """Least of f_n / f_highest - 1 above and of 1 - f_n / f_lowest below the shaft's range.

        An order that is given multiplies the shaft's frequencies; below zero a resonance lies in
        the range.
        """
        order = float(setting.wanted.order or 1)
        lowest, highest = (
            order * shaft_frequency_hz(float(speed))
            for speed in (setting.speeds_rpm.min(), setting.speeds_rpm.max())
        )
        natural = responses[Need("natural")]
        margin = np.maximum(natural / highest - 1.0, 1.0 - natural / lowest)
        return np.asarray(margin.min(axis=-1))
