"""Equal-area maps of the sphere of normals. A plane point is (..., 2), a normal (..., 3) in a frame (right, up, toward).

`right` is the centre of a map, `up` is north, and east is away from the viewer. A frame is a matrix with these unit vectors as rows,
right-handed.
"""

import numpy as np

HAMMER_HALF_WIDTH = 2 * np.sqrt(2)
HAMMER_HALF_HEIGHT = np.sqrt(2)


def normal_at(longitude, latitude):
    """Angles in rad, from the centre."""
    across = np.cos(latitude)
    return np.stack([across * np.cos(longitude), np.sin(latitude), -across * np.sin(longitude)], axis=-1)


def hammer(normals):
    """Hammer's map of the whole sphere to an ellipse (Snyder, Map projections, USGS 1987, eqs. 24-1 to 24-5: Lambert's map with
    halved longitudes, stretched)."""
    x, y, z = np.moveaxis(normals, -1, 0)
    longitude, across = np.arctan2(-z, x), np.hypot(x, z)
    scale = np.sqrt(2 / (np.hypot(y, across) + across * np.cos(longitude / 2)))
    return np.stack([2 * scale * across * np.sin(longitude / 2), scale * y], axis=-1)


def lambert(normals):
    """Lambert's azimuthal map about the centre (Snyder, eqs. 24-2 and 20-18). Distances from it are 2 sin(angle / 2)."""
    x, y, z = np.moveaxis(normals, -1, 0)
    across = np.stack([-z, y], axis=-1)
    length = np.linalg.norm(across, axis=-1)
    distance = np.where(x > 0, length * np.sqrt(2 / (1 + np.abs(x))), np.sqrt(2 * (1 - np.minimum(x, 0))))
    # The antipode of the centre is a whole circle of the map. Any point of it is valid.
    direction = np.where(length[..., None] > 0, across / np.where(length > 0, length, 1)[..., None], [1.0, 0.0])
    return distance[..., None] * direction


def lambert_inverse(points):
    """The normals of points at most 2 from the centre."""
    squared = np.minimum(np.sum(points**2, axis=-1), 4)
    scale = np.sqrt(1 - squared / 4)
    return np.stack([1 - squared / 2, scale * points[..., 1], -scale * points[..., 0]], axis=-1)
