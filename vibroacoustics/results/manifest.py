"""Which files of a folder belong to which results: `files.json`.

It holds the hash of every dataset of the folder and of each file made of it. So what is left of an
older run is seen.
"""

from collections.abc import Container, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path, PurePosixPath
from typing import Annotated, Final

from pydantic import AfterValidator, BaseModel, TypeAdapter

from ..base.hashing import sha256
from . import hashed
from .files import LOCK_NAME, files_in, only_writer, replace_all, write
from .interruption import uninterrupted
from .lock import is_held

MANIFEST_NAME: Final = "files.json"
_MAXIMUM_BYTES: Final = 10_000_000


def _below(name: str) -> str:
    path = PurePosixPath(name)
    if path.is_absolute() or ".." in path.parts or "\0" in name:
        raise ValueError("leads out of the folder")
    return name


Name = Annotated[str, AfterValidator(_below)]


class Entry(BaseModel):
    """A dataset and what was made of it.

    Attributes
    ----------
    sha256 : hash of the dataset
    beside : whether it lies in the folder
    files : hash of each file made of it
    older : hash of each file that older ones left, which goes once the new ones are there
    """

    sha256: str
    beside: bool
    files: dict[Name, str]
    older: dict[Name, str] = {}


Manifest = dict[Name, Entry]
"""By the name of the dataset."""
_MANIFEST: Final = TypeAdapter(Manifest)


@contextmanager
def replacing(folder: Path, dataset: str, dataset_sha256: str = "") -> Iterator[Path]:
    """A hidden folder to write a dataset and its files to; in the end they go to `folder`.

    They replace those of an older run together; of what that run wrote besides, the files that
    nobody has changed are removed.

    Parameters
    ----------
    folder : where everything goes
    dataset : name of the dataset
    dataset_sha256 : its hash, where it is not written along

    Raises
    ------
    StorageError
        The folder cannot be written; what was there before then stays.
    """
    with only_writer(folder) as staged:
        yield staged
        made = {name: _hash(staged / name) for name in files_in(staged) if name != dataset}
        digest = dataset_sha256 or hashed.stored_hash(staged / dataset)
        before = _read(folder) or {}
        beside = any((at / dataset).is_file() for at in (staged, folder))
        older = _older(before.get(dataset), made)
        entry = Entry(sha256=str(digest), beside=beside, files=made, older=older)
        after = dict(sorted({**_without(before, made), dataset: entry}.items()))
        write(staged / MANIFEST_NAME, _MANIFEST.dump_json(after, indent=1) + b"\n")
        with uninterrupted():
            replace_all(staged, folder, first=MANIFEST_NAME)  # killed from here on: it is seen
            if not dataset_sha256:
                _remove(hashed.hash_path(folder / dataset))  # earlier versions'
            for name, digest in older.items():
                if _hash(folder / name) == digest:
                    _remove(folder / name)


def _older(before: Entry | None, made: Container[str]) -> dict[str, str]:
    """Files that are no longer made, those too that a run that was killed did not remove."""
    known = {**before.older, **before.files} if before else {}
    return {name: digest for name, digest in known.items() if name not in made}


def _remove(path: Path) -> None:
    with suppress(OSError):
        path.unlink(missing_ok=True)


def _without(manifest: Manifest, names: Container[str]) -> Manifest:
    """What it says of other files: a file is of the results that wrote it last."""
    return {
        dataset: Entry(
            sha256=entry.sha256,
            beside=entry.beside,
            files={n: h for n, h in entry.files.items() if n not in names},
            older={n: h for n, h in entry.older.items() if n not in names},
        )
        for dataset, entry in manifest.items()
    }


def mixed(folder: Path) -> list[str]:
    """What in a folder is not of the results that it should be of, a line each.

    Nothing while a process writes there, or where no `files.json` is.
    """
    if is_held(folder / LOCK_NAME):
        return []
    manifest = _read(folder)
    if manifest is None:
        return [f"{folder / MANIFEST_NAME}: is damaged"]
    return [line for dataset in manifest for line in _mixed(folder, dataset, manifest[dataset])]


def listed(folder: Path) -> set[str]:
    """Names of all files that `files.json` lists, its datasets too."""
    manifest = _read(folder) or {}
    return {*manifest, *(name for entry in manifest.values() for name in entry.files)}


def _mixed(folder: Path, dataset: str, entry: Entry) -> Iterator[str]:
    path = folder / dataset
    if path.is_file() and hashed.stored_hash(path) != entry.sha256:
        yield f"{path}: is not what the files beside it were made of"
    elif entry.beside and not path.is_file():
        yield f"{path}: is missing"
    for name, digest in entry.files.items():
        if (there := _hash(folder / name)) != digest:
            state = f"is not that of {dataset}" if there else "is missing"
            yield f"{folder / name}: {state}"
    for name, digest in entry.older.items():
        if _hash(folder / name) == digest:
            yield f"{folder / name}: is of older results than {dataset}"


def _hash(path: Path) -> str:
    """Hash of a regular file; empty where there is none."""
    return sha256(path.read_bytes()) if path.is_file() else ""


def _read(folder: Path) -> Manifest | None:
    """What `files.json` says; nothing where there is none, None where it is damaged."""
    path = folder / MANIFEST_NAME
    if not path.exists():
        return {}
    try:
        if not path.is_file() or path.stat().st_size > _MAXIMUM_BYTES:
            return None
        return _MANIFEST.validate_json(path.read_bytes())
    except (OSError, ValueError):
        return None
