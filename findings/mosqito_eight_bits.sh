#!/usr/bin/env bash
# MOSQITO's load gives the bytes of a WAV file of 8 bits, 0 to 255, as pascals: silence (128) is 128 Pa.
# Advice: convert the file to 16 bits first
# Packages: mosqito==1.2.1 matplotlib==3.11.2 numpy==2.4.6 scipy==1.17.1
# Seen:
#   mosqito 1.2.1
#   silence of 8 bits: 128.0
#   silence of 16 bits: 0.0
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check mosqito==1.2.1 matplotlib==3.11.2 numpy==2.4.6 scipy==1.17.1
cat > "$folder/seen.txt" <<'END'
mosqito 1.2.1
silence of 8 bits: 128.0
silence of 16 bits: 0.0
END
cd "$folder"
"$folder/venv/bin/python" -W ignore - > "$folder/now.txt" <<'END'
import contextlib, io
from importlib.metadata import version
import numpy as np
from mosqito.utils import load
from scipy.io import wavfile

print("mosqito", version("mosqito"))
for bits, kind, silence in ((8, "uint8", 128), (16, "int16", 0)):
    wavfile.write("a.wav", 48000, np.full(480, silence, kind))
    with contextlib.redirect_stdout(io.StringIO()):
        signal, _ = load("a.wav")
    print(f"silence of {bits} bits: {float(signal[0]):.1f}")
END
cat "$folder/now.txt"
diff "$folder/seen.txt" "$folder/now.txt" > /dev/null || { echo "the behaviour has changed" >&2; exit 1; }
