"""The chain of one study: its results so far and the typed products that stages hand on."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from typing import TypeVar, cast

import xarray as xr

from ..base.errors import PluginError
from ..base.patterns import is_among
from ..base.progress import Progress, no_progress
from ..machine.cases import Cases
from ..radiation.given import Radiation
from ..study.sampling import Sample
from ..study.study import Study
from ..uncertainty.sampled_cases import sampled_cases

Product = TypeVar("Product")


@dataclass(frozen=True)
class Chain:
    """A study on its way from the machine's parameters to scores.

    Attributes
    ----------
    study : with speeds, options and sources
    radiation : callable that gives the transfer vectors
    progress : called with the advance of long work
    results : all variables so far
    products : things that are not stored, by their type

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

    def __getstate__(self) -> dict[str, object]:
        """Return what goes to other processes: all but the progress."""
        return {**self.__dict__, "progress": no_progress}

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
        reads : names or patterns of variables, and types of products
        """
        others = [name for name in self.results.data_vars if not is_among(str(name), reads)]
        products = {kind: product for kind, product in self.products.items() if kind in reads}
        return replace(self, results=self.results.drop_vars(others), products=products)

    def at(self, sample: Sample) -> "Chain":
        """Return the chain with the cases and loads of one sample, and nominal results.

        Parameters
        ----------
        sample : values by table and field

        Raises
        ------
        ParameterError, SolverError
            A machine cannot run so, an option cannot be built, or a source cannot act.
        """
        return self.having(sampled_cases(self[Cases], self.study, sample))
