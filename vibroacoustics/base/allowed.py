"""Ranges of single values."""

from .errors import ParameterError


def check_range(name: str, value: float, lowest: float, highest: float, unit: str = "") -> None:
    """Refuse a value outside its range, or that is no number.

    Parameters
    ----------
    name : name of the value, as its user knows it
    value : number to be checked
    lowest, highest : limits, both allowed
    unit : unit of value and limits

    Raises
    ------
    ParameterError
        The value is outside.
    """
    if lowest <= value <= highest:
        return
    behind = f" {unit}" if unit else ""
    shown = str(value) if isinstance(value, int) else f"{value:g}"
    raise ParameterError(f"{name} = {shown}{behind}: must be {lowest:g} to {highest:g}{behind}")
