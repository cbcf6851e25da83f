"""What the command line's words mean, checked."""

from collections.abc import Sequence

from ..base.errors import ParameterError
from ..study.order_analysis import (
    BAND_METHODS,
    DEFAULT_COMB,
    EDGES,
    BandMethod,
    Edge,
    NominalSpeed,
    OrderAnalysis,
    SpeedChannel,
    SpeedSource,
    TacholessSpeed,
)


def order_analysis(
    source: SpeedSource,
    orders: str,
    maximum_order: float,
    resolution: float,
    speed_step: float,
    with_map: bool,
    bands: str,
) -> OrderAnalysis:
    """Settings of an analysis from the options of `orders`.

    Raises
    ------
    ParameterError
        The orders are no numbers, or `bands` is neither way.
    """
    numbers = order_numbers(orders)
    return OrderAnalysis(
        source, numbers, maximum_order, resolution, speed_step, with_map, band_method(bands)
    )


def band_method(text: str) -> BandMethod:
    """How third octaves come about.

    Raises
    ------
    ParameterError
        In neither way.
    """
    for method in BAND_METHODS:
        if text == method:
            return method
    raise ParameterError(f"--bands {text!r}: must be one of {', '.join(BAND_METHODS)}")


def speed_source(
    speed: str | None,
    pulses: int,
    index: str | None,
    rpm: float | None,
    tacholess: tuple[float, float] | None,
    comb: str | None = None,
    mains_hz: float | None = None,
    threshold: float | None = None,
    edge: str | None = None,
) -> SpeedSource:
    """Where the speed of a recording comes from.

    Raises
    ------
    ParameterError
        From nowhere or from two places, or an option belongs to another source.
    """
    given = [rpm is not None, tacholess is not None, speed is not None and tacholess is None]
    if sum(given) != 1:
        raise ParameterError(
            "speed: give one of --speed CHANNEL, --rpm NUMBER and --tacholess LOWEST HIGHEST"
        )
    of_a_tacho = pulses != 1 or any(one is not None for one in (index, threshold, edge))
    if of_a_tacho and (rpm is not None or tacholess is not None):
        raise ParameterError(
            "--index, --pulses, --threshold, --edge: belong to a tacho, --speed CHANNEL"
        )
    if (comb is not None or mains_hz is not None) and tacholess is None:
        raise ParameterError("--comb, --mains: belong to --tacholess LOWEST HIGHEST")
    if tacholess is not None:
        orders = DEFAULT_COMB if comb is None else order_numbers(comb, "--comb")
        return TacholessSpeed(speed, *tacholess, orders, mains_hz)
    if rpm is not None:
        return NominalSpeed(rpm)
    return SpeedChannel(str(speed), pulses, index, threshold, _edge(edge))


def _edge(text: str | None) -> Edge | None:
    for edge in EDGES:
        if text == edge:
            return edge
    if text is not None:
        raise ParameterError(f"--edge {text!r}: must be one of {', '.join(EDGES)}")
    return None


def order_numbers(text: str, option: str = "--orders") -> tuple[float, ...]:
    """Orders, rising, from a text with commas.

    Raises
    ------
    ParameterError
        One of them is no number.
    """
    return tuple(sorted(_number(option, part) for part in text.split(",")))


def assignments(option: str, texts: Sequence[str] | None) -> dict[str, str]:
    """`NAME=VALUE` of every text; the last `=` parts name and value.

    Raises
    ------
    ParameterError
        A text has no `=`, or a name comes twice.
    """
    assigned: dict[str, str] = {}
    for text in texts or ():
        name, equals, value = text.rpartition("=")
        if not equals or not name or not value or name in assigned:
            raise ParameterError(f"{option} {text!r}: must be NAME=VALUE, each name once")
        assigned[name] = value
    return assigned


def numbers(option: str, texts: Sequence[str] | None) -> dict[str, float]:
    """`NAME=NUMBER` of every text.

    Raises
    ------
    ParameterError
        See `assignments`; or a value is no number.
    """
    return {name: _number(option, value) for name, value in assignments(option, texts).items()}


def points(option: str, texts: Sequence[str] | None) -> dict[str, tuple[float, float, float]]:
    """`NAME=X,Y,HEIGHT` of every text, mm, as positions in m.

    Raises
    ------
    ParameterError
        See `assignments`; or a value is not three numbers within 20 m.
    """
    positions = {}
    for name, text in assignments(option, texts).items():
        numbers_mm = [_number(option, part) for part in text.split(",")]
        if len(numbers_mm) != len("xyz") or not all(abs(one) <= 20e3 for one in numbers_mm):
            raise ParameterError(f"{option} {name}={text}: must be three numbers up to 20000 mm")
        x, y, height = (1e-3 * one for one in numbers_mm)
        positions[name] = (x, y, height)
    return positions


def _number(option: str, text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise ParameterError(f"{option}: {text!r} is no number") from None
