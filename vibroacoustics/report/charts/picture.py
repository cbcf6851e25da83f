"""Finished pictures of a page."""

from typing import Final, Literal, NamedTuple
from weakref import WeakKeyDictionary

from pydantic import Base64Bytes

from ..file_names import file_name
from .marks import Chart
from .svg import svg


class Picture(NamedTuple):
    """A finished figure: its file, the text in its place, what is below it, and its width."""

    name: str
    alt: str
    caption: str
    content: Base64Bytes
    ending: Literal["png", "svg"] = "png"
    wide: bool = False


def picture_file(drawn: Picture) -> str:
    """Return the name of the file of a picture."""
    return f"{file_name(drawn.name)}.{drawn.ending}"


_DRAWN: Final[WeakKeyDictionary[Chart, Picture]] = WeakKeyDictionary()


def picture(chart: Chart) -> Picture:
    """Return the picture of a chart, which is drawn once."""
    if chart not in _DRAWN:
        _DRAWN[chart] = Picture(chart.name, chart.alt, chart.caption, svg(chart), "svg", chart.wide)
    return _DRAWN[chart]
