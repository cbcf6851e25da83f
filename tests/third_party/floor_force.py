"""A third party's variable over a coordinate of its own, and the section that shows it."""

import vibroacoustics
from vibroacoustics import Coordinate, Section, Variable, blocks, check, stamp

SIDE = Coordinate("side", ("side",), "", "side of the machine")
FLOOR_FORCE = Variable("floor_force", ("option", "side"), "N", "largest force of a side's feet")
vibroacoustics.register(SIDE)
vibroacoustics.register(FLOOR_FORCE)


def with_floor_force(results):
    """The results with the largest foot force on the left and on the right."""
    first = results["foot_force_amplitude"].sel(order=1).max("speed")
    feet = results["foot_position"].sel(axis="y")
    values = [first.where(side).max("foot").values for side in (feet > 0.0, feet <= 0.0)]
    coords = {"option": results["option"], "side": ["left", "right"]}
    array = stamp("floor_force", list(zip(*values, strict=True)), coords)
    return check(results.assign(floor_force=array))


def content(results):
    """One row an option."""
    force = with_floor_force(results)["floor_force"]
    rows = tuple(
        (str(own["option"].item()), *(f"{value:.3g}" for value in own.values)) for own in force
    )
    return [blocks.Table(force.attrs["long_name"], ("Option", "Left, N", "Right, N"), rows)]


SECTION = Section("floor_force", "What the floor gets", content, position=45.0)
vibroacoustics.register(SECTION)
