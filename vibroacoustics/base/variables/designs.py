"""Designs that a search has evaluated, and the best few of them."""

from ..registry import register
from ..vocabulary import Coordinate, Variable

_OF_BEST = ("best_rank", "wanted")

for _thing in (
    Coordinate("design", ("design",), "1", "number of a design, from 0"),
    Coordinate("design_variable", ("design_variable",), "", "dotted key of a value that varies"),
    Coordinate("design_unit", ("design_variable",), "", "unit of the value"),
    Coordinate("design_low", ("design_variable",), "", "least value allowed, or first choice"),
    Coordinate("design_high", ("design_variable",), "", "greatest value allowed, or last choice"),
    Coordinate("wanted", ("wanted",), "", "name of an objective or a constraint"),
    Coordinate("wanted_unit", ("wanted",), "", "unit of it"),
    Coordinate("wanted_label", ("wanted",), "", "what it is, in words"),
    Coordinate("wanted_role", ("wanted",), "", "least, greatest, at most or at least"),
    Coordinate("wanted_limit", ("wanted",), "", "limit of a constraint"),
    Coordinate("spread_design", ("spread_design",), "1", "number of a design spread evenly"),
    Coordinate("best_rank", ("best_rank",), "1", "number among the best few, from 1"),
    Variable(
        "design_value", ("design", "design_variable"), "", "value in its unit; choices by number"
    ),
    Variable("wanted_value", ("design", "wanted"), "", "objective or constraint of a design"),
    Variable("meets_constraints", ("design",), "1", "1 where a design meets every constraint"),
    Variable("on_front", ("design",), "1", "1 where none is better in every objective"),
    Variable("search_generation", ("design",), "1", "generation of the search, from 0"),
    Variable("best_design", ("best_rank",), "1", "number of the design"),
    Variable("wanted_as_meant", _OF_BEST, "", "of a piece without tolerances"),
    Variable("wanted_promised", _OF_BEST, "", "over fresh draws of the tolerances"),
    Variable("wanted_promised_low", _OF_BEST, "", "lower 95 % limit, of the number of draws"),
    Variable("wanted_promised_high", _OF_BEST, "", "upper 95 % limit, of the number of draws"),
    Variable("wanted_reference", ("wanted",), "", "of the machine without an option"),
    Variable("spread_value", ("spread_design", "design_variable"), "", "value in its unit"),
    Variable("spread_wanted", ("spread_design", "wanted"), "", "objective or constraint"),
    Variable(
        "design_share", ("wanted", "design_variable"), "1", "share of the variance of designs"
    ),
    Variable("design_share_quality", ("wanted",), "1", "Q2 of the fit behind the shares"),
):
    register(_thing)
