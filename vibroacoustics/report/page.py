"""The report as sections with their blocks, before it becomes HTML or Markdown."""

from typing import NamedTuple

import xarray as xr

from .blocks import Block, pictures
from .figures.style import Picture, file_name
from .kept_sections import sections_of
from .study import parameters
from .titles import titled


class Part(NamedTuple):
    """A section with its blocks."""

    name: str
    title: str
    blocks: tuple[Block, ...]


class Page(NamedTuple):
    """The report: title, machine, when its results were made, sections, what it is about."""

    title: str
    machine: str
    created: str
    parts: tuple[Part, ...]
    about: str = "What each way of balancing does to the forces, to the feet and to the sound."

    def pictures(self) -> dict[str, Picture]:
        """All figures by the name of their file."""
        of_parts = (picture for part in self.parts for picture in pictures(part.blocks))
        return {figure_file(picture): picture for picture in of_parts}


def page_of(results: xr.Dataset) -> Page:
    """The page of a finished run."""
    results = titled(results)
    parts = tuple(
        Part(section.name, section.title, tuple(section.blocks(results)))
        for section in sections_of(results)
    )
    of_study = parameters(results)
    return Page(of_study["title"], of_study["machine"]["name"], results.attrs["created_utc"], parts)


def figure_file(picture: Picture) -> str:
    """File of a figure beside the report."""
    return f"figures/{file_name(picture.name)}.png"
