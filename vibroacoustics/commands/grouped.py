"""Options that several commands share, as one parameter of each command."""

from collections.abc import Callable
from dataclasses import fields, is_dataclass
from functools import wraps
from inspect import Parameter, Signature, signature
from typing import Any, TypeVar, get_type_hints

Command = TypeVar("Command", bound=Callable[..., Any])


def with_groups(command: Command) -> Command:
    """Show the fields of every parameter that is a dataclass as options in its place.

    Parameters
    ----------
    command : function that gets each group of options as one dataclass
    """
    parameters = signature(command, eval_str=True).parameters.values()
    groups: dict[str, Any] = {
        one.name: one.annotation for one in parameters if is_dataclass(one.annotation)
    }

    def options_of(parameter: Parameter) -> list[Parameter]:
        if parameter.name not in groups:
            return [parameter.replace(kind=Parameter.KEYWORD_ONLY)]
        group = groups[parameter.name]
        hints = get_type_hints(group, include_extras=True)
        return [
            Parameter(
                field.name,
                Parameter.KEYWORD_ONLY,
                default=field.default,
                annotation=hints[field.name],
            )
            for field in fields(group)
        ]

    @wraps(command)
    def spread(**options: Any) -> Any:
        for name, group in groups.items():
            values = {field.name: options.pop(field.name) for field in fields(group)}
            options[name] = group(**values)
        return command(**options)

    shown = [option for parameter in parameters for option in options_of(parameter)]
    spread.__signature__ = Signature(shown)  # type: ignore[attr-defined]
    spread.__annotations__ = {option.name: option.annotation for option in shown}
    return spread  # type: ignore[return-value]
