"""The figures of the report, each with one idea, drawn without global state."""

from .forces import force_figures
from .maps import line_map_figures
from .mounts import mount_figures
from .orders import order_figures
from .radiation import level_figures, transfer_figures
from .scores import score_figures
from .sources import source_figures
from .style import Picture

__all__ = [
    "Picture",
    "force_figures",
    "level_figures",
    "line_map_figures",
    "mount_figures",
    "order_figures",
    "score_figures",
    "source_figures",
    "transfer_figures",
]
