"""Vibration severity of the feet: velocity, RMS, and displacement, peak to peak."""

from ..base.registry import register
from ..transfer.foot_vibration import foot_vibration
from .chain import Chain
from .stage import Given, Stage


@register
class VibrationOfFeet(Stage):
    """Vibration of every foot as a part of the rigid housing, by axis (ISO 20816-1)."""

    name = "vibration"
    reads = ("velocity_order",)
    gives = ("foot_velocity", "foot_displacement")

    def run(self, chain: Chain) -> Given:
        return Given(foot_vibration(chain.results))
