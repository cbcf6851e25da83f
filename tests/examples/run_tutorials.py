"""Follows the tutorials `docs/add_a_*.md`: their Python files, their TOML, a run; prints JSON.

In a process of its own, as the plug-ins are registered for good.
"""

import json
import re
import sys
import tempfile
from pathlib import Path

DOCS = Path(__file__).resolve().parents[2] / "docs"
sys.path[:0] = [str(DOCS / "gallery"), str(DOCS.parent / "tests" / "helpers")]

import pytest  # noqa: E402
from pictures import draw_nothing  # noqa: E402
from rough_radiation import rough_radiation  # noqa: E402
from support import MACHINE_FILE, TINY  # noqa: E402

import vibroacoustics as va  # noqa: E402

INCLUDED = re.compile(r"```\{literalinclude\} (\S+)")
TOML = re.compile(r"^```toml\n(.*?)^```$", re.MULTILINE | re.DOTALL)
DATA = re.compile(r"^with `(\S+)`:\n\n```text\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def main() -> None:
    """All tutorials into one study; the machine's is a study of its own."""
    files, tables, data = {}, {}, {}
    for page in sorted(DOCS.glob("add_a_*.md")):
        text = page.read_text(encoding="utf-8")
        files[page.stem] = INCLUDED.findall(text)
        tables[page.stem] = "\n".join(TOML.findall(text))
        data |= dict(DATA.findall(text))
        for file in files[page.stem]:
            va.load_plugin(DOCS / file)
    with tempfile.TemporaryDirectory() as folder, pytest.MonkeyPatch.context() as patch:
        draw_nothing(patch)
        print(json.dumps({"files": files, **one_study(Path(folder), tables, data)}))


def one_study(folder: Path, tables: dict[str, str], data: dict[str, str]) -> dict[str, object]:
    """What is in the results and the report of a study with everything."""
    for name, content in data.items():
        (folder / name).write_text(content)
    tiny = TINY.read_text()
    further = [tables[f"add_a_{name}"] for name in ("balancer", "source", "criterion")]
    bare = tiny.replace("../../data/machines/copeland_zp41k3e.toml", str(MACHINE_FILE))
    (folder / "study.toml").write_text("\n".join([bare, *further]))
    results = va.run(va.load_study(folder / "study.toml"), radiation=rough_radiation)
    va.write_report(results, folder / "out")

    (folder / "rotor.toml").write_text(machine_file(tables["add_a_machine"]))
    rotor = tiny.replace("../../data/machines/copeland_zp41k3e.toml", "rotor.toml")
    rotor = re.sub(r"(?s)\[options\.counterweight-half\].*?\n\n", "", rotor)
    (folder / "rotor_study.toml").write_text(rotor)
    turned = va.run(va.load_study(folder / "rotor_study.toml"), radiation=rough_radiation)
    return {
        "options": results["option"].values.tolist(),
        "sources": results["sound_source"].values.tolist(),
        "criteria": results["criterion"].values.tolist(),
        "report": (folder / "out" / "report.html").read_text(encoding="utf-8"),
        "rotor_force_n": turned["force_amplitude"].sel(order=1).max().item(),
    }


def machine_file(first: str) -> str:
    """A machine's file from its first lines and the tables that every machine has."""
    tables = re.split(r"(?m)^(?=\[)", MACHINE_FILE.read_text(encoding="utf-8"))
    common = r"\[(housing|mounts|shell|overall_noise)\b"
    return first + "".join(table for table in tables if re.match(common, table))


if __name__ == "__main__":
    main()
