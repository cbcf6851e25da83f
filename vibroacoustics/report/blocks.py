"""Blocks of a section of the report: one list makes HTML, Markdown and JSON.

All are frozen and hold finished text; `block` names the kind of block in templates and JSON.
`Table` is a block too.

>>> table = va.blocks.Table("Prices", ("Option", "Price"), (("none", "0"), ("hood", "12")))
>>> details = va.blocks.Details("More", (va.blocks.Text("As of today."), table))
"""

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Annotated, Literal, NamedTuple, TypeAlias

from pydantic import Field, TypeAdapter

from .charts.marks import Chart
from .charts.svg import Picture, picture
from .tables import Table


@dataclass(frozen=True)
class Text:
    """A paragraph.

    Attributes
    ----------
    words : the text
    kind : `headline` opens the report, `note` explains how to read what follows
    links : words of the text that lead to another section, each with the name of that section
    block : kind of block
    """

    words: str
    kind: Literal["plain", "headline", "strong", "note"] = "plain"
    links: tuple[tuple[str, str], ...] = ()
    block: Literal["text"] = field(default="text", kw_only=True, repr=False)


@dataclass(frozen=True)
class Heading:
    """A heading within a section."""

    words: str
    block: Literal["heading"] = field(default="heading", kw_only=True, repr=False)


@dataclass(frozen=True)
class Bullets:
    """A list of sentences."""

    items: tuple[str, ...]
    block: Literal["bullets"] = field(default="bullets", kw_only=True, repr=False)


@dataclass(frozen=True)
class Definition:
    """A term, a tag of one or two words beside it, and what there is to say."""

    term: str
    tag: str
    words: str


@dataclass(frozen=True)
class Definitions:
    """A list of terms with what there is to say of each."""

    entries: tuple[Definition, ...]
    block: Literal["definitions"] = field(default="definitions", kw_only=True, repr=False)


@dataclass(frozen=True)
class Pictures:
    """Figures and charts side by side where there is room."""

    pictures: tuple[Picture | Chart, ...]
    block: Literal["pictures"] = field(default="pictures", kw_only=True, repr=False)


@dataclass(frozen=True)
class Live:
    """The interactive part of a page of the package; nothing without a script.

    Attributes
    ----------
    data : JSON for the script
    panel : content of the panel; a page has one
    block : kind of block
    """

    data: str = field(repr=False)
    panel: Literal["sliders", "run_up"] = "sliders"
    block: Literal["live"] = field(default="live", kw_only=True, repr=False)


@dataclass(frozen=True)
class Light:
    """Effect of an option on one quantity: a coloured sign, the change, its band.

    Attributes
    ----------
    word : word of the sign
    change : change as text
    band : lowest and highest, of -1 to 1, the ends of the cell's scale
    zone : up to which a change could not be measured, of the same scale
    """

    word: Literal["better", "worse", "mixed", "uncertain", "no change"]
    change: str
    band: tuple[float, float]
    zone: float


@dataclass(frozen=True)
class LightRow:
    """An option with the sign of its verdict and a light for each quantity."""

    name: str
    word: Literal["better", "worse", "mixed", "uncertain", "no change"]
    lights: tuple[Light, ...]


@dataclass(frozen=True)
class Lights:
    """A chart of options and quantities as traffic lights with bands.

    Attributes
    ----------
    caption : above it
    head : names of the columns, the options first
    rows : the options
    note : how to read it
    block : kind of block
    """

    caption: str
    head: tuple[str, ...]
    rows: tuple[LightRow, ...]
    note: str
    block: Literal["lights"] = field(default="lights", kw_only=True, repr=False)


IntervalWord: TypeAlias = Literal[
    "louder", "quieter", "uncertain", "no change", "published", "total", "part"
]


@dataclass(frozen=True)
class Interval:
    """A value with its interval.

    Attributes
    ----------
    name : name of the machine, option or source
    text : value and interval
    low, value, high : ends and value, in the unit of the chart
    word : description; of changes what the option does
    """

    name: str
    text: str
    low: float
    value: float
    high: float
    word: IntervalWord


@dataclass(frozen=True)
class Intervals:
    """A chart of values with their intervals, one row each.

    Attributes
    ----------
    caption : above it
    head : headings of names and texts
    rows : values
    scale : lowest and highest value of the axis
    zone : values that are no different from zero; none for all
    note : how to read it
    block : kind of block
    """

    caption: str
    head: tuple[str, str]
    rows: tuple[Interval, ...]
    scale: tuple[float, float]
    zone: tuple[float, float] | None
    note: str
    block: Literal["intervals"] = field(default="intervals", kw_only=True, repr=False)


@dataclass(frozen=True)
class Sound:
    """A sound that the page plays.

    Attributes
    ----------
    name : name of the source
    file : beside the page
    """

    name: str
    file: str


@dataclass(frozen=True)
class Sounds:
    """Sounds to compare, one below the other; their files are beside the page.

    Attributes
    ----------
    sounds : two for a blind test
    blind : whether the page has a blind test (ABX) of the two
    block : kind of block
    """

    sounds: tuple[Sound, ...]
    blind: bool = False
    block: Literal["sounds"] = field(default="sounds", kw_only=True, repr=False)


@dataclass(frozen=True)
class Beside:
    """A narrow block and a wide one, side by side where there is room."""

    narrow: "Block"
    wide: "Block"
    block: Literal["beside"] = field(default="beside", kw_only=True, repr=False)


@dataclass(frozen=True)
class Details:
    """Blocks that are folded below a summary."""

    summary: str
    blocks: "tuple[Block, ...]"
    block: Literal["details"] = field(default="details", kw_only=True, repr=False)


Block: TypeAlias = Annotated[
    Text
    | Heading
    | Bullets
    | Definitions
    | Table
    | Pictures
    | Lights
    | Intervals
    | Sounds
    | Beside
    | Live
    | Details,
    Field(discriminator="block"),
]


class Part(NamedTuple):
    """A section with its blocks; folded ones open at a click, at a link to them and on paper."""

    name: str
    title: str
    blocks: tuple[Block, ...]
    folded: bool = False


def to_json(blocks: Sequence[Block]) -> str:
    """Blocks as JSON in ASCII; pictures in base64."""
    text = json.dumps(_adapter().dump_python(rendered(blocks), mode="json", warnings=False))
    from_json(text)
    return text


def from_json(text: str) -> tuple[Block, ...]:
    """Blocks from their JSON.

    Raises
    ------
    ValueError
        The text is no JSON of blocks.
    """
    blocks = _adapter().validate_json(text)
    if next(charts(blocks), None) is not None:
        raise ValueError("a chart where a finished picture is expected")
    return blocks


def pictures(blocks: Sequence[Block]) -> Iterator[Picture]:
    """All pictures of some blocks, folded ones too."""
    for block in _flat(rendered(blocks)):
        if isinstance(block, Pictures):
            yield from (each for each in block.pictures if isinstance(each, Picture))


def charts(blocks: Sequence[Block]) -> Iterator[Chart]:
    """All charts of some blocks, folded ones too."""
    for block in _flat(blocks):
        if isinstance(block, Pictures):
            yield from (each for each in block.pictures if isinstance(each, Chart))


def tables(blocks: Sequence[Block]) -> Iterator[Table]:
    """All tables of some blocks, folded ones too."""
    return (block for block in _flat(blocks) if isinstance(block, Table))


def rendered(blocks: Sequence[Block]) -> tuple[Block, ...]:
    """Return blocks with pictures in place of charts."""
    return tuple(map(_rendered, blocks))


def _rendered(block: Block) -> Block:
    if isinstance(block, Pictures):
        finished = (picture(each) if isinstance(each, Chart) else each for each in block.pictures)
        return Pictures(tuple(finished))
    if isinstance(block, Details):
        return replace(block, blocks=rendered(block.blocks))
    if isinstance(block, Beside):
        return Beside(_rendered(block.narrow), _rendered(block.wide))
    return block


def _flat(blocks: Sequence[Block]) -> Iterator[Block]:
    """Yield blocks and those within them."""
    for block in blocks:
        yield block
        if isinstance(block, Details):
            yield from _flat(block.blocks)
        elif isinstance(block, Beside):
            yield from _flat((block.narrow, block.wide))


@cache
def _adapter() -> TypeAdapter[tuple[Block, ...]]:
    return TypeAdapter(tuple[Block, ...])
