"""Command for comparisons. Heavy imports wait until it is needed."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer

from .options import Paper, Pdf, out_option

if TYPE_CHECKING:
    import xarray as xr

    from ..results.figure_limits import CheckedFigure, Compared

BROKEN: Final = 1
"""Exit code where a limit is broken."""

commands = typer.Typer()


@commands.command("compare")
def compare_command(
    first: Annotated[Path, typer.Argument(metavar="A.nc", help="Results of `run` or `orders`.")],
    others: Annotated[
        list[Path],
        typer.Argument(
            metavar="B.nc...", help="Results to compare with; several of `orders` are averaged."
        ),
    ],
    pair: Annotated[
        list[str] | None,
        typer.Option(metavar="CHANNEL_OF_A=CHANNEL_OF_B", help="Default: channels of one name."),
    ] = None,
    option: Annotated[str, typer.Option(help="Balancing option of a study.")] = "none",
    other_option: Annotated[
        str | None, typer.Option(help="Balancing option of B; default: that of A.")
    ] = None,
    specimens: Annotated[
        str | None,
        typer.Option(help="Specimen of each B, with commas; default: all are of one."),
    ] = None,
    tacho_angle: Annotated[
        float, typer.Option(help="Crank angle of A where B's tacho gives its pulse, degrees.")
    ] = 0.0,
    out: Annotated[Path | None, out_option("Folder of the results; default: that of B.")] = None,
    limits: Annotated[
        Path | None,
        typer.Option(
            "--limits",
            metavar="LIMITS.csv",
            help="Hold both against limits of orders, bands, totals, criteria. "
            "The exit code is 1 where one is broken.",
        ),
    ] = None,
    pdf: Pdf = False,
    paper: Paper = None,
) -> None:
    """Compare two results order by order, in level and phase: compared.html, tables, figures."""
    from math import radians

    from .. import report
    from ..results import order_comparison
    from ..results.figure_limits import Compared, check_figures
    from ..results.limits_file import read_figure_limits
    from ..results.mean_of_runs import with_scatter
    from . import arguments, checking, outputs
    from .printing import printer

    prints = printer(pdf, paper)
    folder = out or others[0].parent
    outputs.check_folder(folder)
    of_orders, of_figures = read_figure_limits(limits) if limits else ((), ())
    reference, other = outputs.open_orders(first), _second(others, specimens)
    orders = order_comparison.compare(
        reference,
        other,
        arguments.assignments("--pair", pair),
        option,
        radians(tacho_angle),
        other_option,
    )
    orders = checking.held_against(with_scatter(orders, other), of_orders)
    compared = Compared(orders, reference, other)
    figures = check_figures(compared, of_figures)
    written = outputs.write_comparison(compared, figures, folder, prints)
    typer.echo(report.comparison_of_orders_text(orders))
    _print_limits(compared, figures, folder)
    typer.echo(f"compared orders: {written}")
    typer.echo(f"report: {folder / outputs.COMPARISON_REPORT_NAME}")
    if prints is not None:
        typer.echo(f"pdf: {(folder / outputs.COMPARISON_REPORT_NAME).with_suffix('.pdf')}")
    if report.broken_lines(orders, figures):
        raise typer.Exit(BROKEN)


def _second(files: list[Path], specimens: str | None) -> "xr.Dataset":
    """The only other result, or the mean of several recordings."""
    from ..base.errors import ParameterError
    from ..results.mean_of_runs import mean_of_runs
    from . import outputs

    results = [outputs.open_orders(file) for file in files]
    if len(files) == 1 and specimens is None:
        return results[0]
    names = [name.strip() for name in specimens.split(",")] if specimens else []
    try:
        return mean_of_runs(results, names)
    except ParameterError as error:
        raise ParameterError(f"{', '.join(map(str, files))}: {error}") from None


def _print_limits(compared: "Compared", figures: "list[CheckedFigure]", folder: Path) -> None:
    """Margins and a line for each limit that is broken, where there are limits."""
    from .. import report
    from . import outputs

    orders = compared.orders
    if "order_limit" in orders:
        typer.echo(report.limits_text(orders))
        typer.echo(f"limits: {folder / outputs.COMPARED_LIMITS_NAME}")
    if figures:
        typer.echo(f"limits of other figures: {folder / outputs.COMPARED_FIGURES_NAME}")
    for line in report.broken_lines(orders, figures):
        typer.echo(f"broken: {line}")
