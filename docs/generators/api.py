"""Directives for every public name, so that the page of them needs no list of its own."""

import inspect
from types import FunctionType, ModuleType

import vibroacoustics


def page() -> str:
    """reStructuredText of the page's body."""
    things = {name: getattr(vibroacoustics, name) for name in vibroacoustics.__all__}
    groups = {
        "Functions": [name for name, thing in things.items() if inspect.isfunction(thing)],
        "Classes": [name for name, thing in things.items() if inspect.isclass(thing)],
        "Ports": [name for name, thing in things.items() if isinstance(thing, vibroacoustics.Port)],
        "Modules": [name for name, thing in things.items() if isinstance(thing, ModuleType)],
    }
    parts = [f"{title}\n{'-' * len(title)}\n" for title in groups]
    lines = []
    for title, (head, names) in zip(parts, groups.items(), strict=True):
        if names:
            lines += [title, *(directive(head, name, things[name]) for name in sorted(names))]
    return "\n".join(lines)


def directive(head: str, name: str, thing: object) -> str:
    """What sphinx is told of one name."""
    if head == "Functions":
        return f".. autofunction:: {name}\n"
    if head == "Ports":
        components = ", ".join(thing.components)
        return f"{name}\n{'~' * len(name)}\n\nThe port ``{thing.name}``: {components}.\n"
    if head == "Modules":
        return f"{name}\n{'~' * len(name)}\n\n.. automodule:: {thing.__name__}\n   :members:\n"
    fields = {*getattr(thing, "__dataclass_fields__", ()), *getattr(thing, "_fields", ())}
    public = set(vibroacoustics.__all__)
    homes = [home for home in inspect.getmro(thing) if home is thing or home.__name__ not in public]
    own = [
        member
        for home in homes
        if home.__module__.startswith("vibroacoustics.")
        for member, held in vars(home).items()
        if isinstance(held, FunctionType | classmethod | property)
        and not member.startswith(("_", "model_"))
        and member not in fields
    ]
    members = f"   :members: {', '.join(own)}\n" if own else ""
    return f".. autoclass:: {name}\n{members}"
