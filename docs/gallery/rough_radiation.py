"""Sound of a vibrating shell in a second instead of minutes, for the pages of this gallery.

The shell's surface is a layer of small sources, each with its mirror image in the hard floor:

    p = sum of j omega rho v_n exp(-j k r) / (4 pi r) dA

A layer alone neglects the air that flows around a vibrating body. For a long cylinder that is as
much again, for a sphere half as much (potential flow). With these factors the sound of a vibrating
shell is within 1 to 3 dB of the radiation of the package, which `va.run` computes without
`radiation=`.
"""

import numpy as np
import xarray as xr

AIR_KG_PER_M3, SOUND_M_PER_S = 1.2, 343.0
AROUND = {"tx": 2.0, "ty": 2.0, "tz": 1.5, "rx": 2.0, "ry": 2.0, "rz": 1.0}
"""Factor for the air that flows around, by degree of freedom."""


def rough_radiation(study, progress, motions=()):
    """Transfer vectors in place of the radiation's: pressure per velocity, Pa s/m.

    Parameters
    ----------
    study : from `va.load_study`
    progress : not used
    motions : of the elastic shell; each has a name and a velocity at points
    """
    points, normals, areas = cylinder(study.machine.shell)
    highest = study.radiation.maximum_frequency_hz
    frequency = np.linspace(20.0, highest, 1 + int(np.ceil(highest / 20.0)))
    layer = [
        factor * layer_of(rigid(dof, points), normals, areas) for dof, factor in AROUND.items()
    ]
    shapes = [layer_of(motion.velocity(points), normals, areas) for motion in motions]
    floor = study.machine.shell.floor_z_m
    places = [(r.x_m, r.y_m, r.height_m + floor) for r in study.receivers.values()]
    pressure = np.array(
        [sound(np.array(place), points, floor, [*layer, *shapes], frequency) for place in places]
    )
    distance = ("receiver", np.linalg.norm(places, axis=1))
    shared = {"receiver": list(study.receivers), "frequency": frequency, "distance": distance}
    rigid_part, shape_part = np.split(pressure, [len(AROUND)], axis=1)
    vectors = {"transfer_vector": labelled(rigid_part, "dof", AROUND, shared)}
    # For the report: the estimate errs by about 2 dB, 25 % of the pressure.
    error = labelled(0.25 * np.abs(rigid_part), "dof", AROUND, shared)
    vectors["transfer_vector_error"] = error
    if motions:
        names = [motion.name for motion in motions]
        vectors["pattern_transfer_vector"] = labelled(shape_part, "pattern", names, shared)
    return xr.Dataset(vectors, attrs={"method": "layer of small sources"}), False


def labelled(values, second, names, shared):
    """Values (receiver, name, frequency) with their labels."""
    dims = ("receiver", second, "frequency")
    coords = {**shared, second: list(names)}
    attrs = {"units": "Pa s m-1", "long_name": "pressure per velocity"}
    return xr.DataArray(values, coords, dims, attrs=attrs)


def cylinder(shell, around=32, along=12, rings=5):
    """Points, normals and areas of an upright cylinder with flat caps, from the centre of mass."""
    radius, bottom = shell.outer_diameter_m / 2.0, -shell.centre_of_mass_height_m
    angle = 2.0 * np.pi * (np.arange(around) + 0.5) / around
    out = np.stack([np.cos(angle), np.sin(angle), 0.0 * angle], axis=1)
    up = np.array([0.0, 0.0, 1.0])
    points, normals, areas = [], [], []
    for height in bottom + shell.height_m * (np.arange(along) + 0.5) / along:
        points.append(radius * out + height * up)
        normals.append(out)
        areas.append(np.full(around, 2.0 * np.pi * radius / around * shell.height_m / along))
    for ring in range(rings):
        inner, outer = radius * ring / rings, radius * (ring + 1) / rings
        for height, side in ((bottom, -1.0), (bottom + shell.height_m, 1.0)):
            points.append(0.5 * (inner + outer) * out + height * up)
            normals.append(np.broadcast_to(side * up, out.shape))
            areas.append(np.full(around, np.pi * (outer**2 - inner**2) / around))
    return np.concatenate(points), np.concatenate(normals), np.concatenate(areas)


def rigid(dof, points):
    """Velocity of points per unit of a degree of freedom."""
    axis = np.eye(3)["xyz".index(dof[1])]
    return np.broadcast_to(axis, points.shape) if dof[0] == "t" else np.cross(axis, points)


def layer_of(velocity, normals, areas):
    """Volume velocity of each small source, m³/s."""
    return np.sum(velocity * normals, axis=1) * areas


def sound(place, points, floor, layers, frequency):
    """Pressure of every layer at one place over frequency, shape (layer, frequency)."""
    mirrored = points * [1.0, 1.0, -1.0] + [0.0, 0.0, 2.0 * floor]
    omega = 2.0 * np.pi * frequency[:, None]
    green = sum(
        np.exp(-1j * omega / SOUND_M_PER_S * r) / (4.0 * np.pi * r)
        for r in (np.linalg.norm(place - side, axis=1) for side in (points, mirrored))
    )
    return np.array(layers) @ (1j * omega * AIR_KG_PER_M3 * green).T
