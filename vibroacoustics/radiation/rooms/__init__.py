"""Rooms: waves between parallel walls and furniture, by cosine series in boxes of air.

>>> materials = va.rooms.read_library("data/rooms/materials.toml")
"""

from .diffuse import (
    DiffuseRoom,
    blend,
    gain_at_place_db,
    line_of_sight,
    mean_square_per_power,
)
from .join_box import JoinBox
from .lattice import Lattice
from .local_step import local_transfer
from .machine_in_room import room_pressure_per_velocity, room_vectors
from .materials import HARD, Material, read_library
from .response import room_transfer
from .room import Block, Patch, Room
from .run import RoomResponse
from .settings import RoomSettings
from .spacing_error import spacing_error_db

__all__ = [
    "HARD",
    "Block",
    "DiffuseRoom",
    "JoinBox",
    "Lattice",
    "Material",
    "Patch",
    "Room",
    "RoomResponse",
    "RoomSettings",
    "blend",
    "gain_at_place_db",
    "line_of_sight",
    "local_transfer",
    "mean_square_per_power",
    "read_library",
    "room_pressure_per_velocity",
    "room_transfer",
    "room_vectors",
    "spacing_error_db",
]
