"""The reference: nothing added."""

from typing import ClassVar

from ..base.registry import register
from ..machine.option import Option


@register
class NoBalancer(Option):
    """The machine as it is; the reference of every change."""

    kind: ClassVar[str] = "none"
