"""Depth of TOML before it is parsed."""

import time

import pytest

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.study.toml_files import MAXIMUM_DEPTH, nested_deeper_than, read_toml

DEEP = {
    "key": ".".join(["a"] * 100_000) + " = 1",
    "quoted key": " . ".join(['"a.b"'] * 100_000) + " = 1",
    "table": "[" + ".".join(["a"] * 100_000) + "]",
    "list": "a = " + "[" * 100_000,
    "inline tables": "a = " + "{a=" * 100_000,
    "after a string": 'a = ["""b"""", ' + "[" * 100_000,
}


@pytest.mark.parametrize("name", DEEP)
def test_refused_at_once(tmp_path, name):
    path = tmp_path / "study.toml"
    path.write_text(DEEP[name])
    start = time.perf_counter()
    with pytest.raises(ParameterError, match="nested deeper than"):
        read_toml(path)
    assert time.perf_counter() - start < 2.0


@pytest.mark.parametrize(
    "text",
    [
        'a = "' + "." * 99 + '"',
        "a = '" + "[" * 99 + "'",
        'a = """\n' + "{" * 99 + '\n"""',
        "a = '''\n" + "{" * 99 + "\n'''",
        "# " + "[" * 99,
        'a = "\\"' + "[" * 99 + '"',
        "a = [" + "1.5, " * 99 + "]",
        "[a.b]\nc = 1\n" * 99,
    ],
)
def test_text_is_no_depth(text):
    assert not nested_deeper_than(text, MAXIMUM_DEPTH)


@pytest.mark.parametrize("text", ['"""', "'''", '\\"""', "'", '"', "a", "[]"])
def test_time_grows_with_the_length_only(text):
    start = time.perf_counter()
    nested_deeper_than(text * 300_000, MAXIMUM_DEPTH)
    assert time.perf_counter() - start < 5.0
