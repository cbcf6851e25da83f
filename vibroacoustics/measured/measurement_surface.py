"""Measurement surface of a sound power measurement: positions of its microphones."""

from dataclasses import dataclass

from ..base.allowed import check_range
from ..levels.sound_power import box_area_m2, hemisphere_area_m2
from ..radiation.arrangements import TABLE_B1, box_positions


@dataclass(frozen=True)
class MeasurementSurface:
    """A hemisphere or a parallelepiped over a hard floor (ISO 3744:2010, 7.2).

    Attributes
    ----------
    name : in words, with its sizes
    area_m2 : area of the surface
    positions : numbers of microphones that the standard has for it

    Examples
    --------
    >>> round(va.MeasurementSurface.hemisphere(1.0).area_m2, 2)
    6.28
    >>> va.MeasurementSurface.box(0.3, 0.2, 0.4, 1.0).positions
    (9,)
    """

    name: str
    area_m2: float
    positions: tuple[int, ...]

    @classmethod
    def hemisphere(cls, radius_m: float) -> "MeasurementSurface":
        """A hemisphere with 10 or 20 microphones (Table B.1).

        Raises
        ------
        ParameterError
            The radius is out of range.
        """
        check_range("radius_m", radius_m, 0.5, 16.0, "m")
        area = hemisphere_area_m2(radius_m)
        return cls(f"hemisphere of {radius_m:g} m", area, (len(TABLE_B1) // 2, len(TABLE_B1)))

    @classmethod
    def box(
        cls, length_m: float, width_m: float, height_m: float, distance_m: float
    ) -> "MeasurementSurface":
        """A parallelepiped around a reference box (7.2.4, Annex C).

        Parameters
        ----------
        length_m, width_m, height_m : edges of the smallest box around the machine
        distance_m : from it to the microphones

        Raises
        ------
        ParameterError
            A length is out of range.
        """
        edges = {"length_m": length_m, "width_m": width_m, "height_m": height_m}
        for key, edge in edges.items():
            check_range(key, edge, 0.01, 20.0, "m")
        check_range("distance_m", distance_m, 0.25, 16.0, "m")
        sizes = (length_m, width_m, height_m, distance_m)
        words = f"box {length_m:g} x {width_m:g} x {height_m:g} m at {distance_m:g} m"
        return cls(words, box_area_m2(*sizes), (len(box_positions(*sizes)),))
