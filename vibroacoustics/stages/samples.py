"""All cases with the samples that go on."""

from ..base.registry import register
from ..levels.labelled import draw_variables
from ..levels.remainder import remainder_by_draw, remaining_by_draw
from ..study.study import Study
from ..transfer.received import Transmission
from ..uncertainty.bank import Bank
from ..uncertainty.draws import drawn_values
from ..uncertainty.first_order import first_order_by_draw
from ..uncertainty.share_variables import change_shares
from .chain import Cases, Chain
from .cost_of_samples import cost_of_samples
from .levels import NominalSound
from .paths import PublishedCases, with_published
from .sampled import sounds_of
from .stage import Given, Stage, Trial


@register
class Samples(Stage):
    """Levels, changes and forces of all cases with the samples that go on."""

    name = "samples"
    reads = (
        Cases, PublishedCases, Transmission, NominalSound, Bank, "force_amplitude",
        "moment_amplitude", "foot_force_amplitude",
    )  # fmt: skip
    gives = (
        "level_total_by_draw", "level_modelled_by_draw", "level_remainder_by_draw",
        "source_level_by_draw", "force_1x_by_draw", "moment_1x_by_draw", "foot_force_1x_by_draw",
        "draw_weight", "drawn_value", "change_share", "change_share_quality", "change_variance",
    )  # fmt: skip

    def applies(self, study: Study) -> bool:
        return bool(study.ranges)

    def run(self, chain: Chain) -> Given:
        study, ensemble, axes = chain.study, chain[Bank], chain[NominalSound].axes
        if not ensemble.suffices:
            return Given()
        index, weight = ensemble.chosen(study.uncertainty.seed)
        samples = [ensemble.draws[number] for number in index]

        def done(number: int) -> None:
            chain.progress("sources", number, len(samples))

        sampled = sounds_of(with_published(chain), samples, done)
        sounds = [of_sample.sound for of_sample in sampled]
        unmodelled = remainder_by_draw(study, ensemble.modelled_db[index])
        left = remaining_by_draw(study, axes, sounds, samples, unmodelled[0])
        levels = draw_variables(axes, sounds, left, unmodelled, weight, ensemble.prior_names)
        of_first = [of_sample.first_order for of_sample in sampled]
        levels = levels.merge(first_order_by_draw(of_first, chain.results))
        levels = levels.merge(drawn_values(study.ranges, samples))
        return Given(levels.merge(change_shares(study, levels)))

    def tried(self, chain: Chain, study: Study) -> Trial:
        return Trial(chain, (cost_of_samples(with_published(chain), study),))
