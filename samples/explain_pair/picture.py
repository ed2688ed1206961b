"""The picture of a pair: all panels, their titles and the legends."""

import numpy as np
from bounds_panel import draw_bounds
from canvas import BODY1, BODY2, GREY, INK, Box, Canvas, length_text
from map_panel import (
    REGION_STYLE,
    ZERO_STYLE,
    close_up_angle,
    draw_close_up,
    draw_marker,
    draw_number,
    draw_ring,
    draw_sphere,
    style_of,
)
from pair_panel import draw_axes, draw_contact, draw_manifold, draw_pair
from view import frame_of_picture

# px
WIDTH, HEIGHT = 1200, 800
PAIR = Box(16, 84, 548, 440)
TABLE = Box(16, 548, 548, 84)
LEGEND = Box(16, 648, 380, 136)
SPHERE = Box(596, 64, 588, 350)
CLOSE_UP = Box(596, 480, 290, 290)
BOUNDS = Box(900, 480, 284, 290)
MANIFOLD = Box(444, 648, 120, 120)
AXES = np.array([400, 710])
ROW, ROWS = 22, 3  # of the table; rows that fit in its box
LARGEST_TITLE, WIDTH_OF_LETTER = 17, 0.6  # relative to the size


def picture_of(explanation):
    """A Canvas with all panels."""
    more = ROW * max(len(explanation.paths) - ROWS, 0)  # additional paths make the picture higher
    canvas = Canvas(WIDTH, HEIGHT + more)
    frame = frame_of_picture(explanation.pair, explanation.answer.normal)
    close_up = close_up_angle(explanation)
    _draw_titles(canvas, explanation, close_up)
    draw_pair(canvas, PAIR, explanation, frame)
    _draw_table(canvas, explanation)
    _draw_legend(canvas, LEGEND.lower(more), explanation)
    draw_axes(canvas, AXES + [0, more], frame)
    if len(explanation.corners):
        draw_manifold(canvas, MANIFOLD.lower(more), explanation, frame)
    draw_sphere(canvas, SPHERE, explanation, frame, close_up)
    draw_close_up(canvas, CLOSE_UP, explanation, frame, close_up)
    draw_bounds(canvas, BOUNDS, explanation)
    return canvas


def _draw_titles(canvas, explanation, close_up):
    pair = explanation.pair
    size = min(LARGEST_TITLE, PAIR.width / (WIDTH_OF_LETTER * max(len(pair.title), 1)))
    canvas.text((16, 28), pair.title, size, weight="bold")
    for y, body, fill, edge in ((40, pair.body1, "#8FB4D6", BODY1), (60, pair.body2, "#E3B583", BODY2)):
        canvas.rectangle(Box(16, y, 12, 12), fill=fill, edge=edge)
        canvas.text((34, y + 11), body.description, 13, colour=GREY)
    about = "equal areas; in the middle the common normal; on the middle meridian those in the plane of the left picture"
    panels = (
        ((SPHERE.x, 28), "s(n) for every normal n", 20, about),
        ((CLOSE_UP.x, CLOSE_UP.y - 26), "Close-up", 17, f"the square above, {np.degrees(2 * close_up):.2g}° wide"),
        ((BOUNDS.x + 12, BOUNDS.y - 26), "Proved interval", 17, "of the gap: the grey area, from the answer"),
    )
    for at, title, below, subtitle in panels:
        canvas.text(at, title, 17, weight="bold")
        canvas.text((at[0], at[1] + below), subtitle, 10.5 if subtitle is about else 13, colour=GREY)


def _draw_table(canvas, explanation):
    """The legend of the paths, as a table of the solvers."""
    room = 44 if len(explanation.paths) > ROWS else 0  # px; the names of methods of the literature are longer
    names, counts, gaps, states = TABLE.x + 44, TABLE.x + room + 246, TABLE.x + room + 272, TABLE.x + room + 392
    y = TABLE.y + 14
    for x, head, align in (
        (names, "solver", "left"),
        (counts, "evaluations", "right"),
        (gaps, "s at the end", "left"),
        (states, "status", "left"),
    ):
        canvas.text((x, y), head, 13, align, GREY)
    for path in explanation.paths:
        y += ROW
        style = style_of(path)
        canvas.line([(TABLE.x, y - 5), (TABLE.x + 34, y - 5)], style[0], 1.8, style[1])
        draw_marker(canvas, np.array([TABLE.x + 17, y - 5]), style, 4)
        canvas.text((names, y), path.name)
        canvas.text((counts, y), str(path.evaluations), align="right")
        canvas.text((gaps, y), length_text(path.gap, 6))
        canvas.text((states, y), path.status + (", proved" if path.is_global else ""))


def _draw_legend(canvas, box, explanation):
    """The legend of the other lines and marks."""
    gap, shown = explanation.answer.gap, explanation.shown_evaluations
    middle, half = np.array([box.x + 17, box.y + 7]), np.array([17, 0])

    def row(words):
        nonlocal middle
        canvas.text((box.x + 44, middle[1] + 5), words, 12, colour=GREY)
        middle = middle + [0, 22]

    draw_ring(canvas, middle)
    row("answer of the hybrid")
    canvas.line([middle - half, middle + half], **REGION_STYLE)
    draw_number(canvas, middle, "k")
    row("what the cuts of k evaluations leave: the lighter side")
    if gap > 0:
        canvas.line([middle - half, middle + half], **ZERO_STYLE)
        row("s = 0: normals inside prove that the bodies are apart")
    else:
        draw_contact(canvas, middle)
        row("contact points; seen along n in the box" if len(explanation.corners) else "contact point")
    canvas.line([middle - [0, 8], middle + [0, 8]], INK, 1.3)
    row("tangent planes across n, seen edge on")
    if any(len(path) > shown for path in explanation.paths):
        row(f"paths end after {shown} evaluations")
