"""The report as sections with their blocks, before it becomes HTML or Markdown."""

from typing import NamedTuple

import xarray as xr

from ..base.fault import collected
from ..base.processes import side_by_side
from ..results.stored_study import parameters
from ..results.titles import titled
from .blocks import Block, pictures
from .charts.picture import Picture
from .columns import COLUMNS
from .file_names import file_name
from .kept_columns import columns_of
from .kept_sections import sections_of
from .left_out import with_lines
from .sections import SECTIONS


class Part(NamedTuple):
    """A section with its blocks; folded ones open at a click, at a link to them and on paper."""

    name: str
    title: str
    blocks: tuple[Block, ...]
    folded: bool = False


class Page(NamedTuple):
    """The report: title, machine, when its results were made, sections, what it is about."""

    title: str
    machine: str
    created: str
    parts: tuple[Part, ...]
    about: str = "What each way of balancing does to the forces, to the feet and to the sound."

    @property
    def contents(self) -> tuple[Part, ...]:
        """What is listed below the first section: nothing where others are a list, folded."""
        rest = self.parts[1:]
        return () if any(part.folded for part in rest) else rest

    def pictures(self) -> dict[str, Picture]:
        """All figures by the name of their file."""
        of_parts = (picture for part in self.parts for picture in pictures(part.blocks))
        return {figure_file(picture): picture for picture in of_parts}


def page_of(results: xr.Dataset) -> Page:
    """The page of a finished run."""
    results = titled(results)
    with collected() as lines:
        sections = sections_of(results)
        columns_of(results)
    results = with_lines(results, lines, (SECTIONS, COLUMNS))

    def blocks_of(number: int) -> tuple[Block, ...]:
        return tuple(sections[number].blocks(results))

    parts = tuple(
        Part(section.name, section.title, blocks, section.folded)
        for section, blocks in zip(
            sections, side_by_side(blocks_of, range(len(sections))), strict=True
        )
    )
    of_study = parameters(results)
    return Page(of_study["title"], of_study["machine"]["name"], results.attrs["created_utc"], parts)


def figure_file(picture: Picture) -> str:
    """File of a figure beside the report."""
    return f"figures/{file_name(picture.name)}.{picture.ending}"
