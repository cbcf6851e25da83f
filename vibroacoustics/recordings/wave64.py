"""Chunks of a Sony Wave64 file, which libsndfile reads as far as they go."""

from typing import BinaryIO, Final

from ..base.errors import StorageError

_TAIL: Final = bytes.fromhex("f3acd3118cd100c04f8edb8a")
_RIFF: Final = b"riff" + bytes.fromhex("2e91cf11a5d628db04c10000")
_WAVE, _DATA = b"wave" + _TAIL, b"data" + _TAIL


def check_wave64(file: BinaryIO) -> None:
    """Refuse a file whose samples end before its header says so.

    Raises
    ------
    StorageError
        It is truncated, or no such file.
    """
    size = file.seek(0, 2)
    file.seek(0)
    head = file.read(40)
    if head[:16] != _RIFF or head[24:] != _WAVE:
        raise StorageError("is no Wave64 file: it does not begin with riff and wave")
    while len(chunk := file.read(24)) == 24:
        claimed, follow = int.from_bytes(chunk[16:], "little"), size - file.tell() + 24
        if not 24 <= claimed <= follow:
            name = chunk[:4].decode("latin-1")
            raise StorageError(
                f"chunk {name!r} claims {claimed} bytes, {follow} follow: the file is truncated "
                "or was never finished"
            )
        if chunk[:16] == _DATA:
            return
        file.seek(claimed - 24 + -claimed % 8, 1)
    raise StorageError("holds no samples: it has no data chunk")
