"""Named things that others can add to: options, machines, criteria, sections, variables, units, …

Built-in things are the modules of the registry's folder, or folders in it that register in
`__init__.py` or `content.py`: they are imported when a name is first looked up, so that a new file
edits no other. A thing of a third party comes from an installed package (entry point), from a file
that the user names, or from a call of `register`; never because a study's file says so.
"""

import sys
from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from difflib import get_close_matches
from importlib import import_module, metadata
from importlib.util import find_spec
from pathlib import Path
from pkgutil import iter_modules
from typing import Any, Final, Generic, NamedTuple, TypeVar

from .errors import ParameterError, PluginError
from .fault import FaultError, Owner, leave_out
from .fence import fence, fenced
from .plain_bytes import sha256

Thing = TypeVar("Thing")

PACKAGE: Final = __package__.partition(".")[0]
LAST: Final = 1000.0
"""Position of a thing that names none: behind the built-in ones."""


class Origin(NamedTuple):
    """Origin of a thing that is not built in.

    Attributes
    ----------
    file : name of the file that holds it
    version : version of the installed package, or `__version__` of the file; empty
        where it has none
    sha256 : hash of the file's content
    """

    file: str
    version: str
    sha256: str


class Registry(Generic[Thing]):
    """Things of one kind by their name.

    Parameters
    ----------
    noun : noun for one of them in messages
    base : class that they are instances, or subclasses, of
    label : attribute that holds a thing's name
    folder : package, relative to this one, whose modules hold the built-in things
    group : entry points of installed packages
    further : more such packages
    """

    def __init__(
        self, noun: str, base: type, label: str, folder: str, group: str, *further: str
    ) -> None:
        self.noun = noun
        self.base = base
        self._label = label
        self._folders = folder, *further
        self._group = group
        self._things: dict[str, Thing] = {}
        self._origins: dict[str, Origin] = {}
        self._faults: dict[str, FaultError] = {}
        self._filled = False
        _REGISTRIES.append(self)

    def __getitem__(self, name: str) -> Thing:
        """The thing of a name.

        Raises
        ------
        ParameterError
            There is none; the line names those that come close, or all.
        """
        self._fill()
        if name not in self._things:
            raise ParameterError(f"{self.noun} {name}: {self.unknown(name)}")
        return self._things[name]

    def __contains__(self, name: object) -> bool:
        self._fill()
        return name in self._things

    def __iter__(self) -> Iterator[str]:
        """Names, by position and then by the alphabet."""
        self._fill()
        return iter(sorted(self._things, key=lambda name: (self._position(name), name)))

    def __len__(self) -> int:
        self._fill()
        return len(self._things)

    def items(self) -> Iterator[tuple[str, Thing]]:
        """Names and things, in the order of the names."""
        return ((name, self._things[name]) for name in self)

    def values(self) -> Iterator[Thing]:
        """Things, in the order of the names."""
        return (self._things[name] for name in self)

    def get(self, name: str) -> Thing | None:
        """The thing of a name; None where there is none."""
        self._fill()
        return self._things.get(name)

    def fenced(self, name: str, *passing: type[Exception]) -> AbstractContextManager[None]:
        """Return the fence around work on a thing; none around work on a built-in one."""
        origin = self.origin(name)
        if origin is None:
            return nullcontext()
        return fence(Owner(self.noun, name, origin.file, self._things[name]), passing)

    @contextmanager
    def spared(self) -> Iterator[None]:
        """Omit a thing of this registry that fails, and say so in one line."""
        try:
            yield
        except FaultError as fault:
            if fault.noun != self.noun:
                raise
            leave_out(fault)

    def meant(self, name: str, further: Iterable[str] = ()) -> str:
        """`, did you mean …?` of the name that comes closest; empty where none is close."""
        close = get_close_matches(name, [*self, *further], n=1)
        return f", did you mean {close[0]}?" if close else ""

    def unknown(self, name: str, further: Iterable[str] = ()) -> str:
        """Return words of a refusal of a name: names that come close, or all that there are.


        Raises
        ------
        FaultError
            The thing is installed, but cannot be loaded.
        """
        if name in self._faults:
            raise self._faults[name]
        allowed = [*self, *sorted(further)]
        return f"unknown{self.meant(name, allowed) or ';'} allowed {', '.join(allowed)}"

    def origin(self, name: str) -> Origin | None:
        """Return where a thing comes from; None for a built-in one."""
        self._fill()
        return self._origins.get(name)

    def origins(self) -> dict[str, Origin]:
        """Return where each thing comes from that is not built in."""
        self._fill()
        return dict(self._origins)

    def add(self, thing: Thing, origin: Origin | None = None) -> None:
        """Take a thing in; `register` finds registry and origin by itself.

        Raises
        ------
        PluginError
            Another thing has the name already.
        """
        name = getattr(thing, self._label, None)
        if not isinstance(name, str) or not name:
            raise PluginError(f"{thing!r}: a {self.noun} needs a text `{self._label}`")
        if origin is not None:
            self._fill()
        registered = self._things.get(name)
        if registered is thing:
            return
        if registered is not None:
            other = self._origins.get(name)
            whose = "is built in" if other is None else f"is given by {other.file} already"
            prefix = "" if origin is None else f"{origin.file}: "
            raise PluginError(f"{prefix}{self.noun} {name}: {whose}; choose another name")
        if origin is not None:
            fenced(thing, self.base, Owner(self.noun, name, origin.file, thing))
        self._things[name] = thing
        if origin is not None:
            self._origins[name] = origin

    def accepts(self, thing: object) -> bool:
        """Whether a thing belongs here: an instance, or a subclass, of the base."""
        return isinstance(thing, self.base) or (
            isinstance(thing, type) and issubclass(thing, self.base) and thing is not self.base
        )

    def _position(self, name: str) -> float:
        return float(getattr(self._things[name], "position", LAST))

    def _fill(self) -> None:
        """Import the built-in things and those of installed packages, once."""
        if self._filled:
            return
        self._filled = True
        for folder in (import_module(f"{PACKAGE}.{name}") for name in self._folders):
            for module in iter_modules(folder.__path__):
                name = f"{folder.__name__}.{module.name}"
                import_module(name)
                if module.ispkg and find_spec(f"{name}.content"):
                    import_module(f"{name}.content")
        for point in metadata.entry_points(group=self._group):
            self._add_installed(point)

    def _add_installed(self, point: metadata.EntryPoint) -> None:
        """Take in what an installed package brings, except what cannot be loaded."""
        try:
            with fence(Owner(self.noun, point.name, f"{point.module.rpartition('.')[2]}.py")):
                thing = point.load()
                if not self.accepts(thing):
                    raise PluginError(f"{point.value}: is no {self.noun}")
                version = point.dist.version if point.dist else ""
                self.add(thing, origin_of(vars(sys.modules[point.module]), version))
        except FaultError as fault:
            self._faults[point.name] = fault
            leave_out(fault)


_REGISTRIES: Final[list[Registry[Any]]] = []


def register(thing: Thing) -> Thing:
    """Take a thing in, of whichever registry; also a decorator of its class.

    Parameters
    ----------
    thing : class derived from `Option`, `Machine`, `Source`, `Stage` or `Criterion`, or a
        `Section`, `Column`, `Variable`, `Coordinate` or `Unit`

    Raises
    ------
    PluginError
        It is none of these, or its name is taken.

    Examples
    --------
    >>> @va.register
    ... class Remark(va.Criterion):
    ...     name = "remark_ratio"
    ...     def value(self, results):
    ...         return results["score"].isel(scoring_method=0)
    """
    caller = sys._getframe(1).f_globals
    built_in = str(caller.get("__name__", "")).startswith(f"{PACKAGE}.")
    origin = None if built_in else origin_of(caller)
    for registry in _REGISTRIES:
        if registry.accepts(thing):
            registry.add(thing, origin)
            return thing
    nouns = ", ".join(registry.noun for registry in _REGISTRIES)
    raise PluginError(f"{thing!r}: is none of {nouns}")


def origin_of(module: dict[str, Any], version: str = "") -> Origin:
    """Origin of what a module holds, from its global names."""
    file = module.get("__file__")
    content = b"" if file is None else Path(file).read_bytes()
    name = "notebook" if file is None else Path(file).name
    return Origin(name, version or str(module.get("__version__", "")), sha256(content))


def plugins() -> dict[str, dict[str, str]]:
    """Return the origin of every loaded thing of a third party by noun and name, as JSON values."""
    return {
        f"{registry.noun} {name}": origin._asdict()
        for registry in _REGISTRIES
        for name, origin in sorted(registry._origins.items())
    }
