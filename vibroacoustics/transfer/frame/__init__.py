"""The frame as load path: from loads on the parts in the shell to forces on its wall."""

from .contacts import Contacts, contacts_of
from .inner import InnerSet, inner_set
from .on_shell import FrameOnShell, frame_on_shell

__all__ = [
    "Contacts",
    "FrameOnShell",
    "InnerSet",
    "contacts_of",
    "frame_on_shell",
    "inner_set",
]
