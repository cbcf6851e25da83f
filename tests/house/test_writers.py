"""Files are written by `base/folder` alone, processes are started by `base/process_start` alone."""

import re

from support import ROOT

WRITES = re.compile(
    r"\.(write_bytes|write_text|mkdir|unlink|rmdir|touch|symlink_to|hardlink_to)\("
    r"|\bos\.(replace|rename|remove|open|truncate|mkdir|makedirs|utime)\("
    r"|\b(rmtree|mkdtemp|NamedTemporaryFile|to_netcdf|copyfile|savetxt)\("
    r"|\bopen\([^)]*[\"']([wax]|rb?\+)"
)
ALLOWED = {
    "base/folder.py": "the opener",
    "base/regular_file.py": "opens for reading",
    "commands/messages.py": "appends with the opener",
    "commands/printing.py": "a browser writes to a temporary folder of its own",
    "results/cache.py": "time of the last use, of a file with one link",
    "results/files.py": "makes and moves by descriptor",
    "results/lock.py": "length of a lock that is open",
    "results/netcdf.py": "netCDF opens by name, below a descriptor",
    "results/storage.py": "appends the hash with the opener",
}

STARTS = re.compile(
    r"\bsubprocess\.\w|\bimport subprocess|\bPopen\b|[Pp]rocess\w*\.start\("
    r"|\bos\.(system|popen|fork|forkpty|exec\w+|spawn\w+|posix_spawn\w*)\("
    r"|\bProcessPoolExecutor|\bcreate_subprocess|\bpty\.(spawn|fork)"
)


def files_with(pattern: re.Pattern[str]) -> set[str]:
    """Files of the package that have the pattern in a line that is no example."""
    package = ROOT / "vibroacoustics"
    return {
        str(path.relative_to(package))
        for path in package.rglob("*.py")
        if any(
            pattern.search(line) and not line.lstrip().startswith(">>>")
            for line in path.read_text(encoding="utf-8").splitlines()
        )
    }


def test_every_writer_is_known():
    assert files_with(WRITES) == set(ALLOWED)


def test_one_file_starts_processes():
    assert files_with(STARTS) == {"base/process_start.py"}
