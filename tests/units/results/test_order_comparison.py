"""Orders of two results against each other: studies, recordings, one of each; what is refused."""

import csv
import io

import numpy as np
import pytest
import xarray as xr
from support import tiny_run

from vibroacoustics import analyse_orders, compare, label_recording
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.base.vocabulary import stamp
from vibroacoustics.declaration.facts import vibration
from vibroacoustics.report.compared.orders import (
    compared_data,
    compared_facts,
    matching_orders,
)
from vibroacoustics.report.figures.channel_orders import compared_order_charts
from vibroacoustics.report.tables import to_csv, to_text
from vibroacoustics.results.order_comparison import NEGLIGIBLE, channel_orders
from vibroacoustics.study.order_analysis import OrderAnalysis, SpeedChannel

ROUNDING = 1e-12
OF_A_STUDY = [
    "pressure front_1m",
    *(f"force {axis}" for axis in "xyz"),
    *(f"moment {axis}" for axis in "xyz"),
    *(
        f"foot force {end}_{side} {axis}"
        for end in ("front", "rear")
        for side in ("left", "right")
        for axis in "xyz"
    ),
    *(f"velocity t{axis}" for axis in "xyz"),
    *(f"acceleration t{axis}" for axis in "xyz"),
    *(
        f"foot {quantity} {end}_{side} {axis}"
        for quantity in ("velocity", "acceleration")
        for end in ("front", "rear")
        for side in ("left", "right")
        for axis in "xyz"
    ),
]


@pytest.fixture(scope="module")
def study() -> xr.Dataset:
    return tiny_run()


def recorded(channels, speeds=(2900.0,), orders=(1.0, 2.0), coherence=1.0, **attrs) -> xr.Dataset:
    """Orders of a recording, made up: {name: (unit, complex peaks)} by speed and order."""
    shape = (len(speeds), len(orders))
    lines = np.stack([np.broadcast_to(value, shape) for _, value in channels.values()])
    coords = {"channel": list(channels), "speed": list(speeds), "order": list(orders)}
    names = {
        "channel_order": lines.astype(complex),
        "channel_order_rms": np.abs(lines) / np.sqrt(2.0 * coherence),
        "channel_order_coherence": np.full(lines.shape, coherence),
    }
    units = ("channel", [unit for unit, _ in channels.values()])
    return xr.Dataset(
        {name: stamp(name, value, coords) for name, value in names.items()},
        coords={"channel_unit": units},
        attrs={"title": "Orders of a.wav", "source_file": "a.wav", "angle_zero": "pulse", **attrs},
    )


# --- studies -------------------------------------------------------------------------------------


def test_a_study_has_channels_named_by_what_and_where(study):
    lines = channel_orders(study)
    assert sorted(lines["channel"].values) == sorted(OF_A_STUDY)
    assert lines.dims == ("channel", "speed", "order")
    force = study["force_order"].sum("source").sel(option="none", axis="x")
    np.testing.assert_array_equal(lines.sel(channel="force x"), force.transpose("speed", "order"))
    foot = study["foot_force_order"].sum("source").sel(option="none", foot="rear_left", axis="z")
    own = lines.sel(channel="foot force rear_left z")
    np.testing.assert_array_equal(own, foot.transpose("speed", "order"))
    units = dict(zip(lines["channel"].values, lines["channel_unit"].values, strict=True))
    assert units["moment z"] == "N m"
    assert units["pressure front_1m"] == "Pa"


def test_acceleration_leads_velocity_by_a_quarter(study):
    """a = j ω v, ω = 2π k 2900/60."""
    lines = channel_orders(study).isel(speed=0)
    pulsation = 2.0 * np.pi * lines["order"].values * 2900.0 / 60.0
    np.testing.assert_allclose(
        lines.sel(channel="acceleration tx"),
        1j * pulsation * lines.sel(channel="velocity tx"),
        rtol=ROUNDING,
    )


def test_motion_of_the_feet_is_that_of_the_data_sheet(study):
    """Root mean square over all orders, by the function of declared values."""
    lines = channel_orders(study).isel(speed=0)
    for of_foot in vibration(study.sel(option="none").isel(speed=0), {}):
        for quantity, expected in (
            ("velocity", of_foot.velocity_rms_m_per_s),
            ("acceleration", of_foot.acceleration_rms_m_per_s2),
        ):
            channel = f"foot {quantity} {of_foot.point} {of_foot.direction}"
            found = np.sqrt(0.5 * np.sum(abs(lines.sel(channel=channel).values) ** 2))
            assert found == pytest.approx(expected, rel=1e-9), channel


def test_a_study_against_itself_differs_by_nothing(study):
    compared = compare(study, study)
    for name in ("order_difference", "order_phase_difference"):
        known = np.isfinite(compared[name])
        assert not compared[name].values[known.values].any()
        assert known.sel(channel=["force x", "moment y", "acceleration tx"], order=1).all()
    # What is not told is rounding: 180 dB below the force along x
    unknown = compared["order_difference"].isnull()
    largest = abs(compared["channel_order"].sel(channel="force x", order=1).item())
    axes = {"channel": ["force x", "force y", "force z"]}
    force, unknown = compared["channel_order"].sel(axes), unknown.sel(axes)
    assert unknown.any()
    assert np.all(abs(force).where(unknown, 0.0) <= NEGLIGIBLE * largest)
    np.testing.assert_array_equal(compared["channel_order_coherence"], 1.0)


def test_a_study_with_twice_the_force(study):
    """+6.02 dB and half a turn of the force, nothing else."""
    other = study.copy()
    other["force_order"] = -2.0 * study["force_order"]
    compared = compare(study, other).sel(order=1).isel(speed=0)
    force = compared.sel(channel="force x")
    assert force["order_difference"] == pytest.approx(20.0 * np.log10(2.0), abs=1e-9)
    assert abs(force["order_phase_difference"]) == pytest.approx(np.pi, abs=1e-9)
    assert compared["order_difference"].sel(channel="moment y") == 0.0


def test_options_are_chosen_by_name(study):
    half = compare(study, study, option="counterweight-half")
    force = study["force_order"].sum("source").sel(option="counterweight-half", axis="y", order=1)
    own = half["channel_order"].sel(channel="force y", order=1)
    np.testing.assert_array_equal(own, force)
    assert abs(own.item()) > 1.0  # N; none has no force along y


# --- a study and a recording ---------------------------------------------------------------------


def test_a_recording_of_the_study_itself(study):
    """Acceleration that a tacho pulse 40° after crank angle zero was recorded with."""
    angle = np.radians(40.0)
    lines = channel_orders(study).sel(channel="acceleration tx", order=[1, 2]).isel(speed=0).values
    seen = lines * np.exp(1j * np.array([1, 2]) * angle)  # from the pulse on
    seen[1] = lines[0]  # the study has no 2x
    shell = recorded({"shell": ("m/s²", seen)}, speeds=(2912.0,))
    pairs = {"acceleration tx": "shell"}
    turned = compare(study, shell, pairs, tacho_angle_rad=angle).isel(channel=0, speed=0)
    assert turned["order_difference"].sel(order=1) == pytest.approx(0.0, abs=1e-9)
    assert turned["order_phase_difference"].sel(order=1) == pytest.approx(0.0, abs=1e-9)
    assert np.isnan(turned["order_difference"].sel(order=2))
    assert turned["compared_speed"] == 2912.0
    assert turned["compared_channel"] == "shell"
    as_it_is = compare(study, shell, pairs).isel(channel=0, speed=0)
    assert as_it_is["order_phase_difference"].sel(order=1) == pytest.approx(angle, abs=1e-9)
    np.testing.assert_allclose(abs(as_it_is["compared_order"]), abs(turned["compared_order"]))


def test_the_tachos_angle_is_that_of_the_crank_at_the_pulse():
    """Two recordings of one machine; the second one's tacho gives its pulse at 90°.

    Phase of order k differs by 90° k before the turn, and not at all after it.
    """
    rate_hz, angle = 6400.0, 1.0 + 2.0 * np.pi * 47.0 * np.arange(25600) / 6400.0
    force = np.cos(angle + 0.3) + 0.2 * np.cos(2.0 * angle)

    def results(at):
        pulse = np.where((angle - at) % (2.0 * np.pi) < 0.5, 1.0, 0.0)
        made = label_recording([force, pulse], rate_hz, ["force", "tacho"], ["N", "V"])
        return analyse_orders(made, OrderAnalysis(SpeedChannel("tacho"), orders=(1.0, 2.0)))

    first, second = results(0.0), results(np.pi / 2.0)
    plain = compare(first, second)["order_phase_difference"].squeeze().values
    turned = compare(first, second, tacho_angle_rad=np.pi / 2.0)["order_phase_difference"]
    # The edges are known to a sample in 136, and their mean over 188 revolutions to far less.
    tolerance = np.radians(0.1)
    assert plain[0] == pytest.approx(np.pi / 2.0, abs=tolerance)
    assert abs(plain[1]) == pytest.approx(np.pi, abs=tolerance)
    np.testing.assert_allclose(turned.squeeze(), 0.0, atol=tolerance)


# --- recordings ----------------------------------------------------------------------------------


def test_two_recordings():
    first = recorded({"a": ("Pa", [1.0, 2.0j]), "b": ("N", 1.0)}, coherence=0.9)
    second = recorded({"a": ("Pa", [0.1, 2.0])}, coherence=0.7, source_file="b.wav")
    compared = compare(first, second)
    assert list(compared["channel"].values) == ["a"]
    np.testing.assert_allclose(compared["order_difference"].squeeze(), [-20.0, 0.0], atol=1e-9)
    phase = compared["order_phase_difference"].squeeze()
    np.testing.assert_allclose(phase, [0.0, -np.pi / 2.0], atol=1e-12)
    np.testing.assert_array_equal(compared["channel_order_coherence"], 0.7)
    assert compared.attrs["first"] == "A: a.wav"
    assert compared.attrs["second"] == "B: b.wav"


@pytest.mark.parametrize("place", ["first", "second"])
def test_without_a_mark_on_the_shaft_there_is_no_phase(place):
    marked = recorded({"a": ("Pa", [1.0, 2.0])})
    free = recorded({"a": ("Pa", [1.0, 2.0])}, angle_zero="none")
    compared = compare(free, marked) if place == "first" else compare(marked, free)
    assert np.all(np.isnan(compared["order_phase_difference"]))
    np.testing.assert_allclose(compared["order_difference"], 0.0, atol=1e-9)


def test_without_a_mark_on_the_shaft_the_bands_count():
    """The angle drifts: a tenth of the power is coherent, all of it is in the bands."""
    marked = recorded({"a": ("Pa", [1.0, 2.0])})
    drifting = recorded({"a": ("Pa", np.sqrt(0.1) * np.array([1.0, 2.0]))}, coherence=0.1,
                        angle_zero="none")  # fmt: skip
    compared = compare(marked, drifting)
    np.testing.assert_allclose(compared["order_difference"], 0.0, atol=1e-9)
    assert "peaks from the RMS in the bands" in compared_facts(compared)[1]


def test_a_speed_is_paired_once_with_the_nearest():
    """2950 is within 2 % of 2900 and of 3000, which are nearer to others."""
    run_up = recorded({"a": ("Pa", 1.0)}, speeds=np.arange(2800.0, 3101.0, 50.0))
    points = recorded({"a": ("Pa", 1.0)}, speeds=(2905.0, 2990.0, 4000.0))
    compared = compare(run_up, points)
    np.testing.assert_array_equal(compared["speed"], [2900.0, 3000.0])
    np.testing.assert_array_equal(compared["compared_speed"], [2905.0, 2990.0])
    back = compare(points, run_up)
    np.testing.assert_array_equal(back["speed"], [2905.0, 2990.0])


def test_orders_that_both_have():
    first = recorded({"a": ("Pa", [1.0, 2.0, 3.0])}, orders=(0.0, 1.0, 2.0))
    second = recorded({"a": ("Pa", [5.0, 2.0, 4.0])}, orders=(0.0, 0.5, 2.0))
    compared = compare(first, second)
    np.testing.assert_array_equal(compared["order"], [2.0])
    assert compared["compared_order"].item() == 4.0


# --- what is refused -----------------------------------------------------------------------------


def refused(*arguments, **options) -> str:
    with pytest.raises(ParameterError) as caught:
        compare(*arguments, **options)
    message = str(caught.value)
    assert len(message.splitlines()) == 1
    return message


def test_nothing_in_common(study):
    a = recorded({"a": ("Pa", 1.0)})
    b = recorded({"b": ("N", 1.0)})
    assert refused(a, b).startswith("no channel has the same name in both: a [Pa] against b [N]")
    assert refused(a, b).endswith('pair them, as in --pair "a=b"')
    assert "units differ, Pa and N" in refused(a, b, {"a": "b"})
    assert "units differ, Pa and N" in refused(a, recorded({"a": ("N", 1.0)}))
    assert "no channel 'x'; there are a [Pa]" in refused(a, b, {"x": "b"})
    assert "no channel 'x'; there are b [N]" in refused(a, b, {"a": "x"})
    other_orders = recorded({"a": ("Pa", 1.0)}, orders=(0.0, 0.5))
    assert "no order in common: 1, 2 against 0, 0.5" in refused(a, other_orders)
    only_offset = recorded({"a": ("Pa", 1.0)}, orders=(0.0, 1.0)).sel(order=[0.0])
    assert "no order in common: 0 against 0" in refused(only_offset, only_offset)
    faster = recorded({"a": ("Pa", 1.0)}, speeds=(2960.0,))  # 2.07 %
    assert "no speed in common within 2 %: 2900 against 2960 rpm" in refused(a, faster)
    assert "option 'magic': is none of none, counterweight-half" in refused(
        study, study, option="magic"
    )
    assert "tacho_angle = nan" in refused(a, a, tacho_angle_rad=np.nan)
    assert "made up: holds no orders" in refused(a, xr.Dataset(attrs={"title": "made up"}))


# --- what is written -----------------------------------------------------------------------------


def test_table_and_csv(study):
    shell = recorded({"shell": ("m/s²", [0.5, 1e-4])})
    compared = compare(study, shell, {"acceleration tx": "shell"})
    lines = [*compared_facts(compared), "", *to_text(matching_orders(compared)).splitlines()]
    assert lines[0].startswith("A: Tiny study for tests; crank angle zero: ")
    assert lines[1] == "B: a.wav; crank angle zero: pulse"
    (row,) = [line.split() for line in lines if line.startswith("acceleration tx")]
    assert row[2:7] == ["shell", "m/s²", "2900", "2900", "1"]
    rows = list(csv.DictReader(io.StringIO(to_csv(compared_data(compared)).decode())))
    assert [row["order"] for row in rows] == ["1", "2"]
    size = abs(compared["channel_order"].sel(order=1).item())
    assert float(rows[0]["difference_db"]) == pytest.approx(20.0 * np.log10(0.5 / size), abs=1e-6)
    assert rows[1]["difference_db"] == "nan"


def test_the_text_has_the_orders_that_matter():
    """Within 20 dB of the strongest, or within 40 dB and changed; twelve at most."""
    first = np.array([1.0, 0.2, 0.05, 0.05, 0.005, *[0.5] * 14])
    second = first * np.array([1.0, 1.0, 1.0, 1.2, 1.2, *[1.0] * 14])

    def compared(count):
        orders = range(1, count + 1)
        return compare(
            *(recorded({"a": ("Pa", e[:count])}, orders=orders) for e in (first, second))
        )

    few, many = compared(5), compared(19)
    text = to_text(matching_orders(few))
    assert _printed_orders(text) == ["1", "2", "4"]
    assert "3 of 5 rows, those within 20 dB of the strongest or" in text
    assert len(_printed_orders(to_text(matching_orders(many)))) == 12
    assert to_csv(compared_data(many)).count(b"\n") == 20


def _printed_orders(text):
    return [line.split()[5] for line in text.splitlines() if line.startswith("a ")]


def test_figures_of_what_both_have(study):
    """Neither force y nor force z is there; names that read the same get files of their own."""
    names = [chart.name for chart in compared_order_charts(compare(study, study))]
    shown = [name.split("_", 2)[2] for name in names]
    assert "force_x" in shown
    assert "force_y" not in shown
    same = recorded({"a b": ("Pa", 1.0), "a_b": ("Pa", 1.0), "a" * 300: ("Pa", 1.0)})
    names = [chart.name for chart in compared_order_charts(compare(same, same))]
    assert len(set(names)) == 3
    assert max(map(len, names)) < 100
