"""Results of unchanged studies: computed by the first worker that asks, read by all others."""

import fcntl
import os
import pickle
from collections.abc import Callable
from pathlib import Path

import xarray as xr

FOLDER = "KEPT_RESULTS"
"""Environment variable of the folder that the workers of one session share."""


def kept(name: str, compute: Callable[[], xr.Dataset]) -> xr.Dataset:
    """Results of a name, a copy for each caller; outside a session they are computed.

    Parameters
    ----------
    name : of what depends on the package alone
    compute : called by the first that asks, while the others wait
    """
    if FOLDER not in os.environ:
        return compute()
    path = Path(os.environ[FOLDER]) / f"{name}.pickle"
    with path.with_suffix(".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not path.exists():
            fresh = path.with_suffix(".fresh")
            fresh.write_bytes(pickle.dumps(compute()))
            fresh.replace(path)
    return pickle.loads(path.read_bytes())  # noqa: S301 - of a worker of this session
