"""Follow `docs/tutorial.md` in an empty folder and hold its shown lines against the real ones.

A `console` block has commands after `$` and lines that they print; `…` omits lines. A block with a
caption changes the file of that name: TOML replaces values and adds tables, text is the file.
`--write` puts the numbers of the real lines into the shown ones, `--figures` takes the pictures.
"""

import os
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image

PAGE = Path(__file__).resolve().parents[2] / "docs" / "tutorial.md"
CONSOLE = r"^```console\n(?P<console>.*?)^```$"
FILE = r"^```\{code-block\} (?P<kind>\w+)\n:caption: (?P<file>\S+)\n\n(?P<text>.*?)^```$"
BLOCK = re.compile(f"{CONSOLE}|{FILE}", re.MULTILINE | re.DOTALL)
FIGURES = {
    "tutorial_first_screen.png": "scroll/reports/study/report.html",
    "tutorial_compared.png": "scroll/reports/bench/compared.html",
}
"""Pictures of the page, by the reports of which they are the first screens."""
NUMBER = re.compile(r"\d+(?:\.\d+)?")
RELATIVE, LAST_DIGITS = 0.02, 1.0
"""Difference that another processor and other versions of libraries make in shown numbers."""


def follow(page: str, folder: Path) -> tuple[list[str], str]:
    """Return the differences between shown and real lines, and the page with the real ones."""
    differences: list[str] = []
    place = folder

    def step(block: re.Match[str]) -> str:
        nonlocal place
        if block["file"]:
            change_file(place / block["file"], block["kind"], block["text"])
            return block[0]
        lines = []
        for command, shown in commands(block["console"]):
            lines.append(f"$ {command}")
            parts = shlex.split(command)
            if parts[0] == "cd":
                place = (place / parts[1]).resolve()
                continue
            printed = run(parts, place)
            differences.extend(f"{command}: {line}" for line in missing(shown, printed))
            lines += refreshed(shown, printed)
        return "```console\n" + "\n".join(lines) + "\n```"

    real = BLOCK.sub(step, page)
    return differences, real


def commands(console: str) -> list[tuple[str, list[str]]]:
    """Return each command of a block with the lines shown below it."""
    parts = re.split(r"(?m)^\$ ", console)[1:]
    return [(part.splitlines()[0], part.splitlines()[1:]) for part in parts]


def run(parts: list[str], folder: Path) -> list[str]:
    """Return the lines that a command prints, warnings first and progress left out."""
    module = [sys.executable, "-m", "vibroacoustics", *parts[1:]]
    done = subprocess.run(module, cwd=folder, capture_output=True, text=True, check=False,
                          env={**os.environ, "COLUMNS": "120"}, timeout=170)  # fmt: skip
    lines = (done.stderr + done.stdout).splitlines()
    return [line.rstrip() for line in lines if not line.startswith("progress: ")]


def change_file(file: Path, kind: str, text: str) -> None:
    """Put values and tables of a TOML text into a file; write any other text as the file."""
    if kind != "toml":
        file.write_text(text, encoding="utf-8")
        return
    content = file.read_text(encoding="utf-8")
    head, *tables = re.split(r"(?m)^(?=\[)", text)
    for table in [head, *tables]:
        name = table.splitlines()[0] if table.startswith("[") else ""
        if name and f"\n{name}\n" not in content:
            content += "\n" + table
            continue
        start = content.index(f"\n{name}\n") + len(name) + 1 if name else 0
        end = re.search(r"(?m)^\[", content[start:])
        stop = start + end.start() if end else len(content)
        part = content[start:stop]
        for line in table.splitlines():
            key = line.split(" = ")[0]
            if " = " not in line:
                continue
            part, count = re.subn(rf"(?m)^{key} = .*$", line.replace("\\", r"\\"), part)
            part = part if count else f"{part.rstrip()}\n{line}\n\n"
        content = content[:start] + part + content[stop:]
    file.write_text(content, encoding="utf-8")


def missing(shown: list[str], printed: list[str]) -> list[str]:
    """Return the shown lines that are not printed in this order, with close numbers."""
    absent, position = [], 0
    for line in shown:
        if line in {"…", ""}:
            continue
        found = (i for i in range(position, len(printed)) if alike(line, printed[i]))
        match = next(found, None)
        if match is None:
            absent.append(line)
        else:
            position = match + 1
    return absent


def refreshed(shown: list[str], printed: list[str]) -> list[str]:
    """Return shown lines with the numbers of printed lines that have the same words."""
    lines, position = [], 0
    for line in shown:
        same = (i for i in range(position, len(printed)) if words(line) == words(printed[i]))
        match = next(same, None)
        lines.append(line if match is None else printed[match])
        position = position if match is None else match + 1
    return lines


def words(line: str) -> list[str]:
    """Return the words of a line with all numbers equal, and rules of a table of one length."""
    return re.sub(r"-{3,}", "---", NUMBER.sub("0", line)).split()


def alike(shown: str, printed: str) -> bool:
    """Return whether two lines have the same words, and numbers that are close."""
    if words(shown) != words(printed):
        return False
    pairs = zip(NUMBER.findall(shown), NUMBER.findall(printed), strict=True)
    return all(close(first, second) for first, second in pairs)


def close(shown: str, printed: str) -> bool:
    """Return whether two numbers differ by one in the last digit or by 2 % at most."""
    digit = 10.0 ** -len(shown.partition(".")[2])
    allowed = max(LAST_DIGITS * digit, RELATIVE * float(shown))
    return abs(float(shown) - float(printed)) <= allowed * (1.0 + 1e-9)


def take(folder: Path) -> None:
    """Take the pictures of the reports in a folder, with Chromium."""
    for name, report in FIGURES.items():
        picture = PAGE.parent / "figures" / name
        subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu",
                        "--hide-scrollbars", "--window-size=1280,960", f"--screenshot={picture}",
                        (folder / report).as_uri()], check=True, timeout=170)  # fmt: skip
        Image.open(picture).quantize(64).save(picture, optimize=True)


def main() -> None:
    """Follow the page; print the differences, write the real lines or take the pictures."""
    page = PAGE.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder:
        differences, real = follow(page, Path(folder))
        if "--figures" in sys.argv:
            take(Path(folder))
    print("\n".join(differences))
    if "--write" in sys.argv:
        PAGE.write_text(real, encoding="utf-8")


if __name__ == "__main__":
    main()
