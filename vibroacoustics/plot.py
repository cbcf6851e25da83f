"""Figures of results: each function takes a dataset and returns a matplotlib Figure.

The report holds the same charts. A notebook shows what these functions return;
`figure.savefig("name.png")` writes it.

>>> results = va.open_results("results.nc")
>>> va.plot.levels(results).savefig("levels.png")

From `run`: `force_over_revolution`, `force_orders`, `foot_force_orders`, `level_orders`,
`mount_transmissibility`, `transfer`, `green_difference`, `levels`, `line_map`, `room_map`,
`room_seam`, `scores`, `rank_acceptability`, `source_third_octaves`, `option_third_octaves`,
`baseline_third_octaves`, `path_shares`, `stopping`, `stopping_order_map`, `stacked_third_octaves`,
`stacked_lines`, `run_up_levels`, `run_up_orders`, `polar_levels`.

Over several speeds of `run`: `levels_over_speed`, `source_levels_over_speed`,
`orders_over_speed`, `speed_frequency_map`, `campbell`.

From `radiate`: `transfer_vectors`, `unit_level_map`, `directivity`.

From `analyse_orders`: `order_spectrum`, `orders_over_speed`, `order_map`.

From `speed_frequency_map`: `speed_frequency_map`, `levels_over_speed`. From `track_orders`:
`tracked_orders`.

From `blocked_forces`: `blocked_force`, `blocked_validation`.

From `compare`: `compared_orders`, `order_differences`, `orders_over_speed`.

From `curves`: `curves`. From `predict`: `predicted_levels`.
"""

from .report.charts.needs import plotted
from .report.figures import campbell as _campbell
from .report.figures import (
    channel_orders,
    in_room,
    maps,
    orders,
    paths,
    predicted,
    radiation,
    sources,
    stacked,
)
from .report.figures import curves as _curves
from .report.figures import directivity as _directivity
from .report.figures import levels_over_speed as _levels_over_speed
from .report.figures import orders_over_speed as _orders_over_speed
from .report.figures import scores as _scores
from .report.figures import stopping as _stopping

baseline_third_octaves = plotted(sources.baseline_third_octaves)
blocked_force = plotted(predicted.blocked_force, "blocked_forces.nc")
blocked_validation = plotted(predicted.blocked_validation, "blocked_forces.nc")
campbell = plotted(_campbell.campbell)
compared_orders = plotted(channel_orders.compared_orders, "compared_orders.nc")
curves = plotted(_curves.curves, "curves.nc")
levels_over_speed = plotted(_levels_over_speed.levels_over_speed)
order_differences = plotted(channel_orders.order_differences, "compared_orders.nc")
orders_over_speed = plotted(_orders_over_speed.orders_over_speed, "orders.nc")
predicted_levels = plotted(predicted.predicted_levels, "prediction.nc")
source_levels_over_speed = plotted(_levels_over_speed.source_levels_over_speed)
speed_frequency_map = plotted(_orders_over_speed.speed_frequency_map, "speed_map.nc")
directivity = plotted(_directivity.directivity, "transfer_vectors.nc")
foot_force_orders = plotted(orders.foot_force_orders)
force_orders = plotted(orders.force_orders)
force_over_revolution = plotted(orders.force_over_revolution)
green_difference = plotted(radiation.green_difference)
level_orders = plotted(orders.level_orders)
levels = plotted(radiation.levels)
line_map = plotted(maps.line_map)
mount_transmissibility = plotted(radiation.mount_transmissibility)
option_third_octaves = plotted(sources.option_third_octaves)
path_shares = plotted(paths.path_shares)
polar_levels = plotted(_directivity.polar_levels)
rank_acceptability = plotted(_scores.rank_acceptability)
room_map = plotted(in_room.room_map, "kitchen.nc")
room_seam = plotted(in_room.room_seam, "kitchen.nc")
run_up_levels = plotted(stacked.run_up_levels)
run_up_orders = plotted(stacked.run_up_orders)
scores = plotted(_scores.scores)
source_third_octaves = plotted(sources.source_third_octaves)
stacked_lines = plotted(stacked.stacked_lines)
stacked_third_octaves = plotted(stacked.stacked_third_octaves)
stopping = plotted(_stopping.stopping)
stopping_order_map = plotted(_stopping.stopping_order_map)
transfer = plotted(radiation.transfer)
transfer_vectors = plotted(maps.transfer_vectors, "transfer_vectors.nc")
unit_level_map = plotted(maps.unit_level_map, "transfer_vectors.nc")
order_map = plotted(channel_orders.order_map, "orders.nc")
order_spectrum = plotted(channel_orders.order_spectrum, "orders.nc")
tracked_orders = plotted(channel_orders.tracked_orders, "tracked_orders.nc")

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
    "polar_levels",
    "predicted_levels",
    "rank_acceptability",
    "room_map",
    "room_seam",
    "run_up_levels",
    "run_up_orders",
    "scores",
    "source_levels_over_speed",
    "source_third_octaves",
    "speed_frequency_map",
    "stacked_lines",
    "stacked_third_octaves",
    "stopping",
    "stopping_order_map",
    "tracked_orders",
    "transfer",
    "transfer_vectors",
    "unit_level_map",
]


def __dir__() -> list[str]:
    return __all__
