"""The chain of one study: its results so far and the typed products that stages hand on."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from typing import TypeVar, cast

import xarray as xr

from ..base.errors import PluginError
from ..base.progress import Progress, no_progress
from ..machine.source import Case, CaseKey
from ..mechanics.loads import Loads, PortLoads
from ..radiation.given import Radiation
from ..study.sampling import Draw
from ..study.study import Study
from ..transfer.received import Transmission
from ..uncertainty.drawn import drawn_cases

Product = TypeVar("Product")


@dataclass(frozen=True)
class Cases:
    """Speeds and options of a study with the loads of all sources.

    Attributes
    ----------
    cases : by speed and option, without time series
    loads : by speed and option, then by source, without wrenches, which the results hold
    wrenches : lines of the wrenches over crank angle, by speed and option, then by source

    Examples
    --------
    A stage reads the loads of a speed and an option:

    >>> class GasTorque(va.Stage):
    ...     name = "gas-torque"
    ...     reads = (va.Cases,)
    ...     def run(self, chain):
    ...         by_source = chain[va.Cases].loads[2900.0, "none"]
    ...         print(by_source["gas"].shaft_torque_n_m)
    ...         return va.Given()
    """

    cases: dict[CaseKey, Case]
    loads: dict[CaseKey, dict[str, Loads]]
    wrenches: dict[CaseKey, dict[str, PortLoads]]


@dataclass(frozen=True)
class Chain:
    """A study on its way from the machine's parameters to scores.

    Attributes
    ----------
    study : with speeds, options and sources
    radiation : callable that gives the transfer vectors
    progress : called with the advance of long work
    results : all variables so far
    products : what is not stored, by its type

    Examples
    --------
    >>> study = va.load_study("pipelines/copeland_thesis.toml")
    >>> frequency = np.arange(25.0, 2501.0, 25.0)
    >>> vectors = 1e-4j * frequency * np.ones((len(study.receivers), 6, 1))  # made up
    >>> chain = va.Chain(study, va.given_radiation(vectors, frequency))
    >>> chain.get(va.Cases) is None
    True
    >>> chain.having(va.Cases({}, {}, {}))[va.Cases].loads
    {}
    """

    study: Study
    radiation: Radiation
    progress: Progress = no_progress
    results: xr.Dataset = field(default_factory=xr.Dataset)
    products: Mapping[type, object] = field(default_factory=dict)

    def __getitem__(self, kind: type[Product]) -> Product:
        """Return the product of a type.

        Raises
        ------
        PluginError
            No stage has given it.
        """
        if kind not in self.products:
            raise PluginError(f"{kind.__name__}: no stage of this study gives it")
        return cast(Product, self.products[kind])

    def get(self, kind: type[Product]) -> Product | None:
        """Return the product of a type; None where no stage of this study gives it."""
        return cast("Product | None", self.products.get(kind))

    def having(self, *products: object, results: xr.Dataset | None = None) -> "Chain":
        """Return the chain with further products and with other results.

        Parameters
        ----------
        results : in place of those so far
        products : each takes the place of one of its type
        """
        further = {type(product): product for product in products}
        kept = self.results if results is None else results
        return replace(self, products={**self.products, **further}, results=kept)

    def limited(self, reads: Collection[str | type]) -> "Chain":
        """Return the chain with some variables and products alone; coordinates stay.

        Parameters
        ----------
        reads : names of variables and types of products
        """
        others = [name for name in self.results.data_vars if name not in reads]
        products = {kind: product for kind, product in self.products.items() if kind in reads}
        return replace(self, results=self.results.drop_vars(others), products=products)

    def at(self, sample: Draw) -> "Chain":
        """Return the chain with the cases, loads and paths of one sample, and nominal results.

        Parameters
        ----------
        sample : values by table and field

        Raises
        ------
        ParameterError, SolverError
            A machine cannot run so, an option cannot be built, or a source cannot act.
        """
        path = self[Transmission]
        of = drawn_cases(self[Cases].cases, self.study, sample)
        wrenches = {**path.wrenches, **of.wrenches}
        sampled = Cases(of.cases, of.loads, of.wrenches)
        return self.having(sampled, replace(path, wrenches=wrenches), of)
