"""Every kind of mistake in a lesson file is found, in its line, and told in one sentence."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.classroom.lessons.mistake import LessonMistake
from app.classroom.lessons.read import read_lesson
from tests.support.small_lesson import WHOLE, complaints, damaged, mistakes_of, write_lesson

NO_HINT = WHOLE.replace("3. The worked step.\n\n### Safety", "### Safety")

IN_PLACE = [
    # front matter
    ('title = "Small"', 'titel = "Small"', "titel is unknown here: did you mean title?", 0),
    ("minutes = 10", "minutes = 30", "take 10 minutes together, but the lesson 30", "1"),
    ("minutes = 10", 'minutes = "ten"', "minutes must be a number, not 'ten'", 0),
    ("minutes = 10", "minutes = true", "minutes must be a number, not true", 0),
    ("minutes = 10", "minutes = ", "This is no TOML: invalid value.", 0),
    ("minutes = 10", "minutes = 10\nmood = 3", "The key mood is unknown here", 1),
    ('robot = "par4"\ngoals', 'robot = "par5"\ngoals', "There is no robot par5: did you mean par4?", 0),
    ('goals = ["Move."]', 'goals = "Move."', "goals must be a list in [ ]", 0),
    ("hardware = true", 'papers = ["Laski"]\nhardware = true', "There is no paper Laski", 0),
    ("hardware = true", 'needs = ["07-more"]\nhardware = true', "there is no such lesson", "1"),
    ("step = 5\n", "step = 0\n", "x needs from <= to and a step above 0", -3),
    ("choose = [1, 3]", "choose = []", "leg has nothing to choose from", 0),
    ("choose = [1, 3]", "chose = [1, 3]", "chose is unknown here: did you mean choose?", 0),
    ('formula = "inverse"', 'formula = "invers"', "There is no formula invers: did you mean inverse?", 0),
    ('formula = "inverse"\nrobot = "par4"', 'formula = "inverse"', "The formula inverse needs robot", -1),
    ("z = -320 }", "z = -320 }\nspeed = 2", "The formula inverse has no argument speed", 1),
    ("z = -320 }", "z = -3200 }", "q cannot be computed with x = ", -3),
    ("z = -320 }", 'z = "deep" }', "pose must be a table of numbers", -3),
    ("z = -320 }", "w = -320 }", "a pose of par4 has x, y, z, theta, not w", -3),
    ('pick = "q<<leg>>"', 'pick = "q<<leg>>0"', "inverse has no result q", -4),
    ('pick = "q<<leg>>"', 'pick = "q<<lag>>"', "<<lag>> is no number that stands above q: did you mean leg?", 0),
    ('of = "<<q>>"', 'of = "<<minus_q>>"', "<<minus_q>> is no number that stands above minus_q", 0),
    ("digits = 1\n[derive.minus_q]", "digits = 20\n[derive.minus_q]", "digits must be a whole number from 0 to 12", 0),
    ('unit = "deg"\ndigits', 'unit = "mm"\ndigits', "its unit is written as mm, but must be 'deg'", -5),
    # texts
    ("Welcome to $x = <<x>>$ mm.", "Welcome to <<y>>.", "There is no number y: there are leg, minus_q, q, x.", 0),
    ("Welcome to $x = <<x>>$ mm.", "Welcome to <<a b>>.", "There is no number a b", 0),
    ("Welcome to $x = <<x>>$ mm.", "Hi\nthere $\\fraq{1}{2}$.", "has the command \\fraq, which is unknown", 1),
    ("Welcome to $x = <<x>>$ mm.", "$$\na^\n$$", "cannot be converted", 0),
    ("Welcome to $x = <<x>>$ mm.", "It costs $ 5.", "A $ stands alone", 0),
    ("Welcome to $x = <<x>>$ mm.", "A <b>bold</b> word.", "Raw HTML is not allowed: write <b>", 0),
    ("Welcome to $x = <<x>>$ mm.", "<script>x</script>", "Raw HTML is not allowed", 0),
    ("Welcome to $x = <<x>>$ mm.", "![A leg](02-leg.svg)", "There is no picture 02-leg.svg beside this file", 0),
    ("Welcome to $x = <<x>>$ mm.", "![A leg](../x.svg)", "There is no picture ../x.svg", 0),
    ("Welcome to $x = <<x>>$ mm.", "![](02-leg.svg)", "has no description", 0),
    ("Welcome to $x = <<x>>$ mm.", "See [two](02-two.md).", "There is no lesson 02-two: there is 01-small.", 0),
    ("Welcome to $x = <<x>>$ mm.", "See [two](two.html).", "The link two.html leads nowhere", 0),
    ("Welcome to $x = <<x>>$ mm.", "# A title", "# is no heading here", 0),
    ("Welcome to $x = <<x>>$ mm.", "A title\n---", "A line of --- makes a heading", 0),
    ("Welcome to $x = <<x>>$ mm.", "```toml\na = 1\n```", "the introduction is text only", 0),
    ("A prompt with <<x>>.", "### Act\n\nEarly.", "This step needs one block ```toml setup", "## First"),
    ('right = "Right, $<<q>>$."', 'right = "Right, $\\\\foo$."', "has the command \\foo", 0),
    # set-up
    ("```toml setup\nminutes = 5\ntab", "```toml\nminutes = 5\ntab", "stands ```toml setup, and nothing else", 0),
    ("minutes = 5\ntab", "minutes = 0\ntab", "minutes must be above 0", 0),
    ('tab = "Robot"', 'tab = "Robots"', "There is no tab Robots: did you mean Robot?", 0),
    ('["pose", "joint"]', '["pose", "joints"]', "there is none joints: did you mean joint?", 0),
    ('"pose.x" = "<<x>>"', '"pose.w" = 3', "There is no fact pose.w: did you mean pose.", 0),
    ("pose.y = 0\n", "pose.v = 0\n", "There is no fact pose.v", 0),
    ("pose.y = 0\n", 'pose.y = "up"\n', "pose.y must be a number, not 'up'", 0),
    ("pose.y = 0\n", "pose.radius = 3\n", "pose.radius can only be read", 0),
    ('[set]\nrobot = "par4"', '[set]\nrobot = "par9"', "robot cannot be 'par9': did you mean par4?", 1),
    # questions
    ("### Predict\n", "### Predicts\n", "There is no section Predicts: did you mean Predict?", 0),
    ("### Predict\n", "### Explain\n", "This step has two sections Explain", "### Explain\n\nHow"),
    ("Which way?\n", "", "Predict asks nothing", -2),
    ("- [x] Down, since", "- [ ] Down, since", "Predict has no right option", "### Predict"),
    ("- [ ] Up.", "- [x] Up.", "Predict has no wrong option", "### Predict"),
    ("- [ ] Up.\n", "- Up.\n", "Each option begins with - [ ] or - [x].", 0),
    ("- [ ] Up.\n", "- [ ]\n", "This option is empty", 0),
    ("- [ ] Up.\n  > Not up.\n", "- [ ] Up.\n", "This option has no feedback", 0),
    ('answer = "<<q>>"\n', "", "answer is missing here", 0),
    ('answer = "<<q>>"\nunit = "deg"', 'answer = "<<q>>"\nunit = "dge"', "There is no unit dge: did you mean deg?", 1),
    ('answer = "<<q>>"\nunit = "deg"', 'answer = "<<q>>"\nunit = "mm"', "The answer is in deg, not in mm.", 1),
    ("within = 0.5\n", "within = -1\n", "within must not be negative", 0),
    ("within = 0.5\n", "within = 500\n", "counts as right", "[[near]]"),
    ('wrong = "No."\n', "", "wrong is missing here", -4),
    ('says = "The sign."', 'say = "The sign."', "says is missing here", "[[near]]"),
    # act
    ("Move it to <<x>>.\n", "", "Act says nothing", -2),
    ('fact = "pose.x"\nis', 'fact = "pose.k"\nis', "There is no fact pose.k", 0),
    ('is = "<<x>>"\n', "", "This check compares with nothing", -2),
    ('is = "<<x>>"\n', 'is = "<<x>>"\nat_most = 3\n', "compares in more than one way", -2),
    ('is = "<<x>>"\nwithin = 2\n', 'is = "<<x>>"\n', "A number is never met exactly: add within", 0),
    ('is = "<<x>>"\nwithin = 2\n', "one_of = []\n", "one_of lists nothing", 0),
    ('is = "<<x>>"\nwithin = 2\n', "at_least = 3\nat_most = 2\n", "at_least lies above at_most", 0),
    ('is = "<<x>>"\nwithin = 2\n', "at_least = 3\nwithin = 2\n", "within belongs to a number after is", 1),
    ('is = "<<x>>"\nwithin = 2\n', "is = true\n", "pose.x must be a number, not True", 0),
    ('unit = "mm"\nsays = "It', 'says = "It', 'pose.x has a unit: add unit = "mm"', -4),
    ('unit = "mm"\nsays = "It', 'unit = "Mm"\nsays = "It', "The unit of pose.x is mm, not Mm.", 0),
    ("is = true\n", 'is = true\nunit = "mm"\n', "reach.ok has no unit", 1),
    ("is = true\n", 'is = "yes"\n', "reach.ok must be true or false, not 'yes'", 0),
    ("is = true\n", "at_least = 1\n", "reach.ok is no number, so it has no bounds", -2),
    ('"kept.overshoot"', '"kept.overshot"', "There is no fact kept.overshot: did you mean", 0),
    ('"kept.overshoot"', '"kept.rise"', "kept.rise is in s, which cannot be compared here", 0),
    ("times = 0.5", "time = 0.5", "The key time is unknown here: did you mean times?", 0),
    ("ever = true", 'ever = "true"', "ever must be true or false, not 'true'", 0),
    # plays and what belongs together
    ('press = "jog"', 'press = "jgo"', "There is no action jgo: did you mean jog?", 0),
    ('press = "jog"', 'push = "jog"', "set is missing here", -1),
    ("predict = 2\n", "predict = 1\n", "Solution gives 1 for predict, which is judged wrong.", "### Solution"),
    ("predict = 2\n", "", "Solution needs predict", "### Solution"),
    ("predict = 2\n", "predict = 2\nmore = 1\n", "Solution answers more, but this step does not ask", "### Solution"),
    ('explain = "<<q>>"', "explain = 200", "Solution gives 200 for explain, which is judged wrong", "### Solution"),
    ('explain = "<<minus_q>>"', 'explain = "<<q>>"', "for explain, which is judged right.", "### Wrong solution"),
    (
        "### Safety\n\nMind your fingers.",
        "",
        "The robot on the table moves in this step (jog): add ### Safety",
        "## First",
    ),
    ("### Safety\n\nMind your fingers.", "### Safety\n", "Safety is empty", 0),
    ("hardware = true\n", "", "write hardware = true in the front matter", "## First"),
]


@pytest.mark.parametrize(
    ("old", "new", "sentence", "where"), IN_PLACE, ids=[f"{c[2]:.40}-{n}" for n, c in enumerate(IN_PLACE)]
)
def test_a_mistake_is_found_in_its_line(tmp_path: Path, old: str, new: str, sentence: str, where: int | str) -> None:
    """`where`: lines from the damaged place, or the text of the line that is to be named."""
    source, line = damaged(old, new)
    if isinstance(where, int):
        expected = line + where
    else:
        expected = 1 if where == "1" else source[: source.index(where)].count("\n") + 1
    found = complaints(tmp_path, source)
    assert [at for at, reason in found if sentence in reason] == [expected], found


def test_a_whole_lesson_has_no_mistakes(tmp_path: Path) -> None:
    assert complaints(tmp_path, WHOLE) == []


def test_hints_are_three(tmp_path: Path) -> None:
    assert [reason for _, reason in complaints(tmp_path, NO_HINT)] == [
        "Hints are a numbered list of three, a question, a hint and the worked step, not 2."
    ]


@pytest.mark.parametrize("title", ["Hints", "Solution", "Wrong solution"])
def test_an_act_needs_other_sections(tmp_path: Path, title: str) -> None:
    """The second step loses one of them."""
    begin, end = WHOLE.split("## Second step")
    before, _, after = end.partition(f"### {title}\n")
    source = f"{begin}## Second step{before}{after[after.find('###') :] if '###' in after else ''}"
    line = begin.count("\n") + 1
    assert complaints(tmp_path, source) == [(line, f"This step has no section {title}: add ### {title}.")]


def test_all_mistakes_are_told_at_once(tmp_path: Path) -> None:
    source = WHOLE.replace("is = true", "is = 3").replace('tab = "Robot"', "tab = 1").replace("jog", "walk")
    assert len(complaints(tmp_path, source)) == 3


def test_a_number_that_leads_out_of_reach_is_found_though_it_is_rare(tmp_path: Path) -> None:
    """Only the last value is out of reach; one student in five hundred would get it."""
    source = WHOLE.replace("from = -60\nto = 60\nstep = 5", f"choose = {[0] * 499 + [700]}")
    assert "with x = 700" in complaints(tmp_path, source)[0][1]


@pytest.mark.parametrize(
    ("source", "line", "sentence"),
    [
        ("", 1, "begins with its front matter"),
        ("# Hello\n", 1, "begins with its front matter"),
        ("+++\ntitle = 1\n", 1, "The front matter never ends"),
        ("+++\n+++\n### Act\n", 3, "belongs to no step"),
        (WHOLE + "\n```toml\nexplain = 2\n", 160, "This block never ends"),
    ],
)
def test_a_broken_frame(tmp_path: Path, source: str, line: int, sentence: str) -> None:
    line = source[: source.rindex("```toml")].count("\n") + 1 if line == 160 else line
    assert [at for at, reason in complaints(tmp_path, source) if sentence in reason] == [line]


def test_names_and_encodings(tmp_path: Path) -> None:
    named = mistakes_of_file(write_lesson(tmp_path, WHOLE, name="lesson one"))
    assert named == [(1, "A lesson's file is named like 02-inverse.md, not lesson one.md.")]
    latin = tmp_path / "03-latin.md"
    latin.write_bytes(WHOLE.replace("Mind", "Mïnd").encode("latin-1"))
    line = WHOLE[: WHOLE.index("Mind")].count("\n") + 1
    assert mistakes_of_file(latin) == [(line, "This file is not written in UTF-8: save it so.")]
    assert mistakes_of_file(tmp_path / "04-none.md")[0][1].startswith("This file cannot be read: no such file")


def mistakes_of_file(path: Path) -> list[tuple[int, str]]:
    from app.classroom.lessons.read import mistakes_in

    return [(mistake.line, mistake.reason) for mistake in mistakes_in(path)]


def test_a_mistake_reads_like_a_compilers(tmp_path: Path) -> None:
    source, line = damaged('press = "jog"', 'press = "walk"')
    path = write_lesson(tmp_path, source)
    with pytest.raises(LessonMistake) as caught:
        read_lesson(path)
    assert str(caught.value).startswith(f"{path}:{line}: There is no action walk")
    assert str(mistakes_of(tmp_path, source)[0]) == str(caught.value)


def test_a_picture_must_fit(tmp_path: Path) -> None:
    source, line = damaged("Welcome to $x = <<x>>$ mm.", "![A leg](01-leg.svg)")
    picture = tmp_path / "01-leg.svg"
    picture.write_text("<svg><g></svg>")
    assert "is no SVG" in complaints(tmp_path, source)[0][1]
    picture.write_text("<svg xmlns='http://www.w3.org/2000/svg'/>")
    assert complaints(tmp_path, source) == [
        (line, "The picture 01-leg.svg needs a viewBox in its <svg>, to fit any width.")
    ]
    picture.write_text("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 9 9'/>")
    assert complaints(tmp_path, source) == []


def test_windows_lines_are_lines(tmp_path: Path) -> None:
    path = tmp_path / "01-small.md"
    path.write_bytes(b"\xef\xbb\xbf" + WHOLE.replace("\n", "\r\n").encode())
    assert mistakes_of_file(path) == []
