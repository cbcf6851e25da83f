"""Command for changes predicted from measurements alone. Heavy imports wait until it is needed."""

from pathlib import Path
from typing import Annotated, Final

import typer

PREDICTION_NAME: Final = "prediction.nc"

commands = typer.Typer()


@commands.command("predict")
def predict_command(
    file: Annotated[
        Path, typer.Argument(metavar="FILE.toml", help="Measured files, mounts and changes.")
    ],
    out: Annotated[
        Path | None,
        typer.Option("--out", help="Folder of the results; default: reports/NAME OF THE FILE."),
    ] = None,
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
