"""The ranking as plain text."""

import numpy as np
import xarray as xr


def ranking_text(scores: xr.Dataset) -> str:
    """The options from best to worst as plain text, one line each."""
    first = scores["score"].isel(scoring_method=0)
    order = np.argsort(-first.values, kind="stable")
    head = "  ".join(f"{name:>12}" for name in scores["scoring_method"].values)
    lines = [f"{'rank':>4}  {'option':<24}  {head}  {'first place':>11}"]
    for option in scores["option"].values[order]:
        row = scores.sel(option=option)
        values = "  ".join(f"{value:12.3f}" for value in row["score"].values)
        rank = int(row["rank"].isel(scoring_method=0))
        share = 100.0 * row["first_place_share"].item()
        lines.append(f"{rank:>4}  {option:<24}  {values}  {share:>9.0f} %")
    return "\n".join(lines)
