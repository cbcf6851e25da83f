"""The report as one self-contained HTML page, also for paper."""

import base64
import hashlib
import re
from collections.abc import Sequence
from functools import cache
from importlib import resources
from typing import Final

from jinja2 import Environment, PackageLoader, StrictUndefined, Template
from markupsafe import Markup, escape

from ..base.visible import visible
from .blocks import Live, Part, Sounds, Text, rendered
from .charts.svg import Picture
from .live.assets import blind_script, live_script, live_style, packed, unpacking_script


def html(title: str, about: str, parts: Sequence[Part], results_sha256: str = "") -> bytes:
    """Return a page; all figures and the style are inside, nothing is loaded from elsewhere."""
    style = resources.files(__package__).joinpath("templates/style.css").read_text("utf-8")
    unpacking, script = "", ""
    blocks = (block for part in parts for block in part.blocks)
    live = next((block for block in blocks if isinstance(block, Live)), None)
    if live is not None:
        style += live_style(live.panel)
        unpacking, script = unpacking_script(), live_script(live.panel)
    blind = blind_script() if any(_blind(parts)) else ""
    page = _template().render(
        title=title,
        about=about,
        parts=parts,
        contents=() if any(part.folded for part in parts[1:]) else parts[1:],
        style=style,
        unpacking=unpacking,
        packed=packed(script.encode()),
        blind=blind,
        policy=_policy(style, unpacking, script, blind, plays=bool(_blind(parts))),
        results_sha256=results_sha256,
    )
    return visible(page).encode()


@cache
def _template() -> Template:
    """Template of a page, compiled once."""
    environment = Environment(
        loader=PackageLoader("vibroacoustics.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {
        "data_address": _data_address,
        "along": _along,
        "breakable": _breakable,
        "linked": _linked,
        "rendered": rendered,
        "script_data": _script_data,
    }
    return environment.get_template("report.html.j2")


def _blind(parts: Sequence[Part]) -> list[bool]:
    """Whether there is a blind test, of all sounds of a page."""
    blocks = (block for part in parts for block in part.blocks)
    return [block.blind for block in blocks if isinstance(block, Sounds)]


def _policy(style: str, *scripts: str, plays: bool = False) -> str:
    """Policy of a page for browsers: show its style and figures, run its scripts alone.

    Sounds are played from the folder of the page.
    """
    hashes = " ".join(f"'{content_hash(script)}'" for script in scripts if script)
    run = f"script-src {hashes}; " if hashes else ""
    play = "media-src 'self'; " if plays else ""
    return (
        f"default-src 'none'; img-src data:; style-src '{content_hash(style)}'; {run}{play}"
        "base-uri 'none'; form-action 'none'"
    )


def content_hash(content: str) -> str:
    """Return the hash by which the policy of a page knows its style or a script."""
    return f"sha256-{base64.b64encode(hashlib.sha256(content.encode()).digest()).decode()}"


def _script_data(text: str) -> Markup:
    """JSON that ends no script: none of its letters is `<`."""
    return Markup(text.replace("<", "\\u003c"))  # noqa: S704 - cannot leave its element


def _linked(text: Text) -> Markup:
    """The words with links to other sections."""
    words = escape(text.words)
    for part, section in text.links:
        link = Markup('<a href="#{}">{}</a>').format(section, part)
        words = words.replace(escape(part), link, 1)
    return words


def _along(value: float, scale: tuple[float, float]) -> float:
    """Place of a value along an axis of 100, within its ends."""
    low, high = scale
    return round(100.0 * min(max((value - low) / (high - low), 0.0), 1.0), 1)


def _breakable(text: str) -> Markup:
    """Text that may break after the dots and underscores of a name."""
    return Markup("<wbr>").join(re.split(r"(?<=[._])(?=[^\W\d_])", text))


def _data_address(picture: Picture) -> str:
    kind = {"png": "png", "svg": "svg+xml"}[picture.ending]
    return f"data:image/{kind};base64,{base64.b64encode(picture.content).decode()}"


PAPERS: Final = {"a4": "A4", "letter": "letter"}
"""Names of the sheets as the style writes them."""
_STYLE: Final = re.compile("<style>(.*?)</style>", re.DOTALL)
_DETAILS: Final = re.compile(r'<details(?=>| class="part">)')
_INNERMOST: Final = re.compile(r"<details\b(?:(?!<details\b).)*?</details>", re.DOTALL)


def for_paper(page: bytes, paper: str, brief: bool = False) -> bytes:
    """Return the HTML page for paper, a name of PAPERS; brief: without what is folded.

    The page's policy allows its new style.
    """
    text = page.decode()
    found_style = _STYLE.search(text)
    if found_style is not None:
        style = found_style[1]
        sized = style.replace("size: A4", f"size: {PAPERS[paper]}")
        text = text.replace(style, sized, 1).replace(content_hash(style), content_hash(sized), 1)
    while brief and _INNERMOST.search(text):
        text = _INNERMOST.sub("", text)
    return _DETAILS.sub("<details open", text).encode()
