"""The page of a recording's orders, of the same blocks as the report of a study."""

from collections.abc import Sequence

import xarray as xr

from .blocks import Bullets, Pictures
from .figures.style import Picture
from .html import html
from .limit_tables import order_limits_table
from .order_tables import orders_facts, orders_tables
from .page import Page, Part


def orders_html(results: xr.Dataset, pictures: Sequence[Picture]) -> bytes:
    """The page.

    Parameters
    ----------
    results : orders of a recording
    pictures : of its channels
    """
    parts = [
        Part("figures", "Orders by channel", (Pictures(tuple(pictures)),)),
        Part("orders", "Orders and levels", tuple(orders_tables(results))),
        Part("settings", "Speed and resolution", (Bullets(tuple(orders_facts(results))),)),
    ]
    if "order_limit" in results:
        parts.insert(0, Part("limits", "Limits", (order_limits_table(results),)))
    attrs = results.attrs
    about = "Orders are multiples of the shaft frequency; amplitudes are peaks."
    return html(Page(str(attrs["title"]), "Recording", attrs["created_utc"], tuple(parts), about))
