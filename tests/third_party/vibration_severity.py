"""A third party's stage: vibration severity of the housing, with its section of the report."""

import numpy as np

import vibroacoustics
from vibroacoustics import Chain, Given, Section, Stage, Variable, blocks, stamp

LOWEST_HZ, HIGHEST_HZ = 10.0, 1000.0
SEVERITY = Variable(
    "vibration_severity", ("speed", "option"), "mm s-1", "rms velocity, 10 Hz to 1 kHz"
)
vibroacoustics.register(SEVERITY)


@vibroacoustics.register
class VibrationSeverity(Stage):
    """Root mean square velocity of the centre of mass along its worst axis (ISO 20816-1)."""

    name = "vibration-severity"
    reads = ("velocity_order",)
    gives = ("vibration_severity",)

    def run(self, chain: Chain) -> Given:
        along = chain.results["velocity_order"].sel(dof=["tx", "ty", "tz"]).sum("source")
        frequency = along["order_frequency"]
        within = (frequency >= LOWEST_HZ) & (frequency <= HIGHEST_HZ)
        square = (0.5 * np.abs(along) ** 2).where(within, 0.0).sum("order")
        severity = 1e3 * np.sqrt(square.max("dof")).transpose("speed", "option")
        coords = {name: severity[name].values for name in ("speed", "option")}
        return Given(stamp("vibration_severity", severity.values, coords).to_dataset())


def content(results):
    """One row a speed and option."""
    severity = results["vibration_severity"]
    rows = tuple(
        (f"{speed:g}", str(option), f"{severity.sel(speed=speed, option=option).item():.3g}")
        for speed in severity["speed"].values
        for option in severity["option"].values
    )
    return [blocks.Table(severity.attrs["long_name"], ("Speed, rpm", "Option", "mm/s"), rows)]


def applies(results):
    """Whether the results were made with the stage."""
    return "vibration_severity" in results


SECTION = Section("vibration_severity", "Vibration severity", content, applies, position=46.0)
vibroacoustics.register(SECTION)
