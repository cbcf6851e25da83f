"""What each question of a report is answered, and where: from the text of its page and its CSV.

`python tests/helpers/verdicts.py FOLDER…` lists them for the folders of runs.
"""

import csv
import html
import re
import sys
from collections import defaultdict
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

HIDDEN = re.compile(r"<(script|style|svg)\b.*?</\1>", re.DOTALL)
BREAK = re.compile(r"</(?:p|li|tr|h\d|summary|caption|figcaption|dt|dd|div)>|<br>")
CELL = re.compile(r"</t[dh]>")
SECTION = re.compile(r"<h2[^>]*>(.*?)</h2>", re.DOTALL)
SOURCE, RAISED = "dominant source", "options that may raise the level"
SENTENCES = (
    (SOURCE, r"source is not settled; largest: (?P<name>[^,]+),", "open: {}"),
    (SOURCE, r"source is not settled: the interval of (?P<name>.+?) is not", "open: {}"),
    (SOURCE, r"The dominant source is settled: (?P<name>[^,]+),", "settled: {}"),
    (SOURCE, r"The dominant source is (?!not settled|settled)(?P<name>[^:,;]+?):", "settled: {}"),
    (RAISED, r"Option [^.:;,]+? (?:may raise|raises) the level", "some"),
    (RAISED, r"No option (?:is likely to|will) raise the level", "none"),
    (
        "measurement for the source",
        r"Most valuable measurement for the dominant source: (?P<name>[^.]+)\.",
        "{}",
    ),
    (
        "best option by the weights",
        r"By the study's weights option (?P<name>.+?) ranks first",
        "{}",
    ),
    (
        "largest reduction of foot force",
        r"Largest reduction of force on the most loaded foot.*?: option (?P<name>[^,]+),",
        "{}",
    ),
)


class Verdict(NamedTuple):
    """Answer of one place."""

    question: str
    verdict: str
    place: str


def verdicts(files: Mapping[str, bytes]) -> Iterator[Verdict]:
    """Give every verdict of a report's page and CSV files."""
    page = files["report.html"].decode()
    for place, text in _sections(page):
        for question, pattern, words in SENTENCES:
            for match in re.finditer(pattern, text):
                name = match.groupdict().get("name", "") or ""
                yield Verdict(question, words.format(_plain(name)), place)
        yield from _rows(place, text)
    yield from _tables(files)


def contradictions(files: Mapping[str, bytes]) -> dict[str, dict[str, set[str]]]:
    """Questions with more than one verdict: places by verdict, by question."""
    answers: dict[str, dict[str, set[str]]] = defaultdict(lambda: defaultdict(set))
    for question, verdict, place in verdicts(files):
        answers[question][verdict].add(place)
    return {question: dict(of) for question, of in answers.items() if len(of) > 1}


def _sections(page: str) -> Iterator[tuple[str, str]]:
    """Names and texts of the sections; rows of tables are lines, cells end with a bar."""
    text = CELL.sub(" | ", HIDDEN.sub(" ", page))
    starts = [(match.start(), _lines(match.group(1))) for match in SECTION.finditer(text)]
    ends = [start for start, _ in starts[1:]] + [len(text)]
    for (start, name), end in zip(starts, ends, strict=True):
        yield name, _lines(text[start:end])


def _lines(text: str) -> str:
    plain = html.unescape(re.sub(r"<[^>]+>", "", BREAK.sub("\n", text)))
    return re.sub(r" *\n\s*", "\n", re.sub(r"[ \t\u00a0\u202f]+", " ", plain))


TITLE = r"(Change of the level at|Each option against|(\d+) rpm \(1×)"
WORD = r"(?:no measurable change|no change|uncertain|louder|quieter|better|worse|mixed)"


def _rows(place: str, text: str) -> Iterator[Verdict]:
    """Words of the rows on options: first chart, verdicts with reasons, comparison by speed."""
    table = speed = ""
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.rstrip(" |").split("|")]
        if started := re.match(
            r"(Change of the level at|Each option against|(\d+) rpm \(1×)", line
        ):
            table, speed = started.group(1)[:6], started.group(2) or ""
        if table == "Change" and (word := re.search(WORD + "$", cells[-1])):
            yield Verdict(f"level with {_plain(cells[0])}", _word(word.group()), place)
        elif table == "Each o" and len(cells) > 2 and "%" not in cells[1]:
            because = re.search(r"(?:^|; )([a-z ]+): [^;]*total level", cells[2])
            one = cells[1] if "total level" in cells[2] else "no change"
            word = because.group(1) if because else one
            if re.fullmatch(WORD, cells[1]):
                yield Verdict(f"level with {_plain(cells[0])}", _word(word), place)
        elif speed and len(cells) > 3 and re.fullmatch(WORD, cells[1]):
            yield Verdict(f"level with {_plain(cells[0])} at {speed} rpm", _word(cells[1]), place)


def _word(word: str) -> str:
    return {"louder": "worse", "quieter": "better", "no measurable change": "no change"}.get(
        word, word
    )


def _tables(files: Mapping[str, bytes]) -> Iterator[Verdict]:
    """Answers of CSV files, in the words of the page."""
    for row in _csv(files, "scores.csv"):
        if row.get("rank_weighted_sum") == "1":
            yield Verdict("first by the weights", row["option"], "scores.csv")
    for name, column in (
        ("alternatives.csv", "largest_change_total_db"),
        ("comparison.csv", "change_total_db"),
    ):
        rows = _csv(files, name)[: 1 if name == "alternatives.csv" else None]
        found = [float(row[column]) for row in rows if row[column]]
        if found and "alternatives.csv" in files:
            yield Verdict("a median rises by 0.5 dB", str(max(found) > 0.5), name)


def _csv(files: Mapping[str, bytes], name: str) -> list[dict[str, str]]:
    return list(csv.DictReader(files.get(name, b"").decode().splitlines()))


def _plain(name: str) -> str:
    return name.strip().lower()


if __name__ == "__main__":
    for folder in map(Path, sys.argv[1:]):
        content = {file.name: file.read_bytes() for file in folder.iterdir() if file.is_file()}
        print(f"{folder.name}:")
        for question, verdict, place in sorted(set(verdicts(content))):
            print(f"  {question} | {verdict} | {place}")
        if doubts := contradictions(content):
            raise SystemExit(f"{folder.name}: {doubts}")
