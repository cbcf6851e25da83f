"""The frame as load path: from loads on the parts in the shell to forces on its wall."""

from .contacts import Contacts, contacts_of, rigid_rows
from .inner import InnerSet, inner_set
from .solve import contact_forces, shell_compliance

__all__ = [
    "Contacts",
    "InnerSet",
    "contact_forces",
    "contacts_of",
    "inner_set",
    "rigid_rows",
    "shell_compliance",
]
