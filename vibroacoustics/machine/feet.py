"""Feet anywhere, each on a mount of its own, in place of four equal ones in a square."""

from collections.abc import Mapping
from typing import ClassVar, Final

import numpy as np
from pydantic import Field, model_validator

from ..base.parameters import Parameters
from .mount_stiffness import MountStiffness

FOOT_NAMES: Final = ("front_left", "front_right", "rear_left", "rear_right")
"""Names of four in a square. Front is +x, left is +y."""
LEAST_WIDTH_M: Final = 1e-3
"""Feet closer than this to one line let the machine tip over."""


class Foot(Parameters):
    """A foot; what it does not give of its mount is that of the table `mounts`."""

    x_m: float = Field(ge=-10.0, le=10.0)
    y_m: float = Field(ge=-10.0, le=10.0)
    height_m: float | None = Field(default=None, ge=-10.0, le=10.0)
    """Height of its mount from the centre of mass at rest; under the shell where none is given."""
    lateral_stiffness_n_per_m: float | None = Field(default=None, ge=1e2, le=1e9)
    vertical_stiffness_n_per_m: float | None = Field(default=None, ge=1e2, le=1e9)
    loss_factor_ratio: float | None = Field(default=None, ge=0.0, le=1.0)
    stiffness: MountStiffness | None = None
    """Stiffness over frequency, from a file."""

    @model_validator(mode="after")
    def _one_stiffness(self) -> "Foot":
        constant = (self.lateral_stiffness_n_per_m, self.vertical_stiffness_n_per_m,
                    self.loss_factor_ratio)  # fmt: skip
        if self.stiffness is not None and any(value is not None for value in constant):
            raise ValueError("stiffness: from a file, and values of its own; give one of them")
        return self

    @property
    def has_constant_values(self) -> bool:
        """Whether it gives a constant stiffness or loss."""
        return (self.lateral_stiffness_n_per_m, self.vertical_stiffness_n_per_m,
                self.loss_factor_ratio) != (None, None, None)  # fmt: skip


class Feet(Parameters):
    """Three to eight feet, from the machine's centre of mass."""

    names: ClassVar = tuple(f"foot_{number}" for number in range(1, 9))
    foot_1: Foot
    foot_2: Foot
    foot_3: Foot
    foot_4: Foot | None = None
    foot_5: Foot | None = None
    foot_6: Foot | None = None
    foot_7: Foot | None = None
    foot_8: Foot | None = None

    @property
    def by_name(self) -> Mapping[str, Foot]:
        """The feet that there are."""
        feet = {name: getattr(self, name) for name in self.names}
        return {name: foot for name, foot in feet.items() if foot is not None}

    @model_validator(mode="after")
    def _stands(self) -> "Feet":
        points = np.array([(foot.x_m, foot.y_m, foot.height_m or 0.0)
                           for foot in self.by_name.values()])  # fmt: skip
        widths = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
        if widths[1] < LEAST_WIDTH_M:
            raise ValueError("the feet stand in one line, about which the machine turns freely")
        return self


def values_not_read(feet: Feet | None, stiffness: MountStiffness | None) -> frozenset[str]:
    """Values of the table `mounts` that feet and files leave without effect, dotted."""
    fields = set() if feet is None else {"mounts.pitch_m"}
    each = () if feet is None else tuple(feet.by_name.values())
    if stiffness is not None and not any(foot.has_constant_values for foot in each):
        fields |= {
            "mounts.lateral_stiffness_n_per_m",
            "mounts.vertical_stiffness_n_per_m",
            "mounts.loss_factor_ratio",
        }
    return frozenset(fields)
