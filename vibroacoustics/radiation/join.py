"""Joining the machine side and the room side on the box by reciprocity."""

from collections.abc import Iterable, Sequence

import numpy as np

from .arrays import ComplexArray
from .box import BoxField
from .recording import PartField, Recording


def join(
    recorded: Recording,
    fields: Sequence[Sequence[PartField]],
    frequencies: Sequence[int],
    greens: Iterable[ComplexArray],
) -> ComplexArray:
    """Sound pressure where Green's functions lead, of every field, (point, field, frequency).

    Kirchhoff-Helmholtz integral over the box, with the normal n out of the box (towards the
    receiver): p = integral of [p dG/dn - G dp/dn] dS (Pierce, Acoustics (2019), section 4.6).
    With p and G half a cell inside (i) and outside (o) of every face of area A, a distance d apart,
    the central differences and means combine to

        p = sum of A/d (p_i G_o - p_o G_i),

    which no choice of box changes as long as both fields obey the discrete equations. So a rocking
    body's weak sound is not drowned by quadrature errors of its strong near field.

    Parameters
    ----------
    recorded : the cells of the box
    fields : the parts of each field
    frequencies : those of the fields that are joined
    greens : for each of these frequencies, Green's functions on the inner layer of the box and then
        on the outer one, (point, 2 pairs)
    """
    by_parity: dict[tuple[int, ...], list[tuple[int, PartField]]] = {}
    for number, parts in enumerate(fields):
        for part in parts:
            by_parity.setdefault(part.parity, []).append((number, part))
    matrices = {parity: recorded.join_matrix(parity) for parity in by_parity}
    rows = []
    for frequency, green in zip(frequencies, greens, strict=True):
        row = np.zeros((len(fields), green.shape[0]), dtype=complex)
        for parity, members in by_parity.items():
            spectra = np.stack([part.spectrum[frequency] for _, part in members])
            row[[number for number, _ in members]] += spectra @ (matrices[parity] @ green.T)
        rows.append(row.T)
    return np.stack(rows, axis=-1)


def rows_of(greens: Sequence[BoxField]) -> Iterable[ComplexArray]:
    """Green's functions (point, 2 pairs) at one frequency after the other."""
    for frequency in range(greens[0].inner.shape[0]):
        yield np.stack(
            [np.concatenate([one.inner[frequency], one.outer[frequency]]) for one in greens]
        )
