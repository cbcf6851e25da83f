"""What proves the room solver: closed forms, an exact room, a second method, its own symmetry."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from documents import FORM
from evidence import claim
from exact_room import exact_green
from local_grid import local_grid
from local_step import local_transfer
from scipy.sparse import csc_array
from scipy.sparse.linalg import eigsh

from vibroacoustics.base.constants import AIR_IMPEDANCE_PA_S_PER_M, SPEED_OF_SOUND_M_PER_S
from vibroacoustics.base.decibel import level_of_power
from vibroacoustics.levels.bands import bands_between
from vibroacoustics.radiation.rooms import (
    Block,
    Lattice,
    Material,
    Room,
    RoomSettings,
    room_transfer,
)
from vibroacoustics.radiation.rooms.air import Air, largest_eigenvalue, stable_air
from vibroacoustics.radiation.rooms.cutting import AirBox, cut, faces
from vibroacoustics.radiation.rooms.impedance import absorption_at_angle, fitted_branches
from vibroacoustics.radiation.rooms.plane import plane_gains
from vibroacoustics.radiation.rooms.room import SIDES
from vibroacoustics.radiation.rooms.run import run_all, spacing_error_db


def _material(name, *octaves):
    return Material(name, (*octaves, octaves[-1], octaves[-1]))


SIX = [
    _material("plaster", 0.10, 0.10, 0.06, 0.05, 0.05),
    _material("window", 0.35, 0.35, 0.25, 0.18, 0.12),
    _material("plaster", 0.10, 0.10, 0.06, 0.05, 0.05),
    _material("curtain", 0.14, 0.14, 0.35, 0.55, 0.72),
    _material("tiles", 0.01, 0.01, 0.01, 0.01, 0.02),
    _material("ceiling", 0.20, 0.35, 0.55, 0.75, 0.80),
]
SMALL = (1.9, 1.5, 1.2)
LARGE = (4.0, 3.0, 2.5)


def _uniform(share):
    return _material(f"{share}", *(share,) * 5)


def _thirds(frequency, green):
    """Levels in the third octaves that the frequencies cover, (band, point)."""
    bands = bands_between(3, frequency[0] * 1.1, frequency[-1] / 1.13)
    return np.stack(
        [
            level_of_power(np.mean(np.abs(green[rows]) ** 2, axis=0))
            for band in bands
            for rows in [(frequency >= band.lower_hz) & (frequency < band.upper_hz)]
        ]
    )


def _rms(values):
    return float(np.sqrt(np.mean(values**2)))


class _ExactRoom:
    """A room of six materials, its exact Green's function, a source and microphones."""

    def __init__(self, size, highest_hz, step_hz, modes):
        self.frequency = np.arange(80.0, highest_hz + 0.1, step_hz)
        self.room = Room(size, dict(zip(SIDES, SIX, strict=True)))
        self.settings = RoomSettings(highest_hz)
        shares = np.array([[0.78, 0.73, 0.6], [0.5, 0.87, 0.48], [0.9, 0.17, 0.76]])
        self.points = shares * size
        self.source = np.array([0.27, 0.3, 0.28]) * size
        admittance = [fitted_branches(one).admittance(self.frequency) for one in SIX]
        self.exact = exact_green(
            size, np.stack(admittance, axis=1), self.source, self.points, self.frequency, modes
        )

    def cut(self, shares, spacing_m):
        """The room in boxes along planes at shares of its size."""
        lines = [
            np.array([0.0, *share, 1.0]) * size
            for share, size in zip(shares, self.room.size_m, strict=True)
        ]
        boxes = []
        for index in product(*(range(line.size - 1) for line in lines)):
            lower = np.array([line[i] for line, i in zip(lines, index, strict=True)])
            upper = np.array([line[i + 1] for line, i in zip(lines, index, strict=True)])
            nodes = np.ceil((upper - lower) / spacing_m - 1e-6).astype(int)
            boxes.append(AirBox(lower, upper, tuple(int(n) for n in nodes)))
        return tuple(boxes)

    def error_db(self, shares, nodes_per_wave=3.5):
        """Third octaves by boxes minus the exact ones, (band, point)."""
        settings = replace(self.settings, nodes_per_wave=nodes_per_wave)
        boxes = self.cut(shares, settings.spacing_m)
        run = run_all(
            boxes, faces(self.room, boxes), [Lattice.of_point(p) for p in self.points], False,
            {"source": self.source}, self.frequency, settings, 1.2,
        )["source"]  # fmt: skip
        green = np.concatenate([one.reshape(-1, 1) for one in run.values], axis=1)
        return _thirds(self.frequency, green) - _thirds(self.frequency, self.exact)


@pytest.fixture(scope="module")
def small_room():
    return _ExactRoom(SMALL, 500.0, 5.0, 24)


@pytest.fixture(scope="module")
def large_room():
    return _ExactRoom(LARGE, 1000.0, 1.0, 60)


def test_a_hard_box_has_its_modes_and_no_damping():
    room = Room((1.1, 0.9, 0.7))
    boxes = cut(room, 0.2)
    air = stable_air(boxes, faces(room, boxes), 1.0)
    n = np.stack(np.meshgrid(*(np.arange(count) for count in boxes[0].nodes), indexing="ij"), -1)
    exact = SPEED_OF_SOUND_M_PER_S / 2.0 * np.linalg.norm(n / np.array(room.size_m), axis=-1)
    air.terms[:] = 1.0
    root = np.sqrt(air.operator(air.terms)) / 2.0
    frequency = np.arcsin(root) / (np.pi * air.time_step_s)
    audible = exact.ravel() > 0.0
    claim(
        "Frequencies of a hard room", kind="exact", source=FORM("c/2 |(n_i/l_i)|"), unit="Hz",
        computed=frequency[audible], reference=exact.ravel()[audible],
        tolerance=1e-10 * exact.ravel()[audible], topics=("room",),
    )  # fmt: skip
    assert np.allclose(frequency, exact.ravel(), rtol=1e-10, atol=1e-10)
    start = np.cos(2.0 * np.pi * exact.ravel() * air.time_step_s)
    air._before[:] = start
    for _ in range(1000):
        air.exchange()
        air.advance()
    turned = np.cos(2.0 * np.pi * exact.ravel() * 1000 * air.time_step_s)
    assert np.allclose(air.terms, turned, atol=1e-8)


def test_six_materials_agree_with_the_exact_room(small_room):
    assert _rms(small_room.error_db([(), (), ()])) <= 0.1


def test_a_map_is_the_exact_field_of_a_monopole_of_known_power(small_room):
    above_m, height_m = 0.2, 0.9
    bands = {
        middle: np.linspace(0.9 * middle, 1.11 * middle, 24) for middle in (160.0, 250.0, 400.0)
    }
    room, source = small_room.room, np.array([0.5, 0.5, 0.35])
    gains = plane_gains(room, source, above_m, height_m, bands, 500.0)["room_map_gain"]
    x, y = (gains[f"room_map_{axis}"].values for axis in "xy")
    assert x.size * y.size > 50
    points = np.array([(one, other, height_m) for other in y for one in x])
    cosine = (np.arange(1000) + 0.5) / 1000
    for middle, hertz in bands.items():
        admittance = np.stack([fitted_branches(one).admittance(hertz) for one in SIX], axis=1)
        green = exact_green(room.size_m, admittance, source, points, hertz, 24)
        # power through a far hemisphere over a hard floor of a source with p = exp(-jkr)/(4 pi r)
        k = 2.0 * np.pi * hertz[:, None] / SPEED_OF_SOUND_M_PER_S
        pair = np.mean((2.0 * np.cos(k * above_m * cosine)) ** 2, axis=1) / (4.0 * np.pi) ** 2
        power = 2.0 * np.pi * pair / AIR_IMPEDANCE_PA_S_PER_M
        exact = np.mean(np.abs(green) ** 2 / power[:, None], axis=0) * 1e-12 / 20e-6**2
        level = gains.sel(seam_band=middle).transpose("room_map_y", "room_map_x").values.ravel()
        assert _rms(level - level_of_power(exact)) <= 0.1


def test_a_needless_cut_into_eight_boxes_changes_little(small_room):
    assert _rms(small_room.error_db([(0.42,), (0.45,), (0.55,)], 5.0)) <= 0.1


@pytest.mark.long
def test_six_materials_agree_with_the_exact_room_to_1_khz(large_room):
    assert _rms(large_room.error_db([(), (), ()])) <= 0.1


@pytest.mark.long
def test_a_needless_cut_into_eight_boxes_changes_little_to_1_khz(large_room):
    assert _rms(large_room.error_db([(0.375,), (0.43,), (0.36,)])) <= 0.1


def _absorption_in_a_duct(share, angle, frequency_hz=1000.0):
    """Absorption of the end of a duct for the mode that meets it under an angle."""
    k = 2.0 * np.pi * frequency_hz / SPEED_OF_SOUND_M_PER_S
    sine = np.sin(np.radians(angle))
    width = np.pi / (k * sine) if angle else 0.1
    length, end = 1.8, _uniform(share)
    room = Room((length, width, 0.1), {"-x": end, "+x": end})
    along = np.linspace(0.7, 1.5, 81)  # many: what a series lacks of a point source averages out
    lattice = Lattice(along, np.array([0.0, width]), np.array([0.05]))
    # Down to 60 dB alone, what is cut off would be 0.002 of the absorption.
    settings = RoomSettings(frequency_hz, decay_db=100.0, longest_s=0.75 / share)
    source = np.array([0.2, 0.0, 0.05])
    run = room_transfer(room, [lattice], {"m": source}, np.array([frequency_hz]), settings)["m"]
    field = run.values[0][0, 0, :, :, 0] @ np.array([1.0, -1.0 if angle else 1.0])
    kx = k * np.cos(np.radians(angle))
    waves = np.exp(1j * kx * np.outer(along - length, [-1.0, 1.0]))
    (onward, back), *_ = np.linalg.lstsq(waves, field, rcond=None)
    return 1.0 - abs(back / onward) ** 2


@pytest.mark.parametrize("angle", [0.0, 30.0, 60.0, 80.0])
@pytest.mark.parametrize(
    "share",
    [0.5, pytest.param(0.05, marks=pytest.mark.long), pytest.param(0.8, marks=pytest.mark.long)],
)
def test_a_wall_absorbs_by_its_impedance_at_every_angle(share, angle):
    admittance = fitted_branches(_uniform(share)).admittance(np.array([1000.0]))
    wanted = absorption_at_angle(admittance, np.cos(np.radians(angle)))[0]
    claim(
        f"Absorption of {share:g} of a wall at {angle:g}°", kind="exact", unit="1", tolerance=0.005,
        source=FORM("plane wave on a locally reacting wall"), reference=wanted,
        computed=_absorption_in_a_duct(share, angle), topics=("room",),
    )  # fmt: skip


def _flat_l(height):
    return Room((4.0, 2.5, height), blocks=(Block("corner", (0.0, 0.0, 0.0), (0.6, 0.9, height)),))


def _series_frequencies(room, spacing, count):
    boxes = cut(room, spacing, least_nodes=1)
    air = stable_air(boxes, faces(room, boxes), 1.0)
    factors = air.balance()
    matrix = np.stack([factors * air.operator(row / factors) for row in np.eye(factors.size)])
    assert np.allclose(matrix, matrix.T, atol=1e-9)
    value = np.linalg.eigvalsh(matrix)[1 : count + 1]
    return np.arcsin(np.sqrt(value) / 2.0) / (np.pi * air.time_step_s)


def _local_frequencies(room, spacing, count):
    grid = local_grid(room, spacing)
    number = np.full(grid.air.shape, -1)
    number[grid.air] = np.arange(grid.air.sum())
    rows, columns, values = [], [], []
    for axis in range(2):
        neighbour = np.roll(number, -1, axis)
        joined = (number >= 0) & (neighbour >= 0)
        a, b = number[joined], neighbour[joined]
        share = np.full(a.size, (SPEED_OF_SOUND_M_PER_S / grid.spacing[axis]) ** 2)
        rows += [a, b, a, b]
        columns += [a, b, b, a]
        values += [share, share, -share, -share]
    entries = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
    matrix = csc_array(entries, shape=(grid.air.sum(),) * 2)
    squared = eigsh(matrix, count + 1, sigma=-1e4, which="LM", return_eigenvectors=False)
    return np.sqrt(np.sort(squared)[1:]) / (2.0 * np.pi)


@pytest.mark.parametrize(
    ("point", "heard"),
    [((2.03, 1.44, 0.67), (2.03, 1.44, 0.67)), ((0.62, 0.5, 0.6), (0.65, 0.5, 0.6))],
)
def test_second_method_hears_between_its_cells_and_in_air_alone(point, heard):
    """Shares give a point back; beside the block, 0.6 m wide, its cells have none."""
    grid = local_grid(_flat_l(1.2), 0.1)
    cells, shares = grid.weights(np.array(point))
    assert not shares[~grid.air.ravel()[cells]].any()
    numbers = np.unravel_index(cells, grid.air.shape)
    places = [0.1 * (number - 0.5) for number in numbers]  # a row of solid cells all around
    np.testing.assert_allclose(places @ shares, heard, atol=1e-12)


def _error_of_the_l(spacing, finest, count):
    room = _flat_l(0.9 * finest)  # one layer of cells
    coarse, fine = (_local_frequencies(room, h, count) for h in (2.0 * finest, finest))
    extrapolated = fine + (fine - coarse) / 3.0
    return np.abs(_series_frequencies(room, spacing, count) / extrapolated - 1.0)


def test_an_l_shaped_room_has_the_frequencies_of_fine_cells():
    assert _error_of_the_l(0.1, 0.05, 20).max() <= 1e-3


@pytest.mark.long
def test_an_l_shaped_room_has_the_frequencies_of_fine_cells_to_800_hz():
    assert _error_of_the_l(0.05, 0.0125, 160).max() <= 1e-3


def _furnished(share=0.1):
    wall = _uniform(share)
    blocks = (
        Block("worktop", (0.6, 0.0, 0.0), (1.8, 0.6, 0.8), wall),
        Block("cupboard", (0.0, 0.0, 0.0), (0.6, 0.6, 1.0), wall),
    )
    return Room((1.8, 1.6, 1.2), dict.fromkeys(SIDES, wall), blocks)


def test_source_and_microphone_may_be_exchanged():
    one, other = np.array([0.9, 1.1, 0.9]), np.array([1.5, 0.3, 1.1])
    at = {"one": one, "other": other}
    lattices = [Lattice.of_point(point) for point in at.values()]
    settings = RoomSettings(400.0, longest_s=0.2)
    runs = room_transfer(_furnished(), lattices, at, np.linspace(60.0, 400.0, 30), settings)
    there, back = runs["one"].values[1].ravel(), runs["other"].values[0].ravel()
    assert np.abs(there - back).max() <= 1e-9 * np.abs(there).max()


def test_steps_keep_the_energy_and_walls_only_take():
    for share in (0.0, 0.3):
        room = _furnished(share)
        boxes = cut(room, 0.25)
        assert len(boxes) >= 2
        air = stable_air(boxes, faces(room, boxes), 1.0)
        weight = air.balance() ** 2
        air.terms[:] = np.random.default_rng(1).standard_normal(air.terms.size) / air.balance()
        air._before[:] = air.terms
        energy = []
        for _ in range(700):
            now = air.terms.copy()
            taken = air.operator(now)
            air.exchange()
            air.advance()
            energy.append(weight @ (air.terms - now) ** 2 + weight @ (air.terms * taken))
        energy = np.array(energy) / energy[0]
        if share:
            assert energy[-1] < 1e-3
            assert energy.max() < 1.5
        else:
            assert np.allclose(energy, 1.0, rtol=1e-9)


def test_the_time_step_is_bounded_by_the_largest_eigenvalue():
    room = _furnished(0.0)
    boxes = cut(room, 0.25)
    parts = faces(room, boxes)
    stable = stable_air(boxes, parts, 1.0)
    assert largest_eigenvalue(stable) <= 3.9
    longer = stable.time_step_s
    while largest_eigenvalue(air := Air(boxes, parts, longer)) < 4.3:
        longer *= 1.02
    for one, grows in ((stable, False), (air, True)):
        one.terms[:] = one._before[:] = np.random.default_rng(1).standard_normal(one.terms.size)
        for _ in range(300):
            one.exchange()
            one.advance()
        assert (np.abs(one.terms).max() > 1e6) == grows


def _local_thirds(room, settings, frequency, points, source, spacings):
    """Third octaves of the local scheme, extrapolated from two spacings.

    Around re-entrant edges both schemes err by the 4/3 power of the spacing, to the same side; ours
    takes its part off, so the local one must not keep its own.
    """
    coarse, fine = (
        _thirds(frequency, local_transfer(room, points, {"m": source}, frequency, h, settings)["m"])
        for h in spacings
    )
    ratio = (spacings[0] / spacings[1]) ** (4.0 / 3.0)
    return fine + (fine - coarse) / (ratio - 1.0)


def _second_method_db(room, settings, frequency, points, source, spacings):
    lattice = [Lattice(*points)]
    run = room_transfer(room, lattice, {"m": source}, frequency, settings)["m"]
    all_points = np.stack(np.meshgrid(*points, indexing="ij"), axis=-1).reshape(-1, 3)
    local = _local_thirds(room, settings, frequency, all_points, source, spacings)
    difference = _thirds(frequency, run.values[0].reshape(frequency.size, -1)) - local
    return np.sqrt(np.mean(difference**2, axis=1))


def test_the_local_scheme_agrees_in_a_furnished_room():
    settings = RoomSettings(250.0, nodes_per_wave=20.0, longest_s=0.25)
    points = [np.array([0.75, 1.05, 1.55]), np.array([0.75, 1.15, 1.45]), np.array([0.95, 1.05])]
    frequency = np.arange(80.0, 250.1, 2.0)
    source = np.array([0.25, 1.25, 0.35])
    rms = _second_method_db(_furnished(), settings, frequency, points, source, (0.05, 1.0 / 30.0))
    assert rms.max() <= 0.2


@pytest.mark.long
def test_the_local_scheme_agrees_for_a_source_in_a_niche():
    wall = _uniform(0.1)
    blocks = (
        Block("left", (0.0, 0.0, 0.0), (0.6, 0.6, 0.9), wall),
        Block("right", (1.2, 0.0, 0.0), (1.8, 0.6, 0.9), wall),
        Block("worktop", (0.6, 0.0, 0.75), (1.2, 0.6, 0.9), wall),
    )
    room = Room((1.8, 1.6, 1.5), dict.fromkeys(SIDES, wall), blocks)
    nodes_per_wave = SPEED_OF_SOUND_M_PER_S / 0.098 / 450.0
    settings = RoomSettings(450.0, nodes_per_wave, longest_s=0.5)  # the spacing of 1 kHz
    points = [np.array([0.75, 1.05, 1.55]), np.array([0.85, 1.15, 1.45]), np.array([0.95, 1.25])]
    frequency = np.arange(80.0, 450.0, 2.0)
    source = np.array([0.95, 0.35, 0.35])
    rms = _second_method_db(room, settings, frequency, points, source, (0.05, 0.025))
    assert rms.max() <= 0.2


@pytest.mark.long
def test_the_local_scheme_agrees_in_a_kitchen():
    board = _material("boards", 0.15, 0.15, 0.11, 0.10, 0.07)
    plaster, tiles = SIX[0], SIX[4]
    blocks = (
        Block("worktop", (0.6, 0.0, 0.0), (4.0, 0.6, 0.9), board),
        Block("cupboard", (1.0, 0.0, 1.5), (3.0, 0.3, 2.1), board),
        Block("fridge", (0.0, 0.0, 0.0), (0.6, 0.6, 1.8), board),
    )
    room = Room(LARGE, dict.fromkeys(SIDES, plaster) | {"floor": tiles}, blocks)
    settings = RoomSettings(450.0, nodes_per_wave=343.0 / 45.0, longest_s=0.8)
    points = [
        np.array([0.45, 1.25, 2.05, 2.75, 3.55]),
        np.array([1.05, 1.55, 2.15, 2.65]),
        np.array([1.05, 1.55, 2.15]),
    ]
    frequency = np.arange(55.0, 450.1, 1.0)
    source = np.array([2.05, 1.45, 0.75])
    # Cells of 50 and 33 mm would themselves err by 0.45 dB in the highest third octave.
    rms = _second_method_db(room, settings, frequency, points, source, (1.0 / 30.0, 0.025))
    assert _rms(rms) <= 0.2


def test_halving_the_spacing_tells_the_error(small_room):
    settings = RoomSettings(300.0, nodes_per_wave=3.5, longest_s=0.5)
    lattices = [Lattice.of_point(point) for point in small_room.points]
    chosen = small_room.frequency[::4]
    chosen = chosen[chosen <= 300.0]
    rows = np.isin(small_room.frequency, chosen)
    of = (small_room.room, lattices, {"m": small_room.source}, chosen, settings)
    published_db = spacing_error_db(*of)["m"]
    run = room_transfer(*of)["m"]
    green = np.concatenate([one.reshape(-1, 1) for one in run.values], axis=1)
    true_db = level_of_power(np.abs(green / small_room.exact[rows]) ** 2)
    assert np.corrcoef(published_db.ravel(), true_db.ravel())[0, 1] > 0.5
    assert 0.5 <= _rms(published_db) / _rms(true_db) <= 2.0
