"""Options that say where the speed of a recording comes from."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

if TYPE_CHECKING:
    from ..study.order_analysis import SpeedSource


@dataclass(frozen=True)
class SpeedOptions:
    """Options of the speed, as the command line has them."""

    speed_channel: Annotated[
        str | None,
        "Channel of the tacho, or of the speed in rpm; with --tacholess, of the signal.",
    ] = None
    pulses: Annotated[int, "Pulses of the tacho per revolution."] = 1
    index: Annotated[str | None, "Channel with one pulse a revolution: crank angle zero."] = None
    threshold: Annotated[
        float | None,
        "Level of the tacho that marks the angle, in its unit; default: follows it.",
    ] = None
    edge: Annotated[
        str | None,
        "Edge of the tacho's pulses: rising or falling; default: auto.",
    ] = None
    rpm: Annotated[float | None, "Nominal shaft speed, rpm, instead of a channel."] = None
    tacholess: Annotated[
        tuple[float, float] | None,
        "Find the speed in the signal: lowest and highest speed, rpm.",
    ] = None
    comb: Annotated[
        str | None,
        "With --tacholess: orders that the machine has, with commas; default: 1 to 10.",
    ] = None
    mains: Annotated[
        float | None,
        "With --tacholess: frequency of the mains, Hz; its multiples are neglected.",
    ] = None

    def source(self) -> "SpeedSource":
        """Make the source of the speed that the options give.

        Raises
        ------
        ParameterError
            None or two are given, or an option belongs to another source.
        """
        from ..base.errors import ParameterError
        from ..study.order_analysis import (
            DEFAULT_COMB,
            EDGES,
            NominalSpeed,
            SpeedChannel,
            TacholessSpeed,
        )
        from .arguments import chosen, order_numbers

        by_channel = self.speed_channel is not None and self.tacholess is None
        if sum([self.rpm is not None, self.tacholess is not None, by_channel]) != 1:
            raise ParameterError(
                "speed: give one of --speed-channel CHANNEL, --rpm NUMBER and "
                "--tacholess LOWEST HIGHEST"
            )
        tacho = any(option is not None for option in (self.index, self.threshold, self.edge))
        if (tacho or self.pulses != 1) and not by_channel:
            raise ParameterError(
                "--index, --pulses, --threshold, --edge: belong to a tacho, --speed-channel CHANNEL"
            )
        if (self.comb is not None or self.mains is not None) and self.tacholess is None:
            raise ParameterError("--comb, --mains: belong to --tacholess LOWEST HIGHEST")
        if self.tacholess is not None:
            orders = DEFAULT_COMB if self.comb is None else order_numbers(self.comb, "--comb")
            return TacholessSpeed(self.speed_channel, *self.tacholess, orders, self.mains)
        if self.rpm is not None:
            return NominalSpeed(self.rpm)
        edge = None if self.edge is None else chosen("--edge", self.edge, EDGES)
        return SpeedChannel(str(self.speed_channel), self.pulses, self.index, self.threshold, edge)
