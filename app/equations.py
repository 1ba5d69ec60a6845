"""Equations on the page: LaTeX becomes MathML, which browsers draw themselves."""

from __future__ import annotations

import functools
import html
import re
from xml.etree.ElementTree import Element, tostring


class LatexMistake(ValueError):
    """LaTeX that cannot be converted; the message is the end of a sentence."""


def formulas(latex: str) -> str:
    """Several equations, parted by `\\quad` in the source, as one line that may break between them."""
    return " &ensp; ".join(mathml(part, block=False) for part in latex.split(r"\quad"))


@functools.lru_cache(maxsize=2048)
def mathml(latex: str, block: bool = True) -> str:
    """MathML of an equation; about 2 ms the first time.

    Raises:
        LatexMistake: for what the converter does not understand.
    """
    from latex2mathml.converter import convert_to_element

    upright = latex.replace(r"\operatorname", r"\mathrm")  # the converter would set its letters in italics
    try:
        element = convert_to_element(upright, display="block" if block else "inline")
    except Exception as error:  # it raises a class of its own for each mistake, and others for some
        raise LatexMistake(f"cannot be converted ({_reason(error)})") from error
    return _written(element)


def _written(element: Element) -> str:
    """The converter's own writer would let markup pass that somebody put into `\text`."""
    for node in element.iter():
        node.text = html.unescape(node.text) if node.text else node.text  # operators are character references
        if unknown := re.search(r"\\[A-Za-z]+", node.text or ""):
            raise LatexMistake(f"has the command {unknown[0]}, which is unknown")
        if node.tag == "mi" and node.text == "}":
            raise LatexMistake("has a brace } too many")
        if node.tag == "mfrac" and len(node) < 2:
            raise LatexMistake(r"lacks a part of \frac")
        if {"href", "style"} & set(node.keys()):
            raise LatexMistake("has a link or a style, which equations cannot have here")
    return tostring(element, encoding="unicode")


def _reason(error: Exception) -> str:
    """`MissingEndError` reads "missing end"."""
    words = re.findall(r"[A-Z][a-z]*", type(error).__name__.removesuffix("Error"))
    return " ".join(words).lower() or "nothing there"
