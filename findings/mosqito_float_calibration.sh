#!/usr/bin/env bash
# MOSQITO's load applies wav_calib to a WAV file of 16 bits and of 64-bit floats, and ignores it for 32-bit floats.
# Advice: multiply the signal yourself, and give no wav_calib
# Packages: mosqito==1.2.1 matplotlib==3.11.2 numpy==2.4.6 scipy==1.17.1
# Seen:
#   mosqito 1.2.1
#   int16, wav_calib 2: 1.0
#   float32, wav_calib 2: 0.5
#   float64, wav_calib 2: 1.0
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check mosqito==1.2.1 matplotlib==3.11.2 numpy==2.4.6 scipy==1.17.1
cat > "$folder/seen.txt" <<'END'
mosqito 1.2.1
int16, wav_calib 2: 1.0
float32, wav_calib 2: 0.5
float64, wav_calib 2: 1.0
END
cd "$folder"
"$folder/venv/bin/python" -W ignore - > "$folder/now.txt" <<'END'
import contextlib, io
from importlib.metadata import version
import numpy as np
from mosqito.utils import load
from scipy.io import wavfile

print("mosqito", version("mosqito"))
for kind, half in (("int16", 2**14), ("float32", 0.5), ("float64", 0.5)):
    wavfile.write("a.wav", 48000, np.full(480, half, kind))
    with contextlib.redirect_stdout(io.StringIO()):
        signal, _ = load("a.wav", wav_calib=2.0)
    print(f"{kind}, wav_calib 2: {float(signal[0]):.1f}")
END
cat "$folder/now.txt"
diff "$folder/seen.txt" "$folder/now.txt" > /dev/null || { echo "the behaviour has changed" >&2; exit 1; }
