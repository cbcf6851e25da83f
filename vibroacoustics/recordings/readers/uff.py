"""UFF dataset 58 (ASCII and binary), time responses, through pyuff."""

import mmap
import re
from collections.abc import Mapping
from typing import Any, Final

from ...base.errors import ParameterError, StorageError
from ...base.registry import register
from ..reader import Reader
from ..recorded import Recorded, Request, check_size, numbered
from ..time_axis import even_rate_hz

TIME_RESPONSE: Final = 1
"""Function type in record 6, field 1."""
EVEN_SPACING: Final = 1
"""Abscissa spacing in record 7, field 3."""
_RECORD_9: Final = re.compile(
    rb"^ {4}-1[ ]*\r?\n {4}58[ b][^\n]*\n(?:[^\n]*\n){8}(?P<record>[^\n]*)", re.MULTILINE
)
"""The ordinate's labels, ten lines below the head of a dataset 58."""
_LABEL, _UNIT = slice(26, 46), slice(47, 67)
"""Columns of record 9: format I10, 3I5, 2(1X, 20A1)."""


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
    import pyuff

    labels = _ordinate_labels(request)
    file = pyuff.UFF(str(request.path))
    indices = [index for index, kind in enumerate(file.get_set_types()) if kind == 58]
    if not indices or len(indices) != len(labels):
        raise StorageError(f"{len(indices)} whole datasets 58, {len(labels)} begun: truncated")
    headers = [file.read_sets(index, header_only=True) for index in indices]
    responses = [n for n, header in enumerate(headers) if header["func_type"] == TIME_RESPONSE]
    if not responses:
        kinds = sorted({header["func_type"] for header in headers})
        raise ParameterError(f"holds no time response (function type 1), only types {kinds}")
    names = numbered([_name(headers[n], labels[n][0]) for n in responses])
    chosen = request.chosen(names)
    check_size(len(chosen), max(headers[responses[c]]["num_pts"] for c in chosen))
    sets = [_whole_set(file, indices[responses[c]], names[c]) for c in chosen]
    return Recorded(
        names=[names[c] for c in chosen],
        units=[labels[responses[c]][1] for c in chosen],
        samples=[dataset["data"] for dataset in sets],
        sample_rate_hz=_common_rate_hz(sets, [names[c] for c in chosen], request),
        start_time=_given(sets[0]["id3"]),
    )


def _ordinate_labels(request: Request) -> list[tuple[str, str]]:
    """Label and unit of each ordinate; pyuff would lose the ² of `m/s²` that is not in UTF-8."""
    with (
        request.path.open("rb") as file,
        mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content,
    ):
        records = [match["record"] for match in _RECORD_9.finditer(content)]
    texts = [_text(record) for record in records]
    return [(_given(text[_LABEL]), _given(text[_UNIT])) for text in texts]


def _text(record: bytes) -> str:
    try:
        return record.decode("utf-8")
    except UnicodeDecodeError:
        return record.decode("latin-1")


def _given(text: str) -> str:
    """The text, empty where the file says NONE."""
    return "" if text.strip().upper() == "NONE" else text.strip()


def _name(header: Mapping[str, Any], label: str) -> str:
    """First of id line 1, response entity and ordinate label that is given."""
    return _given(header["id1"]) or _given(header["rsp_ent_name"]) or label or "channel"


def _whole_set(file: Any, index: int, name: str) -> Mapping[str, Any]:
    dataset: Mapping[str, Any] = file.read_sets(index)
    if len(dataset["data"]) != dataset["num_pts"]:
        raise StorageError(
            f"channel {name!r}: {len(dataset['data'])} samples, its header says "
            f"{dataset['num_pts']}"
        )
    return dataset


def _common_rate_hz(sets: list[Mapping[str, Any]], names: list[str], request: Request) -> float:
    rates = {name: _rate_hz(dataset, request) for name, dataset in zip(names, sets, strict=True)}
    if len(set(rates.values())) > 1:
        listing = ", ".join(f"{name} {rate:.9g} Hz" for name, rate in rates.items())
        raise ParameterError(f"channels differ in sample rate ({listing}): choose some of one rate")
    return rates[names[0]]


def _rate_hz(dataset: Mapping[str, Any], request: Request) -> float:
    if dataset["abscissa_spacing"] != EVEN_SPACING:
        return even_rate_hz(dataset["x"], request)
    if request.sample_rate_hz is None and not dataset["abscissa_inc"] > 0.0:
        raise ParameterError(f"abscissa increment {dataset['abscissa_inc']} s: must be above zero")
    return request.sample_rate_hz or 1.0 / dataset["abscissa_inc"]


register(Reader("uff", (".uff", ".unv"), "UFF", read, package="pyuff"))
