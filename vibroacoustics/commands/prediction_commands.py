"""Commands for what measurements alone tell. Heavy imports wait until it is needed."""

from pathlib import Path
from typing import Annotated, Final

import typer

from .options import FileOut

PREDICTION_NAME: Final = "prediction.nc"
BLOCKED_NAME: Final = "blocked_forces.nc"

commands = typer.Typer()


@commands.command("predict")
def predict_command(
    file: Annotated[
        Path, typer.Argument(metavar="FILE.toml", help="Measured files, mounts and changes.")
    ],
    out: FileOut = None,
) -> None:
    """Predict a change of mounts, masses or absorbers from measurements alone, with a band."""
    from .. import report
    from ..measured.prediction import predict
    from . import outputs

    folder = out or Path("reports") / file.stem
    outputs.check_folder(folder)
    predicted = predict(file)
    tables = {
        "prediction.csv": report.prediction_csv(predicted),
        "prediction.md": report.prediction_markdown(predicted),
    }
    written = outputs.write_analysis(
        predicted, folder, PREDICTION_NAME, tables, report.predicted_figures
    )
    typer.echo(report.prediction_text(predicted))
    typer.echo(f"prediction: {written}")


@commands.command("blocked-forces")
def blocked_forces_command(
    file: Annotated[
        Path, typer.Argument(metavar="FILE.toml", help="Measured files and the interface.")
    ],
    out: FileOut = None,
) -> None:
    """Find a source's blocked forces (ISO 20270) where it stands, validated on board."""
    from .. import report
    from ..measured.blocked_forces import blocked_forces
    from ..measured.blocked_orders import blocked_orders_csv
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
    written = outputs.write_analysis(blocked, folder, BLOCKED_NAME, tables, report.blocked_figures)
    typer.echo(report.blocked_text(blocked))
    typer.echo(f"blocked forces: {written}")
