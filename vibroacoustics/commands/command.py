"""One grammar of all commands: a function gives an outcome, and the runner reports it.

The runner adds `--json` and `--quiet`, and `--verbose` and `--log` where a command computes; it
passes `progress` to a function that takes it. Fields of a parameter that is a dataclass are options
in its place.
"""

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, fields, is_dataclass
from inspect import Parameter, Signature, signature
from pathlib import Path
from typing import Annotated, Any, Final, get_type_hints

import typer
from typer.core import TyperCommand, TyperGroup

from ..base.errors import ParameterError
from ..base.fault import collected
from ..base.posix import LEAST_TO_COMPUTE_BYTES, check_memory
from ..base.progress import stage
from ..base.refusal import Parts, Refusal
from . import messages, option_words
from .outcome import Outcome, write_envelope
from .progress import progress_on_stderr

BROKEN_LIMIT: Final = 1
"""Exit code where a limit is broken."""
JOBS: Final = ("Studies", "Results", "Designs", "Recordings", "Measurements", "Installation")
_TYPES: Final = {"str": "TEXT", "path": "PATH", "float": "NUMBER", "int": "INTEGER"}
_USAGE_ERROR: Any = typer.BadParameter.__base__


@dataclass(frozen=True)
class Speech:
    """Options of all commands."""

    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object instead of text.")
    ] = False
    quiet: Annotated[bool, "Print warnings and errors only, and --json."] = False


@dataclass(frozen=True)
class LongSpeech(Speech):
    """Options of commands that compute."""

    verbose: Annotated[bool, "Print a line for every stage on stderr."] = False
    log: Annotated[Path | None, "File: append stages, warnings and errors with their times."] = None


@dataclass(frozen=True)
class Command:
    """A command of the command line.

    Attributes
    ----------
    name : on the command line
    job : group of the help, one of `JOBS`
    example : words behind `vibroacoustics` and the name
    function : gives the outcome
    computes : whether it takes time, and has `--verbose` and `--log`
    """

    name: str
    job: str
    example: str
    function: Callable[..., Outcome]
    computes: bool

    def run(self, options: dict[str, Any], speech: Speech, inputs: Mapping[str, Any]) -> None:
        """Run the function, and print text or JSON.

        Raises
        ------
        VibroacousticsError
            The function refuses its input.
        typer.Exit
            A limit is broken.
        """
        if self.computes:
            check_memory(LEAST_TO_COMPUTE_BYTES)
        with ExitStack() as stack:
            stack.enter_context(messages.hushed(speech.quiet))
            left_out = stack.enter_context(collected())
            if isinstance(speech, LongSpeech):
                stack.enter_context(messages.logged(speech.log))
                advance = progress_on_stderr(speech.quiet, speech.verbose)
                progress = stack.enter_context(advance)
                if "progress" in signature(self.function).parameters:
                    options["progress"] = progress
                else:
                    stack.enter_context(stage(progress, self.name))
            stack.enter_context(option_words.spoken(inputs))
            if "printing" in options:  # refuses paper and browser before anything is read
                options["printing"].printer()
            outcome = self.function(**options)
            for label, path in outcome.files.items():
                messages.note(f"{label}: {path}")
        if speech.as_json:
            write_envelope(outcome.envelope(self.name, inputs, messages.warned(), left_out))
        elif not speech.quiet:
            for line in outcome.lines():
                typer.echo(line)
        if outcome.broken:
            raise typer.Exit(BROKEN_LIMIT)

    def typed(self) -> Callable[..., None]:
        """Return the function as typer reads it: every option is a parameter."""
        parameters = dict(signature(self.function, eval_str=True).parameters)
        parameters.pop("progress", None)
        kind = LongSpeech if self.computes else Speech
        parameters["speech"] = Parameter("speech", Parameter.KEYWORD_ONLY, annotation=kind)
        groups: dict[str, Any] = {
            name: each.annotation
            for name, each in parameters.items()
            if is_dataclass(each.annotation)
        }

        def typed(**options: Any) -> None:
            inputs = {name: value for name, value in options.items() if name not in said}
            for name, group in groups.items():
                values = {each.name: options.pop(each.name) for each in fields(group)}
                options[name] = group(**values)
            self.run(options, options.pop("speech"), inputs)

        said = {each.name for each in fields(kind)}
        shown = [option for each in parameters.values() for option in _spread(each)]
        typed.__signature__ = Signature(shown)  # type: ignore[attr-defined]
        typed.__annotations__ = {option.name: option.annotation for option in shown}
        typed.__doc__ = self.function.__doc__
        return typed


COMMANDS: Final[dict[str, Command]] = {}
"""All commands by name."""


def command(
    name: str,
    job: str,
    example: str,
    computes: bool = True,
) -> Callable[[Callable[..., Outcome]], Callable[..., Outcome]]:
    """Take a function in as a command."""

    def registered(function: Callable[..., Outcome]) -> Callable[..., Outcome]:
        COMMANDS[name] = Command(name, job, example, function, computes)
        return function

    return registered


def _spread(parameter: Parameter) -> list[Parameter]:
    """Options of a parameter: the fields of a dataclass, else itself."""
    group: Any = parameter.annotation
    if not is_dataclass(group):
        return [_option(parameter.name, group, parameter.default)]
    hints = get_type_hints(group, include_extras=True)
    return [_option(each.name, hints[each.name], each.default) for each in fields(group)]


def _option(name: str, annotation: Any, default: Any) -> Parameter:
    """Option or, where its text begins with a name in capitals, argument of typer."""
    about = getattr(annotation, "__metadata__", (None,))[0]
    if isinstance(about, str):
        argument = re.match(r"([A-Z]+): (.*)", about)
        words = typer.Option(f"--{name.replace('_', '-')}", help=about)
        if argument is not None:
            words = typer.Argument(metavar=argument[1], help=argument[2])
        annotation = Annotated[annotation.__origin__, words]
    return Parameter(name, Parameter.KEYWORD_ONLY, default=default, annotation=annotation)


class HelpedCommand(TyperCommand):
    """Command whose help has an example and types in capitals, and whose errors are one line."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Read the words."""
        with _in_one_line(f"vibroacoustics {self.name} -h", tuple(args)):
            return super().parse_args(ctx, args)

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write arguments, options and the example."""
        for title, kind in (("Arguments", "argument"), ("Options", "option")):
            rows = [row for each, row in self.records(ctx) if each == kind]
            if rows:
                with formatter.section(title):
                    formatter.write_dl(rows)
        with formatter.section("Example"):
            formatter.write_dl([(self.example, "")])

    @property
    def example(self) -> str:
        """Words of an example."""
        return f"vibroacoustics {self.name} {COMMANDS[str(self.name)].example}".rstrip()

    def records(self, ctx: Any) -> Iterator[tuple[str, tuple[str, str]]]:
        """Give kind, names and meaning of each argument and option."""
        for parameter in self.get_params(ctx):
            record = parameter.get_help_record(ctx)
            if record is not None:
                names = re.sub(r"<([^>]*)>(?:\.\.\.)?", _type_words, record[0])
                yield parameter.param_type_name, (names, record[1])


class HelpedGroup(TyperGroup):
    """Group of commands whose help is in order of jobs."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Read the words before the command; without any word there is help."""
        if not args:
            return super().parse_args(ctx, args)
        with _in_one_line("vibroacoustics -h"):
            return super().parse_args(ctx, args)

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """Write the commands of each job."""
        width = max(map(len, self.commands))
        for job in JOBS:
            names = [name for name, each in COMMANDS.items() if each.job == job]
            names.sort(key=lambda name: name != "run")
            rows = [
                (name.ljust(width), self.commands[name].get_short_help_str(formatter.width))
                for name in names
            ]
            with formatter.section(job):
                formatter.write_dl(rows)

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """Find the command that the words name."""
        with _in_one_line("vibroacoustics -h"):
            return super().resolve_command(ctx, args)


@contextmanager
def _in_one_line(help_words: str, arguments: Sequence[str] = ()) -> Iterator[None]:
    """Turn an error of usage into one line without types of Python.

    Parameters
    ----------
    help_words : words that print the help
    arguments : words of the command line
    """
    try:
        yield
    except _USAGE_ERROR as error:
        words = error.format_message().rstrip(".")
        words = re.sub(
            r"(?:Input should be|Value '.*' is not) a valid \w+.*", "is no number", words
        )
        option = re.search(r"--?[a-z][\w-]*|(?<=')[A-Z]+(?=\W)", words)
        field = None if option is None else option[0]
        is_value = field in arguments[:-1] and words.startswith("Invalid value")
        value = arguments[arguments.index(str(field)) + 1] if is_value else None
        parts = Parts(field=field, value=value)
        raise ParameterError(Refusal(f"{words}; see {help_words}", parts)) from None


def _type_words(match: re.Match[str]) -> str:
    type_words = re.findall(r"\w+", match[1].lower())
    return " ".join(_TYPES[word] for word in type_words if word in _TYPES)
