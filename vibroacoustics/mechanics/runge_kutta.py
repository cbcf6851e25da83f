"""Classical Runge-Kutta method of fourth order: its stages and the increment of a step."""

import numba


@numba.njit(cache=True, nogil=True, error_model="numpy")
def stage_of(stage: int, step: float) -> tuple[int, float, float]:
    """Half steps before a stage, reach of its rate for the next one, and weight of its rate.

    Parameters
    ----------
    stage : 0 to 3
    step : step of the independent variable; reach and weight have its unit
    """
    half = 0 if stage == 0 else (2 if stage == 3 else 1)
    weight = step / (3.0 if stage in (1, 2) else 6.0)
    return half, step if stage == 2 else 0.5 * step, weight


@numba.njit(cache=True, nogil=True, error_model="numpy")
def increment(step: float, first: float, second: float, third: float, fourth: float) -> float:
    """Increment of a state over a step from its rates at the four stages.

    Parameters
    ----------
    step : step of the independent variable
    first, second, third, fourth : rates per unit of it
    """
    return step / 6.0 * (first + 2.0 * second + 2.0 * third + fourth)
