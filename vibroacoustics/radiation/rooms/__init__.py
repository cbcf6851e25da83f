"""Rooms: waves between parallel walls and furniture, by cosine series in boxes of air.

>>> materials = va.rooms.read_library("data/rooms/materials.toml")
"""

from .join_box import JoinBox
from .lattice import Lattice
from .local_step import local_transfer
from .materials import HARD, Material, read_library
from .response import room_transfer
from .room import Block, Patch, Room
from .run import RoomResponse
from .settings import RoomSettings
from .spacing_error import spacing_error_db

__all__ = [
    "HARD",
    "Block",
    "JoinBox",
    "Lattice",
    "Material",
    "Patch",
    "Room",
    "RoomResponse",
    "RoomSettings",
    "local_transfer",
    "read_library",
    "room_transfer",
    "spacing_error_db",
]
