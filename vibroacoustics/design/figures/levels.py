"""Levels at the microphones and their changes relative to the machine without an option."""

from typing import ClassVar

from ...base.arrays import Array
from ...base.constants import REFERENCE_PRESSURE_PA
from ...base.registry import register
from ...study.design import Wanted
from ..engine.needs import Need, ResponsesByNeed
from ..figure import DesignFigure, Setting


def _power(mean_square: Array) -> Array:
    """Return the power relative to that of 0 dB."""
    return mean_square / REFERENCE_PRESSURE_PA**2


@register
class Level(DesignFigure):
    """A-weighted level of all modelled sound."""

    name = "level_dba"
    label = "Modelled level"
    position = 1.0
    is_level = True

    def needs(self, wanted: Wanted) -> tuple[Need, ...]:
        """All sound."""
        return (Need("sound"),)

    def values(self, responses: ResponsesByNeed, setting: Setting) -> Array:
        """Power over that of 0 dB(A)."""
        return _power(responses[Need("sound")])


@register
class LevelChange(Level):
    """Change of the A-weighted modelled level."""

    name = "level_change_db"
    label = "Change of the modelled level"
    position = 2.0
    is_change = True


@register
class TotalLevel(Level):
    """A-weighted level of the machine: modelled sound and unmodelled noise."""

    name = "level_total_dba"
    label = "Level of the machine"
    position = 3.0

    def values(self, responses: ResponsesByNeed, setting: Setting) -> Array:
        """Power over that of 0 dB(A)."""
        return _power(responses[Need("sound")] + setting.unmodelled())


@register
class TotalChange(TotalLevel):
    """Change of the A-weighted level of the machine."""

    name = "total_change_db"
    label = "Change of the machine's level"
    position = 4.0
    is_change = True


@register
class OrderLevel(DesignFigure):
    """Level of the line of a shaft order, the first where none is given."""

    name = "order_level_db"
    label = "Level of the order"
    position = 5.0
    is_level: ClassVar[bool] = True

    def needs(self, wanted: Wanted) -> tuple[Need, ...]:
        """The order's sound."""
        return (Need("sound", wanted.order or 1),)

    def values(self, responses: ResponsesByNeed, setting: Setting) -> Array:
        """Power over that of 0 dB."""
        (need,) = self.needs(setting.wanted)
        return _power(responses[need])


@register
class OrderChange(OrderLevel):
    """Change of the level of a shaft order."""

    name = "order_change_db"
    label = "Change of the order"
    position = 6.0
    is_change = True
