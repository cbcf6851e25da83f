"""The frame as load path: from loads on the parts in the shell to forces on its wall."""

from .contacts import Contacts, contacts_of
from .inner import InnerSet, inner_set
from .on_shell import FrameOnShell, ShellForces, frame_on_shell
from .solve import contact_forces, shell_compliance

__all__ = [
    "Contacts",
    "FrameOnShell",
    "InnerSet",
    "ShellForces",
    "contact_forces",
    "contacts_of",
    "frame_on_shell",
    "inner_set",
    "shell_compliance",
]
