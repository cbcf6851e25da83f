#!/usr/bin/env bash
# asammdf's append puts signals of different times on the union of their times: each gets samples that were never measured, also before its first one and after its last.
# Advice: append each signal in a call of its own
# Packages: asammdf==8.8.28
# Seen:
#   asammdf 8.8.28
#   together: times [0.0, 0.3, 1.0, 1.3, 2.0, 2.3], b [0.0, 0.0, 14.0, 20.0, 34.0, 40.0]
#   one by one: times [0.3, 1.3, 2.3], b [0.0, 20.0, 40.0]
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check asammdf==8.8.28
cat > "$folder/seen.txt" <<'END'
asammdf 8.8.28
together: times [0.0, 0.3, 1.0, 1.3, 2.0, 2.3], b [0.0, 0.0, 14.0, 20.0, 34.0, 40.0]
one by one: times [0.3, 1.3, 2.3], b [0.0, 20.0, 40.0]
END
cd "$folder"
"$folder/venv/bin/python" -W ignore - > "$folder/now.txt" <<'END'
from importlib.metadata import version
import numpy as np
from asammdf import MDF, Signal

time = np.arange(3.0)
a = Signal(10 * np.arange(3.0), time, name="a", unit="Pa")
b = Signal(20 * np.arange(3.0), time + 0.3, name="b", unit="Pa")
print("asammdf", version("asammdf"))
for name, calls in (("together", [[a, b]]), ("one by one", [[a], [b]])):
    file = MDF(version="4.10")
    for signals in calls:
        file.append(signals)
    file.save("a.mf4", overwrite=True)
    read = MDF("a.mf4").get("b")
    times, samples = np.round(read.timestamps, 6).tolist(), np.round(read.samples, 6).tolist()
    print(f"{name}: times {times}, b {samples}")
END
cat "$folder/now.txt"
diff "$folder/seen.txt" "$folder/now.txt" > /dev/null || { echo "the behaviour has changed" >&2; exit 1; }
