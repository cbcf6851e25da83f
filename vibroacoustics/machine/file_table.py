"""A machine's table whose values stand in a file beside the machine's."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, ClassVar

from pydantic import Field, model_validator

from ..base.errors import ParameterError
from ..base.parameters import Parameters


class FileTable(Parameters):
    """Values that are read once, when the machine is; then they are its own, without the file."""

    content: ClassVar[str]
    """Field that is filled from the file; where it is given the file is not read."""
    file: str = Field(min_length=1)
    """Name, relative to the file that names it."""

    @classmethod
    def read(cls, path: Path, given: dict[str, Any]) -> dict[str, Any]:
        """Values of fields from the file.

        Parameters
        ----------
        path : of the file
        given : the table's other values

        Raises
        ------
        ParameterError
            The file cannot be read, or a value in it is refused.
        """
        raise NotImplementedError

    @model_validator(mode="before")
    @classmethod
    def _with_content(cls, given: Any) -> Any:
        if not isinstance(given, dict):
            return given
        if cls.content in given:  # JSON has lists where there are tuples
            return {key: tuple(v) if isinstance(v, list) else v for key, v in given.items()}
        if not isinstance(given.get("file"), str) or not given["file"]:
            return given
        path = Path(given["file"])
        try:
            read = cls.read(path, given)
        except ParameterError as error:  # pydantic knows none
            raise ValueError(str(error)) from None
        written = sorted(set(read).intersection(given))
        if written:
            raise ValueError(f"{written[0]}: is read from the file, take it out")
        return {**given, **read, "file": path.name}

    @classmethod
    def check_lengths(cls, columns: Sequence[Sequence[object]]) -> None:
        """Refuse columns that differ in length or are empty, as no file has them.

        Raises
        ------
        ValueError
            They do.
        """
        if len({len(column) for column in columns}) > 1 or not columns[0]:
            raise ValueError("columns differ in length or are empty; name a file")
