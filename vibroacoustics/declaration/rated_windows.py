"""Rating levels of a data sheet."""

import xarray as xr

from ..results.data_sheet import RatedWindow
from ..results.estimates import interval


def rated_windows(case: xr.Dataset) -> tuple[RatedWindow, ...]:
    """Return the rating levels at all windows; empty without windows.

    Parameters
    ----------
    case : results of an option at a speed
    """
    if "rating_level" not in case:
        return ()
    level = interval(case, "rating_level")
    return tuple(
        RatedWindow(
            window=window,
            rating_level_dba=float(level["value"].sel(rating_window=window)),
            rating_level_low_dba=float(level["low"].sel(rating_window=window)),
            rating_level_high_dba=float(level["high"].sel(rating_window=window)),
            adjustment_db=float(case["rating_adjustment"].sel(rating_window=window)),
            limit_dba=float(case["rating_limit"].sel(rating_window=window)),
            limit_probability=float(case["limit_probability"].sel(rating_window=window)),
        )
        for window in map(str, case["rating_window"].values)
    )
