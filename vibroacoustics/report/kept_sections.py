"""Sections of third parties: guarded, and kept in the results for a report without the plug-in."""

import json
from typing import Any, Final

import xarray as xr

from ..base.errors import SchemaError
from ..base.fault import collected
from ..results.complete import read_attribute
from ..results.run_attributes import Part
from . import left_out
from .blocks import Block, Text, from_json, to_json
from .sections import SECTIONS, Section

ATTRIBUTE: Final = "report_sections"


def sections_of(results: xr.Dataset) -> list[Section]:
    """Sections that apply: built-in ones, those of third parties that are loaded, kept ones of
    others.

    One that fails, or is missing, says so in one line.
    """
    third_party = SECTIONS.origins()
    built_in = [section for section in SECTIONS.values() if section.name not in third_party]
    sections = [section for section in built_in if section.applies(results)]
    for name in third_party:
        sections += _guarded(SECTIONS[name], results)
    sections += [section for section in kept(results) if section.name not in SECTIONS]
    for name, line in left_out.missing(results, "section", ATTRIBUTE).items():
        if name not in SECTIONS:
            sections.append(_fixed(name, name, (Text(line, "note"),)))
    return sorted(sections, key=lambda section: section.position)


def keep_sections(results: xr.Dataset) -> xr.Dataset:
    """The results with the blocks of every section that is not built in."""
    sections = [
        {
            "name": section.name,
            "title": section.title,
            "position": section.position,
            "blocks": json.loads(to_json(section.blocks(results))),
        }
        for section in sections_of(results)
        if section.name not in SECTIONS or SECTIONS.origin(section.name)
    ]
    if not sections and not SECTIONS.origins():
        return results
    return results.assign_attrs({ATTRIBUTE: json.dumps(sections)})


def _guarded(section: Section, results: xr.Dataset) -> list[Section]:
    """A third party's section with its blocks, or with a line that says how it failed."""
    blocks: tuple[Block, ...] = ()
    with collected() as lines, SECTIONS.spared(), SECTIONS.fenced(section.name):
        if not section.applies(results):
            return []
        blocks = from_json(to_json(section.blocks(results)))
    notes = tuple(Text(line, "note") for line in lines)
    return [_fixed(section.name, section.title, notes or blocks, section.position)]


class KeptSection(Part):
    """A section in the results: its blocks in place of what made them."""

    name: str
    title: str
    position: float
    blocks: list[dict[str, Any]]

    def section(self) -> Section:
        """The section with these blocks."""
        blocks = from_json(json.dumps(self.blocks))
        return _fixed(self.name, self.title, blocks, self.position)


def kept(results: xr.Dataset) -> list[Section]:
    """Sections that the results hold.

    Raises
    ------
    SchemaError
        What they hold is no section.
    """
    if ATTRIBUTE not in results.attrs:
        return []
    entries: list[KeptSection] = read_attribute(results, ATTRIBUTE, list[KeptSection])
    try:
        return [entry.section() for entry in entries]
    except ValueError as error:
        raise SchemaError(f"attribute {ATTRIBUTE}: {str(error).splitlines()[0]}") from None


def _fixed(name: str, title: str, blocks: tuple[Block, ...], position: float = 1e9) -> Section:
    return Section(name, title, lambda results: blocks, position=position)
