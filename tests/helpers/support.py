"""What several test modules need: paths, and the force and moment of one option."""

import os
import subprocess
import sys
import tempfile
import textwrap
from collections.abc import Sequence
from contextlib import redirect_stderr, redirect_stdout
from io import StringIO
from pathlib import Path
from unittest.mock import patch

import numpy as np
import xarray as xr
from kept_results import kept

from vibroacoustics import pipeline
from vibroacoustics.base.arrays import Array, ComplexArray
from vibroacoustics.base.progress import Progress, no_progress
from vibroacoustics.base.vocabulary import RIGID_BODY_DOFS, stamp
from vibroacoustics.commands import cli
from vibroacoustics.mechanics.added import Added
from vibroacoustics.mechanics.moving_parts import MovingPart, Revolution, wrench
from vibroacoustics.mechanics.rotation import Rotation, constant_rotation
from vibroacoustics.mechanisms.oldham_scroll.revolution import oldham_ring, rotating_set
from vibroacoustics.orders import order_spectrum
from vibroacoustics.radiation.bodies import Body
from vibroacoustics.radiation.box import Box, BoxField, closed_box
from vibroacoustics.radiation.near_field import NearField
from vibroacoustics.radiation.patterns import Pattern
from vibroacoustics.radiation.surface_points import SurfacePoints, surface_points
from vibroacoustics.radiation.symmetry import signs
from vibroacoustics.results import hashed
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.study import Study

ROOT = Path(__file__).parents[2]
PIPELINES = ROOT / "pipelines"
TINY = ROOT / "tests" / "studies" / "tiny.toml"
MACHINE_FILE = ROOT / "data" / "machines" / "copeland_zp41k3e.toml"


def radiated(
    near: NearField,
    pattern: Pattern,
    frequency_hz: Array,
    progress: Progress = no_progress,
) -> BoxField:
    """Field of one pattern on the box, from runs that end by microphones around it."""
    (flux,) = near.wall_fluxes([pattern])
    recorded = near.recording
    layers = np.zeros((2, frequency_hz.size, recorded.columns.shape[1]), dtype=complex)
    middle = (near.box.lower + near.box.upper) / 2.0
    around = middle + 1.2 * np.array([[1, 0, 0.2], [0, 1, 0.3], [-0.7, -0.6, 0.4], [0, 0.2, 1]])
    for part in near.radiate(flux, frequency_hz, around, pattern.name, progress):
        sign = signs(recorded.across, part.parity)
        for side, columns in enumerate(recorded.columns):
            layers[side] += sign[side] * part.spectrum[:, columns]
    return BoxField(*layers)


def made_up_transfer_vectors(study: Study, gain: float = 1.0) -> xr.Dataset:
    """Pressure that grows with frequency, differently per receiver and dof."""
    frequency = np.arange(25.0, study.radiation.maximum_frequency_hz + 1.0, 25.0)
    generator = np.random.default_rng(3)
    shape = (len(study.receivers), 6, 1)
    size = generator.standard_normal(shape) + 1j * generator.standard_normal(shape)
    return labelled_vectors(study, gain * 0.01 * size * frequency, np.ones(len(study.receivers)))


def labelled_vectors(study: Study, values: ComplexArray, distance: Array) -> xr.Dataset:
    """Transfer vectors every 25 Hz, (receiver, dof, frequency), by the distance of receivers."""
    coords = {
        "receiver": list(study.receivers),
        "dof": list(RIGID_BODY_DOFS),
        "frequency": 25.0 * np.arange(1.0, values.shape[-1] + 1.0),
        "distance": ("receiver", distance),
    }
    names = ("transfer_vector", "transfer_vector_closed_form")
    error = stamp("transfer_vector_error", 0.01 * np.abs(values), coords)
    return xr.Dataset(
        {**{name: stamp(name, values, coords) for name in names}, error.name: error},
        attrs={"method": "made up"},
    )


def made_up_radiation(study: Study, *_: object) -> tuple[xr.Dataset, bool]:
    """In place of the radiation: transfer vectors made up."""
    return made_up_transfer_vectors(study), False


def tiny_run(options: str = "", criteria: str = "") -> xr.Dataset:
    """Results of the tiny study with further options and criteria, radiation made up."""
    if options or criteria:
        return _tiny_run(options, criteria)
    return kept("tiny", _tiny_run)


def _tiny_run(options: str = "", criteria: str = "") -> xr.Dataset:
    text = TINY.read_text().replace("../../data", str(ROOT / "data"))
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "tiny.toml"
        file.write_text(text.replace("[receivers.", f"{options}\n[receivers.", 1) + criteria)
        return pipeline.run(load_study(file), radiation=made_up_radiation)


def command(*arguments: object, cache: Path) -> subprocess.CompletedProcess[str]:
    """The command line in a process of its own; its stderr without its advance."""
    outcome = subprocess.run(
        [sys.executable, "-m", "vibroacoustics", *map(str, arguments)],
        capture_output=True,
        text=True,
        env={**os.environ, "XDG_CACHE_HOME": str(cache)},
        check=False,
        timeout=300,
    )
    outcome.stderr = without_progress(outcome.stderr)
    return outcome


def without_progress(errors: str) -> str:
    """What a command says on stderr apart from its advance, which depends on the machine."""
    lines = errors.splitlines(keepends=True)
    return "".join(line for line in lines if not line.startswith("progress: "))


def command_here(*arguments: object) -> subprocess.CompletedProcess[str]:
    """The same in this process, which saves seconds of imports."""
    words = ["vibroacoustics", *map(str, arguments)]
    code: object = 0
    with (
        patch.object(sys, "argv", words),
        redirect_stdout(StringIO()) as output,
        redirect_stderr(StringIO()) as errors,
    ):
        try:
            cli.main()
        except SystemExit as ended:
            code = ended.code or 0
    return subprocess.CompletedProcess(
        words, int(str(code)), output.getvalue(), without_progress(errors.getvalue())
    )


def without_warnings(
    outcome: subprocess.CompletedProcess[str],
) -> subprocess.CompletedProcess[str]:
    """Outcome of a command whose stderr has the other lines alone."""
    lines = outcome.stderr.splitlines(keepends=True)
    outcome.stderr = "".join(line for line in lines if not line.startswith("warning: "))
    return outcome


def assert_refused(outcome: subprocess.CompletedProcess[str], *words: str) -> None:
    """Lines of errors on stderr, one of which holds the words, and exit code 2."""
    assert outcome.returncode == 2, outcome.stdout + outcome.stderr
    lines = outcome.stderr.splitlines()
    assert all(line.startswith("error: ") for line in lines), outcome.stderr
    assert any(all(word in line for word in words) for line in lines), (words, outcome.stderr)


PEAK_MEMORY = """
        import ctypes
        def peak(forget=True):
            if forget:  # the peak so far
                ctypes.CDLL(None).malloc_trim(0)
                open("/proc/self/clear_refs", "w").write("5")
            status = open("/proc/self/status").read()
            return 1024 * int(status.split("VmHWM:")[1].split()[0])
""".strip()
"""For the script of a child: `peak()` in bytes."""


def append_hash(path: Path) -> None:
    """Make the hash of a file's content its last line."""
    with path.open("r+b") as file:
        hashed.append_hash(file)


def in_child(script: str) -> list[str]:
    """Words that a script prints in a Python process of its own."""
    result = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(script)],
        capture_output=True, text=True, timeout=300, check=False,
    )  # fmt: skip
    assert result.returncode == 0, result.stderr
    return result.stdout.split()


def whole_surface(body: Body, planes: tuple[Array, Array, Array]) -> SurfacePoints:
    """Points of all faces of a body."""
    return surface_points(body, planes, np.arange(body.faces.shape[0]))


CRANK_ANGLE = 2.0 * np.pi * np.arange(256) / 256


def turning(frequency_hz: float) -> Rotation:
    """Constant rotation at CRANK_ANGLE."""
    return constant_rotation(60.0 * frequency_hz, CRANK_ANGLE.size)


ROUNDING = 1e-12
"""Relative rounding error of a low order's phasor: sums of 256 terms at 2.2e-16 each are good to
6e-14; the rest is for the few operations that follow."""


def wrench_rounding(parts: Sequence[MovingPart], frequency_hz: float) -> tuple[float, float]:
    """Bound of the rounding of force and moment over crank angle, N and N m.

    The Fourier derivative multiplies the rounding eps |r| of the path by orders squared, up to
    128²; the moment takes it times |r|, in two products.
    """
    omega = 2.0 * np.pi * frequency_hz
    force = moment = 0.0
    for part in parts:
        reach = float(np.max(np.linalg.norm(part.position_m, axis=0)))
        own = part.mass_kg * omega**2 * 128**2 * np.finfo(float).eps * reach
        force += own
        moment += 2.0 * own * reach
    return force, moment


def machine_parts(study: Study) -> list[MovingPart]:
    """Moving parts of the bare machine."""
    return [*oldham_ring(study.machine, CRANK_ANGLE), *rotating_set(study.machine, CRANK_ANGLE)]


def steady(speed_rpm: float, samples: int = CRANK_ANGLE.size) -> Revolution:
    """A revolution at constant speed of a machine without moving parts."""
    return Revolution(speed_rpm, constant_rotation(speed_rpm, samples), {})


def balancing(study: Study, option: str, speed_rpm: float) -> Added:
    """What an option of the study adds."""
    parameters = study.options[option]
    key = (parameters.model_dump_json(), study.machine.model_dump_json(), speed_rpm)
    if key not in _BALANCING:  # a pendulum takes half a second to settle
        machine = parameters.applied_to(study.machine)
        _BALANCING[key] = parameters.added(machine, steady(speed_rpm))
    return _BALANCING[key]


_BALANCING: dict[tuple[str, str, float], Added] = {}


def wrench_orders(study: Study, option: str, speed_rpm: float) -> tuple[Array, Array]:
    """Order spectra (3, 41) of the resultant force and moment of machine and option."""
    parts = [*machine_parts(study), *balancing(study, option, speed_rpm).parts]
    force, moment = wrench(parts, turning(speed_rpm / 60.0))
    return order_spectrum(force, 40), order_spectrum(moment, 40)


def cube_box(half_edge_m: float, spacing_m: float, on_floor: bool) -> Box:
    """Box of cubic cells about the origin; on a floor without its lower side."""
    half = round(half_edge_m / spacing_m)
    edges = spacing_m * np.arange(-half - 1.0, half + 2.0)
    stop = 2 * half + 1
    return closed_box([edges] * 3, [1] * 3, [stop] * 3, {(2, -1)} if on_floor else ())
