"""A made-up study for replays: orders at some speeds, with and without options, and noise."""

import numpy as np
import xarray as xr

ORDERS = (0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 20.0, np.nan)
NAMES = [*(f"order {order:g}" for order in ORDERS[:-1]), "motor: 2 x line"]
OPTIONS = ("none", "ring", "hood")


def ratio(order: float, speed_rpm: np.ndarray) -> np.ndarray:
    """Ratio of the ring: smooth over the speed, other for each order."""
    return (0.4 + 0.2 * order) * np.exp(1j * order * speed_rpm / 1000.0)


def replay_study(speeds_rpm: list[float]) -> xr.Dataset:
    """Results with two sources at one microphone.

    The ring changes orders 1 to 3, 5 and 20 and the tone, order 5 by 26 dB; order 4 is there with
    the ring only. The hood changes the noise of one third octave. Orders 1 to 3 change by the
    ring's ratio, -2 to 3 dB in 80 % of the samples.
    """
    speeds = np.array(speeds_rpm)
    pressure = np.zeros((speeds.size, 3, 2, 1, len(NAMES)), dtype=complex)
    for column, order in enumerate(ORDERS):
        number = 6.0 if np.isnan(order) else order
        old = np.exp(2j * number) / (1.0 + number) * np.ones(speeds.size)
        new = old * ratio(number, speeds)
        if order == 4.0:
            old = 0.0 * old
        if order == 5.0:
            new = 20.0 * old
        for option, value in enumerate((old, new, old)):
            pressure[:, option, 0, 0, column] = 3.0 * value
            pressure[:, option, 1, 0, column] = -2.0 * value
    whole = np.arange(4.0)
    change = np.zeros((speeds.size, 3, 1, whole.size))
    change[:, 1, 0] = [
        [20.0 * np.log10(abs(ratio(order, speed))) for order in whole] for speed in speeds
    ]
    noise = np.full((speeds.size, 3, 1, 2), 40.0)
    noise[:, 2, 0, 1] = 43.0
    return xr.Dataset(
        {
            "pressure_line": (("speed", "option", "sound_source", "receiver", "line"), pressure),
            "noise_band_level": (("speed", "option", "receiver", "noise_band"), noise),
            "unmodelled_band_level": (
                ("speed", "option", "receiver", "noise_band"),
                np.full(noise.shape, -300.0),
            ),
            **{
                f"order_change{suffix}": (("speed", "option", "receiver", "order"), change + end)
                for suffix, end in (("_10_percent", -2.0), ("", 0.0), ("_90_percent", 3.0))
            },
        },
        coords={
            "speed": speeds,
            "option": list(OPTIONS),
            "sound_source": ["unbalance", "gas"],
            "receiver": ["front"],
            "line": NAMES,
            "line_order": ("line", list(ORDERS)),
            "order": whole,
            "noise_band": [500.0, 1000.0],
        },
    )
