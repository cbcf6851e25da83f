"""Whether a dataset is a run of which a report and a score can be made, by what it must hold."""

import json
from typing import Any, Final

import xarray as xr
from pydantic import TypeAdapter, ValidationError

from ..base.errors import SchemaError
from ..base.plain_bytes import sha256
from ..base.vocabulary import PUBLISHED_SHARE
from .estimates import has_samples
from .run_attributes import JSON_ATTRIBUTES, Parameters, Words
from .run_variables import check_variables

LONGEST_REASON: Final = 200


def check_run(results: xr.Dataset) -> None:
    """Refuse what is no complete run.

    Raises
    ------
    SchemaError
        A variable, coordinate or attribute is missing, empty or cannot be right.
    """
    check_variables(results)
    if not isinstance(results.attrs.get("created_utc"), str):
        raise SchemaError("attribute created_utc is missing or no text")
    parameters: Parameters = read_attribute(results, "parameters", Parameters)
    words: Words = read_attribute(results, "words", Words)
    for name, kind in JSON_ATTRIBUTES.items():
        if name in results.attrs:
            read_attribute(results, name, kind)
    _check_hash(results)
    _check_names(results, parameters, words)
    _check_parts(results, parameters)


def read_attribute(results: xr.Dataset, name: str, kind: Any) -> Any:
    """A JSON attribute, checked to be of a kind.

    Raises
    ------
    SchemaError
        It is missing, no JSON, or lacks something.
    """
    try:
        read = json.loads(results.attrs[name])
        json.dumps(read, ensure_ascii=False).encode()  # half a character cannot be written
        return TypeAdapter(kind).validate_python(read)
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(map(str, first["loc"]))
        reason = f"{where}: {first['msg']}"[:LONGEST_REASON]
        raise SchemaError(f"attribute {name}: {reason}") from None
    except (LookupError, ValueError, TypeError, RecursionError):
        raise SchemaError(f"attribute {name} is missing or no JSON") from None


def _check_hash(results: xr.Dataset) -> None:
    digest = sha256(results.attrs["parameters"].encode())
    if results.attrs.get("parameters_sha256", digest) != digest:
        raise SchemaError("attribute parameters does not fit its hash, parameters_sha256")


def _check_names(results: xr.Dataset, parameters: Parameters, words: Words) -> None:
    """Options and receivers of the variables are those of parameters and words."""
    options, receivers = (set(results[dim].values.tolist()) for dim in ("option", "receiver"))
    for names, present, where in (
        (receivers, parameters.receivers, "parameters: receivers"),
        (options, words.sentences, "words: sentences"),
    ):
        if not names <= present.keys():
            raise SchemaError(f"attribute {where}: not those of the variables")
    if parameters.catalogue_receiver not in receivers:
        raise SchemaError("attribute parameters: catalogue_receiver is no receiver")


def _check_parts(results: xr.Dataset, parameters: Parameters) -> None:
    """Tables of the parameters that certain results come from."""
    machine = parameters.machine
    redesigned = (option.machine for option in parameters.options.values())
    suspended = all(case.suspension for case in (machine, *filter(None, redesigned)))
    has_block = "block_velocity_order" in results or "block" in results["body"].values
    alone = results.sizes["sound_source"] == 1
    noise = machine.overall_noise
    has_share = "datum" in results and PUBLISHED_SHARE in results["datum"].values
    needed = {
        "ranges": parameters.ranges is not None or not has_samples(results),
        "options": not has_block
        or set(results["option"].values.tolist()) <= parameters.options.keys(),
        "machine.suspension": not has_block or suspended,
        "machine.stopping": machine.stopping or "stopping_force" not in results,
        "scoring.published": parameters.scoring.published or "published_score" not in results,
        "machine.overall_noise.spectral_share": not has_share
        or (noise is not None and noise.spectral_share is not None),
        "radiation.maximum_frequency_hz": alone
        or parameters.radiation.maximum_frequency_hz is not None,
    }
    for name, is_there in needed.items():
        if not is_there:
            raise SchemaError(f"attribute parameters: {name}: does not fit the variables")
