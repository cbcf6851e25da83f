"""A stage of the chain, the registry of stages, and the order that follows from what they read."""

import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import ClassVar, Final, NamedTuple

import xarray as xr

from ..base.errors import ParameterError, PluginError
from ..base.patterns import is_among, is_pattern
from ..base.registry import Registry
from ..base.vocabulary import VARIABLES, check
from ..radiation.cost import Cost, about
from ..results.estimates import estimated
from ..study.study import Study
from .chain import Chain

EVERYTHING: Final = "*"
"""Among what a stage reads: all variables that other stages give."""


@dataclass(frozen=True)
class Given:
    """Results of a stage.

    Attributes
    ----------
    results : variables of the vocabulary
    products : typed things that are not stored
    estimates : statistics of samples that take the place of nominal values

    Examples
    --------
    >>> level = va.stamp("level_total", [[[54.2]]],
    ...                  {"speed": [2900.0], "option": ["none"], "receiver": ["front_1m"]})
    >>> list(va.Given(level.to_dataset()).results)
    ['level_total']
    """

    results: xr.Dataset = field(default_factory=xr.Dataset)
    products: tuple[object, ...] = ()
    estimates: xr.Dataset = field(default_factory=xr.Dataset)


class Stage:
    """A step of the chain, in a file of `stages` or of a plug-in.

    Names or patterns of variables and types of products say what it reads and gives; the order of
    all stages follows from them. What it reads may be missing where no stage of the study gives it.

    Examples
    --------
    >>> class Total(va.Stage):
    ...     name = "total"
    ...     reads = ("level_total",)
    ...     gives = ("level_of_total",)
    """

    name: ClassVar[str]
    reads: ClassVar[tuple[str | type, ...]] = ()
    gives: ClassVar[tuple[str | type, ...]] = ()
    estimates: ClassVar[tuple[str, ...]] = ()
    """Variables of other stages whose nominal values it replaces by statistics of samples; stages
    that read them come after it, but for those whose things it reads itself."""
    is_tried: ClassVar[bool] = False
    """Whether a trial runs it at the first speed."""

    def applies(self, study: Study) -> bool:
        """Return whether the study asks for this stage."""
        return True

    def run(self, chain: Chain) -> Given:
        """Compute the variables and products that the stage gives.

        Parameters
        ----------
        chain : the study, with results and products of the stages before

        Raises
        ------
        ParameterError, SolverError, StorageError
            An input is out of range, a computation failed, or a file cannot be read.
        """
        raise NotImplementedError

    def tried(self, chain: Chain, study: Study) -> "Trial":
        """Run at the first speed, or not at all, and say what a run at all speeds will cost.

        Parameters
        ----------
        chain : at the first speed
        study : at all speeds
        """
        return timed(chain, self) if self.is_tried else Trial(chain)


class Trial(NamedTuple):
    """A stage tried at the first speed.

    Attributes
    ----------
    chain : with what the stage gave, if it was run
    costs : costs of the stage at all speeds; empty where it costs little
    """

    chain: Chain
    costs: tuple[Cost, ...] = ()


STAGES: Final[Registry[type[Stage]]] = Registry(
    "stage", Stage, "name", "stages", "vibroacoustics.stages"
)


def applying(study: Study) -> list[Stage]:
    """Return the stages that a study of one machine asks for, in their order."""
    if study.machines:
        raise ParameterError("machines: several machines run by `run_machines` and the command run")
    stages = []
    for name, kind in STAGES.items():
        with STAGES.spared(), STAGES.fenced(name):
            stage = kind()
            if stage.applies(study):
                stages.append(stage)
    return ordered(stages)


def ordered(stages: Iterable[Stage]) -> list[Stage]:
    """Sort stages so that each follows those that give what it reads, else by name.

    Raises
    ------
    PluginError
        Two stages give the same, or stages read what each other gives.
    """
    waiting = sorted(stages, key=lambda stage: stage.name)
    givers = _givers(waiting)
    before = {stage.name: _before(stage, waiting, givers) for stage in waiting}
    for stage in waiting:
        _after_estimates(stage, waiting, givers, before)
    done: list[Stage] = []
    while waiting:
        names = {stage.name for stage in waiting}
        ready = next((stage for stage in waiting if not before[stage.name] & names), None)
        if ready is None:
            raise PluginError(f"stages {', '.join(sorted(names))}: read what each other gives")
        waiting.remove(ready)
        done.append(ready)
    return done


def needed_for(product: type, stages: Sequence[Stage]) -> list[Stage]:
    """Return the stages that a product follows from and the one that gives it, in their order."""
    givers = _givers(stages)
    waiting, names = {givers.get(product, "")}, set()
    while waiting:
        names |= waiting
        read = (_before(stage, stages, givers) for stage in stages if stage.name in waiting)
        waiting = set().union(*read) - names
    return [stage for stage in stages if stage.name in names]


def _givers(stages: Iterable[Stage]) -> dict[str | type, str]:
    """Name of the stage that gives each thing; a name goes before a pattern that it fits."""
    givers: dict[str | type, str] = {}
    things = [(thing, stage.name) for stage in stages for thing in stage.gives]
    for thing, name in things:
        other = givers.setdefault(thing, name)
        if other != name:
            raise PluginError(f"stage {name}: {_word(thing)} is given by {other} already")
    patterns = [(thing, name) for thing, name in things if is_pattern(thing)]
    for variable in VARIABLES:
        fitting = (name for pattern, name in patterns if is_among(variable, (pattern,)))
        givers.setdefault(variable, next(fitting, ""))
    return givers


def _before(stage: Stage, stages: Iterable[Stage], givers: Mapping[str | type, str]) -> set[str]:
    """Names of the stages that give what one reads."""
    read = _read(stage, givers)
    if EVERYTHING in stage.reads:
        read |= {other.name for other in stages if stage.name not in _read(other, givers)}
    return read - {stage.name}


def _after_estimates(
    estimating: Stage,
    stages: Iterable[Stage],
    givers: Mapping[str | type, str],
    before: dict[str, set[str]],
) -> None:
    """Put the readers of what a stage estimates after it, unless it needs them itself."""
    ancestors, further = {estimating.name}, before[estimating.name]
    while further - ancestors:
        ancestors |= further
        further = set().union(*(before[name] for name in further if name in before))
    estimated = [name for name in VARIABLES if is_among(name, estimating.estimates)]
    for stage in stages:
        if stage.name not in ancestors and any(is_among(name, stage.reads) for name in estimated):
            before[stage.name].add(estimating.name)


def _read(stage: Stage, givers: Mapping[str | type, str]) -> set[str]:
    """Names of the stages that give what one names among its reads."""
    named = [thing for thing in stage.reads if thing != EVERYTHING]
    patterns = [thing for thing in named if is_pattern(thing)]
    fitting = {giver for thing, giver in givers.items() if patterns and is_among(thing, patterns)}
    return fitting.union(givers[thing] for thing in named if thing in givers)


def _word(thing: str | type) -> str:
    return thing if isinstance(thing, str) else thing.__name__


def advanced(chain: Chain, stage: Stage) -> Chain:
    """Run one stage and return the chain with what it gives.

    The stage gets what it names among its reads, so that one that it forgets is missing in every
    run, not only where the stage that gives it comes later.
    """
    with STAGES.fenced(stage.name):
        return _advanced(chain, stage)


def _advanced(chain: Chain, stage: Stage) -> Chain:
    output = stage.run(chain if EVERYTHING in stage.reads else chain.limited(stage.reads))
    if STAGES.origin(stage.name):
        _check_variables(output.results)
    names: list[str | type] = [str(name) for name in output.results.data_vars]
    for thing in names + [type(product) for product in output.products]:
        if not is_among(thing, stage.gives):
            raise PluginError(f"stage {stage.name}: gives {_word(thing)}, which it does not name")
    for name in map(str, output.estimates.data_vars):
        if not any(name == base or name.startswith(f"{base}_") for base in stage.estimates):
            raise PluginError(f"stage {stage.name}: estimates {name}, which it does not name")
    results = estimated(chain.results, output.estimates)
    if output.results.variables:  # a merge copies all that is there
        results = results.merge(output.results)
    return chain.having(*output.products, results=results)


def _check_variables(results: xr.Dataset) -> None:
    """Refuse what a stage of a plug-in may not give: other dims or units, no finite numbers."""
    for name, array in check(results).data_vars.items():
        VARIABLES[str(name)].check_numbers(array)


def timed(chain: Chain, stage: Stage, speeds: int = 1) -> Trial:
    """Run a stage at the first speed; at each further one it takes as long."""
    start = time.process_time()
    after = advanced(chain, stage)
    seconds = time.process_time() - start
    how = "measured" if speeds == 1 else f"{speeds} speeds, one measured"
    return Trial(after, (about(stage.name, seconds, how, speeds),))
