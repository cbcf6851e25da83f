"""Units of functions of frequency: of a response by a reference, of mean squares."""

import re
from typing import Final, NamedTuple

from ..base.errors import ParameterError
from .quantities import Quantity, find_quantity, quantity

ALLOWED: Final = (
    "acceleration", "velocity", "displacement", "force", "moment", "sound pressure",
)  # fmt: skip
_SQUARE: Final = re.compile(r"\(?(?P<unit>.*?)\)?(?:²|\^2|\*\*2)")


class Units(NamedTuple):
    """SI units of response and reference, the latter empty of a spectrum, and the factor to SI."""

    response: str
    reference: str
    factor: float


def ratio(text: str) -> Units | None:
    """`m/s²/N` as response and reference; None where it is no such ratio."""
    numerator, slash, denominator = text.strip().rpartition("/")
    above, below = _known(numerator), _known(denominator)
    if not slash or above is None or below is None:
        return None
    return Units(above.unit, below.unit, above.factor / below.factor)


def product(text: str) -> Units | None:
    """`Pa*N` or `(m/s²)²` as units of a mean square; None where it is neither."""
    if "*" in text:
        first, _, second = text.partition("*")
    else:
        square = _SQUARE.fullmatch(text.strip())
        if square is None or find_quantity(text) is not None:
            return None
        first = second = square["unit"]
    numerator, other = _known(first), _known(second)
    return (
        numerator and other and Units(numerator.unit, other.unit, numerator.factor * other.factor)
    )


def single(text: str) -> Units:
    """Unit of a spectrum."""
    measured = quantity(text)
    return Units(checked(measured, text).unit, "", measured.factor)


def checked(measured: Quantity, text: str) -> Quantity:
    """The quantity, if it is one that a function may have.

    Raises
    ------
    ParameterError
        It is another.
    """
    if measured.kind not in ALLOWED:
        raise ParameterError(
            f"unit {text!r} is of {measured.kind}; allowed are {', '.join(ALLOWED)}"
        )
    return measured


def _known(text: str) -> Quantity | None:
    plain = text.strip()
    if plain.startswith("(") and plain.endswith(")"):
        plain = plain[1:-1]
    measured = find_quantity(plain)
    return measured if measured is not None and measured.kind in ALLOWED else None
