"""Smooth convex bodies: shapes, signed distance, witness points, contacts and rays, with NumPy arrays in and out.

Lengths are in metres, or in whatever unit a program uses throughout. Normals point from body 1 to body 2; a gap is positive when
bodies are apart and negative when they overlap. Bad input raises ValueError with the parameter, its value and the valid range.
`supernormal.ode` has the same bodies as geoms of PyODE.
"""

try:
    import numpy as _numpy  # noqa: F401  # without it the next import fails and does not say why
except ImportError as _missing:
    raise ImportError("supernormal takes NumPy (Debian: python3-numpy)", name="numpy") from _missing

from ._core import (
    Box,
    CallbackShape,
    Capsule,
    ContactManifold,
    Cylinder,
    Ellipsoid,
    LinearImage,
    MassProperties,
    MinkowskiSum,
    Polytope,
    Pose,
    Poses,
    Proximities,
    Proximity,
    RayHit,
    RayHits,
    Rounded,
    Settings,
    Shape,
    Shapes,
    Solver,
    Sphere,
    Status,
    Superellipsoid,
    Superovoid,
    Tessellation,
    find_contact_curvature,
    find_contact_manifold,
    find_curvature,
    find_plane_contact_manifold,
    find_plane_proximity,
    find_proximities,
    find_proximity,
    find_ray_hit,
    find_ray_hits,
)

__all__ = [
    "Box",
    "CallbackShape",
    "Capsule",
    "ContactManifold",
    "Cylinder",
    "Ellipsoid",
    "LinearImage",
    "MassProperties",
    "MinkowskiSum",
    "Polytope",
    "Pose",
    "Poses",
    "Proximities",
    "Proximity",
    "RayHit",
    "RayHits",
    "Rounded",
    "Settings",
    "Shape",
    "Shapes",
    "Solver",
    "Sphere",
    "Status",
    "Superellipsoid",
    "Superovoid",
    "Tessellation",
    "find_contact_curvature",
    "find_contact_manifold",
    "find_curvature",
    "find_plane_contact_manifold",
    "find_plane_proximity",
    "find_proximities",
    "find_proximity",
    "find_ray_hit",
    "find_ray_hits",
]
