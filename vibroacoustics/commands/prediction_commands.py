"""Commands for measurements without a model. Heavy imports wait until they are needed."""

from math import isnan
from pathlib import Path
from typing import Annotated

from .command import command
from .options import FileOut, Printing
from .outcome import Outcome

Despite = Annotated[
    list[str] | None, "Fault of the measurements that is accepted; no bands are stated then."
]


@command("predict", "Measurements", "softer_mounts.toml")
def predict_command(
    file: Annotated[Path, "FILE: File, .toml, of measurements, mounts and changes."],
    out: FileOut = None,
    *,
    despite: Despite = None,
    printing: Printing,
) -> Outcome:
    """Predict a change of mounts, masses or absorbers from measurements alone, with a band."""
    from .. import report
    from ..measured.prediction import predict

    target = printing.target(out or Path("reports") / file.stem)
    predicted = predict(file, despite or ())
    return target.outcome(report.analysis_of_prediction(predicted), predicted, "prediction.nc")


@command("blocked-forces", "Measurements", "fan_in_situ.toml")
def blocked_forces_command(
    file: Annotated[Path, "FILE: File, .toml, of measurements and interface."],
    out: FileOut = None,
    *,
    despite: Despite = None,
    printing: Printing,
) -> Outcome:
    """Find the blocked forces of an installed source (ISO 20270), with on-board validation."""
    from .. import report
    from ..measured.blocked_forces import blocked_forces, blocked_orders_csv
    from . import outputs

    target = printing.target(out or Path("reports") / file.stem)
    blocked = blocked_forces(file, despite or ())
    with outputs.naming(file):
        orders = blocked_orders_csv(blocked)
    further = {} if orders is None else {"orders.csv": orders}
    analysis = report.analysis_of_blocked_forces(blocked, further)
    return target.outcome(analysis, blocked, "blocked_forces.nc")


@command("check-functions", "Measurements", "softer_mounts.toml")
def check_functions_command(
    file: Annotated[Path, "FILE: File, .toml, of `predict` or `blocked-forces`."],
) -> Outcome:
    """Test measured functions against physics; each fault names its point and what to do."""
    from ..measured.function_check import check_functions
    from ..results.claim_kinds import FUNCTIONS
    from ..results.conditional import Finding, condition_table, stated
    from .outcome import columns

    checked = check_functions(file)
    words = [
        f"{row['point']}: passivity {row['passivity']:.2f}, causality {row['causality']:.2f}, "
        f"reciprocity residual {row['reciprocity_residual']:.3f}"
        for row in checked.rows
    ]
    verdict = "no fault was found" if not checked.faults else f"faults: {len(checked.faults)}"
    tested = {
        name: Finding(", ".join(missing) or "every point", not missing)
        for name, column in (("passivity", "passivity"), ("reciprocity", "reciprocity_residual"))
        for missing in [[str(row["point"]) for row in checked.rows if isnan(float(row[column]))]]
    }
    claim = FUNCTIONS.claim(verdict, tested)
    text = "\n".join([*words, f"{file}: {stated(claim)}"])
    tables = {"points": columns(checked.rows), "functions_conditions": condition_table([claim])}
    return Outcome(text, tables=tables, broken=checked.faults)


@command("hammer", "Measurements", "hammer.toml")
def hammer_command(
    file: Annotated[Path, "FILE: File, .toml, of channels, points and records."],
    out: FileOut = None,
    *,
    printing: Printing,
) -> Outcome:
    """Find frequency responses from time records of hammer hits: H1, H2, coherence, faults."""
    from ..measured.hammer_test import hammer_test
    from .hammer_tables import analysis_of_hammer

    target = printing.target(out or Path("reports") / file.stem)
    results = hammer_test(file)
    return target.outcome(analysis_of_hammer(results), broken=results.faults)
