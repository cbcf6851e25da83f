"""Order of the stages, what they may give, and the chain that they work on."""

import pytest

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


def stage(name, reads=(), gives=(), given=None):
    """A stage that returns what it is asked to return."""

    class Made(Stage):
        def run(self, chain):
            return given

    Made.name, Made.reads, Made.gives = name, reads, gives
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


def test_the_room_follows_the_samples_whose_bands_it_gives():
    """Without a plate under the feet nothing else puts it behind them."""
    order = names(kind() for kind in STAGES.values() if kind.name != "structure-borne")
    assert order.index("samples") < order.index("room")
