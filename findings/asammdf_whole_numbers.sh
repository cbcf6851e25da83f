#!/usr/bin/env bash
# asammdf's resample interpolates floats and holds whole numbers: the same speed ramp is a line or a staircase by the type of its numbers.
# Advice: convert to floats, or MDF.configure(integer_interpolation=1)
# Packages: asammdf==8.8.28
# Seen:
#   asammdf 8.8.28
#   int16: [0, 0, 10, 10, 20]
#   float64: [0.0, 5.0, 10.0, 15.0, 20.0]
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check asammdf==8.8.28
cat > "$folder/seen.txt" <<'END'
asammdf 8.8.28
int16: [0, 0, 10, 10, 20]
float64: [0.0, 5.0, 10.0, 15.0, 20.0]
END
cd "$folder"
"$folder/venv/bin/python" -W ignore - > "$folder/now.txt" <<'END'
from importlib.metadata import version
import numpy as np
from asammdf import MDF, Signal

print("asammdf", version("asammdf"))
for kind in ("int16", "float64"):
    file = MDF(version="4.10")
    ramp = np.array([0, 10, 20], dtype=kind)
    file.append([Signal(ramp, np.array([0.0, 1.0, 2.0]), name="speed", unit="rpm")])
    print(f"{kind}: {file.resample(0.5).get('speed').samples.tolist()}")
END
cat "$folder/now.txt"
diff "$folder/seen.txt" "$folder/now.txt" > /dev/null || { echo "the behaviour has changed" >&2; exit 1; }
