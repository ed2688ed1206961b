"""The gap function on the sphere of normals, with the paths of the solvers."""

from dataclasses import dataclass

import numpy as np
import supernormal as sn
from canvas import (
    BLACK,
    BLUE,
    BROWN,
    GREEN,
    INK,
    ORANGE,
    PURPLE,
    VERMILION,
    Box,
    hex_colour,
    length_text,
    map_colour,
    round_step,
    simplified,
)
from contourpy import FillType, LineType, contour_generator
from sphere_maps import HAMMER_HALF_HEIGHT, HAMMER_HALF_WIDTH, hammer, lambert, lambert_inverse, normal_at
from view import any_perpendicular, unit

BANDS, CLOSE_UP_BANDS = 18, 10
LINE_COLOUR = "#223344"
ZERO_STYLE = {"colour": LINE_COLOUR, "width": 1.8}
REGION_STYLE = {"colour": BLACK, "width": 1.2, "dashes": (4, 2.5)}

# px
BAR = 40  # the colour bar with its labels
LINE_ERROR = 0.12  # of a line on a map
NUMBERS_APART = 20  # a number closer than this to another is omitted
MARKERS_APART = 7  # a marker closer than this to another is omitted
SMALLEST_REGION = 24  # a smaller remaining region is not drawn

ARC_STEP = np.radians(2)
SAME_NORMAL = 1e-12
FEW_EVALUATIONS = 20  # a longer path is drawn finely, without outlined markers
NUMBERED = 9
MOST_REGIONS = 4
ROUNDING = 1e-12  # of s relative to its largest value


@dataclass(frozen=True)
class Map:
    """A map in the picture: the normals (rows, columns, 3) at the nodes of its grid, and how normals (..., 3) become px."""

    box: Box
    normals: np.ndarray
    nodes: np.ndarray
    to_px: object
    longest_piece: float  # px; if two points of an arc are farther apart, they are on opposite sides of the map

    def contours(self, values):
        x, y = np.moveaxis(self.nodes, -1, 0)
        return contour_generator(x, y, values, line_type=LineType.Separate, fill_type=FillType.OuterOffset)

    def is_inside(self, at):
        return bool(np.all(np.abs(at - self.box.centre) < [self.box.width / 2 - 12, self.box.height / 2 - 12]))


def hammer_map(box, frame):
    """The whole sphere."""
    scale = min(0.5 * box.width / HAMMER_HALF_WIDTH, 0.5 * box.height / HAMMER_HALF_HEIGHT)
    # Just within the rim, so that an end of a parallel stays on its side.
    longitudes, latitudes = np.linspace(-np.pi, np.pi, 181) * (1 - 1e-9), np.linspace(-np.pi / 2, np.pi / 2, 91)
    places = normal_at(*np.meshgrid(longitudes, latitudes))
    to_px = lambda n: box.centre + scale * hammer(n @ frame.T) * [1, -1]  # noqa: E731
    return Map(box, places @ frame, box.centre + scale * hammer(places) * [1, -1], to_px, 0.3 * box.width)


def lambert_map(box, frame, half_angle):
    """The normals within an angle (rad) of the centre, and the corners."""
    reach = 2 * np.sin(half_angle / 2)
    scale = 0.5 * min(box.width, box.height) / reach
    points = np.stack(np.meshgrid(np.linspace(-reach, reach, 97), np.linspace(-reach, reach, 97)), axis=-1)
    to_px = lambda n: box.centre + scale * lambert(n @ frame.T) * [1, -1]  # noqa: E731
    return Map(box, lambert_inverse(points) @ frame, box.centre + scale * points * [1, -1], to_px, np.inf)


class Levels:
    """Levels at multiples of a round step."""

    def __init__(self, values, parts):
        least, most = values.min(), values.max()
        rounding = ROUNDING * max(abs(least), abs(most))
        self.step = round_step(max(most - least, rounding), parts)
        # A constant function has no band: its level is above it.
        first = np.ceil(least / self.step) if most - least > rounding else np.floor(most / self.step) + 1
        self.values = self.step * np.arange(first, max(np.floor(most / self.step), first) + 1)

    def colour(self, bands_above_lowest):
        return hex_colour(*map_colour(bands_above_lowest / len(self.values)))


def draw_sphere(canvas, box, explanation, frame, close_up):
    """The whole sphere on Hammer's map, with a colour bar below. `close_up`: the half angle of draw_close_up(), rad."""
    inner = Box(box.x, box.y, box.width, box.height - BAR)
    sphere = hammer_map(inner, frame)
    values = explanation.pair.gap(sphere.normals)
    levels = Levels(values, BANDS)
    half_width = min(inner.width, 2 * inner.height) / 2
    canvas.ellipse(inner.centre, half_width, half_width / 2, fill=levels.colour(0))
    _draw_bands(canvas, values, levels, sphere)
    _draw_graticule(canvas, frame, sphere)
    axes = sphere.to_px(np.vstack([sign * axis for axis in np.eye(3) for sign in (1, -1)]).reshape(-1, 3))
    _draw_regions(canvas, explanation, sphere, list(axes))
    canvas.fill(_window(close_up, frame, sphere), edge=INK)
    _draw_world_axes(canvas, axes, inner.centre)
    _draw_paths(canvas, explanation, sphere, 3.4)
    canvas.ellipse(inner.centre, half_width, half_width / 2, edge=INK, width=1.4)
    bar = Box(inner.centre[0] - half_width, box.bottom - BAR + 12, 2 * half_width, 10)
    _draw_colour_bar(canvas, bar, levels)


def draw_close_up(canvas, box, explanation, frame, half_angle):
    """The surroundings of the answer on Lambert's map."""
    close = lambert_map(box, frame, half_angle)
    values = explanation.pair.gap(close.normals)
    levels = Levels(values, CLOSE_UP_BANDS)
    with canvas.clipped(box.corners):
        canvas.rectangle(box, fill=levels.colour(0))
        _draw_bands(canvas, values, levels, close)
        _draw_regions(canvas, explanation, close, [])
        _draw_paths(canvas, explanation, close, 4, has_numbers=True)
    canvas.rectangle(box, edge=INK, width=1.4)


def close_up_angle(explanation):
    """The half angle, rad, that shows the steps of the solvers after their first ones."""
    steps = [path.normals[1] for path in explanation.paths if path.solver is not None and len(path) > 1]
    distances = [np.linalg.norm(normal - explanation.answer.normal) for normal in steps]
    angle = 2 * np.arcsin(min(0.5 * max(distances, default=0), 1))
    return np.radians(40) if angle < 1e-6 else np.clip(1.4 * angle, np.radians(0.2), np.radians(40))


def _rings(contours, level):
    """The polygons of the values above a level, as lists of rings with their holes."""
    for points, offsets in zip(*contours.filled(level, np.inf)):
        yield [simplified(points[a:b], LINE_ERROR) for a, b in zip(offsets[:-1], offsets[1:])]


def _draw_bands(canvas, values, levels, on_map):
    """The bands of s, and the border between the normals that prove the bodies apart and all others."""
    contours = on_map.contours(values)
    for k, level in enumerate(levels.values):
        rings = [ring for polygon in _rings(contours, level) for ring in polygon]
        canvas.fill(*rings, fill=levels.colour(k + 1), edge=LINE_COLOUR + "4D", width=0.6)
    for line in contours.lines(0):
        canvas.line(simplified(line, LINE_ERROR), **ZERO_STYLE)


def _draw_graticule(canvas, frame, on_map):
    """Parallels and meridians of the map."""
    share = np.linspace(-1, 1, 91) * (1 - 1e-9)
    for k in range(-2, 3):
        for line in (
            normal_at(np.pi * share, np.radians(30 * k) + 0 * share),
            normal_at(np.radians(60 * k) + 0 * share, np.pi / 2 * share),
        ):
            canvas.line(simplified(on_map.to_px(line @ frame), LINE_ERROR), LINE_COLOUR, 0.7, alpha=0.25)


def _draw_world_axes(canvas, places, middle):
    """Crosses, with labels towards the middle."""
    for name, at in zip(("+x", "−x", "+y", "−y", "+z", "−z"), places):
        canvas.line([at - [3.5, 0], at + [3.5, 0]], INK, 1.2)
        canvas.line([at - [0, 3.5], at + [0, 3.5]], INK, 1.2)
        is_right, is_low = at > middle
        where = at + [-6 if is_right else 6, -5 if is_low else 13]
        canvas.text(where, name, 12, "right" if is_right else "left", INK, True)


def _window(half_angle, frame, on_map):
    """The border of Lambert's map of the normals within this angle, on another map."""
    reach = 2 * np.sin(half_angle / 2)
    along = reach * np.linspace(-1, 1, 12, endpoint=False)
    side = np.stack([along, -reach + 0 * along], axis=1)
    sides = [side, side[:, ::-1] * [-1, 1], -side, side[:, ::-1] * [1, -1]]
    return on_map.to_px(lambert_inverse(np.vstack(sides)) @ frame)


def _draw_colour_bar(canvas, box, levels):
    """The colours of the bands, with some of the levels below."""
    count = len(levels.values)
    width = box.width / (count + 1)
    for k in range(count + 1):
        canvas.rectangle(Box(box.x + k * width, box.y, width, box.height), fill=levels.colour(k), edge=LINE_COLOUR, width=0.5)
    every = max(1, int(round_step(count, 6)))
    for k, level in enumerate(levels.values):
        if round(level / levels.step) % every == 0:
            x = box.x + (k + 1) * width
            canvas.line([(x, box.bottom), (x, box.bottom + 4)], LINE_COLOUR)
            canvas.text((x, box.bottom + 17), length_text(level) if round(level / levels.step) else "0", 12, "center")


# --- what the cuts leave ---


def _draw_regions(canvas, explanation, on_map, occupied):
    """The normals at which the cuts of the first k evaluations allow a value as high as the best one so far."""
    regions = []
    rounding = ROUNDING * np.abs(explanation.hybrid.values).max()
    for evaluations in _region_counts(len(explanation.hybrid)):
        contours = on_map.contours(-explanation.room_left(evaluations, on_map.normals) - rounding)
        border = [simplified(line, LINE_ERROR) for line in contours.lines(0)]
        if not border or np.ptp(np.vstack(border), axis=0).max() < SMALLEST_REGION:
            break
        regions.append((evaluations, border, contours))
    if not regions:
        return
    canvas.fill(*(ring for polygon in _rings(regions[-1][2], 0) for ring in polygon), fill=BLACK, alpha=0.13)
    for _, border, _ in regions:
        for line in border:
            canvas.line(line, "white", 2.6, alpha=0.6)
            canvas.line(line, **REGION_STYLE)
    for evaluations, border, _ in regions:
        # The highest point of the border on the map, away from other numbers.
        points = [at for at in np.vstack(border) if on_map.is_inside(at) and _is_clear(occupied, at, NUMBERS_APART)]
        if points:
            at = min(points, key=lambda point: point[1])
            draw_number(canvas, at, str(evaluations))
            occupied.append(at)


def _region_counts(evaluations):
    """Some numbers of evaluations, up to all of them."""
    if evaluations <= MOST_REGIONS:
        return range(1, evaluations + 1)
    if evaluations <= 2 * MOST_REGIONS:
        return 1, 2, 3, evaluations
    return 1, evaluations // 9 + 1, evaluations // 3 + 1, evaluations


def _is_clear(others, at, distance):
    return all(np.linalg.norm(other - at) >= distance for other in others)


def draw_number(canvas, at, number):
    canvas.ellipse(at, 11 if len(number) > 2 else 8, fill="white", edge=BLACK, width=0.8)
    canvas.text(at + [0, 4], number, 11, "center")


# --- the paths of the solvers ---


def style_of(path):
    """Colour, dashes and marker of a path."""
    if path.solver is not None:
        return {
            sn.Solver.HYBRID: (BLACK, None, "circle"),
            sn.Solver.NEWTON: (VERMILION, (7, 3), "triangle"),
            sn.Solver.FIXED_POINT: (PURPLE, (2, 3), "square"),
        }[path.solver]
    # The methods of the literature have their numbers in their names. Each number has a colour; dashes distinguish the variants.
    colour = {"(1)": BLUE, "(2)": GREEN, "(3)": ORANGE, "(4)": BROWN}[path.name[-3:]]
    is_dashed = path.name.startswith("normal") or path.name.endswith("distance (4)")
    is_dotted = path.name.endswith("common normal (4)")
    return colour, (5, 4) if is_dashed else (2, 4) if is_dotted else None, "diamond"


MARKERS = {
    "triangle": [(0, -1.4), (1.25, 0.9), (-1.25, 0.9)],
    "square": [(-1, -1), (1, -1), (1, 1), (-1, 1)],
    "diamond": [(0, -1.3), (1.3, 0), (0, 1.3), (-1.3, 0)],
}


def draw_marker(canvas, at, style, size):
    colour, _, marker = style
    if marker == "circle":
        canvas.ellipse(at, size, fill=colour, edge="white")
    else:
        canvas.fill(at + size * np.array(MARKERS[marker]), fill=colour, edge="white")


def draw_ring(canvas, at):
    """The mark of the answer."""
    canvas.ellipse(at, 7.5, edge="white", width=3.5)
    canvas.ellipse(at, 7.5, edge=BLACK, width=1.6)


def _draw_paths(canvas, explanation, on_map, size, has_numbers=False):
    # The hybrid is drawn last, on top.
    for path in reversed(explanation.paths):
        normals = path.normals[: explanation.shown_evaluations]
        _draw_path(canvas, normals, style_of(path), on_map, size, has_numbers and path is explanation.hybrid)
    draw_ring(canvas, on_map.to_px(explanation.answer.normal))


def _draw_path(canvas, normals, style, on_map, size, has_numbers):
    colour, dashes, _ = style
    is_short = len(normals) <= FEW_EVALUATIONS
    lines = _path_lines(normals, on_map)
    for line in lines if is_short else ():
        canvas.line(line, "white", 3.6, alpha=0.6)
    for line in lines:
        canvas.line(line, colour, 1.8 if is_short else 0.7, dashes)
    marked, numbered = [], []
    for k, at in enumerate(on_map.to_px(normals)):
        if not _is_clear(marked, at, MARKERS_APART):
            continue
        marked.append(at)
        draw_marker(canvas, at, style, size if is_short else 0.7 * size)
        if has_numbers and k < NUMBERED and _is_clear(numbered, at, NUMBERS_APART):
            numbered.append(at)
            canvas.text(at + [-6, -6], str(k + 1), 12, "right", INK, True)


def _path_lines(normals, on_map):
    """The great circles between successive normals. A cycle of a solver is drawn once."""
    lines, line, drawn = [], [], set()
    for start, end in zip(normals[:-1], normals[1:]):
        key = tuple(np.rint(on_map.to_px(np.array([start, end]))).ravel())
        if key in drawn:
            lines.append(line)
            line = []
            continue
        drawn.add(key)
        points = on_map.to_px(_arc(start, end))
        is_jump = np.linalg.norm(np.diff(points, axis=0), axis=1) > on_map.longest_piece
        first, *rest = np.split(points, np.flatnonzero(is_jump) + 1)
        line = [*line, *first]
        for piece in rest:
            lines.append(line)
            line = list(piece)
    return [simplified(one, LINE_ERROR) for one in [*lines, line] if len(one) > 1]


def _arc(start, end):
    """Normals on the great circle between two of them, both included. Between antipodes it is any great circle."""
    angle = 2 * np.arcsin(min(0.5 * np.linalg.norm(end - start), 1))
    tangent = end - (end @ start) * start
    tangent = unit(tangent) if np.linalg.norm(tangent) > SAME_NORMAL else any_perpendicular(start)
    t = np.linspace(0, angle, 2 + int(angle / ARC_STEP))[1:-1, None]
    return np.vstack([start, np.cos(t) * start + np.sin(t) * tangent, end])
