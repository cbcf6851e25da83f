"""The moving parts of machine and option: their change of momentum shakes the rigid machine."""

from collections.abc import Mapping
from typing import ClassVar

from ..machine.source import Case, Source
from ..mechanics.loads import Loads
from ..mechanics.moving_parts import wrench


class MovingParts(Source):
    """Always there; a study does not name it."""

    kind: ClassVar[str] = "moving-parts"
    position: ClassVar[float] = 0.0
    label: ClassVar[str] = "moving parts (orders of the rigid machine)"

    def loads(self, case: Case, before: Mapping[str, Loads]) -> Loads:
        """Wrenches of the machine's parts by name, and of the option's as `balancer`."""
        balancer = wrench(case.added.parts, case.revolution.rotation)
        return Loads(wrenches={**case.revolution.wrenches, "balancer": balancer})
