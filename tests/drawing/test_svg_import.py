"""SVG files of other programs as strokes: shapes against geometry, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial import KDTree

from app.drawing import svg_import, svg_xml
from app.drawing.errors import DrawingError
from app.drawing.svg_import import read_svg
from app.drawing.svg_xml import MAX_BYTES, MAX_DEPTH

NAMESPACES = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
PAGE = 'width="200mm" height="100mm" viewBox="0 0 200 100"'
TOLERANCE_MM = 0.0101

Points = NDArray[np.float64]


def svg(inside: str, page: str = PAGE) -> bytes:
    return f"<svg {NAMESPACES} {page}>{inside}</svg>".encode()


def drawn(inside: str, page: str = PAGE) -> list[Points]:
    """Strokes in mm from the upper left corner of a 200 x 100 page, y down: as the file has them."""
    return [(stroke + (100.0, -50.0)) * (1.0, -1.0) for stroke in read_svg(svg(inside, page))]


def path(data: str) -> list[Points]:
    return drawn(f'<path d="{data}"/>')


def assert_points(found: list[Points], *wanted: list[tuple[float, float]]) -> None:
    assert [stroke.shape for stroke in found] == [(len(points), 2) for points in wanted]
    for stroke, points in zip(found, wanted, strict=True):
        np.testing.assert_allclose(stroke, points, atol=1e-9)


def assert_on_curve(stroke: Points, curve: Points) -> None:
    """Polyline and finely sampled curve lie upon each other, with the same ends."""
    np.testing.assert_allclose(stroke[[0, -1]], curve[[0, -1]], atol=1e-9)
    parts = np.linspace(0.0, 1.0, 101)[:, None, None]
    fine = (stroke[:-1] + parts * np.diff(stroke, axis=0)).reshape(-1, 2)
    spacing = np.linalg.norm(np.diff(curve, axis=0), axis=1).max()
    spacing = max(spacing, np.linalg.norm(np.diff(stroke, axis=0), axis=1).max() / 100)
    assert KDTree(curve).query(fine)[0].max() < TOLERANCE_MM + spacing
    assert KDTree(fine).query(curve)[0].max() < TOLERANCE_MM + spacing


def length(stroke: Points) -> float:
    return float(np.linalg.norm(np.diff(stroke, axis=0), axis=1).sum())


@pytest.mark.parametrize(
    ("data", "wanted"),
    [
        ("M10 20L30 40", [[(10, 20), (30, 40)]]),
        ("m10,20 20,20 5-5", [[(10, 20), (30, 40), (35, 35)]]),
        ("M10 20 30 40 50 60", [[(10, 20), (30, 40), (50, 60)]]),
        ("M1 2h3v4H10V20", [[(1, 2), (4, 2), (4, 6), (10, 6), (10, 20)]]),
        ("M1 1h2v2z", [[(1, 1), (3, 1), (3, 3), (1, 1)]]),
        ("M1 1H3V3H1V1Z", [[(1, 1), (3, 1), (3, 3), (1, 3), (1, 1)]]),
        ("M1 1h2v2zl5 5", [[(1, 1), (3, 1), (3, 3), (1, 1)], [(1, 1), (6, 6)]]),
        ("m1 1h2zm5 5h1", [[(1, 1), (3, 1), (1, 1)], [(6, 6), (7, 6)]]),
        ("M0 0M5 5L6 6M9 9", [[(5, 5), (6, 6)]]),
        ("M.5.5L1e1-2.5E-1", [[(0.5, 0.5), (10, -0.25)]]),
        ("M5 5h0", [[(5, 5), (5, 5)]]),
        ("M5 5z", [[(5, 5), (5, 5)]]),
        ("M0 0A0 5 0 0 1 10 10", [[(0, 0), (10, 10)]]),
        ("M3 3A5 5 0 0 1 3 3", [[(3, 3), (3, 3)]]),
        (" \n\tM 1 , 2 \n L 3\t4 , ", [[(1, 2), (3, 4)]]),
    ],
)
def test_straight_paths(data, wanted):
    assert_points(path(data), *wanted)


@pytest.mark.parametrize(
    ("relative", "absolute"),
    [
        ("m5 5 c1 9 9 9 10 0 s9 -9 10 0", "M5 5 C6 14 14 14 15 5 S24 -4 25 5"),
        ("m5 5 q5 9 10 0 t10 0", "M5 5 Q10 14 15 5 T25 5"),
        ("M5 5a8 4 30 0 1 10 5", "M5 5A8 4 30 0 1 15 10"),
        ("M5 5a8 4 30 0110 5a8 4 30 00-10-5", "M5 5A8 4 30 0 1 15 10A8 4 30 0 0 5 5"),
        ("M0 0Q5 10 10 0T20 0", "M0 0Q5 10 10 0Q15 -10 20 0"),
        ("M0 0C0 5 5 5 5 0S10 -5 10 0", "M0 0C0 5 5 5 5 0C5 -5 10 -5 10 0"),
        ("M0 0C0 5 5 5 5 0T10 0", "M0 0C0 5 5 5 5 0Q5 0 10 0"),
        ("M0 0Q5 5 5 0S10 -5 10 0", "M0 0Q5 5 5 0C5 0 10 -5 10 0"),
        ("M0 0L5 0S10 -5 10 0", "M0 0L5 0C5 0 10 -5 10 0"),
        ("M0 0Q3 6 6 0", "M0 0C2 4 4 4 6 0"),
    ],
)
def test_two_ways_to_write_a_path(relative, absolute):
    np.testing.assert_allclose(path(relative)[0], path(absolute)[0], atol=1e-9)


@given(st.lists(st.tuples(st.integers(0, 200), st.integers(0, 100)), min_size=4, max_size=4))
def test_cubics_are_followed(corners):
    a, b, c, d = (np.array(corner, dtype=float) for corner in corners)
    t = np.linspace(0.0, 1.0, 1501)[:, None]
    ab, bc, cd = a + t * (b - a), b + t * (c - b), c + t * (d - c)  # de Casteljau
    abc, bcd = ab + t * (bc - ab), bc + t * (cd - bc)
    (stroke,) = path(f"M{a[0]} {a[1]}C{b[0]} {b[1]} {c[0]} {c[1]} {d[0]} {d[1]}")
    assert_on_curve(stroke, abc + t * (bcd - abc))


@given(
    st.floats(1.0, 50.0),
    st.floats(1.0, 50.0),
    st.floats(-180.0, 180.0),
    st.floats(0.0, 6.28),
    st.floats(0.1, 6.1),
    st.booleans(),
)
def test_arcs_are_followed(rx, ry, degrees, start, angle, sweep):
    """An arc made from its centre; the path data tell only its ends."""
    angles = start + np.linspace(0.0, angle if sweep else -angle, 1501)
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    curve = np.column_stack([rx * np.cos(angles), ry * np.sin(angles)]) @ [[c, s], [-s, c]] + (100.0, 50.0)
    (x1, y1), (x2, y2) = curve[[0, -1]].tolist()
    assume(abs(angle - np.pi) > 1e-3)  # half an ellipse: the flag decides nothing, and rounding much
    (stroke,) = path(f"M{x1} {y1}A{rx} {ry} {degrees} {int(angle > np.pi)} {int(sweep)} {x2} {y2}")
    assert_on_curve(stroke, curve)


@pytest.mark.parametrize(
    ("flags", "middle"),
    [("0 1", -1.339746), ("1 1", -18.660254), ("0 0", 1.339746), ("1 0", 18.660254)],
)
def test_flags_choose_among_four_arcs(flags, middle):
    (stroke,) = path(f"M50 50A10 10 0 {flags} 60 50")
    centre = 50.0 + middle - 10.0 * np.sign(middle)
    np.testing.assert_allclose(np.hypot(stroke[:, 0] - 55.0, stroke[:, 1] - centre), 10.0, atol=1e-9)
    assert np.abs(stroke - (55.0, 50.0 + middle)).sum(axis=1).min() < 1.0


def test_radii_too_small_grow():
    (stroke,) = path("M50 50A1 1 0 0 1 70 50")
    np.testing.assert_allclose(np.hypot(*(stroke - (60.0, 50.0)).T), 10.0, atol=1e-9)


def test_shapes():
    assert_points(drawn('<line x1="1" y1="2" x2="3" y2="4"/>'), [(1, 2), (3, 4)])
    assert_points(drawn('<polyline points="1,2 3,4, 5 6"/>'), [(1, 2), (3, 4), (5, 6)])
    assert_points(drawn('<polygon points="1,2 3,4 5,0"/>'), [(1, 2), (3, 4), (5, 0), (1, 2)])
    assert_points(drawn('<rect x="1" y="2" width="3" height="4"/>'), [(1, 2), (4, 2), (4, 6), (1, 6), (1, 2)])
    (rounded,) = drawn('<rect width="30" height="20" rx="5"/>')
    assert length(rounded) == pytest.approx(20 + 20 + 10 + 10 + 2 * np.pi * 5, rel=1e-3)
    assert (rounded[0] == rounded[-1]).all()
    np.testing.assert_allclose([rounded.min(axis=0), rounded.max(axis=0)], [(0, 0), (30, 20)], atol=1e-9)
    (sharp,) = drawn('<rect x="1" width="30" height="20" rx=".5"/>')
    assert length(sharp) == pytest.approx(2 * 29 + 2 * 19 + np.pi, abs=0.05)
    (lozenge,) = drawn('<rect width="30" height="20" rx="99" ry="99"/>')
    np.testing.assert_allclose(((lozenge - (15, 10)) ** 2 / (15**2, 10**2)).sum(axis=1), 1.0, atol=1e-9)
    (circle,) = drawn('<circle cx="50" cy="40" r="10"/>')
    np.testing.assert_allclose(np.hypot(*(circle - (50, 40)).T), 10.0, atol=1e-9)
    assert length(circle) == pytest.approx(2 * np.pi * 10, rel=1e-3) and (circle[0] == circle[-1]).all()
    (ellipse,) = drawn('<ellipse cx="50" cy="40" rx="20" ry="10"/>')
    np.testing.assert_allclose(((ellipse - (50, 40)) ** 2 / (20**2, 10**2)).sum(axis=1), 1.0, atol=1e-9)


@pytest.mark.parametrize("shape", ['<circle r="0"/>', '<rect width="0" height="5"/>', '<path d=""/>', "<polyline/>"])
def test_shapes_of_no_size_draw_nothing(shape):
    assert len(drawn(shape + '<line x2="5"/>')) == 1


@pytest.mark.parametrize(
    ("transform", "wanted"),
    [
        ("translate(5)", (15, 20)),
        ("translate(5,-3)", (15, 17)),
        ("scale(2)", (20, 40)),
        ("scale(2 3)", (20, 60)),
        ("rotate(90)", (-20, 10)),
        ("rotate(90 10 0)", (-10, 0)),
        ("skewX(45)", (30, 20)),
        ("skewY(45)", (10, 30)),
        ("matrix(1 2 3 4 5 6)", (75, 106)),
        ("translate(5 0), scale(2)", (25, 40)),
        ("scale(2) translate(5 0)", (30, 40)),
    ],
)
def test_transforms(transform, wanted):
    (stroke,) = drawn(f'<g transform="{transform}"><line x1="10" y1="20" x2="10" y2="20"/></g>')
    np.testing.assert_allclose(stroke, [wanted, wanted], atol=1e-9)


def test_groups_add_up_and_magnified_circles_stay_round():
    (stroke,) = drawn('<g transform="scale(100)"><a><circle transform="translate(1 .5)" r=".3"/></a></g>')
    np.testing.assert_allclose(np.hypot(*(stroke - (100, 50)).T), 30.0, atol=1e-9)
    assert length(stroke) == pytest.approx(2 * np.pi * 30, rel=1e-3)


LINE = '<line x1="10" y1="20" x2="30" y2="20"/>'


@pytest.mark.parametrize(
    ("page", "wanted"),
    [
        (PAGE, [(-90, 30), (-70, 30)]),
        ('width="20cm" height="10cm" viewBox="0 0 200 100"', [(-90, 30), (-70, 30)]),
        ('width="2in" height="1in" viewBox="0 0 200 100"', [(-22.86, 7.62), (-17.78, 7.62)]),
        ('width="192px" height="96" viewBox="0 0 200 100"', [(-22.86, 7.62), (-17.78, 7.62)]),
        ('width="144pt" height="6pc" viewBox="0 0 200 100"', [(-22.86, 7.62), (-17.78, 7.62)]),
        ('width="400mm" viewBox="0 0 200 100"', [(-180, 60), (-140, 60)]),
        ('height="200mm" viewBox="0 0 200 100"', [(-180, 60), (-140, 60)]),
        ('viewBox="0 0 96 48"', [(-38 * 25.4 / 96, 4 * 25.4 / 96), (-18 * 25.4 / 96, 4 * 25.4 / 96)]),
        ('width="100%" viewBox="0 0 96 48"', [(-38 * 25.4 / 96, 4 * 25.4 / 96), (-18 * 25.4 / 96, 4 * 25.4 / 96)]),
        ('width="96" height="48"', [(-38 * 25.4 / 96, 4 * 25.4 / 96), (-18 * 25.4 / 96, 4 * 25.4 / 96)]),
        ("", [(-10 * 25.4 / 96, 0), (10 * 25.4 / 96, 0)]),
        ('width="200mm" height="100mm" viewBox="10 20 200 100"', [(-100, 50), (-80, 50)]),
        ('width="200mm" height="200mm" viewBox="0 0 200 100"', [(-90, 30), (-70, 30)]),
        ('width="200mm" height="200mm" viewBox="0 0 200 100" preserveAspectRatio="xMidYMin"', [(-90, 80), (-70, 80)]),
        ('width="200mm" height="200mm" viewBox="0 0 200 100" preserveAspectRatio="xMidYMax"', [(-90, -20), (-70, -20)]),
        ('width="200mm" height="200mm" viewBox="0 0 200 100" preserveAspectRatio="none"', [(-90, 60), (-70, 60)]),
        (f'{PAGE.replace("100m", "200m")} preserveAspectRatio="xMinYMin slice"', [(-80, 60), (-40, 60)]),
    ],
)
def test_pages(page, wanted):
    (stroke,) = read_svg(svg(LINE, page))
    np.testing.assert_allclose(stroke, wanted, atol=1e-9)


def test_lengths_have_units_and_percentages():
    (stroke,) = drawn('<rect width="100%" height="50%"/>')
    np.testing.assert_allclose(stroke.max(axis=0), (200, 50))
    (stroke,) = drawn('<line x2="1in" y2="2.54cm"/>', 'width="200mm" height="100mm"')
    np.testing.assert_allclose(stroke[1], (25.4, 25.4))


def test_only_what_shows_is_drawn():
    hidden = [
        f'<g style="fill:none; display : none">{LINE}</g>',
        f'<g display="none">{LINE}</g>',
        LINE.replace("/>", ' visibility="hidden"/>'),
        f"<defs>{LINE}</defs><clipPath>{LINE}</clipPath><symbol>{LINE}</symbol><metadata>{LINE}</metadata>",
        '<text>words</text><image href="data:image/png;base64,AAAA"/>',
        f'<g transform="scale(0)">{LINE}</g>',
    ]
    assert len(drawn("".join([*hidden, LINE]))) == 1
    with pytest.raises(DrawingError, match="no lines to draw; turn its text and pictures into paths"):
        drawn("".join(hidden))


def test_parts_that_are_used_again():
    parts = '<defs><line id="a" x2="5"/><symbol id="b"><line x2="7"/></symbol></defs>'
    used = parts + '<use href="#a" x="1" y="2"/><use xlink:href="#b" transform="scale(2)"/><use href="#c"/>'
    assert_points(drawn(used), [(1, 2), (6, 2)], [(0, 0), (14, 0)])
    inner = '<svg x="10" y="10" width="20" height="20" viewBox="0 0 10 10"><line x2="5"/></svg>'
    assert_points(drawn(inner), [(10, 10), (20, 10)])


def test_files_as_programs_save_them():
    doctype = '<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">'
    data = b'<?xml version="1.0"?>' + doctype.encode() + svg(LINE)
    assert len(read_svg(data)) == 1
    assert len(read_svg(b'<s:svg xmlns:s="http://www.w3.org/2000/svg"><s:path d="M0 0h5"/></s:svg>')) == 1
    assert len(read_svg(svg(LINE).decode().encode("utf-16"))) == 1
    assert len(read_svg(svg(f'<a href="https://example.org">{LINE}</a><style>.a{{fill:url(#b)}}</style>'))) == 1


ENTITIES = b'<!DOCTYPE svg [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;">]>'


@pytest.mark.parametrize(
    ("data", "complaint"),
    [
        (b"", "no readable SVG"),
        (b"\x89PNG\r\n\x1a\n\0\0", "no readable SVG"),
        (b"\x1f\x8b\x08\0\0", "no readable SVG"),
        (svg(LINE)[:-9], r"no readable SVG \(line 1\)"),
        (b'<?xml version="1.0" encoding="klingon"?><svg/>', "no readable SVG"),
        (b'<?xml version="1.0" encoding="utf-7"?><svg/>', "no readable SVG"),
        (b"<html><body/></html>", "a 'html' and not an SVG"),
        (svg(""), "no lines to draw"),
        (svg("<script>alert(1)</script>" + LINE), "holds a script"),
        (svg('<x:script xmlns:x="http://www.w3.org/2000/svg"/>' + LINE), "holds a script"),
        (svg(LINE, 'onload="alert(1)"'), "holds a script .'onload'"),
        (svg(f'<a href=" javascript:alert(1)">{LINE}</a>'), "holds a script"),
        (svg('<image href="https://example.org/a.png"/>' + LINE), "another file .'https://example.org/a.png'"),
        (svg('<use xlink:href="other.svg#a"/>' + LINE), "another file"),
        (svg('<image href="file:///etc/passwd"/>' + LINE), "another file"),
        (svg("<g style=\"fill:url( 'http://example.org/a')\"/>" + LINE), "another file"),
        (svg("<style>@import 'http://example.org/a.css';</style>" + LINE), "style sheet refers to another"),
        (svg("<style><![CDATA[a{fill:URL(//example.org)}]]></style>" + LINE), "style sheet refers to another"),
        (b'<?xml-stylesheet href="http://example.org/a.css"?>' + svg(LINE), "style sheet in another file"),
        (ENTITIES + svg("<text>&b;</text>" + LINE), "declares entities"),
        ((ENTITIES + svg(LINE)).decode().encode("utf-16"), "declares entities"),
        (b'<!DOCTYPE svg [<!ENTITY a SYSTEM "file:///etc/passwd">]>' + svg(LINE), "declares entities"),
        (b'<!DOCTYPE svg [<!ENTITY % a SYSTEM "http://example.org/a">%a;]>' + svg(LINE), "declares entities"),
        (svg(LINE) + b" " * MAX_BYTES, "larger than 6 MB"),
        (svg("<g>" * MAX_DEPTH + LINE + "</g>" * MAX_DEPTH), "nested more than"),
        (svg(f'<g id="a">{LINE}<use href="#a"/></g>'), "repeats its parts too often"),
        (svg('<line x2="nan"/>'), "has the length 'nan'"),
        (svg('<line x2="5em"/>'), "has the length '5em'"),
        (svg(f'<line x2="{"1" * 1000}"/>'), "has the length '11111"),
        (svg('<path d="M0 0L1e999 0"/>'), "the number '1e999', which is no place"),
        (svg('<path d="M0 0L1e6 0"/>'), "further than 100 m"),
        (svg('<path d="M0 0LNaN 0"/>'), "path data"),
        (svg('<path d="M0 0Linf 0"/>'), "path data"),
        (svg('<path d="M0 0L5"/>'), "path data"),
        (svg('<path d="M0 0L"/>'), "path data"),
        (svg('<path d="L5 5"/>'), "path data"),
        (svg('<path d="5 5"/>'), "path data"),
        (svg('<path d="M0 0Z5"/>'), "path data"),
        (svg('<path d="M0 0A5 5 0 2 0 1 1"/>'), "path data"),
        (svg('<polyline points="1 2 3"/>'), "path data"),
        (svg(LINE, 'viewBox="0 0 0 10"'), "the viewBox '0 0 0 10'"),
        (svg(LINE, 'viewBox="0 0 nan 10"'), "the number 'nan'"),
        (svg(LINE, 'viewBox="0 0 10"'), "the viewBox"),
        (svg(LINE, 'width="5" viewBox="0 0 1e-300 1"'), "beyond all bounds"),
        (svg(f'<g transform="scale(1e9) scale(1e9)">{LINE}</g>'), "beyond all bounds"),
        (svg(f'<g transform="spin(3)">{LINE}</g>'), "the transform 'spin' of 1 numbers"),
        (svg(f'<g transform="rotate(x)">{LINE}</g>'), "'x' where a number belongs"),
        (svg(f'<g transform="rotate(3">{LINE}</g>'), "the transform 'rotate.3'"),
    ],
)
def test_refusals_are_one_sentence(data, complaint):
    with pytest.raises(DrawingError, match=complaint) as refusal:
        read_svg(data)
    assert str(refusal.value).endswith(".") and "\n" not in str(refusal.value) and len(str(refusal.value)) < 200


def test_too_many_elements(monkeypatch):
    monkeypatch.setattr(svg_xml, "MAX_ELEMENTS", 5)
    assert len(drawn(4 * LINE)) == 4
    with pytest.raises(DrawingError, match="more than 5 elements"):
        drawn(5 * LINE)


def test_repetitions_of_repetitions(monkeypatch):
    """A billion lines in twelve; none of them is nested deeply."""
    monkeypatch.setattr(svg_import, "MAX_ELEMENTS", 2_000)
    bomb = "".join(f'<g id="g{n}">{10 * f"""<use href="#g{n - 1}"/>"""}</g>' for n in range(1, 12))
    with pytest.raises(DrawingError, match="repeats its parts too often"):
        drawn(f'<g id="g0">{LINE}</g>{bomb}')


def test_style_sheets_are_looked_at_one_by_one():
    with pytest.raises(DrawingError, match="style sheet refers to another"):
        drawn(f"<style>a{{}}</style><style>@import 'b.css'</style>{LINE}")
    assert len(drawn(f"<style>@im</style><style>port 'b.css'</style>{LINE}")) == 1


def test_too_many_points(monkeypatch):
    monkeypatch.setattr(svg_import, "MAX_POINTS", 10)
    assert len(drawn(5 * LINE)) == 5
    with pytest.raises(DrawingError, match="more than 10 points; simplify"):
        drawn(6 * LINE)


def read_or_refuse(data: bytes) -> None:
    try:
        strokes = read_svg(data)
    except DrawingError:
        return
    assert all(stroke.ndim == 2 and stroke.shape[1] == 2 and len(stroke) >= 2 for stroke in strokes)
    assert all(np.isfinite(stroke).all() for stroke in strokes)


@given(st.binary(max_size=100))
def test_any_bytes_are_read_or_refused(data):
    read_or_refuse(data)


@given(st.text(alphabet="MmLlHhVvCcSsQqTtAaZz0123456789.-+eE, ", max_size=60).map(lambda data: "M" + data))
def test_any_path_is_read_or_refused(data):
    read_or_refuse(svg(f'<path d="{data}"/>'))


@given(
    st.sampled_from(["transform", "viewBox", "width", "x", "r", "points", "rx", "style", "id", "href"]),
    st.text(alphabet="0123456789.-+eE,() %;:#abimnoprstxyw", max_size=40),
)
def test_any_attribute_is_read_or_refused(name, value):
    shapes = (
        f'<g height="5" {name}="{value}"><rect width="5" height="5" rx="1"/></g><rect height="5" {name}="{value}"/>'
    )
    shapes += f'<circle {name}="{value}"/><polygon {name}="{value}"/><svg {name}="{value}"/><use {name}="{value}"/>'
    read_or_refuse(svg(shapes, f'{name}="{value}"'))
