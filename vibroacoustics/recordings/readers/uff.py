"""UFF dataset 58 (ASCII and binary), time responses."""

from collections.abc import Sequence
from typing import BinaryIO, Final

from ...base.errors import ParameterError
from ...base.registry import register
from ..reader import Reader
from ..recorded import Recorded, Request, Samples, check_rate, check_size, listed, numbered
from ..time_axis import even_part
from ..uff58 import DOUBLE, SINGLE, Datasets, Header, datasets
from ..uff58_values import values

TIME_RESPONSE: Final = 1
"""Function type in record 6, field 1."""

_Part = tuple[int, int, float]
"""First sample, the one behind the last, sample rate."""


def read(request: Request) -> Recorded:
    """Time responses of a universal file; the sample rate is 1 over the abscissa increment.

    An ASCII file stores that increment with six digits, so the rate is no better.

    Raises
    ------
    ParameterError
        The file holds no time response, or the chosen ones differ in length or rate.
    StorageError
        The file is truncated or too large.
    """
    with request.path.open("rb") as file:
        contents = datasets(file)
        responses = _time_responses(contents)
        names = numbered([header.name or "channel" for header in responses])
        chosen = request.chosen(names)
        names, responses = [names[c] for c in chosen], [responses[c] for c in chosen]
        first, last, rate_hz = _common_part(file, names, responses, request)
        check_size(len(chosen), last - first)
        samples = [values(file, header, first, last)[0] for header in responses]
    return Recorded(
        names=names,
        units=[header.unit for header in responses],
        samples=samples,
        sample_rate_hz=rate_hz,
        start_time=responses[0].start_time,
        first_sample=first,
        total_samples=responses[0].points,
        remarks=contents.remarks,
    )


def _time_responses(contents: Datasets) -> list[Header]:
    responses = [header for header in contents.functions if header.function_type == TIME_RESPONSE]
    types = sorted({header.function_type for header in contents.functions})
    if types and not responses:
        raise ParameterError(
            f"holds no time response (function type 1), only functions of type {types}"
        )
    if not responses:
        kinds = ", ".join(map(str, sorted(set(contents.kinds)))) or "none"
        raise ParameterError(f"holds no time response (dataset 58); its datasets: {kinds}")
    if any(header.ordinate_type not in (SINGLE, DOUBLE) for header in responses):
        raise ParameterError("holds a complex time response: no real numbers")
    return responses


def _common_part(
    file: BinaryIO, names: Sequence[str], responses: Sequence[Header], request: Request
) -> _Part:
    """The part that is wanted, which all responses share."""
    if not responses:
        raise ParameterError("no channel is chosen")
    lengths = [f"{name} {header.points}" for name, header in zip(names, responses, strict=True)]
    if len({header.points for header in responses}) > 1:
        raise ParameterError(f"channels differ in length ({listed(lengths)}): choose some alike")
    check_size(0, 0 if not request.wants_all else responses[0].points)
    parts = [_part(file, header, request) for header in responses]
    if len(set(parts)) > 1:
        rates = ", ".join(
            f"{name} {part[2]:.9g} Hz" for name, part in zip(names, parts, strict=True)
        )
        raise ParameterError(f"channels differ in sample rate ({rates}): choose some of one rate")
    return parts[0]


def _part(file: BinaryIO, header: Header, request: Request) -> _Part:
    if header.is_even:
        rate_hz = request.sample_rate_hz or _rate_hz(header.increment)
        check_rate(rate_hz)
        return (*request.part(header.points, rate_hz), rate_hz)

    def times(first: int, last: int) -> Samples:
        _, abscissas = values(file, header, first, last)
        assert abscissas is not None  # noqa: S101 - the abscissa is uneven
        return abscissas

    return even_part(times, header.points, request)


def _rate_hz(increment: float) -> float:
    if not increment > 0.0:
        raise ParameterError(f"abscissa increment {increment} s: must be above zero")
    return 1.0 / increment


register(Reader("uff", (".uff", ".unv"), "UFF", read))
