"""Rooms: waves between parallel walls and furniture, by cosine series in boxes of air.

>>> materials = va.rooms.read_library("data/rooms/materials.toml")
"""

from .diffuse import (
    DiffuseRoom,
    blend,
    gain_at_position_db,
    line_of_sight,
    mean_square_per_power,
)
from .join_box import JoinBox
from .lattice import Lattice
from .machine_in_room import room_pressure_per_velocity, room_vectors
from .room import HARD, Block, Material, Patch, Room, read_library
from .run import RoomResponse, room_transfer, spacing_error_db
from .settings import RoomSettings

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
    "gain_at_position_db",
    "line_of_sight",
    "mean_square_per_power",
    "read_library",
    "room_pressure_per_velocity",
    "room_transfer",
    "room_vectors",
    "spacing_error_db",
]
