"""Effective flow resistivity of kinds of ground."""

from typing import Final, Literal

GroundName = Literal[
    "snow", "moss", "loose_soil", "pasture", "lawn", "gravel_road", "asphalt", "water"
]
FLOW_RESISTIVITY_PA_S_PER_M2: Final[dict[GroundName, float]] = {
    "snow": 12.5e3,
    "moss": 31.5e3,
    "loose_soil": 80e3,
    "pasture": 200e3,
    "lawn": 500e3,
    "gravel_road": 2e6,
    "asphalt": 20e6,
    "water": 200e6,
}
"""Directive (EU) 2015/996, Table 2.5.a, classes A to H, which are those of Nordtest ACOU 104:
very soft, snow or moss-like; soft forest floor, thick moss; uncompacted, loose ground, turf;
normal uncompacted ground, forest floor, pasture; compacted field, lawn, park; compacted dense
ground, gravel road, car park; hard, most asphalt and concrete; very hard and dense, water."""
