"""Figures of results: each function takes a dataset and returns a matplotlib Figure.

The report draws its pictures with the same functions. A notebook shows what they return;
`figure.savefig("name.png")` writes it.

>>> results = va.open_results("results.nc")
>>> va.plot.levels(results).savefig("levels.png")

Of `run`: `force_over_revolution`, `force_orders`, `foot_force_orders`, `level_orders`,
`mount_transmissibility`, `transfer`, `green_difference`, `levels`, `line_map`, `room_map`,
`room_seam`, `scores`, `rank_acceptability`, `source_third_octaves`, `option_third_octaves`,
`baseline_third_octaves`, `path_shares`, `stopping`, `stopping_order_map`.

Over several speeds of `run`: `levels_over_speed`, `source_levels_over_speed`,
`orders_over_speed`, `speed_frequency_map`, `campbell`.

Of `radiate`: `transfer_vectors`, `unit_level_map`, `directivity`.

Of `analyse_orders`: `order_spectrum`, `orders_over_speed`, `order_map`.

Of `speed_frequency_map`: `speed_frequency_map`, `levels_over_speed`. Of `track_orders`:
`tracked_orders`.

Of `blocked_forces`: `blocked_force`, `blocked_validation`.

Of `compare`: `compared_orders`, `order_differences`, `orders_over_speed`.

Of `curves`: `curves`. Of `predict`: `predicted_levels`.
"""

from .report.charts.needs import plotted
from .report.figures import recorded_orders
from .report.figures.baseline import baseline_third_octaves
from .report.figures.blocked_forces import blocked_force, blocked_validation
from .report.figures.campbell import campbell
from .report.figures.compared_orders import compared_orders, order_differences
from .report.figures.curves import curves
from .report.figures.directivity import directivity
from .report.figures.forces import force_over_revolution
from .report.figures.in_room import room_map, room_seam
from .report.figures.levels_over_speed import levels_over_speed, source_levels_over_speed
from .report.figures.maps import line_map, unit_level_map
from .report.figures.mounts import mount_transmissibility
from .report.figures.orders import foot_force_orders, force_orders, level_orders
from .report.figures.orders_over_speed import orders_over_speed
from .report.figures.paths import path_shares
from .report.figures.prediction import predicted_levels
from .report.figures.radiation import green_difference, levels, transfer
from .report.figures.scores import rank_acceptability, scores
from .report.figures.sources import option_third_octaves, source_third_octaves
from .report.figures.speed_maps import speed_frequency_map
from .report.figures.stopping import stopping, stopping_order_map
from .report.figures.transfer_vectors import transfer_vectors

order_map = plotted(recorded_orders.order_map, "orders.nc")
order_spectrum = plotted(recorded_orders.order_spectrum, "orders.nc")
tracked_orders = plotted(recorded_orders.tracked_orders, "tracked_orders.nc")

__all__ = [
    "baseline_third_octaves",
    "blocked_force",
    "blocked_validation",
    "campbell",
    "compared_orders",
    "curves",
    "directivity",
    "foot_force_orders",
    "force_orders",
    "force_over_revolution",
    "green_difference",
    "level_orders",
    "levels",
    "levels_over_speed",
    "line_map",
    "mount_transmissibility",
    "option_third_octaves",
    "order_differences",
    "order_map",
    "order_spectrum",
    "orders_over_speed",
    "path_shares",
    "predicted_levels",
    "rank_acceptability",
    "room_map",
    "room_seam",
    "scores",
    "source_levels_over_speed",
    "source_third_octaves",
    "speed_frequency_map",
    "stopping",
    "stopping_order_map",
    "tracked_orders",
    "transfer",
    "transfer_vectors",
    "unit_level_map",
]


def __dir__() -> list[str]:
    return __all__
