"""Rooms: waves between parallel walls and furniture, by cosine series in boxes of air."""

from .join_box import JoinBox
from .lattice import Lattice
from .materials import HARD, Material, read_library
from .response import room_transfer
from .room import Block, Patch, Room
from .run import RoomResponse
from .settings import RoomSettings

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
    "read_library",
    "room_transfer",
]
