"""The command that plays an option of a study in a recording."""

from pathlib import Path
from typing import Annotated, Final

import typer

from ..base.progress import Progress
from .command import command
from .options import FileOut, Plugins, Printing, Recording
from .outcome import Outcome
from .reading import Reading, SpeedOptions

_EXAMPLE: Final = (
    "machine.wav --results reports/mine/results.nc --option counterweight "
    "--pair mic=front_1m --rpm 2900"
)


@command("replay", "Recordings", _EXAMPLE)
def replay_command(
    progress: Progress,
    recording_file: Recording,
    *,
    results_file: Annotated[
        Path, typer.Option("--results", help="Results of a run of the machine's study, .nc.")
    ],
    option: Annotated[str, "Balancing option of the study."],
    pair: Annotated[
        list[str], "CHANNEL=RESPONSE: microphone or motion of the study for a channel; repeatable."
    ],
    speed: SpeedOptions,
    bandwidth: Annotated[
        float | None, "Full width at -3 dB of what belongs to an order, Hz; default: automatic."
    ] = None,
    orders_only: Annotated[bool, "Accept an option that changes the noise too."] = False,
    shaft_ratio: Annotated[
        float, "Speed of the study's shaft over that of the recorded one, as of a gear or belt."
    ] = 1.0,
    reading: Reading,
    out: FileOut = None,
    plugin: Plugins = None,
    printing: Printing,
) -> Outcome:
    """Play an option of a study in a recording: sounds before and after, levels, page."""
    from . import arguments

    source, pairs = speed.source(), arguments.assignments("--pair", pair)
    recording = reading.at_once(recording_file, plugin, speed)
    from ..measured.replay import replay
    from . import outputs
    from .replaying import analysis_with_sounds

    target = printing.target(out or Path("reports") / recording_file.stem)
    results, _ = outputs.open_run(results_file)
    replayed = replay(
        recording, results, option, pairs, source, bandwidth, orders_only, shaft_ratio, progress
    )
    return target.outcome(analysis_with_sounds(replayed), replayed.summary, "replay.nc")
