"""The checks of an act."""

from __future__ import annotations

from app.classroom.lessons.build_step import complain_value, known
from app.classroom.lessons.catalogue import FactKind
from app.classroom.lessons.document import Section
from app.classroom.lessons.fill import Fill
from app.classroom.lessons.lesson import Act, Bound, Check, Relation
from app.classroom.lessons.mistake import Complaints
from app.classroom.lessons.table import Table


def act_of(section: Section, fill: Fill, complaints: Complaints) -> Act:
    """From the section Act."""
    text = fill.text(section.passage.text)
    if not text.strip():
        complaints.add(section.line, "Act says nothing: write what the student is to do.")
    if len(section.blocks) != 1:
        complaints.add(section.line, f"Act needs one toml block with its checks, not {len(section.blocks)}.")
        return Act(text, ())
    table = Table.of(section.blocks[0], fill, complaints)
    checks = tuple(_check(one) for one in table.tables("check"))
    table.close()
    if not checks and table.keys:
        complaints.add(section.line, "Act has no check: add one under [[check]].")
    return Act(text, checks)


def _check(table: Table) -> Check:
    fact = table.word("fact")
    unit, within = table.word("unit", ""), table.number("within", 0.0)
    kind = known(table, fact, "fact")
    if kind is not None:
        _complain_unit(table, fact, kind, unit)
    check = Check(
        fact=fact,
        unit=unit,
        says=table.word("says"),
        is_=table.value("is") if "is" in table else None,
        within=within,
        at_least=_bound(table, "at_least", kind),
        at_most=_bound(table, "at_most", kind),
        one_of=table.values("one_of") if "one_of" in table else (),
        why=table.word("why", ""),
        if_not=table.word("if_not", ""),
        ever=table.flag("ever", False),
        line=table.line(),
    )
    table.close("is", "one_of")
    _complain_comparison(table, check, kind)
    return check


def _complain_unit(table: Table, fact: str, kind: FactKind, unit: str) -> None:
    if unit in kind.units:
        return
    spelled = " or ".join(one for one in kind.units if one)
    if not spelled:
        table.complain(f"{fact} has no unit: leave unit out.", "unit")
    elif unit:
        table.complain(f"The unit of {fact} is {spelled}, not {unit}.", "unit")
    else:
        table.complain(f'{fact} has a unit: add unit = "{kind.unit}".')


def _complain_comparison(table: Table, check: Check, kind: FactKind | None) -> None:
    bounds = "at_least" in table or "at_most" in table
    ways = bounds + ("is" in table) + ("one_of" in table)
    if ways != 1:
        wrong = "compares with nothing" if not ways else "compares in more than one way"
        table.complain(f"This check {wrong}: give is, at_least and at_most, or one_of.")
    elif "one_of" in table and not check.one_of:
        table.complain("one_of lists nothing: no student could meet this.", "one_of")
    if kind is not None:
        _complain_wanted(table, check, kind)
    low, high = check.at_least, check.at_most
    if isinstance(low, (int, float)) and isinstance(high, (int, float)) and low > high:
        table.complain("at_least lies above at_most: no student could meet this.", "at_least")


def _complain_wanted(table: Table, check: Check, kind: FactKind) -> None:
    """A word or a flag is compared in another way than a number."""
    wanted = [("is", check.is_)] if "is" in table else [("one_of", one) for one in check.one_of]
    for key, value in wanted:
        if value is not None:
            complain_value(table, check.fact, value, key)
    bounds = "at_least" in table or "at_most" in table
    if "is" in table and kind.kind == "number" and "within" not in table:
        table.complain("A number is never met exactly: add within = ...", "is")
    elif "within" in table and (kind.kind != "number" or bounds):
        table.complain("within belongs to a number after is: leave it out.", "within")
    elif check.within < 0.0:
        table.complain("within must not be negative.", "within")
    elif bounds and kind.kind != "number":
        table.complain(f"{check.fact} is no number, so it has no bounds: use is or one_of.")


def _bound(table: Table, key: str, kind: FactKind | None) -> Bound | None:
    if key not in table:
        return None
    if not table.is_table(key):
        return table.number(key)
    below = table.table(key)
    relation = Relation(below.word("fact"), below.number("times", 1.0), below.number("plus", 0.0))
    below.close()
    other = known(below, relation.fact, "fact")
    if other is not None and kind is not None and not set(other.units) & set(kind.units):
        below.complain(f"{relation.fact} is in {other.unit or 'no unit'}, which cannot be compared here.", "fact")
    return relation
