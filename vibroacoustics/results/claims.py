"""Claims that the package's tests check: computed values beside references, in evidence.json."""

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files
from typing import Any, Final

MET: Final = "met"
MISSED: Final = "missed"
EVIDENCE_FILE: Final = "evidence.json"
NAMED_BY_USERS: Final = frozenset({"options", "receivers", "sources", "titles", "given"})
"""Tables whose keys are names that a user chooses."""


@dataclass(frozen=True)
class Claim:
    """A computed value beside a reference, as a test checks it.

    Attributes
    ----------
    what : name of the claim, unique
    kind : exact, printed, second code or recording
    document : short name of the document that the reference is from
    passage : equation, table, page or section of the document
    reference, computed : numbers in `unit`
    unit : unit of the numbers
    tolerance : tolerance of the distance between both, in `unit`
    share : distance of computed and reference in tolerances, to one digit
    verdict : `MET` or `MISSED`
    reason : why it is missed; empty where it is met
    test : identifier of the test in the repository
    topics : kinds and tables of a study that leans on the claim
    """

    what: str
    kind: str
    document: str
    passage: str
    reference: float
    computed: float
    unit: str
    tolerance: float
    share: float
    verdict: str
    reason: str
    test: str
    topics: tuple[str, ...]


@dataclass(frozen=True)
class Document:
    """A document that references are from.

    Attributes
    ----------
    name : short name
    author, title : author and title as printed
    year : year of publication
    """

    name: str
    author: str
    title: str
    year: str


@lru_cache
def _content() -> dict[str, Any]:
    text = files(__package__).joinpath(EVIDENCE_FILE).read_text(encoding="utf-8")
    return dict(json.loads(text))


@lru_cache
def claims() -> tuple[Claim, ...]:
    """Return all claims of evidence.json."""
    return tuple(Claim(**{**row, "topics": tuple(row["topics"])}) for row in _content()["claims"])


@lru_cache
def documents() -> dict[str, Document]:
    """Return the documents of the claims by short name."""
    return {row["name"]: Document(**row) for row in _content()["documents"]}


def closest(rows: Iterable[Claim], count: int) -> list[Claim]:
    """Return the claims that are met with the largest shares of their tolerances, largest first."""
    met = [row for row in rows if row.verdict == MET]
    return sorted(met, key=lambda row: (-row.share, row.what))[:count]


def topics_of(parameters: Mapping[str, Any]) -> frozenset[str]:
    """Return the kinds and the keys of filled tables of a study's parameters, at all depths.

    Examples
    --------
    >>> sorted(topics_of({"machine": {"kind": "table"}, "room": None}))
    ['machine', 'table']
    """
    return frozenset(_topics(parameters))


def _topics(table: Mapping[str, Any], named_by_users: bool = False) -> Iterator[str]:
    for key, entry in table.items():
        if key == "kind":
            yield str(entry)
        elif isinstance(entry, Mapping) and entry:
            if not named_by_users:
                yield key
            yield from _topics(entry, key in NAMED_BY_USERS)


def claims_of_study(parameters: Mapping[str, Any]) -> tuple[Claim, ...]:
    """Return the claims with a topic of a study, given its parameters."""
    topics = topics_of(parameters)
    return tuple(row for row in claims() if topics.intersection(row.topics))
