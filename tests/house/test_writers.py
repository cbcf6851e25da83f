"""Files are written through `base/folder`: other code opens, makes and removes none by its path."""

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


def test_every_writer_is_known():
    package = ROOT / "vibroacoustics"
    writers = {
        str(path.relative_to(package))
        for path in package.rglob("*.py")
        if any(
            WRITES.search(line) and not line.lstrip().startswith(">>>")
            for line in path.read_text(encoding="utf-8").splitlines()
        )
    }
    assert writers == set(ALLOWED)
