"""A picture in px, x to the right and y down, on which matplotlib draws; colours, lengths and lines."""

import io
import re
from contextlib import contextmanager
from dataclasses import dataclass
from math import cos, hypot, pi, radians, sin

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.text import Text

# From the palette of Okabe and Ito, which is distinguishable with any colour vision. Purple and orange are darker than there, to
# stand out on the pale map; brown is not in it.
BLUE, VERMILION, PURPLE, GREEN, ORANGE, BROWN = "#0072B2", "#D55E00", "#AA4488", "#009E73", "#B87300", "#7A4A2A"
BLACK, INK, GREY = "#000000", "#222222", "#444444"
BODY1, BODY2 = "#1F5F8F", "#A3600F"

LOWEST, HIGHEST = (0.60, 0.075, 235), (0.985, 0.02, 95)  # of the map: lightness, chroma, hue in degrees


# The unit circle in four cubic arcs.
_BEND = 0.5522847498
_QUARTER = np.array([[1, _BEND], [_BEND, 1], [0, 1]])
_TURN = np.array([[0, 1], [-1, 0]])  # of rows, by 90 degrees
CIRCLE = np.vstack([[[1, 0]], *(_QUARTER @ np.linalg.matrix_power(_TURN, k) for k in range(4))])
CIRCLE_CODES = [Path.MOVETO] + 12 * [Path.CURVE4]


@dataclass(frozen=True)
class Box:
    """A rectangle of the picture, px."""

    x: float
    y: float
    width: float
    height: float

    @property
    def right(self):
        return self.x + self.width

    @property
    def bottom(self):
        return self.y + self.height

    @property
    def centre(self):
        return np.array([self.x + self.width / 2, self.y + self.height / 2])

    @property
    def corners(self):
        return np.array([[self.x, self.y], [self.right, self.y], [self.right, self.bottom], [self.x, self.bottom]])

    def lower(self, by):
        return Box(self.x, self.y + by, self.width, self.height)


class Canvas:
    """What is drawn later is on top. Points are arrays (N, 2)."""

    def __init__(self, width, height):
        self.figure = Figure(figsize=(width / 72, height / 72), dpi=72)  # 1 px is 1 pt
        FigureCanvasAgg(self.figure)
        self.axes = self.figure.add_axes((0, 0, 1, 1), xlim=(0, width), ylim=(height, 0))
        self.axes.set_axis_off()
        self._order = 0
        self._clip = None

    def _add(self, artist):
        self._order += 1
        artist.set_zorder(self._order)
        self.axes.add_artist(artist)
        artist.set_clip_on(self._clip is not None)
        if self._clip is not None:
            artist.set_clip_path(self._clip, self.axes.transData)

    def line(self, points, colour=INK, width=1.0, dashes=None, **style):
        points = np.asarray(points, float)
        line = Line2D(points[:, 0], points[:, 1], color=colour, linewidth=width, solid_capstyle="butt", **style)
        if dashes:
            line.set_dashes([length / width for length in dashes])  # matplotlib counts in widths
        self._add(line)

    def fill(self, *polygons, fill="none", edge="none", width=1.0, **style):
        """Closed polygons as one path. A hole has the other orientation."""
        polygons = [np.asarray(polygon, float) for polygon in polygons if len(polygon) > 2]
        if polygons:
            path = Path.make_compound_path(*(Path(np.vstack([one, one[:1]]), closed=True) for one in polygons))
            self._add(PathPatch(path, facecolor=fill, edgecolor=edge, linewidth=width, joinstyle="round", **style))

    def rectangle(self, box, **style):
        self.fill(box.corners, **style)

    def ellipse(self, centre, radius_x, radius_y=None, fill="none", edge="none", width=1.0):
        path = Path(CIRCLE * [radius_x, radius_y or radius_x] + centre, CIRCLE_CODES)
        self._add(PathPatch(path, facecolor=fill, edgecolor=edge, linewidth=width, joinstyle="round"))

    def text(self, at, words, size=13, align="left", colour=INK, is_on_map=False, **style):
        """Text at a point of its baseline. On a map or a body it has a pale ground."""
        words = words.replace("$", r"\$")
        text = Text(*at, words, size=size, ha=align, va="baseline", color=colour, **style)
        if is_on_map:
            text.set_bbox({"facecolor": "white", "alpha": 0.6, "edgecolor": "none", "pad": 0.5})
        self._add(text)

    def arrow(self, start, end, colour, width):
        """A line with an arrowhead at `end`."""
        start, end = np.asarray(start, float), np.asarray(end, float)
        along = (end - start) / np.linalg.norm(end - start)
        across, length = np.array([-along[1], along[0]]), 3 + 3 * width
        self.line([start, end - 0.7 * length * along], colour, width)
        self.fill(
            [end, end - length * along + 0.4 * length * across, end - length * along - 0.4 * length * across], fill=colour
        )

    @contextmanager
    def clipped(self, polygon):
        """What is drawn within is clipped to the polygon."""
        self._clip = Path(np.vstack([polygon, polygon[:1]]), closed=True)
        yield
        self._clip = None

    def save(self, file, kind, title):
        """Writes SVG, PNG or PDF. The bytes of an SVG depend on the picture alone. Its coordinates have a resolution of 0.1."""
        metadata = {"Title": title} | ({"Date": None} if kind == "svg" else {})
        with matplotlib.rc_context(
            {"svg.fonttype": "none", "svg.hashsalt": "explain_pair", "font.sans-serif": ["DejaVu Sans"]}
        ):
            picture = io.BytesIO()
            self.figure.savefig(picture, format=kind, dpi=144 if kind == "png" else 72, metadata=metadata)
        file.write(_shorter(picture.getvalue()) if kind == "svg" else picture.getvalue())


def _shorter(svg):
    """Each path in one line and no group, with rounded coordinates; clips by their numbers, where matplotlib has addresses."""
    names = {}
    svg = re.sub(rb"\bp[0-9a-f]{10}\b", lambda name: names.setdefault(name[0], b"clip%d" % len(names)), svg)
    svg = re.sub(rb' d="[^"]*"', _shorter_path, svg)
    return re.sub(rb'<g id="[^"]*">\s*(<path[^>]*/>)\s*</g>', rb"\1", svg)


def _shorter_path(path):
    """A command is left out where it is the one before."""
    words, command = [b""], b""
    for word in path[0].split():
        if word != command:
            words.append(word)
        command = word if word.isalpha() else command
    return re.sub(rb"\d+\.\d+", lambda number: (b"%.1f" % float(number[0])).removesuffix(b".0"), b" ".join(words))


def hex_colour(lightness, chroma, hue):
    """ "#rrggbb" in sRGB of a colour in the polar form of OKLab: equal distances look equal. Channels are clamped.

    Ottosson, A perceptual color space for image processing, 2020. `hue` in degrees.
    """
    a, b = chroma * cos(radians(hue)), chroma * sin(radians(hue))
    l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3
    m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3
    s = (lightness - 0.0894841775 * a - 1.2914855480 * b) ** 3
    linear = (
        4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
        -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
        -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s,
    )

    def byte(channel):
        value = min(max(channel, 0), 1)
        return round(255 * (12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055))

    return "#" + "".join(f"{byte(channel):02x}" for channel in linear)


def map_colour(share):
    """Lightness, chroma and hue for a fraction from 0 to 1 of the range of s, from dark to light: a straight line in OKLab."""

    def place(colour):
        lightness, chroma, hue = colour
        return np.array([lightness, chroma * cos(radians(hue)), chroma * sin(radians(hue))])

    lightness, a, b = (1 - share) * place(LOWEST) + share * place(HIGHEST)
    return lightness, hypot(a, b), np.arctan2(b, a) * 180 / pi


def length_text(metres, digits=4):
    """ "12.5 mm", in the unit m, mm or µm with the fewest zeros. Lengths out of this range are in m with an exponent."""
    size = abs(metres)
    unit, name = (1, "m") if not 1e-7 <= size < 0.1 else (1e-3, "mm") if size >= 1e-4 else (1e-6, "µm")
    return f"{'−' if metres < 0 else ''}{size / unit:.{digits}g} {name}"


def round_step(length, parts):
    """The smallest of 1, 2 and 5 times a power of ten of which at most `parts` are within a length."""
    power = 10 ** np.floor(np.log10(length / parts))
    return next(factor * power for factor in (1, 2, 5, 10) if factor == 10 or factor * power * parts >= length)


def simplified(points, error):
    """A line with fewer of its points, within `error` of the line (Douglas and Peucker 1973)."""
    points = np.asarray(points, float)
    is_kept = np.zeros(len(points), bool)
    is_kept[[0, -1]] = True
    spans = [(0, len(points) - 1)]
    while spans:
        first, last = spans.pop()
        if last - first < 2:
            continue
        start, along = points[first], points[last] - points[first]
        squared = along @ along
        inner = points[first + 1 : last] - start
        share = np.clip(inner @ along / squared, 0, 1) if squared > 0 else np.zeros(len(inner))
        distances = np.linalg.norm(inner - share[:, None] * along, axis=1)
        farthest = int(np.argmax(distances))
        if distances[farthest] > error:
            middle = first + 1 + farthest
            is_kept[middle] = True
            spans += [(first, middle), (middle, last)]
    return points[is_kept]
