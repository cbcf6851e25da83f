"""The frame as load path: from loads on the parts in the shell to forces on its wall."""

from .contacts import Contacts, contacts_of
from .inner import InnerSet, inner_set
from .of_machine import frame_on_shell
from .on_shell import FrameOnShell, SoundPerForce

__all__ = [
    "Contacts",
    "FrameOnShell",
    "InnerSet",
    "SoundPerForce",
    "contacts_of",
    "frame_on_shell",
    "inner_set",
]
