"""Markdown becomes HTML that cannot do anything."""

from __future__ import annotations

import base64
from pathlib import Path

import pytest

from app.classroom.lessons.render import forget_rendered, to_html


@pytest.mark.parametrize(
    "markdown",
    [
        "<script>alert(1)</script>",
        "Hi <img src=x onerror=alert(1)>",
        "$\\text{<script>alert(1)</script>}$",
        "$\\text{&lt;img src=x&gt;}$ and $$\\fraq{<b>}$$",
        "[a](javascript:alert(1))",
        "[a](data:text/html;base64,PHNjcmlwdD4=)",
        "![x](javascript:alert(1))",
        '!["><script>](x.svg)',
        "| <b>a</b> |\n|---|\n| <i>b</i> |",
        "- [ ] <u>a</u>",
        "```\n<script>\n```",
    ],
)
def test_markup_of_others_stays_text(markdown: str) -> None:
    html = to_html(markdown)
    for bad in ("<script", "<img", "<b>", "<i>", "<u>", 'href="javascript', 'href="data', ' src="'):
        assert bad not in html


def test_what_lessons_are_made_of() -> None:
    html = to_html("**bold** $x^2$\n\n$$\nE = 1\n$$\n\n| a | b |\n|---|---|\n| 1 | 2 |\n\n1. one\n2. two")
    assert "<strong>bold</strong>" in html and "<table>" in html and "<ol>" in html
    assert html.count("<math") == 2 and html.count('display="block"') == 1
    assert '<div class="equation"><math' in html


def test_links_lead_to_lessons_and_out() -> None:
    assert '<a href="?lesson=02-inverse">' in to_html("[x](02-inverse.md)") == to_html("[x](02-inverse)")
    assert 'href="https://a.org" target="_blank" rel="noopener noreferrer"' in to_html("[x](https://a.org)")


def test_pictures_come_along_and_change(tmp_path: Path) -> None:
    picture = tmp_path / "01-leg.svg"
    picture.write_text("<svg/>")
    old = to_html("![A leg](01-leg.svg)", folder=tmp_path)
    assert f'alt="A leg" src="data:image/svg+xml;base64,{base64.b64encode(b"<svg/>").decode()}"' in old
    picture.write_text("<svg> </svg>")
    forget_rendered()
    assert to_html("![A leg](01-leg.svg)", folder=tmp_path) != old


@pytest.mark.parametrize("name", ["../secret.svg", "/etc/x.svg", "sub/x.svg", "x.txt", ".x.svg", "https://a.org/x.svg"])
def test_pictures_come_from_the_lessons_folder_only(tmp_path: Path, name: str) -> None:
    folder = tmp_path / "lessons"
    (folder / "sub").mkdir(parents=True)
    for path in (tmp_path / "secret.svg", folder / "sub" / "x.svg", folder / "x.txt", folder / ".x.svg"):
        path.write_text("secret")
    assert to_html(f"![A leg]({name})", folder=folder) == "<p><em>[A leg]</em></p>\n"


def test_an_equation_that_cannot_be_is_shown_as_written() -> None:
    assert to_html("$\\fraq{1}$") == "<p><code>\\fraq{1}</code></p>\n"
