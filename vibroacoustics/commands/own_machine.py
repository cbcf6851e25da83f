"""Blocks of a study and its machine without what belongs to the published machine alone."""

from typing import Final

from ..base.errors import ParameterError
from ..base.units import si_key
from ..machine.option import OPTIONS
from ..study.study import Study
from ..study.toml_blocks import Block, Entry, blocks_of

PUBLISHED: Final = frozenset({"errata", "evidence", "overall_noise", "operating_points"})
"""Tables of a machine or a study that leave with the published machine."""
OF_THE_LEVEL: Final = "remainder"
_PUBLISHED_KEYS: Final = frozenset({"published_table", "refrigerant", "point", "catalogue_point"})
_HIGHEST_DBA: Final = 140.0
OWN_SOURCE: Final = "given to vibroacoustics new: catalogue or measurement of the machine"
_LEVEL: Final = """\
# Level of the machine, by a catalogue or a measurement: samples are weighted by it, and noise that
# no source models is estimated. Without it levels are those of the model alone.
[overall_noise]
level_dba = {{ {level}, source = "{source}" }}
speed_rpm = {{ {speed}, source = "{source}" }}
distance_mm = {{ {distance}, source = "{source}" }}
"""


def without_published(blocks: list[Block]) -> list[Block]:
    """Blocks without tables and values of the published machine."""
    kept = [block for block in blocks if block.keys[:1] not in {(name,) for name in PUBLISHED}]
    for block in kept:
        block.entries = [each for each in block.entries if each.key not in _PUBLISHED_KEYS]
    return [block for block in kept if block.entries or not block.header or _is_parent(block, kept)]


def _is_parent(block: Block, blocks: list[Block]) -> bool:
    """Whether further tables are in an empty one, which its header then introduces."""
    return block.keys != ("scoring",) and any(
        each.keys[: len(block.keys)] == block.keys for each in blocks if each is not block
    )


def applied_overrides(study: list[Block], machine: list[Block]) -> list[Block]:
    """Write values of a study's operating point and overrides to the machine's blocks.

    Returns
    -------
    blocks of the study without its overrides
    """
    prefix = ("machine", "override")
    points = [block.entry("point") for block in study if block.keys == ("operation",)]
    for point in points:
        if point is not None:
            _apply(machine, ("operating_points", str(point.value)), machine)
    _apply(study, prefix, machine)
    return [block for block in study if block.keys[:2] != prefix]


def _apply(blocks: list[Block], prefix: tuple[str, ...], machine: list[Block]) -> None:
    length = len(prefix)
    for block in [each for each in blocks if each.keys[:length] == prefix]:
        target = next(each for each in machine if each.keys == block.keys[length:])
        for entry in block.entries:
            field = si_key(entry.key)[0]
            target.entries = [
                each
                for each in target.entries
                if each.key == entry.key or si_key(each.key)[0] != field
            ]
            target.put(entry)


def named_for(kind: str, study: list[Block], machine: list[Block]) -> None:
    """Name study and machine for the kind, in place of the published machine's names."""
    name = f"Machine of kind {kind}"
    machine[0].put(Entry("name", f'name = "{name}"'))
    study[0].put(Entry("title", f'title = "{name}"'))
    for block in (study[0], machine[0]):
        block.entries[0].comments = []  # of the published machine


def with_level(
    study: list[Block], machine: list[Block], level_dba: float | None, shipped: Study
) -> None:
    """Write the level of the user's machine, or comment what to write.

    Raises
    ------
    ParameterError
        It is no level of a machine.
    """
    if level_dba is not None and not 0.0 < level_dba <= _HIGHEST_DBA:
        raise ParameterError(
            f"--level = {level_dba:g} dB(A): must be above 0 to {_HIGHEST_DBA:g} dB(A)"
        )
    speed = float(shipped.catalogue_speed_rpm)
    text = _LEVEL.format(level="value=…", speed="value=…", distance="value=…", source="…")
    if level_dba is not None:
        level, distance = f"value = {level_dba}", "value = 1000.0"
        text = _LEVEL.format(
            level=level, speed=f"value = {speed}", distance=distance, source=OWN_SOURCE
        )
    for block in machine:
        if block.keys[:1] == (OF_THE_LEVEL,):
            block.comment_out()
    (_, block) = blocks_of(text)
    number = next(n for n, each in enumerate(machine) if each.keys == ("shell",)) + 1
    machine.insert(number, block)
    if level_dba is None:
        block.comment_out()
        receiver = study[0].entry("catalogue_receiver")
        if receiver is not None:
            receiver.active = False


def commented_options(study: list[Block]) -> None:
    """Turn options with dimensions of their own to comments, and values that have a default.

    What is left follows the machine: shares of its masses, and its own ring or weights.
    """
    names = {block.keys[1] for block in study if block.keys[:1] == ("options",)}
    for name in names:
        blocks = [block for block in study if block.keys[:2] == ("options", name)]
        kind = next(entry for block in blocks for entry in block.entries if entry.key == "kind")
        fields = OPTIONS[str(kind.value)].model_fields
        main, *changes = blocks
        for entry in main.entries:
            field = fields.get(si_key(entry.key)[0])
            entry.active = field is None or field.is_required()
        if not all(map(_follows_machine, main.entries)) or not all(
            _number(entry) == 0.0 for block in changes for entry in block.entries
        ):
            for block in blocks:
                block.comment_out()


def _follows_machine(entry: Entry) -> bool:
    """Whether a value of an option is none of the published machine's."""
    if entry.key in ("kind", "title"):
        return True
    if not entry.active:
        return entry.key != "added_mass_kg" or _number(entry) == 0.0
    value = entry.value
    derived = isinstance(value, dict) and str(value.get("source", "")).startswith("derived")
    return entry.key.endswith("_ratio") and not derived


def _number(entry: Entry) -> float:
    value = entry.value
    number = value["value"] if isinstance(value, dict) else value
    return float(number) if isinstance(number, int | float) else 1.0
