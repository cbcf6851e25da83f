"""Gas of the pockets over a turn."""

from dataclasses import dataclass

from ...base.arrays import Array
from .suction import SuctionFlow


@dataclass(frozen=True)
class TrappedGas:
    """Gas of a pair of closed pockets, and what crosses its outer contacts.

    Attributes
    ----------
    since_closing : crank angle, from 0 to the opening, shape (steps,), rad
    mass_ratio : mass over that which the pair would hold from constant suction pressure without
        leakage
    contact_angle : crank angle since the closing of the outer contacts, from 0 to a turn after the
        opening, when they open too, rad
    leak_kg_per_s : outwards across both of them, over `contact_angle`
    """

    since_closing: Array
    mass_ratio: Array
    contact_angle: Array
    leak_kg_per_s: Array


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
    trapped : gas of the closed pockets where they leak or fill with inertia; else none
    filling : of the suction pockets where their pressure acts; else none
    """

    since_opening: Array
    pair_pa: Array
    chamber_pa: Array
    plenum_pa: Array
    gap_flow_kg_per_s: Array
    port_flow_kg_per_s: Array
    trapped: TrappedGas | None = None
    filling: SuctionFlow | None = None
