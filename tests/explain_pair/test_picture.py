"""The picture of a pair: what is drawn is what the library found."""

import io
import re
import xml.dom.minidom
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest
import supernormal as sn
from canvas import BODY1, BODY2, Box, Canvas, hex_colour, length_text, map_colour, round_step, simplified
from pair_panel import draw_pair
from pairs import data, hard_case
from picture import picture_of
from solvers import explain
from sphere_maps import HAMMER_HALF_HEIGHT, HAMMER_HALF_WIDTH, hammer, lambert, lambert_inverse, normal_at
from view import View, frame_of_picture, lit_part, outline, unit

LARGEST_PICTURE = 400_000  # bytes


def frame_of(explanation):
    return frame_of_picture(explanation.pair, explanation.answer.normal)


def svg_of(canvas, title="test"):
    file = io.BytesIO()
    canvas.save(file, "svg", title)
    return file.getvalue().decode()


def test_the_normal_points_to_the_right_in_a_right_handed_frame(explanations):
    for explanation in explanations:
        right, up, toward = frame_of(explanation)
        assert np.allclose(right, explanation.answer.normal, atol=1e-12)
        assert np.allclose(np.cross(right, up), toward, atol=1e-12)
        assert np.linalg.norm(up) == pytest.approx(1)


def test_an_outline_reaches_as_far_as_its_body_and_what_is_lit_is_within(sample_pairs):
    scale, angles = 400, 0.157 * np.arange(40)
    along = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    for pair in sample_pairs:
        view = View(np.eye(3), pair.body1.pose.position, scale, Box(0, 0, 800, 800))
        for body in (pair.body1, pair.body2):
            lit = lit_part(body, view, unit(np.array([0.3, -0.5, 0.8])), 0.4)
            assert len(lit) > 3
            reach, lit_reach = (((one - 400) * [1, -1] @ along[:, :2].T).max(axis=0) for one in (outline(body, view), lit))
            exact = scale * (along @ (body.pose.position - pair.body1.pose.position) + body.support(along))
            assert np.abs(reach - exact).max() < 0.3
            assert (lit_reach <= exact + 0.01).all()


def test_the_witness_points_the_planes_and_the_scale_agree_with_the_answer(explanations):
    box = Box(10, 90, 560, 440)
    for explanation in explanations:
        answer, frame = explanation.answer, frame_of(explanation)
        canvas = Canvas(600, 600)
        draw_pair(canvas, box, explanation, frame)
        lines = {"plane": [], "scale": []}
        for line in canvas.axes.lines:
            lines.get(line.get_gid(), []).append(line.get_xydata())
        texts = {text.get_gid() or text.get_text(): text.get_text() for text in canvas.axes.texts}
        number, unit_of_scale = texts["length of scale"].split()
        ends = lines["scale"][0][:, 0]
        scale = (ends[1] - ends[0]) / (float(number) * {"m": 1, "mm": 1e-3}[unit_of_scale])
        points = {
            patch.get_facecolor(): patch.get_path().vertices[[0, 6]].mean(axis=0)
            for patch in canvas.axes.patches
            if np.allclose(np.ptp(patch.get_path().vertices, axis=0), 8.4)
        }
        point1, point2 = (points[colour] for colour in map(rgba, (BODY1, BODY2)))
        assert abs(point2[0] - point1[0] - scale * answer.gap) < 0.01 * abs(scale * answer.gap) + 0.2
        assert abs(point1[1] - point2[1] - scale * frame[1] @ (answer.point2 - answer.point1)) < 0.3
        for (at, _), plane in zip((point1, point2), lines["plane"]):
            assert box.x <= at <= box.right
            assert np.allclose(plane, [(at, 96), (at, 530)], atol=0.2)
        assert f"{'gap' if answer.gap >= 0 else 'depth'} {length_text(abs(answer.gap))}" in texts


def rgba(colour):
    return tuple(int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)) + (1.0,)


def check_case(name):
    """What is wrong with the picture of a hard case."""
    document = svg_of(picture_of(explain(hard_case(name), sn.Settings())), name)
    xml.dom.minidom.parseString(document)
    if len(document) >= LARGEST_PICTURE:
        return f"{name}: {len(document)} bytes"
    return f"{name}: not finite" if re.search(r"[\" ]-?(nan|inf)\b", document) else ""


def check_cases(names):
    with ProcessPoolExecutor(2) as pool:
        assert [text for text in pool.map(check_case, names, chunksize=8) if text] == []


def test_hard_cases_have_a_picture_of_limited_size_with_finite_coordinates():
    largest = "concentric: identical superballs 1.9"
    check_cases([largest, *[name for name, _ in data("list")][::16]])


@pytest.mark.thorough
def test_every_hard_case_has_a_picture_of_limited_size_with_finite_coordinates():
    names = [name for name, _ in data("list")]
    assert len(names) == 397
    check_cases(names)


def test_an_svg_depends_on_the_pair_alone_and_holds_any_text(explanations):
    for title in ('a < b & "c"', "$10^2$"):
        first, second = (svg_of(picture_of(explanations[0]), title) for _ in range(2))
        assert first == second
    canvas = Canvas(10, 10)
    canvas.text((1, 2), "<script> $x$")
    document = svg_of(canvas)
    assert "&lt;script&gt; $x$" in document
    xml.dom.minidom.parseString(document)


def test_neighbouring_colours_of_the_map_are_equally_far_apart():
    def place(share):
        lightness, chroma, hue = map_colour(share)
        return np.array([lightness, chroma * np.cos(np.radians(hue)), chroma * np.sin(np.radians(hue))])

    steps = np.diff([place(share) for share in np.linspace(0, 1, 13)], axis=0)
    assert np.linalg.norm(steps, axis=1) == pytest.approx(np.linalg.norm(steps[0]), rel=1e-3)
    assert (steps[:, 0] > 0).all()
    assert hex_colour(0, 0, 0) == "#000000"
    assert hex_colour(1, 0, 0) == "#ffffff"
    assert hex_colour(0.62796, 0.25768, 29.234) == "#ff0000"  # Ottosson's red


def test_lengths_have_units_that_leave_few_zeros():
    texts = {0.5: "0.5 m", 0.0123456: "12.35 mm", -1.5e-5: "−15 µm", 0: "0 m", 2e-12: "2e-12 m", -0.25: "−0.25 m"}
    for metres, text in texts.items():
        assert length_text(metres) == text


def test_steps_are_round():
    for (length, parts), step in {(10, 10): 1, (11, 10): 2, (0.0034, 10): 0.0005, (6e5, 10): 1e5}.items():
        assert round_step(length, parts) == pytest.approx(step)


def test_a_simplified_line_stays_within_its_error():
    t = 0.1 * np.arange(1001)
    line = np.stack([t, 10 * np.sin(t)], axis=1)
    few = simplified(line, 0.2)
    assert len(few) < 200
    assert np.array_equal(few[[0, -1]], line[[0, -1]])
    along = np.diff(few, axis=0)
    for point in line:
        share = np.clip(np.sum((point - few[:-1]) * along, axis=1) / np.sum(along**2, axis=1), 0, 1)
        assert np.linalg.norm(point - few[:-1] - share[:, None] * along, axis=1).min() <= 0.2 + 1e-12
    ring = np.vstack([line[:50], line[:1]])
    assert np.array_equal(simplified(ring, 0.2)[[0, -1]], ring[[0, -1]])


# --- maps of the sphere ---


def random_normals(seed, count):
    normals = np.random.default_rng(seed).normal(size=(count, 3))
    return normals / np.linalg.norm(normals, axis=1)[:, None]


def test_lamberts_map_goes_back_and_forth_to_the_antipode():
    normals = random_normals(2, 10_000)
    assert np.abs(lambert_inverse(lambert(normals)) - normals).max() < 1e-12
    assert np.linalg.norm(lambert(np.array([-1.0, 0, 0]))) == pytest.approx(2)
    assert lambert(unit(np.array([1, 1e-9, 0])))[1] == pytest.approx(1e-9)


def test_both_maps_keep_areas():
    random = np.random.default_rng(3)
    longitude, latitude = random.uniform(-0.95 * np.pi, 0.95 * np.pi, 1000), random.uniform(-0.45 * np.pi, 0.45 * np.pi, 1000)
    step = 1e-5
    for to_plane in (hammer, lambert):
        slopes = [
            to_plane(normal_at(longitude + a, latitude + b)) - to_plane(normal_at(longitude - a, latitude - b))
            for a, b in ((step, 0), (0, step))
        ]
        area = (slopes[0][:, 0] * slopes[1][:, 1] - slopes[0][:, 1] * slopes[1][:, 0]) / (4 * step * step) / np.cos(latitude)
        assert area == pytest.approx(1, rel=1e-5)
    assert np.pi * HAMMER_HALF_WIDTH * HAMMER_HALF_HEIGHT == pytest.approx(4 * np.pi)


def test_the_centre_north_and_east_of_the_maps():
    right, up, toward = np.eye(3)
    assert np.linalg.norm(hammer(right)) < 1e-12
    assert hammer(up)[1] == pytest.approx(HAMMER_HALF_HEIGHT)
    assert hammer(-toward)[0] > 1
    assert lambert(unit(right - 0.1 * toward))[0] > 0
