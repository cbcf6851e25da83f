"""Tests in the order in which they are likely to see a fault: by words, then the fastest first."""

import ast
import re
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from math import log
from pathlib import Path
from typing import Final

from fault_places import Place

DEEPEST: Final = 5
"""Steps from a function to the functions that use it."""
COMMON: Final = 40
"""A name that so many functions use leads nowhere."""
SHORTEST: Final = 4
"""Letters of a name that is looked for in tests."""


class Order:
    """Files of tests by how closely they name the function of a fault, or what uses it.

    A step nearer counts as much as half of the words of the function, rare ones counting more.
    """

    def __init__(self, tree: Path, files: Iterable[str]) -> None:
        helpers = {path.stem: _words(path) for path in (tree / "tests" / "helpers").glob("*.py")}
        self._words: dict[str, frozenset[str]] = {}
        for file in files:
            words = _words(tree / file)
            self._words[file] = words.union(*(helpers[name] for name in words & helpers.keys()))
        held = Counter(word for words in self._words.values() for word in words)
        self._rarity = {word: log(len(self._words) / count) for word, count in held.items()}
        self._tree = tree
        self._users: dict[str, set[str]] = defaultdict(set)
        for path in sorted((tree / "vibroacoustics").rglob("*.py")):
            for used, user in _uses(ast.parse(path.read_bytes()), ""):
                self._users[used].add(user)

    def files(self, place: Place) -> list[str]:
        """Files that name the function, what uses it and so on, those of the room earlier."""
        room, words_of_function = f"tests/units/{place.room}/", self._words_around(place)
        rare = max(self._rare(words_of_function), 1.0)
        distance: dict[str, float] = {}
        for step, names in enumerate(self._steps(place.function or place.name)):
            for file, words in self._words.items():
                if file not in distance and not words.isdisjoint(names):
                    outside = 0.0 if file.startswith(room) else 0.5
                    likeness = self._rare(words_of_function & words) / rare
                    distance[file] = step + outside - 2.0 * likeness
        for file in self._words:
            if file.startswith(room):
                distance.setdefault(file, DEEPEST)
        return sorted(distance, key=distance.__getitem__)

    def _rare(self, words: Iterable[str]) -> float:
        return sum(self._rarity.get(word, 0.0) for word in words)

    def _words_around(self, place: Place) -> frozenset[str]:
        """Words of the innermost function or class around a place and of its file's name."""
        source = (self._tree / place.file).read_text(encoding="utf-8")
        around = [
            node
            for node in ast.walk(ast.parse(source))
            if isinstance(node, ast.FunctionDef | ast.ClassDef)
            and node.lineno <= place.first <= (node.end_lineno or 0)
        ]
        lines = source.splitlines()
        inner = max(around, key=lambda node: node.lineno, default=None)
        text = (
            lines[inner.lineno - 1 : inner.end_lineno]
            if inner
            else lines[place.first - 1 : place.last]
        )
        return frozenset(re.findall(r"\w+", " ".join(text))) | {Path(place.file).stem}

    def _steps(self, name: str) -> Iterator[set[str]]:
        level = {name}
        known = set(level)
        for _ in range(DEEPEST):
            yield {name for name in level if len(name) >= SHORTEST}
            users = (self._users[name] for name in level if len(self._users[name]) < COMMON)
            level = set().union(*users) - known
            known |= level


def by_time(tests: Sequence[str], seconds: Mapping[str, float]) -> list[str]:
    """Tests of a file, the fastest first; one whose time is not known counts as half a second."""
    return sorted(tests, key=lambda test: seconds.get(test, 0.5))


def _words(path: Path) -> frozenset[str]:
    return frozenset(re.findall(r"\w+", path.read_text(encoding="utf-8")))


def _uses(node: ast.AST, user: str) -> Iterator[tuple[str, str]]:
    """Names in a module, each with the outermost function, method or constant around it."""
    for child in ast.iter_child_nodes(node):
        inside = user
        if isinstance(child, ast.FunctionDef | ast.ClassDef):
            private = child.name.startswith("__")
            if not user or (isinstance(node, ast.ClassDef) and not private):
                inside = child.name
        elif isinstance(child, ast.Assign | ast.AnnAssign) and isinstance(node, ast.Module):
            target = child.targets[0] if isinstance(child, ast.Assign) else child.target
            inside = target.id if isinstance(target, ast.Name) else ""
        if inside and isinstance(child, ast.Name | ast.Attribute):
            yield (child.id if isinstance(child, ast.Name) else child.attr), inside
        yield from _uses(child, inside)
