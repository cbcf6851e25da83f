#!/usr/bin/env bash
# npTDMS writes an array of big-endian numbers byte by byte into a file whose header says little-endian.
# Advice: convert first: values.astype(values.dtype.newbyteorder('='))
# Packages: npTDMS==1.13.0 numpy==2.4.6
# Seen:
#   nptdms 1.13.0
#   written [0, 1, 2, 3], read [0, 256, 512, 768]
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check npTDMS==1.13.0 numpy==2.4.6
cat > "$folder/seen.txt" <<'END'
nptdms 1.13.0
written [0, 1, 2, 3], read [0, 256, 512, 768]
END
cd "$folder"
"$folder/venv/bin/python" -W ignore - > "$folder/now.txt" <<'END'
from importlib.metadata import version
import numpy as np
from nptdms import ChannelObject, TdmsFile, TdmsWriter

values = np.arange(4).astype(">i2")
with TdmsWriter("a.tdms") as writer:
    writer.write_segment([ChannelObject("group", "channel", values)])
read = TdmsFile.read("a.tdms")["group"]["channel"][:]
print("nptdms", version("nptdms"))
print(f"written {values.tolist()}, read {read.tolist()}")
END
cat "$folder/now.txt"
diff "$folder/seen.txt" "$folder/now.txt" > /dev/null || { echo "the behaviour has changed" >&2; exit 1; }
