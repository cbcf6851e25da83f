"""evidence.json, written from claims."""

import json
from collections.abc import Collection, Iterable
from dataclasses import asdict
from pathlib import Path
from typing import Final

import documents

from vibroacoustics.results.claims import EVIDENCE_FILE, Claim, Document, claims

ROOT: Final = Path(__file__).parents[2]
FILE: Final = ROOT / "vibroacoustics" / "results" / EVIDENCE_FILE


def write(made: Iterable[Claim], passed: Collection[str]) -> None:
    """Write the file: claims that were made, and committed ones of tests that did not pass.

    A committed claim goes where its test passed without it, or is no more.
    """
    by_name = {}
    for row in made:
        if by_name.setdefault(row.what, row).test != row.test:
            raise ValueError(f"two tests claim {row.what!r}: {row.test}, {by_name[row.what].test}")
    kept = [row for row in claims() if row.test not in passed and has_test(row)]
    rows = sorted([*by_name.values(), *(row for row in kept if row.what not in by_name)],
                  key=lambda row: (row.test, row.what))  # fmt: skip
    FILE.write_text(written(rows), encoding="utf-8")


def written(rows: Iterable[Claim]) -> str:
    """The text of evidence.json, a claim a line."""
    rows = list(rows)
    tables = {
        "documents": [asdict(document) for document in cited(rows).values()],
        "claims": [asdict(row) for row in rows],
    }
    lines = (
        f'"{name}": [\n'
        + ",\n".join(json.dumps(each, ensure_ascii=False) for each in table)
        + "\n]"
        for name, table in tables.items()
    )
    return "{\n" + ",\n".join(lines) + "\n}\n"


def cited(rows: Iterable[Claim]) -> dict[str, Document]:
    """Documents of the claims by short name."""
    known = {each.name: each for each in vars(documents).values() if isinstance(each, Document)}
    names = sorted({row.document for row in rows})
    return {name: Document(**asdict(known[name])) for name in names}


def has_test(row: Claim) -> bool:
    """Whether the function of a claim's test is in its file."""
    path, *_, name = row.test.partition("[")[0].split("::")
    file = ROOT / path
    return file.is_file() and f"def {name}(" in file.read_text(encoding="utf-8")
