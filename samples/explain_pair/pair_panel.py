"""The pair, seen across the common normal, and its contact points, seen along it."""

import numpy as np
from canvas import BLACK, BODY1, BODY2, GREY, INK, VERMILION, Box, hex_colour, length_text
from view import View, graticule, lit_part, outline, unit

# px
ABOVE, BELOW, ASIDE = 40, 40, 14  # margins for normals, the gap and the bodies
TIGHT_GAP = 44  # below this the arrows of the gap are outside
OUTSIDE_ARROW = 26
LONGEST_SCALE = 90

GRATICULE = 30  # degrees
PAINT1, PAINT2 = (0.075, 240, BODY1), (0.085, 60, BODY2)  # chroma, hue, and the colour of the lines
TONES, DARKEST, LIGHTEST = 9, 0.74, 0.97  # nested parts from dark to light: their number, and lightness


def draw_pair(canvas, box, explanation, frame):
    """Both bodies, the tangent planes, the witness points, the contact and the gap."""
    pair, answer = explanation.pair, explanation.answer
    inner = Box(box.x + ASIDE, box.y + ABOVE, box.width - 2 * ASIDE, box.height - ABOVE - BELOW)
    view = View.of(frame, (pair.body1, pair.body2), inner)
    outline1, outline2 = outline(pair.body1, view), outline(pair.body2, view)
    _shade(canvas, pair.body1, view, outline1, PAINT1)
    _shade(canvas, pair.body2, view, outline2, PAINT2)
    if answer.gap < 0:
        # Body 1 shows through body 2.
        with canvas.clipped(outline2):
            _draw_graticule(canvas, pair.body1, view, BODY1)
        with canvas.clipped(outline1):
            canvas.fill(outline2, fill=VERMILION, alpha=0.35)
    canvas.fill(outline1, edge=BODY1, width=1.6)
    canvas.fill(outline2, edge=BODY2, width=1.6)

    point1, point2 = view.to_px(answer.point1), view.to_px(answer.point2)
    _draw_planes(canvas, box, point1[0], point2[0], answer.gap)
    for corner in explanation.corners:
        draw_contact(canvas, view.to_px(corner))
    if answer.gap <= 0:
        draw_contact(canvas, view.to_px(answer.contact))
    side = 1 if answer.gap >= 0 else -1  # each label on the side of its body
    for at, direction, words, colour in ((point1, -side, "P₁", BODY1), (point2, side, "P₂", BODY2)):
        canvas.ellipse(at, 4.2, fill=colour, edge="white", width=1.2)
        align = "right" if direction < 0 else "left"
        canvas.text(at + [9 * direction, -9], words, 16, align, colour, True, style="italic")
    _draw_scale(canvas, np.array([box.right - 6, box.y - 14]), view.scale)


def _shade(canvas, body, view, outline_of_body, paint):
    chroma, hue, line = paint
    light = unit(np.array([-0.45, 0.5, 0.75]) @ view.frame)

    def tone(share):
        return hex_colour(DARKEST + share * (LIGHTEST - DARKEST), chroma * (1 - 0.6 * share), hue)

    canvas.fill(outline_of_body, fill=tone(0))
    for share in np.arange(1, TONES) / TONES:
        canvas.fill(lit_part(body, view, light, -0.35 + share * 1.35), fill=tone(share))
    _draw_graticule(canvas, body, view, line)


def _draw_graticule(canvas, body, view, colour):
    for line in graticule(body, view, GRATICULE):
        canvas.line(line, colour, 0.8, alpha=0.35)


def _draw_scale(canvas, right_end, px_per_metre):
    longest = LONGEST_SCALE / px_per_metre
    power = 10 ** np.floor(np.log10(longest))
    length = max(factor * power for factor in (1, 2, 5) if factor == 1 or factor * power <= longest)
    left_end = right_end - [length * px_per_metre, 0]
    canvas.line([left_end, right_end], GREY, 1.4, gid="scale")
    for end in (left_end, right_end):
        canvas.line([end - [0, 4], end + [0, 4]], GREY, 1.4)
    canvas.text(right_end + [0, -8], length_text(length), 12, "right", GREY, gid="length of scale")


def _draw_planes(canvas, box, x1, x2, gap):
    for x in (x1, x2):
        canvas.line([(x, box.y + 6), (x, box.bottom)], INK, 1.3, gid="plane")
    y = box.y + 16
    canvas.arrow((x1, y), (x1 + 46, y), INK, 1.8)
    # Its label is at the tail if the other plane is close to the tip.
    is_tight = x1 < x2 < x1 + 80
    canvas.text((x1 - 8 if is_tight else x1 + 52, y + 5), "n", 16, "right" if is_tight else "left", INK, True, style="italic")
    _draw_gap(canvas, box, min(x1, x2), max(x1, x2), gap)


def _draw_gap(canvas, box, left, right, gap):
    """The distance between the planes, with its label beside them, on the side with more space."""
    y = box.bottom - 16
    is_wide = right - left > TIGHT_GAP
    for tip, outward in ((right, 1), (left, -1)):
        tail = (left + right) / 2 if is_wide else tip + outward * OUTSIDE_ARROW
        canvas.arrow((tail, y), (tip, y), VERMILION, 2)
    words = f"gap {length_text(gap)}" if gap >= 0 else f"depth {length_text(-gap)}"
    is_right = (left + right) / 2 < box.centre[0]
    away = (0 if is_wide else OUTSIDE_ARROW) + 8
    at = (right + away if is_right else left - away, y + 5)
    canvas.text(at, words, 13, "left" if is_right else "right", VERMILION, True, weight="bold")


def draw_contact(canvas, at):
    """The mark of a contact point."""
    canvas.fill(at + 5 * np.array([[0, -1], [1, 0], [0, 1], [-1, 0]]), fill=BLACK, edge="white", width=1.2)


def draw_axes(canvas, at, frame):
    """The directions of the world axes."""
    letters = []
    for name, axis in zip("xyz", frame.T):
        along = axis[:2] * [1, -1]
        tip = at + 26 * along
        canvas.line([at, tip], GREY, 1.4)
        # An axis towards the viewer is a dot, with its label beside it. Labels of neighbouring axes are moved apart.
        outward = unit(along) if np.linalg.norm(along) > 0.25 else np.array([-1.0, 0])
        letter = tip + 8 * outward
        while any(np.linalg.norm(other - letter) < 11 for other in letters):
            letter = letter + 3 * outward
        letters.append(letter)
        canvas.text(letter + [0, 4], name, 12, "center", GREY)


def draw_manifold(canvas, box, explanation, frame):
    """The points of a contact manifold, seen along the normal: body 2 is on top."""
    pair, contact = explanation.pair, explanation.answer.contact
    right, up, toward = frame
    against = np.array([-toward, up, right])
    places = np.vstack([explanation.corners, contact]) @ against.T
    low, high = places.min(axis=0), places.max(axis=0)
    with np.errstate(divide="ignore"):
        scale = 0.7 * min(np.array([box.width, box.height]) / (high - low)[:2])
    view = View(against, 0.5 * (low + high) @ against, scale, box)
    with canvas.clipped(box.corners):
        canvas.fill(outline(pair.body1, view), fill="#DCE9F5", edge=BODY1, width=1.6)
        canvas.fill(outline(pair.body2, view), fill="#F7E3CCB3", edge=BODY2, width=1.6)
    polygon = view.to_px(explanation.corners)
    canvas.fill(polygon, fill=VERMILION + "59", edge=VERMILION, width=1.2)
    for at in [*polygon, view.to_px(contact)]:
        draw_contact(canvas, at)
    canvas.rectangle(box, edge="#999999")
