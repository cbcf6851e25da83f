"""Forces of the moving parts on the machine and into its feet, by shaft order."""

from typing import ClassVar, Literal

import numpy as np

from ...base.arrays import Array
from ...base.registry import register
from ...study.design import Wanted
from ..engine.needs import Need, ResponsesByNeed
from ..figure import DesignFigure, Setting


class OrderFigure(DesignFigure):
    """Amplitude at an order, the first where none is given."""

    what: ClassVar[Literal["force", "moment", "foot"]]

    def needs(self, wanted: Wanted) -> tuple[Need, ...]:
        """The order's amplitude."""
        return (Need(self.what, wanted.order or 1),)

    def values(self, responses: ResponsesByNeed, setting: Setting) -> Array:
        """Amplitude by speed; of feet the largest."""
        (need,) = self.needs(setting.wanted)
        return responses[need]


@register
class Force(OrderFigure):
    """Force of the moving parts on the machine."""

    name = "force_n"
    label = "Force of the moving parts"
    position = 10.0
    what = "force"


@register
class Moment(OrderFigure):
    """Moment of the moving parts about the centre of mass."""

    name = "moment_nm"
    label = "Moment of the moving parts"
    position = 11.0
    what = "moment"


@register
class FootForce(OrderFigure):
    """Largest force into a foot."""

    name = "foot_force_n"
    label = "Largest force into a foot"
    position = 12.0
    what = "foot"

    def values(self, responses: ResponsesByNeed, setting: Setting) -> Array:
        """Largest force into a foot by speed, N."""
        return np.asarray(super().values(responses, setting).max(axis=-1))
