"""Names: what is kept, and which are taken for one another."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.classroom.codes import ALPHABET, plain_code
from app.classroom.names import LONGEST_NAME, clean_name, free_name, name_key


@pytest.mark.parametrize(
    ("typed", "kept"),
    [
        ("  Ada   Lovelace ", "Ada Lovelace"),
        ("", ""),
        (" \t\n", ""),
        ("!?…", ""),
        ("a\u202eb\x00c", "a b c"),
        ("<b>x</b>", "<b>x</b>"),
        ("x" * 1_000_000, "x" * LONGEST_NAME),
        ("Jose\u0301", "José"),
        ("Zoë 李", "Zoë 李"),
        ("a" + "\u0335" * 40 + "b", "a" + "\u0335" * 2 + "b"),
    ],
)
def test_names_are_short_and_printable(typed: str, kept: str):
    assert clean_name(typed) == kept


@pytest.mark.parametrize("other", ["ADA", "A da", "Аda", "Ａda", "Ada.", "аdа"])
def test_names_that_look_the_same_are_the_same(other: str):
    assert name_key(other) == name_key("Ada")


@pytest.mark.parametrize(("one", "other"), [("Ada", "Ada 2"), ("José", "Jose"), ("Kim", "Jim"), ("की", "का")])
def test_other_names_are_others(one: str, other: str):
    assert name_key(one) != name_key(other)


@given(st.text())
def test_a_name_is_clean_or_none(typed: str):
    name = clean_name(typed)
    assert len(name) <= LONGEST_NAME and clean_name(name) == name
    assert name.isprintable() and bool(name_key(name)) == bool(name)


def test_a_suggestion_is_free_and_no_longer_than_a_name():
    taken: set[str] = set()
    for _ in range(12):
        name = free_name("x" * LONGEST_NAME, taken)
        assert name_key(name) not in taken and len(name) <= LONGEST_NAME
        taken.add(name_key(name))


def test_codes_are_read_as_they_are_spoken():
    assert plain_code(" k7qf-2mwa ") == plain_code("K7QF 2MWA") == "K7QF2MWA"
    assert not set("0O1IL5S") & set(ALPHABET)
