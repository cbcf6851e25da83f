"""Claims with their conditions: a value, what it needs, what was found, and what falls without."""

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Final, Literal

import xarray as xr

Effect = Literal["no value", "at least", "at most", "remark", "lower value"]
"""Consequence of a missing condition: no value, a bound, a value with a remark, a lower value."""
ATTRIBUTE: Final = "conditional_claims"
"""Attribute of a dataset that holds its claims."""
COLUMNS: Final = (
    "claim", "subject", "statement", "condition", "needed", "finding", "met", "effect",
)  # fmt: skip
_BOUNDS: Final = ("at least", "at most")


@dataclass(frozen=True)
class Condition:
    """Requirement of a kind of claim.

    Attributes
    ----------
    name : noun, unique in its kind
    needed : requirement with its unit
    effect : consequence for a claim without it
    lacking : words where it is not met; `{finding}` is the finding, `{needed}` the requirement.
        Empty for `{finding} for {needed}`
    """

    name: str
    needed: str
    effect: Effect
    lacking: str = ""


@dataclass(frozen=True)
class ClaimKind:
    """Kind of claim that headlines state.

    Attributes
    ----------
    name : noun, unique
    commands : commands whose headline states it
    conditions : requirements
    source : document that sets them; empty for those of the method itself
    """

    name: str
    commands: tuple[str, ...]
    conditions: tuple[Condition, ...]
    source: str = ""

    def claim(
        self, value: str, findings: Mapping[str, "Finding"], subject: str = ""
    ) -> "ConditionalClaim":
        """Return a claim of this kind.

        Parameters
        ----------
        value : with its unit, as it is printed where all conditions are met
        findings : finding by name of each condition
        subject : channel, microphone or option whose claim it is
        """
        names = {condition.name for condition in self.conditions}
        if names != set(findings):
            raise KeyError(f"{self.name}: conditions {sorted(names ^ set(findings))}")
        checks = tuple(_check(each, findings[each.name]) for each in self.conditions)
        return ConditionalClaim(self.name, subject, value, checks)


@dataclass(frozen=True)
class Finding:
    """Finding on a condition.

    Attributes
    ----------
    words : value with its unit
    is_met : whether it is enough
    needed : requirement in this case; empty for that of the condition
    """

    words: str
    is_met: bool
    needed: str = ""


@dataclass(frozen=True)
class Check:
    """Condition of one claim beside its finding; see `Condition`."""

    condition: str
    needed: str
    finding: str
    is_met: bool
    effect: Effect
    lacking: str


@dataclass(frozen=True)
class ConditionalClaim:
    """Value with the conditions under which it holds.

    Attributes
    ----------
    kind : name of its kind
    subject : channel, microphone or option; empty where there is one only
    value : with its unit
    checks : every condition of the kind
    """

    kind: str
    subject: str
    value: str
    checks: tuple[Check, ...]

    def missing(self, *effects: Effect) -> tuple[Check, ...]:
        """Conditions that are not met, with one of some effects; default: all."""
        return tuple(
            each for each in self.checks
            if not each.is_met and (not effects or each.effect in effects)
        )  # fmt: skip

    @property
    def is_withdrawn(self) -> bool:
        """Whether there is no value."""
        return bool(self.missing("no value"))

    @property
    def bound(self) -> str:
        """`at least`, `at most`, `about` where errors of both signs remain, else empty."""
        signs = [effect for effect in _BOUNDS if self.missing(effect)]
        return "about" if len(signs) > 1 else "".join(signs)

    @property
    def reasons(self) -> tuple[str, ...]:
        """Words on each missing condition that its value does not show."""
        if self.is_withdrawn:
            return (self.short,)
        lacking = (each.lacking for each in self.missing("at least", "at most", "remark"))
        return tuple(dict.fromkeys(lacking))

    @property
    def short(self) -> str:
        """Value with its bound, or what it lacks; without the reasons of bounds and remarks."""
        if self.is_withdrawn:
            needed = dict.fromkeys(each.needed for each in self.missing("no value"))
            return f"no {self.kind} without {' and '.join(needed)}"
        return f"{self.bound} {self.value}".lstrip()


def stated(claim: ConditionalClaim) -> str:
    """Return a claim in words: headline, table, CSV and JSON state these.

    Examples
    --------
    >>> bands = Condition("bands", "to 12.5 kHz", "at least", "bands above {finding} are missing")
    >>> loudness = ClaimKind("loudness", ("tones",), (bands,))
    >>> stated(loudness.claim("35 sone", {"bands": Finding("6.3 kHz", False)}))
    'at least 35 sone (bands above 6.3 kHz are missing)'
    """
    if claim.is_withdrawn or not claim.reasons:
        return claim.short
    return f"{claim.short} ({'; '.join(claim.reasons)})"


def named(claim: ConditionalClaim) -> str:
    """Return a claim in words that begin with its kind, for values that do not name it."""
    return stated(claim) if claim.is_withdrawn else f"{claim.kind} {stated(claim)}"


def condition_table(claims: Iterable[ConditionalClaim]) -> dict[str, list[str | float]]:
    """Return columns `COLUMNS` with a row for each condition of each claim."""
    rows: list[tuple[str, ...]] = [
        (claim.kind, claim.subject, stated(claim), each.condition, each.needed, each.finding,
         "yes" if each.is_met else "no", each.effect)
        for claim in claims
        for each in claim.checks
    ]  # fmt: skip
    return {head: [row[column] for row in rows] for column, head in enumerate(COLUMNS)}


def with_claims(results: xr.Dataset, claims: Sequence[ConditionalClaim]) -> xr.Dataset:
    """Return a dataset that keeps its claims."""
    kept = json.dumps([asdict(claim) for claim in claims], ensure_ascii=False)
    return results.assign_attrs({ATTRIBUTE: kept})


def claims_of(results: xr.Dataset) -> tuple[ConditionalClaim, ...]:
    """Return the claims that a dataset keeps."""
    return tuple(
        ConditionalClaim(**{**row, "checks": tuple(Check(**each) for each in row["checks"])})
        for row in json.loads(results.attrs.get(ATTRIBUTE, "[]"))
    )


def claim_of(results: xr.Dataset, kind: str, subject: str = "") -> ConditionalClaim:
    """Return the claim of a kind and a subject that a dataset keeps."""
    return next(c for c in claims_of(results) if (c.kind, c.subject) == (kind, subject))


def _check(condition: Condition, finding: Finding) -> Check:
    needed = finding.needed or condition.needed
    template = condition.lacking or "{finding} for {needed}"
    lacking = template.format(finding=finding.words, needed=needed)
    return Check(condition.name, needed, finding.words, finding.is_met, condition.effect, lacking)
