"""Settings of the radiation step: body, surroundings, grids, frequencies."""

from math import ceil, hypot
from typing import Final, Literal

from pydantic import Field

from ..base.constants import SPEED_OF_SOUND_M_PER_S
from ..base.parameters import Contradictions, Parameters
from .body import RadiatingBody, ShellBody
from .surroundings import Surroundings

KWAVE_LIMIT_HZ: Final = 4000.0
"""Highest frequency at which k-Wave computes the room."""
_NODES_PER_WAVE: Final = 3.5
"""Fewest nodes of the k-Wave grid in a wavelength."""
_CELLS_PER_WAVE: Final = 8.0
"""Fewest cells of the cut-cell grid in a wavelength."""
_AUTOMATIC_CELLS_PER_WAVE: Final = 14.5
"""Cells of an automatic grid in a wavelength: 5.9 mm at 4 kHz."""
BODY_SPACING_M: Final = 0.006
"""Cell size that resolves every body well enough, as far as an automatic grid decides."""
_LARGEST_SPACING_M: Final = 0.05
_TABLE_STEP_HZ: Final = 25.0
"""Step of an automatic table without walls: splines err by 0.01 dB for a compressor's shell."""
_TURNS_PER_STEP: Final = 0.13
"""Turns of an echo's phase in a step: cubic splines err by (2π 0.13)⁴/384 of it, 0.01 dB."""


class RadiationSettings(Parameters):
    """Grid spacings and frequency range of the near field and of the room."""

    body: RadiatingBody = ShellBody()
    surroundings: Surroundings = Surroundings()
    method: Literal["automatic", "revolution", "cut-cells"] = "automatic"
    """Method of radiation by the machine's wall: boundary elements on the meridian of a shell or a
    sphere in free field or over the floor, or cut cells; automatic takes the first where it can."""
    room_solver: Literal["k-wave", "closed-form"] = "k-wave"
    """Method of the sound from the box to the receivers of `kwave_receivers`, up to 4 kHz."""
    kwave_receivers: Literal["catalogue", "all"] = "catalogue"
    """Receivers for which k-Wave computes the room: the microphone of the published level, or
    all."""
    near_field_spacing_m: float | None = Field(default=None, ge=0.002, le=_LARGEST_SPACING_M)
    """Cell size of the finer cut-cell grid around the body; the coarser one has 1.5 times it.
    Without it automatic: the largest that resolves the wave, the body and a cabinet's panels."""
    room_spacing_m: float | None = Field(default=None, ge=0.005, le=0.1)
    """Largest node spacing of the k-Wave grid; it shrinks to fit the walls. Without it automatic:
    the largest that resolves the wave and that the microphone's distance allows."""
    maximum_frequency_hz: float = Field(default=4000.0, ge=50.0, le=10000.0)
    frequency_step_hz: float | None = Field(default=None, ge=1.0, le=100.0)
    """Spacing of the frequencies at which the transfer vectors are tabulated. Without it automatic:
    25 Hz, or a whole part of it that follows the echoes of walls."""

    @property
    def revolution(self) -> bool:
        """Whether boundary elements on the meridian take the place of cut cells."""
        return self.method == "revolution" or (self.method == "automatic" and self._turned)

    @property
    def wave_spacing_m(self) -> float:
        """Cell size of an automatic grid that resolves the shortest wave, m."""
        shortest_m = SPEED_OF_SOUND_M_PER_S / self.maximum_frequency_hz
        return min(shortest_m / _AUTOMATIC_CELLS_PER_WAVE, _LARGEST_SPACING_M)

    @property
    def table_step_hz(self) -> float:
        """Spacing of the tabulated frequencies: the study's, or automatic.

        The farthest image of the machine is twice as far from it as the corner of the walls.
        """
        if self.frequency_step_hz is not None:
            return self.frequency_step_hz
        detour_m = 2.0 * hypot(*(wall.distance_m for wall in self.surroundings.walls.values()))
        turns = _TABLE_STEP_HZ * detour_m / SPEED_OF_SOUND_M_PER_S
        return _TABLE_STEP_HZ / max(1, ceil(turns / _TURNS_PER_STEP))

    @property
    def _turned(self) -> bool:
        """Whether body and surroundings are of revolution about the shell's axis."""
        alone = not self.surroundings.walls and self.surroundings.cabinet is None
        return alone and self.body.kind in ("shell", "sphere")

    def contradictions(self) -> Contradictions:
        if self.method == "revolution" and not self._turned:
            yield (
                'method = "revolution": needs a body of kind shell or sphere, no walls and no '
                'cabinet; take "automatic" or "cut-cells"'
            )
        if self.surroundings.is_outdoors and self.room_solver == "k-wave":
            yield (
                'room_solver = "k-wave": has hard and absorbing walls alone; take "closed-form" '
                "over ground or a barrier"
            )
        near_m = None if self.revolution else self.near_field_spacing_m
        room_m = self.room_spacing_m if self.room_solver == "k-wave" else None
        kwave_hz = min(self.maximum_frequency_hz, KWAVE_LIMIT_HZ)
        for name, spacing_m, nodes, highest_hz in (
            ("near_field_spacing_mm", near_m, _CELLS_PER_WAVE, self.maximum_frequency_hz),
            ("room_spacing_mm", room_m, _NODES_PER_WAVE, kwave_hz),
        ):
            largest_m = SPEED_OF_SOUND_M_PER_S / highest_hz / nodes
            if spacing_m is not None and spacing_m > largest_m:
                yield (
                    f"{name} = {1e3 * spacing_m:g} mm: fewer than {nodes:g} nodes per wavelength "
                    f"at {highest_hz:g} Hz; allowed up to {1e3 * largest_m:.4g} mm"
                )
        cabinet, least = self.surroundings.cabinet, 1.5 * (self.near_field_spacing_m or 0.0)
        if cabinet is not None and cabinet.panel_thickness_m < least * (1.0 - 1e-9):
            yield (
                f"surroundings.cabinet.panel_thickness_mm = {1e3 * cabinet.panel_thickness_m:g} mm:"
                f" thinner than a cell of the coarser grid, {1e3 * least:g} mm, and sound would "
                "leak through; take thicker panels or a smaller near_field_spacing_mm"
            )
