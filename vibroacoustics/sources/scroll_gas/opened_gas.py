"""Gas of opened pockets over a turn."""

from dataclasses import dataclass

from ...base.arrays import Array


@dataclass(frozen=True)
class OpenedGas:
    """Gas at the discharge over a turn from the opening of a pair of pockets.

    Attributes
    ----------
    since_opening : crank angle, 0 to 2π, shape (steps + 1,), rad
    pair_pa : pressure in the opened pair; after half a turn that of the chamber
    chamber_pa : in the chamber inside all closed pockets, out of which the port leads
    plenum_pa : beyond the port
    gap_flow_kg_per_s : from pair to chamber; zero after half a turn
    port_flow_kg_per_s : from chamber to plenum
    """

    since_opening: Array
    pair_pa: Array
    chamber_pa: Array
    plenum_pa: Array
    gap_flow_kg_per_s: Array
    port_flow_kg_per_s: Array
