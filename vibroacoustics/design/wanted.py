"""Objectives and constraints of a table `design`: their figures, and what these need."""

from typing import Final

from ..base.errors import ParameterError
from ..study.criterion import CRITERIA
from ..study.design import Constraint, Design, Objective, Wanted
from ..study.study import Study
from .engine.needs import Need
from .figure import FIGURES, DesignFigure, OfCriterion

MEDIAN: Final = 0.5
CONFIDENCE: Final = 0.9
"""Share of the samples that a change is stated for."""
CHANGE_OF_TOTAL: Final = "total_change_db"
TOTALS: Final = ("level_total_dba", CHANGE_OF_TOTAL)
"""Figures of the level of the machine with unmodelled noise."""
MOST_PIECES_KEEP: Final = 0.9
"""Share of nominal pieces that reach a value or better."""


def more_is_better(wanted: Wanted) -> bool:
    """Whether the smallest value is the worst."""
    if isinstance(wanted, Objective):
        return wanted.goal == "greatest"
    return isinstance(wanted, Constraint) and wanted.at_least is not None


def _where(study: Study, design: Design, name: str) -> str:
    table = "objectives" if name in design.objectives else "constraints"
    return f"{study.source_file}: design.{table}.{name}"


def figure_of(study: Study, design: Design, name: str, wanted: Wanted) -> DesignFigure:
    """Return the figure of an objective or constraint.

    Parameters
    ----------
    study : study of the designs
    design : its table
    name : name of the objective or constraint
    wanted : the objective or constraint

    Raises
    ------
    ParameterError
        There is no such figure, or an objective and a constraint have one name.
    """
    if name in design.objectives and name in design.constraints:
        raise ParameterError(
            f"{study.source_file}: design.constraints.{name}: is an objective's name too"
        )
    takes_run = wanted.figure in CRITERIA and study.baseline is not None  # measured noise
    if wanted.figure in FIGURES and not takes_run:
        return FIGURES[wanted.figure]()
    if wanted.figure in CRITERIA:
        return OfCriterion(wanted.figure)
    where = f"{_where(study, design, name)}.figure = {wanted.figure}"
    raise ParameterError(f"{where}: {FIGURES.unknown(wanted.figure, CRITERIA)}")


def needs_of(
    study: Study, design: Design, figure: DesignFigure, name: str, wanted: Wanted
) -> tuple[Need, ...]:
    """Return the responses that a figure needs.

    Parameters
    ----------
    study : study of the designs
    design : its table
    figure : figure of the objective or constraint
    name : name of the objective or constraint
    wanted : the objective or constraint

    Raises
    ------
    ParameterError
        The figure does not allow what is wanted of it.
    """
    try:
        return figure.needs(wanted)
    except ParameterError as error:
        raise ParameterError(f"{_where(study, design, name)}.{error}") from None
