"""The published level is met at its own operating point, whatever the study's is."""

import pytest
from sources_study import SOURCES_STUDY, run_made_up

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.report.sections.assumptions import unmodelled_sentence
from vibroacoustics.report.sections.sources.words import samples_sentence
from vibroacoustics.study.loading import load_study

GAS_ALONE = {
    **{f"sources.{name}": None for name in ("keys", "torque_ripple", "motor")},
    **{f"options.{name}": None for name in ("counterweight-half", "twin-oldham", "damping")},
    "operation.stopping": False,
    "operation.supply_frequency_hz": None,
    "machine.gas.opening_law": "inertia",
    "machine.overall_noise.level_dba": 90.0,
    "uncertainty.seed": 8,
}
BY_SAMPLE = ("level_unmodelled_by_sample", "sample_weight", "prior_sample_level")


@pytest.fixture(scope="module")
def study():
    return load_study(SOURCES_STUDY).replace(GAS_ALONE)


@pytest.fixture(scope="module")
def at_ari(study):
    """Without the index's range: what is sampled is then the same at both points."""
    return run_made_up(study.replace({"operation.point": "ari"}))


def test_remainder_is_that_of_the_point_of_the_published_level(study, at_ari):
    """It is the same at both points, as given and in each sample; what the machine makes is not."""
    here = study.replace({"catalogue_point": "ari"})
    assert here.catalogue_machine.gas.discharge_pressure_pa == pytest.approx(33.86e5)
    values = {
        "value": 1.067,
        "source": "test",
    }  # and with it, not of it, the same values are sampled
    results = run_made_up(here.replace({"machine.gas.polytropic_index": values}))
    assert results["level_unmodelled"].item() == pytest.approx(at_ari["level_unmodelled"].item())
    for name in BY_SAMPLE:
        assert results[name].values == pytest.approx(at_ari[name].values, rel=1e-9), name
    off = results["level_modelled"].values - at_ari["level_modelled"].values
    assert abs(off).max() > 1.0
    assert list(results["option"].values) == ["none"]
    said = "rpm at the operating point ari; the machine runs at the values of its file. Unmodelled"
    assert said in unmodelled_sentence(results)
    assert "by the likelihood of the published level at the operating point ari: " in (
        samples_sentence(results)
    )


def test_a_report_at_the_point_itself_names_it_once(at_ari):
    assert "2900 rpm at the operating point ari. Unmodelled noise" in unmodelled_sentence(at_ari)
    assert "by the likelihood of the published level: " in samples_sentence(at_ari)


def test_a_study_at_the_point_itself_needs_no_second_machine(study):
    named = study.replace({"operation.point": "ari", "catalogue_point": "ari"})
    assert named.catalogue_machine is None
    assert named.catalogue_case == (2900.0, "none")


def test_an_unknown_point_is_refused(study):
    with pytest.raises(ParameterError, match=r"catalogue_point = sun: unknown; allowed ari"):
        study.replace({"catalogue_point": "sun"})
    with pytest.raises(ParameterError, match=r"catalogue_point = \[1\]: must be the name"):
        study.replace({"catalogue_point": [1]})
    with pytest.raises(ParameterError, match="catalogue_machine: unknown key"):
        study.replace({"catalogue_machine": "x"})
