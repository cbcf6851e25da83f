#!/usr/bin/env bash
# pyuff refuses a dataset 58 of double precision whose last line of values is filled with blanks to 80 columns, as fixed-format records are; in single precision it reads it.
# Advice: strip the blanks at the ends of the lines
# Packages: pyuff==2.5.8
# Seen:
#   pyuff 2.5.8
#   single precision: [1.5, -2.5, 3.5, -4.5, 5.5]
#   double precision: Error when reading data-set(s).
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pyuff==2.5.8
cat > "$folder/seen.txt" <<'END'
pyuff 2.5.8
single precision: [1.5, -2.5, 3.5, -4.5, 5.5]
double precision: Error when reading data-set(s).
END
cd "$folder"
"$folder/venv/bin/python" -W ignore - > "$folder/now.txt" <<'END'
import contextlib, io
from importlib.metadata import version
import pyuff

values = [1.5, -2.5, 3.5, -4.5, 5.5]


def dataset(kind, form, per_line):
    none = f"{0:10d}{0:5d}{0:5d}{0:5d} {'NONE':20} {'NONE':20}"
    node = f" {'NONE':10}{1:10d}{3:4d}"
    lines = [
        "    -1", "    58", "a", "NONE", "NONE", "NONE", "NONE",
        f"{1:5d}{1:10d}{1:5d}{0:10d}{node}{node}",
        f"{kind:10d}{len(values):10d}{1:10d}{0.0:13.5e}{0.001:13.5e}{0.0:13.5e}",
        f"{17:10d}{0:5d}{0:5d}{0:5d} {'Time':20} {'s':20}",
        f"{12:10d}{0:5d}{0:5d}{0:5d} {'Acceleration':20} {'m/s^2':20}", none, none,
    ]
    texts = [form.format(value) for value in values]
    lines += ["".join(texts[n : n + per_line]) for n in range(0, len(texts), per_line)]
    return "".join(line.ljust(80) + "\n" for line in [*lines, "    -1"])


print("pyuff", version("pyuff"))
for name, *form in (("single", 2, "{:13.5e}", 6), ("double", 4, "{:20.12e}", 4)):
    with open("a.uff", "w") as file:
        file.write(dataset(*form))
    try:
        with contextlib.redirect_stderr(io.StringIO()):
            outcome = pyuff.UFF("a.uff").read_sets()["data"].tolist()
    except Exception as error:
        outcome = error
    print(f"{name} precision: {outcome}")
END
cat "$folder/now.txt"
diff "$folder/seen.txt" "$folder/now.txt" > /dev/null || { echo "the behaviour has changed" >&2; exit 1; }
