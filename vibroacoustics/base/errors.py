"""Errors that a user can act on. Each message is one clear line."""


class VibroacousticsError(Exception):
    """Base of every error raised on purpose; the command line prints it and exits with code 2."""

    def __init__(self, message: str) -> None:
        super().__init__(" ".join(message.splitlines()))  # names and values may hold line breaks


class ParameterError(VibroacousticsError):
    """An input value is missing, unknown, of the wrong type or outside its allowed range."""


class SchemaError(VibroacousticsError):
    """A variable left a stage with the wrong dimensions or unit."""


class SolverError(VibroacousticsError):
    """A computation did not converge or gave values that cannot be right."""


class StorageError(VibroacousticsError):
    """A file cannot be read or written, or its content does not match its hash."""


class PluginError(VibroacousticsError):
    """A stranger's option, machine, criterion, section or column cannot be taken in."""
