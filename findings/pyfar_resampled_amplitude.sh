#!/usr/bin/env bash
# pyfar's resample changes the amplitude of a sine by the ratio of the sample rates, unless the signal has another fft_norm than its default: it keeps the spectrum, not the signal.
# Advice: give match_amplitude='time'
# Packages: pyfar==0.8.1 numpy==2.4.6
# Seen:
#   pyfar 0.8.1
#   default: 0.919
#   match_amplitude time: 1.001
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pyfar==0.8.1 numpy==2.4.6
cat > "$folder/seen.txt" <<'END'
pyfar 0.8.1
default: 0.919
match_amplitude time: 1.001
END
cd "$folder"
"$folder/venv/bin/python" -W ignore - > "$folder/now.txt" <<'END'
from importlib.metadata import version
import numpy as np
import pyfar

sine = pyfar.Signal(np.sin(2 * np.pi * 1000 * np.arange(44100) / 44100), 44100)
print("pyfar", version("pyfar"))
for name, how in (("default", {}), ("match_amplitude time", {"match_amplitude": "time"})):
    middle = pyfar.dsp.resample(sine, 48000, **how).time[0, 12000:36000]
    print(f"{name}: {np.sqrt(2 * np.mean(middle**2)):.3f}")
END
cat "$folder/now.txt"
diff "$folder/seen.txt" "$folder/now.txt" > /dev/null || { echo "the behaviour has changed" >&2; exit 1; }
