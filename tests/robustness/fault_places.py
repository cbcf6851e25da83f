"""Places of the physics where one formula, sign, factor or threshold can be changed."""

import ast
import json
import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Final

ROOMS: Final = (
    "balancers", "levels", "machine", "measured", "mechanics", "mechanisms", "orders", "radiation",
    "recordings", "scoring", "sound", "sources", "stopping", "transfer", "uncertainty",
)  # fmt: skip
NOT_PHYSICS: Final = ("text", "word", "remark", "plot", "figure", "cache", "progress", "export")
"""A file with one of these in its name makes words, pictures or stores."""
MESSAGES: Final = ("Error", "warn", "text", "message", "fault", "progress", "line_of", "words")
"""A call of a name with one of these makes a message."""
ROUNDING: Final = 1e-6
"""A smaller constant is a guard against rounding: twice as much changes no result."""
OPERATORS: Final = {
    ast.Add: ("+", "-"), ast.Sub: ("-", "+"), ast.Mult: ("*", "/"), ast.Div: ("/", "*"),
}  # fmt: skip
COMPARISONS: Final = {
    ast.Lt: ("<", ">"), ast.Gt: (">", "<"), ast.LtE: ("<=", ">="), ast.GtE: (">=", "<="),
}  # fmt: skip
_PAIRS: Final = (
    "sin cos", "sinh cosh", "max min", "maximum minimum", "argmax argmin", "floor ceil",
    "real imag", "any all", "nanmax nanmin",
)  # fmt: skip
FUNCTIONS: Final = {
    name: other
    for pair in map(str.split, _PAIRS)
    for name, other in (pair, reversed(pair))
}  # fmt: skip
NUMBERS: Final = ("Array", "ComplexArray", "float", "complex")
"""What a function returns whose result may be negated."""
PASSED_OVER: Final = (ast.Raise, ast.Assert, ast.JoinedStr, ast.Import, ast.ImportFrom)
PATHS: Final = ("path", "folder", "file", "root", "directory")


@dataclass(frozen=True)
class Place:
    """A change of a few letters of one file.

    Attributes
    ----------
    file : from the root of the tree
    start, end : bytes of the file that the change replaces
    kind : of the change
    before, after : text of the change
    first, last : lines of the statement
    function : around it, the innermost; empty at module level
    compiled : whether numba compiles this function
    name : what an assignment at module or class level, or a default, gives its value to
    """

    file: str
    start: int
    end: int
    kind: str
    before: str
    after: str
    first: int
    last: int
    function: str
    compiled: bool
    name: str
    text: str

    @property
    def room(self) -> str:
        return self.file.split("/")[1]

    @property
    def is_living(self) -> bool:
        """Whether it is in a function that runs as Python; not in a constant or compiled code."""
        return bool(self.function) and not self.compiled

    @property
    def key(self) -> str:
        """The same while the line is the same, wherever it is in the file."""
        return json.dumps([self.file, self.kind, self.text, self.before, self.after])

    def changed(self, content: bytes) -> bytes:
        """The file with the change in it."""
        return content[: self.start] + self.after.encode() + content[self.end :]


def places_of(root: Path) -> list[Place]:
    """All places of the physics rooms, in the order of the files."""
    found = []
    for room in ROOMS:
        for path in sorted((root / "vibroacoustics" / room).rglob("*.py")):
            if not any(word in path.stem for word in NOT_PHYSICS):
                found += _Finder(path.relative_to(root).as_posix(), path.read_bytes()).places
    return found


def chosen(places: Sequence[Place], seed: int) -> Iterator[Place]:
    """Places in the order of a seed, at most one a statement; a longer sample begins the same.

    Each is sampled by its room, with the root of the number of its places as weight, then by its
    kind, all alike, then among those left.
    """
    generator = random.Random(seed)
    rooms = {
        room: {kind: list(group) for kind, group in groupby(
            sorted(inside, key=lambda place: place.kind), lambda place: place.kind)}
        for room, inside in groupby(places, lambda place: place.room)
    }  # fmt: skip
    weights = {room: sum(map(len, kinds.values())) ** 0.5 for room, kinds in rooms.items()}
    taken = set()
    while rooms:
        room = generator.choices(list(rooms), [weights[room] for room in rooms])[0]
        kind = generator.choice(list(rooms[room]))
        left = rooms[room][kind]
        place = left.pop(generator.randrange(len(left)))
        if not left:
            del rooms[room][kind]
        if not rooms[room]:
            del rooms[room]
        if (place.file, place.first) not in taken:
            taken.add((place.file, place.first))
            yield place


class _Finder(ast.NodeVisitor):
    """Places of one file; words, annotations, decorators and ranges of input are passed over."""

    def __init__(self, file: str, content: bytes) -> None:
        self.places: list[Place] = []
        self._file = file
        self._content = content
        self._starts = [0]
        for line in content.splitlines(keepends=True):
            self._starts.append(self._starts[-1] + len(line))
        self._functions: list[tuple[str, bool, bool]] = []
        self._first = self._last = 0
        self._name = ""
        self.visit(ast.parse(content))

    def visit(self, node: ast.AST) -> None:
        if isinstance(node, PASSED_OVER):
            return
        if isinstance(node, ast.stmt):
            body = getattr(node, "body", None)
            self._first = node.lineno
            last = body[0].lineno - 1 if isinstance(body, list) else node.end_lineno
            self._last = max(node.lineno, last or 0)
        super().visit(node)

    def visit_FunctionDef(self, node: ast.FunctionDef) -> None:
        decorators = [ast.unparse(decorator) for decorator in node.decorator_list]
        compiled = any("njit" in text or text.endswith("kernel") for text in decorators)
        numeric = node.returns is not None and ast.unparse(node.returns) in NUMBERS
        for default in (*node.args.defaults, *filter(None, node.args.kw_defaults)):
            self._name = node.name
            self.visit(default)
        self._name = ""
        self._functions.append((node.name, compiled or self._compiled, numeric))
        for statement in node.body:
            self.visit(statement)
        self._functions.pop()

    def visit_Assign(self, node: ast.Assign) -> None:
        self._assigned(node.targets[0], node.value)

    def visit_AnnAssign(self, node: ast.AnnAssign) -> None:
        if node.value is not None:
            self._assigned(node.target, node.value)

    def _assigned(self, target: ast.expr, value: ast.expr) -> None:
        if not self._functions:
            self._name = target.id if isinstance(target, ast.Name) else ""
        self.visit(value)
        self._name = ""

    def visit_AugAssign(self, node: ast.AugAssign) -> None:
        pair = OPERATORS.get(type(node.op))
        if pair is not None and not _is_text(node.value):
            self._between(node.target, node.value, f"{pair[0]}=", f"{pair[1]}=", "operator")
        self.visit(node.value)

    def visit_Return(self, node: ast.Return) -> None:
        if node.value is not None:
            if self._functions[-1][2] and not _is_text(node.value):
                start, end = self._span(node.value)
                text = self._content[start:end].decode()
                self._add(start, end, f"-({text})", "negated return")
            self.visit(node.value)

    def visit_BinOp(self, node: ast.BinOp) -> None:
        sides = (node.left, node.right)
        if any(_is_text(side) for side in sides):
            return
        pair = OPERATORS.get(type(node.op))
        if pair is not None:
            self._between(*sides, *pair, "operator")
        if isinstance(node.op, ast.Mult):
            start, end = self._span(node)
            left, right = (self._content[slice(*self._span(side))].decode() for side in sides)
            kept = right if isinstance(node.left, ast.Constant) else left
            if not isinstance(node.left, ast.List | ast.Tuple):
                self._add(start, end, f"({kept})", "dropped factor")
        if isinstance(node.op, ast.Pow) and isinstance(node.right, ast.Constant):
            self._replace(node.right, repr(node.right.value + 1), "exponent")
            self.visit(node.left)
            return
        self.generic_visit(node)

    def visit_UnaryOp(self, node: ast.UnaryOp) -> None:
        if isinstance(node.op, ast.USub) and not isinstance(node.operand, ast.Constant):
            start, end = self._span(node)
            self._add(start, end, f"({self._content[start + 1 : end].decode()})", "sign")
        self.visit(node.operand)

    def visit_Compare(self, node: ast.Compare) -> None:
        for left, operator, right in zip(
            (node.left, *node.comparators), node.ops, node.comparators, strict=False
        ):
            if type(operator) in COMPARISONS:
                self._between(left, right, *COMPARISONS[type(operator)], "comparison")
        self.generic_visit(node)

    def visit_Constant(self, node: ast.Constant) -> None:
        if isinstance(node.value, float) and abs(node.value) >= ROUNDING:
            for kind, factor in (("constant × 1.1", 1.1), ("constant × 2", 2.0)):
                self._replace(node, repr(node.value * factor), kind)

    def visit_Attribute(self, node: ast.Attribute) -> None:
        if node.attr in FUNCTIONS:
            end = self._span(node)[1]
            self._add(end - len(node.attr), end, FUNCTIONS[node.attr], "function")
        self.visit(node.value)

    def visit_Call(self, node: ast.Call) -> None:
        called = ast.unparse(node.func)
        if any(word in called for word in MESSAGES):
            return
        if called == "Field":  # its ranges refuse input; its default is a number of the model
            for argument in node.args:
                self.visit(argument)
            return
        if isinstance(node.func, ast.Name) and node.func.id in FUNCTIONS:
            self._replace(node.func, FUNCTIONS[node.func.id], "function")
        self.generic_visit(node)

    @property
    def _compiled(self) -> bool:
        return bool(self._functions) and self._functions[-1][1]

    def _span(self, node: ast.expr) -> tuple[int, int]:
        assert node.end_lineno is not None
        assert node.end_col_offset is not None
        start = self._starts[node.lineno - 1] + node.col_offset
        return start, self._starts[node.end_lineno - 1] + node.end_col_offset

    def _between(self, left: ast.expr, right: ast.expr, old: str, new: str, kind: str) -> None:
        """An operator between its two sides, beside brackets and spaces."""
        start, end = self._span(left)[1], self._span(right)[0]
        gap = self._content[start:end]
        if gap.count(old.encode()) == 1 and b"#" not in gap:
            start += gap.index(old.encode())
            self._add(start, start + len(old), new, kind)

    def _replace(self, node: ast.expr, new: str, kind: str) -> None:
        self._add(*self._span(node), new, kind)

    def _add(self, start: int, end: int, after: str, kind: str) -> None:
        function, compiled, _ = self._functions[-1] if self._functions else ("", False, False)
        line = self._content.count(b"\n", 0, start)
        place = Place(
            self._file, start, end, kind, self._content[start:end].decode(), after,
            self._first, self._last, function, compiled, self._name,
            self._content.splitlines()[line].decode().strip(),
        )  # fmt: skip
        self.places.append(place)


def _is_text(node: ast.expr) -> bool:
    """Whether an operand is text, a list or a path, which have operators of their own."""
    if isinstance(node, ast.Constant):
        return isinstance(node.value, str | bytes)
    if isinstance(node, ast.JoinedStr | ast.List | ast.Tuple | ast.ListComp):
        return True
    if isinstance(node, ast.BinOp):
        return _is_text(node.left) or _is_text(node.right)
    name = ast.unparse(node).lower()
    return isinstance(node, ast.Name | ast.Attribute) and name.split(".")[-1] in PATHS
