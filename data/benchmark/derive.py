"""Write the expected values of all cases again, from closed forms, printed values, second methods.

    python derive.py

Needs Python 3.11 or later and nothing else: a reader can follow every expected value. Each function
in `derivations` takes the folder of a case and gives its rows. `changed_mounts`
has its inputs.csv written, too.
"""

import csv
from collections.abc import Callable, Iterator
from pathlib import Path

from derivations import bench, gas, mechanics, printed, room, sound
from derivations.rows import CASES, Row

DERIVATIONS: dict[str, Callable[[Path], Iterator[Row]]] = {
    "changed_mounts": bench.changed_mounts,
    "counterweight_optimum": mechanics.counterweight_optimum,
    "exact_room": room.exact_room,
    "minicrank_torque": mechanics.minicrank_torque,
    "oldham_force": mechanics.oldham_force,
    "point_and_ring_sources": sound.point_and_ring_sources,
    "scroll_gas": gas.scroll_gas,
    "slider_link_invariants": mechanics.slider_link_invariants,
    "sound_power_example": printed.sound_power_example,
    "tone_audibility": printed.tone_audibility,
}


def main() -> None:
    """Write expected.csv of every case."""
    for name, derivation in DERIVATIONS.items():
        folder = CASES / name
        rows = list(derivation(folder))
        with (folder / "expected.csv").open("w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(Row._fields)
            for row in rows:
                numbers = (f"{row.value:.9g}", f"{row.tolerance:.2g}")
                writer.writerow([row.key, row.unit, *numbers, row.derivation])
        print(f"{name}: {len(rows)} values")


if __name__ == "__main__":
    main()
