"""Manifest `files.json`: files of a folder by the results that they belong to.

It holds the hash of every dataset of the folder and of each file made of it. So what is left of an
older run is seen.
"""

from collections.abc import Container, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Annotated, Final

from pydantic import AfterValidator, BaseModel, TypeAdapter

from ..base.errors import StorageError
from ..base.folder import Folder, leads_out, opened_folder
from ..base.plain_bytes import file_sha256
from . import hashed
from .files import LOCK_NAME, Staging, only_writer, replace_all, write
from .interruption import uninterrupted
from .lock import is_held

MANIFEST_NAME: Final = "files.json"
_MAXIMUM_BYTES: Final = 10_000_000


def _below(name: str) -> str:
    if leads_out(name):
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
"""Manifest by the name of the dataset."""
_MANIFEST: Final = TypeAdapter(Manifest)


@contextmanager
def replacing(path: Path, dataset: str, dataset_sha256: str = "") -> Iterator[Staging]:
    """A hidden folder to write a dataset and its files to; in the end they go to `path`.

    They replace those of an older run together; of what that run wrote besides, the files that
    nobody has changed are removed.

    Parameters
    ----------
    path : folder where everything goes
    dataset : name of the dataset
    dataset_sha256 : its hash, where it is not written along
    """
    with only_writer(path) as staged:
        yield staged
        folder = staged.target
        made = {name: _hash(staged, name) for name in staged.files() if name != dataset}
        digest = dataset_sha256 or hashed.stored_hash(staged.path / dataset, staged)
        before = _read(folder) or {}
        beside = staged.holds_file(dataset) or folder.holds_file(dataset)
        older = _older(before.get(dataset), made)
        entry = Entry(sha256=str(digest), beside=beside, files=made, older=older)
        after = dict(sorted({**_without(before, made), dataset: entry}.items()))
        write(staged, MANIFEST_NAME, _MANIFEST.dump_json(after, indent=1) + b"\n")
        with uninterrupted():
            replace_all(staged, first=MANIFEST_NAME)  # killed from here on: it is seen
            for name, digest in older.items():
                if _hash(folder, name) == digest:
                    _remove(folder, name)


def _older(before: Entry | None, made: Container[str]) -> dict[str, str]:
    """Files that are no longer made, those too that a run that was killed did not remove."""
    digests = {**before.older, **before.files} if before else {}
    return {name: digest for name, digest in digests.items() if name not in made}


def _remove(folder: Folder, name: str) -> None:
    with suppress(OSError, StorageError):
        folder.remove(name)


def _without(manifest: Manifest, names: Container[str]) -> Manifest:
    """Entries of other files: a file is of the results that wrote it last."""
    return {
        dataset: Entry(
            sha256=entry.sha256,
            beside=entry.beside,
            files={n: h for n, h in entry.files.items() if n not in names},
            older={n: h for n, h in entry.older.items() if n not in names},
        )
        for dataset, entry in manifest.items()
    }


def mixed(path: Path) -> list[str]:
    """Name the files in a folder that are not of its results, a line each.

    Nothing while a process writes there, or where no `files.json` is.
    """
    with ExitStack() as stack:
        try:
            folder = stack.enter_context(opened_folder(path))
        except OSError:
            return []
        if is_held(folder, LOCK_NAME):
            return []
        manifest = _read(folder)
        if manifest is None:
            return [f"{path / MANIFEST_NAME}: is damaged"]
        return [line for dataset in manifest for line in _mixed(folder, dataset, manifest[dataset])]


def listed(path: Path) -> set[str]:
    """Names of all files that `files.json` lists, its datasets too."""
    try:
        with opened_folder(path) as folder:
            manifest = _read(folder) or {}
    except OSError:
        return set()
    return {*manifest, *(name for entry in manifest.values() for name in entry.files)}


def together(path: Path, name: str) -> set[str]:
    """Names of a dataset and the files made of it, where `files.json` lists one of them."""
    try:
        with opened_folder(path) as folder:
            manifest = _read(folder) or {}
    except OSError:
        return set()
    for dataset, entry in manifest.items():
        if name == dataset or name in entry.files:
            return {*entry.files, *([dataset] if entry.beside else [])}
    return set()


def _mixed(folder: Folder, dataset: str, entry: Entry) -> Iterator[str]:
    path = folder.path / dataset
    is_there = folder.holds_file(dataset)
    if is_there and hashed.stored_hash(path, folder) != entry.sha256:
        yield f"{path}: is not what the files beside it were made of"
    elif entry.beside and not is_there:
        yield f"{path}: is missing"
    for name, digest in entry.files.items():
        if _hash(folder, name) != digest:
            state = f"is not that of {dataset}" if folder.holds_file(name) else "is missing"
            yield f"{folder.path / name}: {state}"
    for name, digest in entry.older.items():
        if _hash(folder, name) == digest:
            yield f"{folder.path / name}: is of older results than {dataset}"


def _hash(folder: Folder, name: str) -> str:
    """Hash of a regular file; empty where there is none."""
    try:
        with folder.opened(name, hashed.MAXIMUM_RESULTS_BYTES) as file:
            return file_sha256(file)
    except (OSError, StorageError):
        return ""


def _read(folder: Folder) -> Manifest | None:
    """Content of `files.json`; nothing where there is none, None where it is damaged."""
    try:
        return _MANIFEST.validate_json(folder.read_bytes(MANIFEST_NAME, _MAXIMUM_BYTES))
    except FileNotFoundError:
        return {}
    except (OSError, StorageError, ValueError):
        return None
