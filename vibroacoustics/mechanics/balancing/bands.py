"""Samples of the readings that remain, for their bands."""

from typing import Final

import numpy as np

from ...base.arrays import ComplexArray
from .coefficients import Coefficients

_SEED: Final = 6


def residual_samples(fitted: Coefficients, moment: ComplexArray) -> ComplexArray:
    """Return samples of the readings with weights, shape (sample, row).

    Errors of b₀ and A are those of the fit. Of what no weight can change (the part of the readings
    across the columns of A) only as much is real as exceeds its scatter: its variance is estimated
    from its size (Efron and Morris, J. Am. Stat. Assoc. 68 (1973) 117), and it shrinks accordingly.

    Parameters
    ----------
    fitted : b₀ and A with their scatter
    moment : moments of all weights that are in, shape (plane,), kg m
    """
    samples = fitted.sampled()
    residual = fitted.response + fitted.influence @ moment
    error = samples[..., 0] + samples[..., 1:] @ moment - residual
    size = np.sqrt(0.5 * np.mean(np.abs(error) ** 2, axis=0))
    if not np.all(np.isfinite(size)) or np.any(size == 0.0):
        return np.asarray(residual + error)
    outer, spread, _ = np.linalg.svd(fitted.influence / size[:, None], full_matrices=False)
    kept = outer[:, spread > 1e-9 * spread.max(initial=0.0)]
    across = np.eye(len(size)) - kept @ kept.conj().T
    freedom = 2 * (len(size) - kept.shape[1])
    fixed, errors = residual / size, error / size
    squares = float(np.sum(np.abs(across @ fixed) ** 2))
    if not freedom or not squares:
        return np.asarray(residual + error)
    chance = np.random.default_rng(_SEED).chisquare(freedom, len(errors))
    share = np.maximum(1.0 - chance / squares, 0.0)[:, None]
    part = across @ fixed, errors @ across.T
    along = (fixed - part[0]) + (errors - part[1])
    return np.asarray(size * (along + share * part[0] + np.sqrt(share) * part[1]))
