"""Which values of tables are read: fields, hashes and dumps, copies not."""

import threading

from vibroacoustics.base.field_reads import recorded_reads, unrecorded_reads, watched
from vibroacoustics.base.parameters import Parameters
from vibroacoustics.study.samples import _replaced


class Wheel(Parameters):
    """A wheel."""

    mass_kg: float
    radius_m: float

    @property
    def inertia_kg_m2(self) -> float:
        """Of a ring."""
        return self.mass_kg * self.radius_m**2

    def contradictions(self):
        if self.radius_m > 1.0:
            yield "radius_m: too large"


class Cart(Parameters):
    """A cart."""

    wheel: Wheel
    length_m: float


CART = Cart(wheel=Wheel(mass_kg=2.0, radius_m=0.5), length_m=3.0)
LABELS = {("wheel", "mass_kg"): "mass", ("length_m",): "length"}


def read_by(function, table=None):
    """Labels of what a function of the watched cart reads."""
    cart = watched(CART, LABELS) if table is None else table
    with recorded_reads() as reads:
        function(cart)
    return reads


def test_fields_are_read_one_by_one_and_by_properties():
    assert read_by(lambda cart: cart.length_m) == {"length"}
    assert read_by(lambda cart: cart.wheel) == set()
    assert read_by(lambda cart: cart.wheel.radius_m) == set()  # not watched
    assert read_by(lambda cart: cart.wheel.inertia_kg_m2) == {"mass"}


def test_what_takes_all_fields_reads_all():
    for function in (hash, Cart.model_dump, Cart.model_dump_json):
        assert read_by(function) == {"mass", "length"}
    assert read_by(dict) == {"length"}  # the wheel as it is
    assert read_by(lambda cart: cart == watched(CART, LABELS)) == {"mass", "length"}


def test_copies_read_nothing_and_are_watched_too():
    cart = watched(CART, LABELS)
    copies = []
    for copied in (lambda one: one.model_copy(update={"length_m": 4.0}),
                   lambda one: _replaced(one, {"length_m": 5.0})):  # fmt: skip
        assert read_by(lambda one, made=copied: copies.append(made(one)), cart) == set()
    for copy, length_m in zip(copies, (4.0, 5.0), strict=True):
        assert read_by(lambda one: one.length_m, copy) == {"length"}
        assert copy.length_m == length_m
    with recorded_reads() as reads, unrecorded_reads():
        _ = cart.length_m
    assert reads == set()


def test_equal_tables_are_equal_and_other_threads_count():
    assert watched(CART, LABELS) == watched(CART, LABELS)
    assert hash(watched(CART, LABELS)) == hash(CART)
    assert isinstance(watched(CART, LABELS).wheel, Wheel)

    def elsewhere(cart):
        thread = threading.Thread(target=lambda: cart.length_m)
        thread.start()
        thread.join()

    assert read_by(elsewhere) == {"length"}
