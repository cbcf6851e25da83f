"""Order of the stages, what they may give, and the chain that they work on."""

import pytest
import xarray as xr

from vibroacoustics.base.errors import PluginError
from vibroacoustics.base.vocabulary import stamp
from vibroacoustics.machine.cases import Cases
from vibroacoustics.stages.chain import Chain
from vibroacoustics.stages.stage import (
    EVERYTHING,
    STAGES,
    Given,
    Stage,
    advanced,
    ordered,
)


def stage(name, reads=(), gives=(), given=None, estimates=()):
    """A stage that returns what it is asked to return."""

    class Made(Stage):
        def run(self, chain):
            return given

    Made.name, Made.reads, Made.gives, Made.estimates = name, reads, gives, estimates
    return Made()


def names(stages):
    return [one.name for one in ordered(stages)]


def test_a_stage_follows_those_that_give_what_it_reads():
    chain = [stage("a", ("level_total",)), stage("b", (Cases,), ("level_total",))]
    assert names([*chain, stage("c", (), (Cases,))]) == ["c", "b", "a"]


def test_stages_that_do_not_depend_on_each_other_go_by_name():
    assert names([stage("b"), stage("a"), stage("c")]) == ["a", "b", "c"]


def test_what_no_stage_gives_is_not_waited_for():
    assert names([stage("b"), stage("a", ("level_total",))]) == ["a", "b"]


def test_a_stage_that_reads_everything_is_last_but_for_those_that_read_it():
    first = stage("a", (EVERYTHING,), ("score",))
    assert names([first, stage("b"), stage("z", ("score",))]) == ["b", "a", "z"]


def test_a_circle_is_refused_with_its_stages():
    one, other = stage("a", ("score",), ("rank",)), stage("b", ("rank",), ("score",))
    with pytest.raises(PluginError, match="stages a, b: read what each other gives"):
        ordered([stage("c"), one, other])


def test_two_stages_cannot_give_the_same():
    with pytest.raises(PluginError, match="stage b: Cases is given by a already"):
        ordered([stage("a", (), (Cases,)), stage("b", (), (Cases,))])


def test_what_a_stage_does_not_name_is_refused():
    shown = stamp("level_unmodelled", 50.0).to_dataset()
    chain = Chain(None, None)
    with pytest.raises(
        PluginError, match="stage a: gives level_unmodelled, which it does not name"
    ):
        advanced(chain, stage("a", given=Given(shown)))
    with pytest.raises(PluginError, match="stage a: gives Cases, which it does not name"):
        advanced(chain, stage("a", given=Given(products=(Cases({}, {}, {}),))))


def test_products_are_found_by_type():
    cases = Cases({}, {}, {})
    chain = advanced(Chain(None, None), stage("a", (), (Cases,), Given(products=(cases,))))
    assert chain[Cases] is cases
    assert chain.get(Given) is None
    with pytest.raises(PluginError, match="Given: no stage of this study gives it"):
        chain[Given]


def test_a_pattern_gives_what_fits_and_a_name_goes_before_it():
    pattern, name = stage("c", (), ("room_*",)), stage("b", (), ("room_limit",))
    assert names([stage("a", ("room_level",)), pattern, name]) == ["b", "c", "a"]
    assert names([stage("a", ("room_*",)), pattern, name]) == ["b", "c", "a"]
    assert names([stage("a", ("room_limit",)), pattern, name]) == ["b", "a", "c"]


def test_a_pattern_lets_a_stage_give_and_read_what_fits_alone():
    shown = stamp("level_unmodelled", 50.0).to_dataset()
    chain = advanced(Chain(None, None), stage("a", (), ("level_*",), Given(shown)))
    assert list(chain.limited(("level_unm*",)).results) == ["level_unmodelled"]
    assert list(chain.limited(("room_*",)).results) == []
    with pytest.raises(
        PluginError, match="stage a: gives level_unmodelled, which it does not name"
    ):
        advanced(Chain(None, None), stage("a", (), ("room_*",), Given(shown)))


def test_readers_of_what_a_stage_estimates_come_after_it():
    levels = stage("a", gives=("level_total", "source_level"))
    estimating = stage("z", ("level_total",), ("sample_weight",), estimates=("level_total",))
    readers = [stage("b", ("level_total",)), stage("c", ("source_level",)), stage("d", ("level*",))]
    order = names([levels, estimating, *readers])
    assert order == ["a", "c", "z", "b", "d"]


def test_a_stage_that_the_estimating_one_needs_stays_before_it():
    """It gets the nominal values, directly or by another stage."""
    levels = stage("a", gives=("level_total",))
    before = stage("c", ("level_total",), ("rank",))
    further = stage("b", ("rank",), (Cases,))
    estimating = stage("e", (Cases,), estimates=("level_total",))
    after = stage("d", ("level_total",))
    assert names([levels, before, further, estimating, after]) == ["a", "c", "b", "e", "d"]


def test_a_second_estimating_stage_that_reads_the_first_ones_estimates_follows_it():
    levels = stage("a", gives=("level_total", "change_total"))
    first = stage("z", ("level_total",), ("sample_weight",), estimates=("level_total",))
    second = stage("b", ("level_total", "sample_weight"), estimates=("change_total",))
    reader = stage("c", ("change_total",))
    assert names([levels, first, second, reader]) == ["a", "z", "b", "c"]


def test_estimates_take_the_place_of_nominal_values_which_stay_beside_them():
    parts = {
        name: stamp(name, value)
        for name, value in (("level_unmodelled", 51.0), ("level_unmodelled_10_percent", 48.0),
                            ("level_unmodelled_90_percent", 53.0))
    }  # fmt: skip
    chain = Chain(None, None).having(results=stamp("level_unmodelled", 50.0).to_dataset())
    statistics = xr.Dataset(parts)
    given = Given(estimates=statistics)
    results = advanced(chain, stage("a", given=given, estimates=("level_unmodelled",))).results
    found = {name: results[f"level_unmodelled{name}"].item()
             for name in ("", "_10_percent", "_90_percent", "_nominal")}  # fmt: skip
    assert found == {"": 51.0, "_10_percent": 48.0, "_90_percent": 53.0, "_nominal": 50.0}


def test_estimates_that_a_stage_does_not_name_are_refused():
    given = Given(estimates=stamp("level_unmodelled", 50.0).to_dataset())
    with pytest.raises(PluginError, match="a: estimates level_unmodelled, which it does not name"):
        advanced(Chain(None, None), stage("a", given=given, estimates=("level_total",)))


def test_stages_of_the_package_that_read_estimates_follow_the_samples():
    order = names(kind() for kind in STAGES.values())
    assert order.index("levels") < order.index("ensemble") < order.index("samples")
    assert order.index("samples") < order.index("representative")
    assert order.index("samples") < order.index("contributions")
    for name in ("scores", "stopping", "room"):
        assert order.index("representative") < order.index(name), name


def test_the_room_follows_the_samples_whose_bands_it_gives():
    """Without a plate under the feet nothing else puts it behind them."""
    order = names(kind() for kind in STAGES.values() if kind.name != "structure-borne")
    assert order.index("samples") < order.index("room")
