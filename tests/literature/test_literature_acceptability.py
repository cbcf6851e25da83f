"""Rank acceptability on a published example, beside exact volumes and a sampling apart from it.

Two antidepressants and placebo by response and three adverse events, each a beta distribution of
the counts of a trial: model `smaa2-br-betas` that is distributed with JSMAA (Tervonen 2014,
International Journal of Systems Science 45, 69-81). Its scale of a criterion reaches from the
lowest to the highest end of the 95 % intervals.
"""

from itertools import combinations, permutations

import numpy as np
from documents import SECOND, VARSI
from evidence import claim
from scipy.optimize import linprog
from scipy.spatial import ConvexHull, HalfspaceIntersection
from scipy.stats import beta, qmc

from vibroacoustics.scoring import any_weights, rank_acceptability, utilities

BETAS = np.array(
    [
        [
            [52, 46],
            [41, 61],
            [23, 79],
            [11, 91],
        ],  # venlafaxine: response, nausea, insomnia, anxiety
        [[46, 56], [23, 81], [16, 88], [8, 96]],  # fluoxetine
        [[38, 65], [9, 95], [15, 89], [2, 102]],  # placebo
    ]
)
"""Parameters of the beta distributions, shape (option, criterion, 2)."""
ALLOWED = 0.005


def at_quantiles(shares: np.ndarray) -> np.ndarray:
    return beta.ppf(shares, BETAS[..., 0], BETAS[..., 1])


def utility_of(values: np.ndarray) -> np.ndarray:
    """Utilities, shape (sample, option, criterion); response is better the higher."""
    ends = at_quantiles(np.array([[[0.025]], [[0.975]]]))
    low, high = ends[0].min(axis=0), ends[1].max(axis=0)
    rising = np.array([True, False, False, False])
    best, worst = np.where(rising, high, low), np.where(rising, low, high)
    return utilities(values, best, worst)


def volume(leads: np.ndarray) -> float:
    """Share of all weights of four criteria by which all leads are positive, exactly.

    The fourth weight is what the others leave of one, so that the weights are a tetrahedron.
    """
    sides = np.vstack([np.column_stack([-np.eye(3), np.zeros(3)]), [1.0, 1.0, 1.0, -1.0]])
    cuts = np.column_stack([leads[:, 3:] - leads[:, :3], -leads[:, 3]])
    halfspaces = np.vstack([sides, cuts])
    norm = np.linalg.norm(halfspaces[:, :-1], axis=1)
    inner = linprog([0, 0, 0, -1], np.column_stack([halfspaces[:, :-1], norm]), -halfspaces[:, -1])
    if not inner.success or inner.x[3] < 1e-9:
        return 0.0
    corners = HalfspaceIntersection(halfspaces, inner.x[:3]).intersections
    return 6.0 * ConvexHull(corners).volume


def exact_places(utility: np.ndarray) -> np.ndarray:
    """Share of the weights by which each option takes each place, from volumes."""
    places = np.zeros((3, 3))
    for order in permutations(range(3)):
        leads = np.array(
            [utility[order[0]] - utility[order[1]], utility[order[1]] - utility[order[2]]]
        )
        places[order, range(3)] += volume(leads)
    return places


def test_places_are_the_exact_volumes_of_their_weights() -> None:
    """Samples that count by different weights."""
    shares = qmc.LatinHypercube(12, seed=3).random(12).reshape(12, 3, 4)
    utility, sample_weight = utility_of(at_quantiles(shares)), np.arange(1.0, 13.0)
    exact = np.average([exact_places(one) for one in utility], axis=0, weights=sample_weight)
    np.testing.assert_allclose(exact.sum(axis=0), 1.0, atol=1e-9)
    places = rank_acceptability(utility, sample_weight, any_weights(4, 40_000, 1))
    claim(
        "Rank acceptability of three options beside exact volumes", kind="exact", unit="1",
        source=SECOND("volumes of the weights, test_literature_acceptability"), computed=places,
        reference=exact, tolerance=ALLOWED, topics=("scoring",),
    )  # fmt: skip


def test_pairs_have_the_closed_form_of_their_share() -> None:
    """Σ over d_i > 0 of d_i^(n-1) / Π (d_i - d_j): share of the weights with Σ w_i d_i > 0.

    Of a linear form on a simplex (Varsi 1973, Pacific Journal of Mathematics 46, 315-319).
    """
    utility = utility_of(at_quantiles(np.full((3, 4), 0.5)))
    for one, other in combinations(range(3), 2):
        lead = utility[one] - utility[other]
        products = [
            np.prod([own - rest for rest in np.delete(lead, i)]) for i, own in enumerate(lead)
        ]
        share = sum(own**3 / of for own, of in zip(lead, products, strict=True) if own > 0.0)
        places = rank_acceptability(
            utility[None, [one, other]], np.ones(1), any_weights(4, 200_000, 2)
        )
        claim(
            f"Rank acceptability of the pair {one + 1}, {other + 1}", kind="exact", unit="1",
            source=VARSI("share of a simplex"), computed=places[0, 0], reference=share,
            tolerance=ALLOWED, topics=("scoring",),
        )  # fmt: skip


def test_places_agree_with_a_sampling_of_values_and_weights_together() -> None:
    """By other random numbers: quantiles on a lattice, weights as gaps between sorted numbers."""
    samples = qmc.Sobol(12, seed=5).random(512).reshape(512, 3, 4)
    places = rank_acceptability(
        utility_of(at_quantiles(samples)), np.ones(512), any_weights(4, 400, 6)
    )
    generator = np.random.default_rng(7)
    gaps = np.diff(np.sort(generator.random((200_000, 3)), axis=1), axis=1, prepend=0.0, append=1.0)
    sampled = utility_of(generator.beta(*np.moveaxis(BETAS, 2, 0), size=(200_000, 3, 4)))
    place = np.argsort(np.argsort(-np.einsum("doc,dc->do", sampled, gaps), axis=1), axis=1)
    by_hand = np.array(
        [[(place[:, option] == at).mean() for at in range(3)] for option in range(3)]
    )
    claim(
        "Rank acceptability of three options by another sampling", kind="second code", unit="1",
        source=SECOND("model smaa2-br-betas of JSMAA, sampled apart"), computed=places,
        reference=by_hand, tolerance=ALLOWED, topics=("scoring",),
    )  # fmt: skip
