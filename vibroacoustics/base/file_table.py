"""A table whose values are read from a data file."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, ClassVar

from pydantic import Field, model_validator

from .errors import ParameterError
from .parameters import Parameters


class FileTable(Parameters):
    """A table of a machine, option or source whose values are in a data file that it names.

    The file is read once, with the study or the machine. Its values then are parameters: they are
    in the hash of the parameters, in the keys of caches and in the results, which need the file no
    longer. Fields that the file fills have the default `()` or `""`.

    Examples
    --------
    >>> class ForceFile(va.FileTable):
    ...     content = "force_n"
    ...     force_n: tuple[float, ...] = ()
    ...     @classmethod
    ...     def read(cls, path, table):
    ...         columns = va.read_columns(path, ["force_n"])
    ...         return {"force_n": tuple(columns.numbers["force_n"].tolist())}
    >>> _ = open("force.csv", "w").write("force_kn\\n1.5\\n-1.5\\n")
    >>> ForceFile(file="force.csv").force_n
    (1500.0, -1500.0)
    """

    content: ClassVar[str]
    """Field that is filled from the file; a table that holds it already is not read again."""
    file: str = Field(min_length=1)
    """Name, relative to the TOML file that holds it."""

    @classmethod
    def read(cls, path: Path, table: dict[str, Any]) -> dict[str, Any]:
        """Values of fields from the file.

        Parameters
        ----------
        path : path of the file
        table : the table's other values

        Raises
        ------
        ParameterError
            The file cannot be read, or a value in it is refused.
        """
        raise NotImplementedError

    @model_validator(mode="before")
    @classmethod
    def _with_content(cls, table: Any) -> Any:
        if not isinstance(table, dict):
            return table
        if cls.content in table:  # JSON has lists where there are tuples
            return {key: tuple(v) if isinstance(v, list) else v for key, v in table.items()}
        if not isinstance(table.get("file"), str) or not table["file"]:
            return table
        path = Path(table["file"])
        try:
            read = cls.read(path, table)
        except ParameterError as error:  # pydantic knows none
            raise ValueError(str(error)) from None
        written = sorted(set(read).intersection(table))
        if written:
            raise ValueError(f"{written[0]}: is read from the file, take it out")
        return {**table, **read, "file": path.name}

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
