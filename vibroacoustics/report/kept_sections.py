"""Sections of strangers: guarded, and kept in the results for a report without the plug-in."""

import json
from typing import Final

import xarray as xr

from . import left_out
from .blocks import Block, Text, from_json, to_json
from .sections import SECTIONS, Section

ATTRIBUTE: Final = "report_sections"


def sections_of(results: xr.Dataset) -> list[Section]:
    """Sections that apply: built-in ones, those of strangers that are loaded, kept ones of others.

    One that fails, or is missing, says so in one line.
    """
    strangers = SECTIONS.origins()
    sections = [
        section
        for section in SECTIONS.values()
        if section.name not in strangers and section.applies(results)
    ]
    for name in strangers:
        sections += _guarded(SECTIONS[name], results)
    sections += [section for section in _kept(results) if section.name not in SECTIONS]
    for name, line in left_out.missing(results, "section", ATTRIBUTE).items():
        if name not in SECTIONS:
            sections.append(_fixed(name, name, (Text(line, "note"),)))
    return sorted(sections, key=lambda section: section.position)


def keep_sections(results: xr.Dataset) -> xr.Dataset:
    """The results with the blocks of every section that is not built in."""
    kept = [
        {
            "name": section.name,
            "title": section.title,
            "position": section.position,
            "blocks": json.loads(to_json(section.blocks(results))),
        }
        for section in sections_of(results)
        if section.name not in SECTIONS or SECTIONS.origin(section.name)
    ]
    if not kept and not SECTIONS.origins():
        return results
    return results.assign_attrs({ATTRIBUTE: json.dumps(kept)})


def _guarded(section: Section, results: xr.Dataset) -> list[Section]:
    """A stranger's section with its blocks, or with a line that says how it failed."""
    try:
        if not section.applies(results):
            return []
        blocks = from_json(to_json(section.blocks(results)))
    except Exception as error:
        blocks = (Text(left_out.failure(f"section {section.name}", error), "note"),)
    return [_fixed(section.name, section.title, blocks, section.position)]


def _kept(results: xr.Dataset) -> list[Section]:
    return [
        _fixed(
            entry["name"], entry["title"], from_json(json.dumps(entry["blocks"])), entry["position"]
        )
        for entry in json.loads(results.attrs.get(ATTRIBUTE) or "[]")
    ]


def _fixed(name: str, title: str, blocks: tuple[Block, ...], position: float = 1e9) -> Section:
    return Section(name, title, lambda results: blocks, position=position)
