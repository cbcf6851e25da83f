from .measured_power import sound_power as sound_power
from .measurement_surface import MeasurementSurface as MeasurementSurface
from .radiating import radiate as radiate
from .recording import analyse_orders as analyse_orders
from .recording import speed_frequency_map as speed_frequency_map
from .recording import track_orders as track_orders
from .room_responses import impulse_responses as impulse_responses
from .study import run as run
