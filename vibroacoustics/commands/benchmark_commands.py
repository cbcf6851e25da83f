"""The command that answers and scores the open benchmark."""

from pathlib import Path
from typing import Annotated

from ..base.errors import ParameterError
from ..base.progress import Progress
from .command import command
from .outcome import Outcome


@command("benchmark", "Installation", "--out reports/benchmark/submission.csv")
def benchmark_command(
    progress: Progress,
    *,
    out: Annotated[Path, "CSV file of the answers."] = Path("reports/benchmark/submission.csv"),
) -> Outcome:
    """Answer the ten cases of the open benchmark, and score the answers."""
    from ..benchmark.answers import submission
    from ..benchmark.verdicts import scored
    from ..results.files import write_together
    from . import outputs
    from .starter import shipped_folder

    if out.suffix.lower() != ".csv":
        raise ParameterError(f"--out {out}: must end with .csv")
    outputs.check_folder(out.parent, [out.name])
    folder = shipped_folder() / "data" / "benchmark"
    write_together(out.parent, {out.name: submission(folder / "cases", progress)})
    lines, failed = scored(folder, out)
    files = {"submission": out, "scorer": folder / "score.py"}
    return Outcome("\n".join(lines), files, broken=[f"case {name}" for name in failed])
