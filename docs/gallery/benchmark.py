"""
The open benchmark
==================

Ten cases with expected values and tolerances, and a scorer without dependencies. Here
``vibroacoustics benchmark`` answers them. How to score another program: :doc:`/benchmark`.
"""

import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt

folder = Path(tempfile.mkdtemp())
command = [sys.executable, "-m", "vibroacoustics", "benchmark", "--json"]
done = subprocess.run(
    [*command, "--out", str(folder / "submission.csv")], capture_output=True, text=True, check=True
)
files = json.loads(done.stdout)["files"]

# %%
# Scorer
# ------
# One file scores the submission of any program, here also one with a wrong sign.
with (folder / "submission.csv").open(encoding="utf-8", newline="") as file:
    answers = list(csv.DictReader(file))
wrong = [
    {**row, "value": row["value"] if row["case"] != "oldham_force" else str(-float(row["value"]))}
    for row in answers
]
(folder / "wrong.json").write_text(json.dumps(wrong), encoding="utf-8")
scorer = [sys.executable, files["scorer"]]
for name in ("submission.csv", "wrong.json"):
    scored = subprocess.run(
        [*scorer, str(folder / name)], capture_output=True, text=True, check=False
    )
    print(f"{name}, exit code {scored.returncode}", *scored.stdout.splitlines()[-11:], sep="\n")

# %%
# Errors of the answers
# ---------------------
# Largest error of each case as a share of its tolerance.
cases = sorted({row["case"] for row in answers})
shares = []
for case in cases:
    table = Path(files["scorer"]).parent / "cases" / case / "expected.csv"
    values = {row["key"]: float(row["value"]) for row in answers if row["case"] == case}
    with table.open(encoding="utf-8", newline="") as file:
        shares.append(
            max(
                abs(values[row["key"]] - float(row["value"])) / float(row["tolerance"])
                for row in csv.DictReader(file)
            )
        )
figure, axes = plt.subplots(layout="constrained")
axes.barh(cases, shares)
axes.set(xlabel="largest error / tolerance", xscale="log", xlim=(1e-7, 1.0))
axes.invert_yaxis()
