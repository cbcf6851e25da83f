"""Parts of a line of an error: kept from where it is raised, or read from its words."""

import ast
import copy
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from support import TINY

import vibroacoustics
from vibroacoustics.base import errors
from vibroacoustics.base.refusal import Parts, Refusal, parts_of, refusal

PACKAGE = Path(vibroacoustics.__file__).parent
_PLACE = re.compile(r"\{([^{}]*)\}")
_HEAD = re.compile(
    r"(?:\{([\w.]*(?:file|path))\}: )?([\w.]+) = \{[^{}]*?(!r|:\.?\d*g)?\}( [^:,{}]+)?: "
)


def templates() -> Iterator[str]:
    """Every message of an error of this package, with `{expression}` for what is filled in."""
    names = {name for name in vars(errors) if name.endswith("Error")} | {"ValueError"}
    for path in sorted(PACKAGE.rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        for node in ast.walk(ast.parse(text)) if "Error(" in text else ():
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") in names:
                yield from (_template(each) for each in node.args if _template(each))


def _template(node: ast.expr) -> str:
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    parts = node.values if isinstance(node, ast.JoinedStr) else []
    return "".join(
        each.value if isinstance(each, ast.Constant) else _place(each)  # type: ignore[misc]
        for each in parts
    )


def _place(node: ast.expr) -> str:
    assert isinstance(node, ast.FormattedValue)
    name = re.sub(r"[{}:]", "", ast.unparse(node.value))
    form = "" if node.format_spec is None else ":" + _template(node.format_spec)
    return f"{{{name}{'!r' * (node.conversion == 114)}{form}}}"


def _filled_in(match: re.Match[str]) -> str:
    if re.fullmatch(r"[\w.]*(file|path)", match[1]):
        return "folder/study.toml"
    if match[1].endswith("!r"):
        return "'word: of it'"
    return "2.5" if re.search(r":\.?\d*[gf]$", match[1]) else "word"


MESSAGES = sorted(set(templates()))


def test_every_message_of_a_value_is_read() -> None:
    """Expected parts are those of the expression that builds the message."""
    checked = 0
    for template in MESSAGES:
        head = _HEAD.match(template)
        if head is None or not head[3]:
            continue
        parts = parts_of(_PLACE.sub(_filled_in, template))
        form = head[3]
        value = "word: of it" if form == "!r" else 2.5
        assert parts.file == (head[1] and "folder/study.toml"), template
        assert parts.field == head[2], template
        assert (parts.value, parts.unit) == (value, head[4] and head[4].strip()), template
        if "must be " in template or "allowed " in template:
            assert parts.allowed, template
        checked += 1
    assert checked > 60, checked


def test_every_message_of_a_file_names_it() -> None:
    begin = re.compile(r"\{[\w.]*(file|path)\}: ")
    lines = [_PLACE.sub(_filled_in, each) for each in MESSAGES if begin.match(each)]
    assert len(lines) > 60
    assert {parts_of(line).file for line in lines} == {"folder/study.toml"}


@pytest.mark.parametrize(
    ("line", "parts"),
    [
        ("a.toml: feet.mass_kg = -1 kg: must be 0 to 9 kg",
         Parts("a.toml", "feet.mass_kg", -1.0, "kg", "0 to 9 kg")),
        ("/home/a: b/s.toml: x.y_mm = 'a: b' mm: must be a number; allowed from -5 to 5 mm",
         Parts("/home/a: b/s.toml", "x.y_mm", "a: b", "mm", "from -5 to 5 mm")),
        ("a.toml: o.x_mm = [1.0, 2.0] mm: outside its own range 3 to 4",
         Parts("a.toml", "o.x_mm", "[1.0, 2.0]", "mm", "3 to 4")),
        ("a.toml: machine.file = missing: name the machine's TOML file",
         Parts("a.toml", "machine.file")),
        ("study: no such file", Parts("study")),
        ("/home/x: cannot be read: Is a directory", Parts("/home/x")),
        ("forces.csv: line 3: has 2 columns", Parts("forces.csv")),
        ("forces.csv: option = x: is none of a, b", Parts("forces.csv", "option", "x")),
        ("--tls-ca x.pem: is not a file", Parts(None, "--tls-ca", "x.pem")),
        ("--level = 900 dB(A): must be above 0 to 140 dB(A)",
         Parts(None, "--level", 900.0, "dB(A)", "above 0 to 140 dB(A)")),
        ("scheduler tcp://127.0.0.1:80: no connection: timed out", Parts()),
        ("order 5: must be above 0", Parts(None, "order", 5.0, None, "above 0")),
        ("modulus_pa = 1 Pa, ratio = 2: allowed above 0 Pa",
         Parts(None, "modulus_pa", 1.0, "Pa", "above 0 Pa")),
        ("full scale = 3 Pa: the sound reaches 4 Pa", Parts(None, "full scale", 3.0, "Pa")),
        ("and 3 more", Parts()),
        ("", Parts()),
    ],
)  # fmt: skip
def test_of_a_line(line: str, parts: Parts) -> None:
    assert parts_of(line) == parts


def test_parts_are_kept_from_where_a_line_is_built() -> None:
    line = refusal("a b.tml", "x.y_mm", "out of range", -1.5, "mm", "from 0 to 2")
    assert line == "a b.tml: x.y_mm = -1.5 mm: out of range; allowed from 0 to 2 mm"
    error = errors.ParameterError(line)
    assert parts_of(error.args[0]) == Parts("a b.tml", "x.y_mm", -1.5, "mm", "from 0 to 2 mm")
    assert parts_of(copy.deepcopy(line)) == line.parts  # by what carries it between processes


def test_a_line_that_is_shortened_keeps_its_parts() -> None:
    line = Refusal("x: " + 400 * "word ", Parts("a.toml", "x"))
    (kept,) = errors.ParameterError(line).args
    assert len(kept) < len(line)
    assert parts_of(kept) == line.parts


def test_the_loader_keeps_the_parts_of_a_file_of_any_name(tmp_path: Path) -> None:
    """Its name cannot be told from a key by words alone."""
    text = TINY.read_text().replace("../../data", str(TINY.parents[2] / "data"))
    path = tmp_path / "a = b"
    path.write_text(text.replace("x_mm = 1082.5", "x_mm = 1e9").replace("none]", "none]\nwarp = 1"))
    with pytest.raises(errors.ParameterError) as caught:
        vibroacoustics.load_study(path)
    parts = [parts_of(line) for line in caught.value.args]
    assert Parts(str(path), "options.none.warp") in parts
    limits = "from -20000 to 20000 mm"
    assert Parts(str(path), "receivers.front_1m.x_mm", 1e9, "mm", limits) in parts
