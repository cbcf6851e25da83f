"""Results beside published values of the machine."""

from ..base.hashing import canonical_json
from ..base.registry import register
from ..uncertainty.validation import validation_variables
from .chain import Chain
from .stage import Given, Stage


@register
class Validation(Stage):
    """Error and uncertainty of results of which a value is published."""

    name = "validation"
    reads = (
        "level_modelled", "level_modelled_nominal", "force_order", "prior_sample_*", "shell_weight",
        "transfer_vector", "transfer_vector_error", "pattern_transfer_vector*",
    )  # fmt: skip
    gives = ("evidence_*",)

    def run(self, chain: Chain) -> Given:
        parameters = canonical_json(chain.study.parameters())
        return Given(validation_variables(chain.results.assign_attrs(parameters=parameters)))
