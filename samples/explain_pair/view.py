"""Views of a body, through its parameterization by normals."""

import numpy as np
from canvas import simplified

# A curve is halved until its points are this close in px, or its parameters are practically equal: at a flat face the boundary
# point jumps.
PIXEL_STEP = 3
SMALLEST_STEP = 1e-10
OUTLINE_ERROR = 0.08  # px; largest deviation of a drawn line from the exact one
ROUNDING = 1e-15

# Relative to the largest area. Among views with nearly as much area, the one with the centres' offset in the picture plane is chosen.
PREFERENCE = 0.02
VIEWS = 180


def any_perpendicular(normal):
    """A unit vector perpendicular to a unit vector."""
    axis = np.eye(3)[np.argmin(np.abs(normal))]
    return unit(np.cross(normal, axis))


def unit(vector):
    return vector / np.linalg.norm(vector)


def frame_of_picture(pair, normal):
    """The frame (right, up, toward) of the picture of a pair, as rows. The common normal points to the right.

    So both tangent planes are seen edge on. The visible area of the bodies is as large as possible.
    """
    e1 = any_perpendicular(normal)
    e2 = np.cross(normal, e1)
    offset = pair.body2.pose.position - pair.body1.pose.position
    aside = offset - (offset @ normal) * normal
    length = np.linalg.norm(aside)
    bodies = [body for body in (pair.body1, pair.body2) if body.shape.half_extents.min() > 0]  # a point has no area
    whole = sum(body.shape.surface_area() for body in bodies)

    def merit(toward):
        seen = sum(body.shape.projected_area(toward @ body.pose.rotation) for body in bodies) / whole if bodies else 0
        return seen - PREFERENCE * (abs(aside @ toward) / length if length > 0 else 0)

    angles = np.pi * np.arange(VIEWS) / VIEWS
    toward = max((np.cos(angle) * e1 + np.sin(angle) * e2 for angle in angles), key=merit)
    up = np.cross(toward, normal)
    # The upward direction is as close as possible to the upward direction of the world.
    return np.array([normal, -up, -toward] if up[2] < 0 else [normal, up, toward])


class View:
    """An orthographic view with `middle` (m, world frame) at the centre of a box, and `scale` px per metre."""

    def __init__(self, frame, middle, scale, box):
        self.frame, self.middle, self.scale, self.centre = frame, middle, scale, box.centre

    @classmethod
    def of(cls, frame, bodies, box):
        """A view that fits bodies into a box."""

        def extent(direction):
            return max(body.pose.position @ direction + body.support(direction) for body in bodies)

        (right, up, _) = frame
        width, height = extent(right) + extent(-right), extent(up) + extent(-up)
        middle = 0.5 * (extent(right) - extent(-right)) * right + 0.5 * (extent(up) - extent(-up)) * up
        return cls(frame, middle, min(box.width / width, box.height / height), box)

    def to_px(self, points):
        """Of points (..., 3), m, world frame."""
        return self.centre + self.scale * ((points - self.middle) @ self.frame[:2].T) * [1, -1]


def trace(body, view, normal, start, end):
    """The image of the boundary points with the normals normal(t), an array (N, 3) in the body's frame for an array of t."""

    def image(t):
        return view.to_px(body.pose.position + body.shape.point(normal(t)) @ body.pose.rotation.T)

    t = np.linspace(start, end, 33)
    points = image(t)
    while True:
        is_wide = (np.linalg.norm(np.diff(points, axis=0), axis=1) > PIXEL_STEP) & (np.abs(np.diff(t)) > SMALLEST_STEP)
        if not is_wide.any():
            break
        middle = (0.5 * (t[:-1] + t[1:]))[is_wide]
        places = np.flatnonzero(is_wide) + 1
        t, points = np.insert(t, places, middle), np.insert(points, places, image(middle), axis=0)
    return simplified(points, OUTLINE_ERROR)


def _without_rounding(normals):
    """Components within rounding of 0 are 0: on a body with flat faces the boundary point is a steep power of them."""
    return np.where(np.abs(normals) < ROUNDING, 0, normals)


def _arc(first, second):
    """The great circle from one unit vector through another one."""
    return lambda t: _without_rounding(np.cos(t)[:, None] * first + np.sin(t)[:, None] * second)


def outline(body, view):
    """The boundary points whose normals are perpendicular to the view direction: closed, of either orientation."""
    right, up, _ = view.frame @ body.pose.rotation
    return trace(body, view, _arc(right, up), -np.pi, np.pi)


class Circle:
    """The normals at the angle acos(cosine) from an axis, from where they are nearest to the viewer."""

    def __init__(self, axis, toward, cosine):
        tangent = toward - (toward @ axis) * axis
        self.axis, self.cosine, self.sine = axis, cosine, np.sqrt(max(1 - cosine**2, 0))
        self.nearest = unit(tangent) if np.linalg.norm(tangent) > 1e-9 else any_perpendicular(axis)
        self.aside = np.cross(axis, self.nearest)

    def __call__(self, t):
        across = np.cos(t)[:, None] * self.nearest + np.sin(t)[:, None] * self.aside
        return self.cosine * self.axis + self.sine * across

    def visible(self, toward):
        """Normals up to this angle on both sides of the start are visible: pi if all are, negative if none is."""
        depth, reach = self.cosine * (self.axis @ toward), self.sine * (self.nearest @ toward)
        if depth >= reach:
            return np.pi
        return -1 if depth <= -reach else np.arccos(np.clip(-depth / reach, -1, 1))


def lit_part(body, view, light, cosine):
    """The visible points whose normals are within acos(cosine) of `light` (unit): a closed polygon, possibly empty."""
    toward, source = view.frame[2] @ body.pose.rotation, light @ body.pose.rotation
    circle = Circle(source, toward, cosine)
    end = circle.visible(toward)
    if end < 0:
        return np.empty((0, 2))
    part = trace(body, view, circle, -end, end)
    if end == np.pi:
        return part
    # Return along the outline, on the side of the light.
    middle = unit(source - (source @ toward) * toward)
    aside = np.cross(toward, middle)
    (first, last) = ((np.arctan2(n @ aside, n @ middle)) for n in circle(np.array([end, -end])))
    return np.vstack([part, trace(body, view, _arc(middle, aside), first, last)])


def graticule(body, view, spacing):
    """The visible curves along which the normal has one latitude or longitude in the body's frame, every `spacing` degrees."""
    toward = view.frame[2] @ body.pose.rotation
    angles = np.radians(np.arange(0, 180, spacing))
    circles = [Circle(np.array([0.0, 0, 1]), toward, np.cos(angle)) for angle in angles[1:]]
    axes = _without_rounding(np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1))
    circles += [Circle(axis, toward, 0) for axis in axes]
    ends = [circle.visible(toward) for circle in circles]
    return [trace(body, view, circle, -end, end) for circle, end in zip(circles, ends) if end > 0]
