"""The page of all classes of error, each with an example that is run."""

import inspect
import os
import tempfile
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Final

import xarray as xr

import vibroacoustics as va
from vibroacoustics.base import errors

from .tables import first_sentence

ROOT: Final = Path(__file__).resolve().parents[2]
HEAD: Final = """# Errors

Every error derives from `VibroacousticsError` and is one line that names what to do. The command
line prints it with exit code 2 and without a traceback; in Python it is raised. The lines below are
the output of the examples.
"""
EXAMPLES: Final = {
    "VibroacousticsError": """
# Catches all of them.
try:
    va.load_study("nowhere.toml")
except VibroacousticsError as error:
    print(type(error).__name__)
    raise
""",
    "ParameterError": '''
Path("fast.toml").write_text("""
extends = "pipelines/copeland_thesis.toml"
[operation]
speed_rpm = [90000.0]
""")
va.load_study("fast.toml")
''',
    "PlatformError": """
# As under `ulimit -v` with less than a command needs.
from vibroacoustics.base.posix import check_memory, resource
limits = resource.getrlimit(resource.RLIMIT_AS)
resource.setrlimit(resource.RLIMIT_AS, (10**12, limits[1]))
try:
    check_memory(2 * 10**12)
finally:
    resource.setrlimit(resource.RLIMIT_AS, limits)
""",
    "SchemaError": """
results = xr.Dataset({"loudness": ("speed", [4.0])})
va.check(results)
""",
    "SolverError": '''
Path("light.toml").write_text("""
extends = "pipelines/dagilis_slider_link.toml"
[machine.override.masses]
crankshaft_inertia_kg_m2 = { value = 1.0e-5, source = "derived: shaft alone" }
""")
va.run(va.load_study("light.toml"))
''',
    "StorageError": """
va.open_results("reports/nothing/results.nc")
""",
    "PluginError": """
Path("mine.py").write_text("import vibroacoustics\\nvibroacoustics.register(42)\\n")
va.load_plugin("mine.py")
""",
}


def page() -> str:
    """Markdown of the page."""
    return "\n\n".join([HEAD, *(section(name, kind) for name, kind in classes().items())]) + "\n"


def classes() -> dict[str, type[Exception]]:
    """Classes of error by name, the base first."""
    return {
        name: kind
        for name, kind in vars(errors).items()
        if inspect.isclass(kind) and issubclass(kind, errors.VibroacousticsError)
    }


def section(name: str, kind: type[Exception]) -> str:
    """What an error means, the example, and its line."""
    example = EXAMPLES[name].strip()
    shown = f"```python\n{example}\n```\n\n```text\nerror: {line_of(name, kind)}\n```"
    return f"## `{name}`\n\n{first_sentence(kind.__doc__)}\n\n{shown}"


def line_of(name: str, kind: type[Exception]) -> str:
    """Run an example in a folder of its own; the line of its error.

    Raises
    ------
    AssertionError
        The example raises no such error.
    """
    before = Path.cwd()
    names = {"va": va, "xr": xr, "Path": Path, **vars(errors)}
    with tempfile.TemporaryDirectory() as folder:
        for shared in ("data", "pipelines"):
            (Path(folder) / shared).symlink_to(ROOT / shared)
        os.chdir(folder)
        try:
            with redirect_stdout(StringIO()):
                exec(compile(EXAMPLES[name], name, "exec"), names)  # noqa: S102 - our own
        except kind as error:
            return str(error)
        finally:
            os.chdir(before)
    raise AssertionError(f"{name}: its example raises nothing")
