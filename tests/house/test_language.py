"""Words and phrases of the old dialect fall in number, room by room."""

import re

import pytest
from language import (
    EXEMPT,
    LISTS,
    ROOT,
    committed,
    counts,
    faults,
    faults_of_code,
    faults_of_text,
    risen,
)

MOST_EXEMPT = 10


def test_no_room_has_more_of_them_than_written_down():
    more = risen(counts(), committed())
    rooms = [f"{fault.path}:{fault.line}: {fault.what}" for fault in faults()] if more else []
    assert not more, "\n".join(rooms)


def test_counts_that_fell_are_written_down():
    assert counts() == committed(), "run python tests/house/language.py --write"


@pytest.mark.parametrize("kind", ["holds", "is"])
def test_each_word_is_seen_in_its_example(kind):
    for entry in LISTS[kind]:
        words = [fault.what for fault in faults_of_code("a.py", f"{entry['example']} = 1")]
        assert entry["word"] in words, entry


def test_each_phrase_is_seen_in_its_example():
    for entry in LISTS["phrase"]:
        assert re.search(entry["pattern"], entry["example"]), entry
        assert list(faults_of_text("a.md", entry["example"])), entry


@pytest.mark.parametrize("word", LISTS["openings"])
def test_each_opening_is_seen_below_a_field_and_a_function(word):
    code = f'x: int = 1\n"""{word} the axis."""\ndef f():\n    """{word} the axis."""\n'
    assert [fault.line for fault in faults_of_code("a.py", code) if fault.what == word] == [2, 4]
    assert not list(faults_of_code("a.py", f'"""Axis. {word} it is."""'))


def test_an_array_without_shape_is_seen():
    section = "Parameters\n    ----------\n    x : force, N"
    code = f'def f(x: Array):\n    """Sum.\n\n    {section}\n    """\n'
    assert [fault.what for fault in faults_of_code("a.py", code)] == ["x without shape"]
    assert list(faults_of_code("a.py", code.replace("force, N", "force (10), N")))
    assert not list(faults_of_code("a.py", code.replace("force, N", "force, shape (time,), N")))
    assert not list(faults_of_code("a.py", code.replace("Sum.", "Sum, shape (time,).")))


def test_exemptions_are_few_and_each_is_needed():
    assert len(EXEMPT) <= MOST_EXEMPT
    for path, what in EXEMPT:
        code = (ROOT / path).read_text("utf-8")
        assert what in {fault.what for fault in faults_of_code(path, code)}, path


@pytest.mark.parametrize(
    "line", ["name : of a thing", "a, *b : the same", "x : what acts", "x : as y"]
)
def test_parameter_lines_begin_with_a_noun(line):
    assert list(faults_of_code("a.py", f'"""Sum.\n\n    {line}\n"""'))
    assert not list(
        faults_of_code("a.py", f'"""Sum.\n\n    {line.replace(" :", " : length")}\n"""')
    )


@pytest.mark.parametrize(
    "code",
    ["rest_of_path = 1", "def at_speed(x): ...", "bank_of_cylinders = 1", "'unknown option told'",
     "x.one", "# a bank of cylinders", "cylinder_bank = 1"],
)  # fmt: skip
def test_ordinary_words_stay_free(code):
    assert not list(faults_of_code("a.py", code))


def test_docstrings_comments_and_messages_are_read():
    code = '"""Of a change."""\n# it hangs on that\nerror = f"no file is told {x} here"\n'
    seen = sorted({(fault.line, fault.what) for fault in faults_of_code("a.py", code)})
    assert seen == [(1, "Of"), (2, "hangs on"), (3, "is told")]
