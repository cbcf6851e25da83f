"""Sound to listen to, and what an ear makes of it: tones, loudness, sharpness."""

from .ingredients import Ingredients, SoundBands, SoundLines, ingredients

__all__ = ["Ingredients", "SoundBands", "SoundLines", "ingredients"]
