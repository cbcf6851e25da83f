"""Arguments of the command line, checked."""

from collections.abc import Sequence
from typing import TypeVar

from ..base.errors import ParameterError

Choice = TypeVar("Choice", bound=str)


def chosen(option: str, text: str, choices: Sequence[Choice]) -> Choice:
    """Return the choice that a text names.

    Raises
    ------
    ParameterError
        It names none.
    """
    for choice in choices:
        if text == choice:
            return choice
    raise ParameterError(f"{option} {text!r}: must be one of {', '.join(choices)}")


def order_numbers(text: str, option: str = "--orders") -> tuple[float, ...]:
    """Orders, rising, from a text with commas."""
    return tuple(sorted(_number(option, part) for part in text.split(",")))


def line_points(text: str, option: str = "--tacholess-line") -> tuple[tuple[float, float], ...]:
    """Points of a line, time in s and speed in rpm, from TIME:RPM with commas between them.

    Raises
    ------
    ParameterError
        A point has no colon, or one of its parts is no number.
    """
    points = []
    for part in text.split(","):
        time, colon, speed = part.partition(":")
        if not colon:
            raise ParameterError(f"{option} {part!r}: must be TIME:RPM, in s and rpm")
        points.append((_number(option, time), _number(option, speed)))
    return tuple(points)


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
    """`NAME=NUMBER` of every text."""
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
        if len(numbers_mm) != len("xyz") or not all(abs(number) <= 20e3 for number in numbers_mm):
            raise ParameterError(f"{option} {name}={text}: must be three numbers up to 20000 mm")
        x, y, height = (1e-3 * number for number in numbers_mm)
        positions[name] = (x, y, height)
    return positions


def _number(option: str, text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise ParameterError(f"{option}: {text!r} is no number") from None
