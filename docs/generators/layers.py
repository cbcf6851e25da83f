"""The picture of the layers, drawn from the contract that the import-linter checks."""

import tomllib
from html import escape
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).resolve().parents[2]
WORDS: Final = {
    "commands": "the command line",
    "plot": "figures as functions",
    "report": "HTML, Markdown, CSV",
    "pipeline": "the order of stages",
    "scoring": "criteria, ranks",
    "uncertainty": "samples, bands",
    "results": "files, provenance",
    "balancers": "one file an option",
    "stopping": "switched off",
    "mechanisms": "one folder a machine",
    "sources": "gas, keys, motor",
    "transfer": "mounts, shell, path",
    "levels": "dB, bands",
    "radiation": "velocity to Pa",
    "orders": "order analysis",
    "recordings": "files of sensors",
    "study": "TOML to values",
    "machine": "what all machines have",
    "mechanics": "moving parts, loads",
    "base": "units, errors, vocabulary",
}
"""A few words for each room, where there are some."""
WIDTH, HEIGHT, GAP = 900, 46, 6


def layers() -> list[list[str]]:
    """Rooms by layer from the top, as the contract has them."""
    with (ROOT / "pyproject.toml").open("rb") as file:
        contracts = tomllib.load(file)["tool"]["importlinter"]["contracts"]
    lines = next(one for one in contracts if one["type"] == "layers")["layers"]
    return [[room.strip() for room in line.replace(":", "|").split("|")] for line in lines]


def picture() -> str:
    """SVG of the layers, each room a box."""
    boxes = []
    for row, rooms in enumerate(layers()):
        width = (WIDTH - GAP * (len(rooms) - 1)) / len(rooms)
        boxes += [
            box(room, number * (width + GAP), row * (HEIGHT + GAP), width)
            for number, room in enumerate(rooms)
        ]
    height = len(layers()) * (HEIGHT + GAP) - GAP
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" '
        f'font-family="sans-serif" text-anchor="middle">\n{"".join(boxes)}</svg>\n'
    )


def box(room: str, left: float, top: float, width: float) -> str:
    """One room with its words."""
    middle, words = left + width / 2.0, WORDS.get(room, "")
    name_y = top + (20 if words else 28)
    return (
        f'<rect x="{left:.1f}" y="{top}" width="{width:.1f}" height="{HEIGHT}" rx="5" '
        f'fill="#dce9f5" stroke="#3b6ea5"/>\n'
        f'<text x="{middle:.1f}" y="{name_y}" font-size="16" fill="#10233a">{escape(room)}</text>\n'
        f'<text x="{middle:.1f}" y="{top + 38}" font-size="12.5" fill="#3d5166">{escape(words)}'
        "</text>\n"
    )
