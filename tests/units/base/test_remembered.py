"""A function of a dataset is called once for each dataset, and forgets those that are gone."""

import gc

import xarray as xr

from vibroacoustics.base.remembered import remembered


def test_called_once_for_each_dataset_and_argument():
    calls = []

    @remembered
    def size(dataset: xr.Dataset, factor: int = 1) -> int:
        calls.append(factor)
        return factor * dataset.sizes["x"]

    short, long = (xr.Dataset(coords={"x": range(number)}) for number in (2, 3))
    assert [size(short), size(short), size(long), size(short, 5), size(short, factor=5)] == [
        2, 2, 3, 10, 10,
    ]  # fmt: skip
    assert calls == [1, 1, 5, 5]


def test_a_dataset_that_is_gone_leaves_nothing():
    alive = []

    @remembered
    def same(dataset: xr.Dataset) -> xr.Dataset:
        return dataset

    @remembered
    def held(dataset: xr.Dataset) -> object:
        alive.append(1)
        return object()

    for _ in range(3):
        dataset = xr.Dataset(coords={"x": [1]})
        assert same(dataset) is dataset
        held(dataset)
        del dataset
        gc.collect()
    assert len(alive) == 3
