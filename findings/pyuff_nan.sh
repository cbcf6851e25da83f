#!/usr/bin/env bash
# pyuff writes NaN into a dataset 58 of text as 0: a sample that is missing becomes a measured one.
# Advice: check np.isfinite before writing
# Packages: pyuff==2.5.8
# Seen:
#   pyuff 2.5.8
#   written [nan, 0.5, 1.0, 1.5], read [0.0, 0.5, 1.0, 1.5]
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pyuff==2.5.8
cat > "$folder/seen.txt" <<'END'
pyuff 2.5.8
written [nan, 0.5, 1.0, 1.5], read [0.0, 0.5, 1.0, 1.5]
END
cd "$folder"
"$folder/venv/bin/python" -W ignore - > "$folder/now.txt" <<'END'
from importlib.metadata import version
import numpy as np
import pyuff

values = np.array([np.nan, 0.5, 1.0, 1.5])
fields = pyuff.prepare_58(
    binary=0, func_type=1, rsp_node=1, rsp_dir=1, ref_node=1, ref_dir=1, data=values,
    x=np.arange(4) / 10, id1="a", abscissa_spec_data_type=17, ordinate_spec_data_type=12,
    orddenom_spec_data_type=0, abscissa_spacing=1, abscissa_min=0.0, abscissa_inc=0.1,
    ord_data_type=4,
)
pyuff.UFF("a.uff").write_sets([fields], "add")
read = pyuff.UFF("a.uff").read_sets()["data"]
print("pyuff", version("pyuff"))
print(f"written {values.tolist()}, read {read.tolist()}")
END
cat "$folder/now.txt"
diff "$folder/seen.txt" "$folder/now.txt" > /dev/null || { echo "the behaviour has changed" >&2; exit 1; }
