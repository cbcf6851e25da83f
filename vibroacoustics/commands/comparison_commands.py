"""Command for comparisons. Heavy imports wait until it is needed."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from .command import command
from .options import LimitsFile, Option, Printing
from .outcome import Outcome

if TYPE_CHECKING:
    import xarray as xr


@command("compare", "Results", "reports/mine/results.nc reports/bench/orders.nc")
def compare_command(
    first: Annotated[Path, "A: Results of `run` or `orders`, .nc."],
    others: Annotated[
        list[Path],
        "B: Results to compare with; several of `orders` are averaged.",
    ],
    pair: Annotated[
        list[str] | None,
        "CHANNEL=CHANNEL, of A and of B; may be repeated; default: channels of one name.",
    ] = None,
    option: Option = "none",
    other_option: Annotated[str | None, "Balancing option of B; default: that of A."] = None,
    specimens: Annotated[
        str | None,
        "Specimen of each B, with commas; default: all are of one.",
    ] = None,
    tacho_angle: Annotated[
        float, "Crank angle of A where B's tacho gives its pulse, degrees."
    ] = 0.0,
    out: Annotated[Path | None, "Folder of the results; default: that of B."] = None,
    limits: LimitsFile = None,
    *,
    printing: Printing,
) -> Outcome:
    """Compare two results order by order, in level and phase: compared.html, tables, figures."""
    from math import radians

    from .. import report
    from ..results import order_comparison
    from ..results.figure_limits import Compared, check_figures
    from ..results.limits_file import read_figure_limits
    from ..results.mean_of_runs import with_scatter
    from . import arguments, checking, outputs

    prints = printing.printer()
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
    analysis = report.analysis_of_comparison(compared, figures)
    return Outcome(
        files=outputs.write_analysis(analysis, orders, folder, "compared_orders.nc", prints),
        analyses={"": analysis},
        broken=report.broken_lines(orders, figures),
    )


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
