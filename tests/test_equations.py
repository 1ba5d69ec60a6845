"""LaTeX becomes MathML, and nothing else: what people type into it stays text."""

from __future__ import annotations

from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.equations import LatexMistake, mathml

HARMLESS = {"math", "mrow", "mi", "mn", "mo", "mtext", "mspace", "mstyle", "mfrac", "msqrt", "mroot", "msup", "msub"}
HARMLESS |= {"msubsup", "mover", "munder", "munderover", "mtable", "mtr", "mtd", "menclose", "mpadded", "mphantom"}
HARMLESS |= {"mmultiscripts", "mprescripts", "none", "merror", "mfenced", "mlabeledtr"}
PIECES = [
    r"\text{",
    "}",
    "<script>",
    "&lt;img onerror=x&gt;",
    '"',
    "'",
    r"\frac",
    "{",
    "a",
    "^",
    "_",
    "&",
    r"\href{javascript:x}",
]


@pytest.mark.parametrize(
    "latex", [r"\text{<script>alert(1)</script>}", r"\text{&lt;script&gt;}", r"\textcolor{x\"><b>}{y}"]
)
def test_markup_stays_text(latex: str) -> None:
    root = ElementTree.fromstring(mathml(latex))
    assert {node.tag.rpartition("}")[2] for node in root.iter()} <= HARMLESS


@given(st.lists(st.sampled_from(PIECES), max_size=8).map("".join))
def test_whatever_is_typed_makes_equations_only(latex: str) -> None:
    try:
        root = ElementTree.fromstring(mathml(latex))
    except LatexMistake:
        return
    for node in root.iter():
        assert node.tag.rpartition("}")[2] in HARMLESS
        assert not {name for name in node.attrib if name.startswith("on") or name in ("href", "style")}


@pytest.mark.parametrize(
    ("latex", "reason"),
    [
        ("a^", "cannot be converted"),
        ("", "cannot be converted"),
        (r"\frac{a}", "lacks a part of \\frac"),
        (r"\fraq{a}{b}", r"has the command \fraq, which is unknown"),
        ("a}", "has a brace } too many"),
        (r"\href{javascript:alert(1)}{x}", "has a link or a style"),
        (r"\begin{matrix} a", "missing end"),
    ],
)
def test_a_mistake_is_named(latex: str, reason: str) -> None:
    with pytest.raises(LatexMistake, match=reason.replace("\\", "\\\\").replace("}", r"\}")):
        mathml(latex)


def test_names_of_functions_stand_upright() -> None:
    assert 'mathvariant="normal"' in mathml(r"\operatorname{atan2}(y, x)")
