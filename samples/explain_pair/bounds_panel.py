"""The proved interval around the answer after each evaluation."""

from math import ceil, copysign, floor, log10

import numpy as np
from canvas import BLACK, INK, Box
from map_panel import draw_marker, style_of

LEFT, BOTTOM = 62, 36  # px, for the labels of the axes
DECADE_LABELS = 3  # at most, above and below


class _Axes:
    """Logarithmic axes for distances from the answer: powers of ten from 10^least up and down, with 0 in the middle."""

    def __init__(self, box, explanation):
        self.box = Box(box.x + LEFT, box.y, box.width - LEFT, box.height - BOTTOM)
        self.evaluations = explanation.shown_evaluations
        answer = explanation.answer.gap
        uppers = [upper - answer for _, _, upper in explanation.hybrid.intervals]
        widest = max(*uppers, *(np.abs(path.values[: self.evaluations] - answer).max() for path in explanation.paths))
        last = max(uppers[-1], np.finfo(float).tiny)
        self.least = floor(log10(last)) - 1
        self.most = max(log10(max(widest, last)) + 0.5, self.least + 2)  # half a decade of margin for the markers

    def x(self, evaluation):
        return self.box.x + (evaluation - 0.5) / self.evaluations * self.box.width

    def y(self, length):
        decades = max(log10(abs(length)) - self.least, 0) if length else 0
        return self.box.centre[1] - copysign(decades / (self.most - self.least), length) * 0.5 * self.box.height


def draw_bounds(canvas, box, explanation):
    """The bounds of the hybrid from the answer, and the values reached by the other solvers, against the number of evaluations."""
    axes = _Axes(box, explanation)
    inner, middle = axes.box, axes.box.centre
    canvas.rectangle(inner, fill="white")
    _draw_labels(canvas, axes)
    canvas.line([(inner.x, middle[1]), (inner.right, middle[1])], "#555555")
    _draw_interval(canvas, axes, explanation)
    for path in reversed(explanation.paths):
        values = path.values[: axes.evaluations] - explanation.answer.gap
        points = np.array([(axes.x(k), axes.y(value)) for k, value in enumerate(values, 1)])
        colour, dashes, _ = style_of(path)
        canvas.line(points, colour, 1.6, dashes)
        for at in points:
            draw_marker(canvas, at, style_of(path), 1.6 if len(points) > 40 else 3)
    canvas.rectangle(inner, edge=INK, width=1.4)


def _draw_labels(canvas, axes):
    inner, most = axes.box, floor(axes.most)
    for exponent in range(most, axes.least, -max(1, ceil((most - axes.least) / DECADE_LABELS))):
        for sign, name in ((1, "+"), (-1, "−")):
            y = axes.y(sign * 10.0**exponent)
            canvas.line([(inner.x, y), (inner.right, y)], "#dddddd")
            canvas.text((inner.x - 6, y + 4), f"{name}1e{exponent} m", 12, "right")
    canvas.text((inner.x - 6, inner.centre[1] + 4), "answer", 12, "right")
    step = max(1, ceil(axes.evaluations / 8))
    for k in range(step, axes.evaluations + 1, step):
        canvas.text((axes.x(k), inner.bottom + 16), str(k), 12, "center")
    canvas.text((inner.centre[0], inner.bottom + 33), "evaluations of s", 13, "center")


def _draw_interval(canvas, axes, explanation):
    """The area between the bounds, as steps."""
    answer = explanation.answer.gap
    intervals = explanation.hybrid.intervals
    starts = [axes.x(evaluations - 0.5) for evaluations, _, _ in intervals]
    ends = [*starts[1:], axes.x(intervals[-1][0] + 0.5)]
    upper, lower = [], []
    for start, end, (_, low, high) in zip(starts, ends, intervals):
        upper += [(start, axes.y(high - answer)), (end, axes.y(high - answer))]
        lower += [(start, axes.y(min(low - answer, 0))), (end, axes.y(min(low - answer, 0)))]
    canvas.fill(upper + lower[::-1], fill=BLACK, alpha=0.13)
    for line in (upper, lower):
        canvas.line(line, BLACK, 1.8)
