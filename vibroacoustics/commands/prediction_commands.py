"""Commands for measurements without a model. Heavy imports wait until they are needed."""

from pathlib import Path
from typing import Annotated, Final

from .command import command
from .options import FileOut
from .outcome import Outcome

PREDICTION_NAME: Final = "prediction.nc"
BLOCKED_NAME: Final = "blocked_forces.nc"


@command("predict", "Measurements", "softer_mounts.toml")
def predict_command(
    file: Annotated[
        Path,
        "FILE: File, .toml, of measurements, mounts and changes.",
    ],
    out: FileOut = None,
) -> Outcome:
    """Predict a change of mounts, masses or absorbers from measurements alone, with a band."""
    from .. import report
    from ..measured.prediction import predict
    from ..report.charts.picture import picture
    from . import outputs

    folder = out or Path("reports") / file.stem
    outputs.check_folder(folder)
    predicted = predict(file)
    tables = {
        "prediction.csv": report.prediction_csv(predicted),
        "prediction.md": report.prediction_markdown(predicted),
    }
    pictures = map(picture, report.predicted_charts(predicted))
    written = outputs.write_analysis(predicted, folder, PREDICTION_NAME, tables, pictures)
    return Outcome(report.prediction_text(predicted), {"prediction": written})


@command("blocked-forces", "Measurements", "fan_in_situ.toml")
def blocked_forces_command(
    file: Annotated[Path, "FILE: File, .toml, of measurements and interface."],
    out: FileOut = None,
) -> Outcome:
    """Find the blocked forces of an installed source (ISO 20270), with on-board validation."""
    from .. import report
    from ..measured.blocked_forces import blocked_forces
    from ..measured.blocked_orders import blocked_orders_csv
    from ..report.charts.picture import picture
    from . import outputs

    folder = out or Path("reports") / file.stem
    outputs.check_folder(folder)
    blocked = blocked_forces(file)
    tables = {
        "blocked_forces.csv": report.blocked_csv(blocked),
        "validation.csv": report.validation_csv(blocked),
        "blocked_forces.md": report.blocked_markdown(blocked),
    }
    with outputs.naming(file):
        orders = blocked_orders_csv(blocked)
    if orders is not None:
        tables["orders.csv"] = orders
    pictures = map(picture, report.blocked_charts(blocked))
    written = outputs.write_analysis(blocked, folder, BLOCKED_NAME, tables, pictures)
    return Outcome(report.blocked_text(blocked), {"blocked forces": written})
