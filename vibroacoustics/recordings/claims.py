"""Claims of a header against what the bytes of its file can hold, before memory is planned."""

from pathlib import Path
from typing import Final

from ..base.errors import StorageError

DEFLATE_RATIO: Final = 1032
"""Most bytes that one byte of deflate stands for: Gailly and Adler, "zlib Technical Details"."""


def check_claim(
    path: Path, claimed: int, value_bytes: float, what: str = "samples", ratio: float = 1.0
) -> None:
    """Refuse a header that claims more values than the bytes of its file can hold.

    Parameters
    ----------
    path : file
    claimed : number of values, each of all channels where they are interleaved
    value_bytes : fewest bytes of a value, before compression
    what : values of the message
    ratio : most bytes that a byte of the file stands for; 1 without compression

    Raises
    ------
    StorageError
        It does.
    """
    size = path.stat().st_size
    most = int(size * ratio / value_bytes)
    if claimed > most:
        raise StorageError(
            f"claims {claimed} {what}, its {size} bytes can hold {most} at most: the header is "
            "wrong or the file is truncated"
        )
