#!/usr/bin/env bash
# asammdf's cut adds an interpolated sample at the begin and at the end of the part: it is not at the sampling interval, so even times become uneven.
# Advice: cut at the times of samples, or by arrays
# Packages: asammdf==8.8.28
# Seen:
#   asammdf 8.8.28
#   file: times [0.0, 0.1, 0.2, 0.3, 0.4, 0.5]
#   cut: times [0.12, 0.2, 0.3, 0.33], samples [12.0, 20.0, 30.0, 33.0]
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check asammdf==8.8.28
cat > "$folder/seen.txt" <<'END'
asammdf 8.8.28
file: times [0.0, 0.1, 0.2, 0.3, 0.4, 0.5]
cut: times [0.12, 0.2, 0.3, 0.33], samples [12.0, 20.0, 30.0, 33.0]
END
cd "$folder"
"$folder/venv/bin/python" -W ignore - > "$folder/now.txt" <<'END'
from importlib.metadata import version
import numpy as np
from asammdf import MDF, Signal

time = np.arange(6) / 10
file = MDF(version="4.10")
file.append([Signal(100 * time, time, name="a", unit="Pa")])
cut = file.cut(start=0.12, stop=0.33).get("a")
print("asammdf", version("asammdf"))
print(f"file: times {time.round(6).tolist()}")
print(f"cut: times {cut.timestamps.round(6).tolist()}, samples {cut.samples.round(6).tolist()}")
END
cat "$folder/now.txt"
diff "$folder/seen.txt" "$folder/now.txt" > /dev/null || { echo "the behaviour has changed" >&2; exit 1; }
