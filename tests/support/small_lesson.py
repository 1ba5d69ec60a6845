"""A lesson that is whole, to be damaged in one place."""

from __future__ import annotations

from pathlib import Path

from app.classroom.lessons.mistake import LessonMistake
from app.classroom.lessons.read import mistakes_in

WHOLE = r"""+++
title = "Small"
minutes = 10
robot = "par4"
goals = ["Move."]
hardware = true
[vary.x]
from = -60
to = 60
step = 5
[vary.leg]
choose = [1, 3]
[derive.q]
formula = "inverse"
robot = "par4"
pose = { x = "<<x>>", y = 20, z = -320 }
pick = "q<<leg>>"
unit = "deg"
digits = 1
[derive.minus_q]
formula = "negative"
of = "<<q>>"
unit = "deg"
+++
Welcome to $x = <<x>>$ mm.

## First step

A prompt with <<x>>.

```toml setup
minutes = 5
tab = "Robot"
may_change = ["pose", "joint"]
[set]
robot = "par4"
"pose.x" = "<<x>>"
pose.y = 0
```

### Predict

Which way?

- [ ] Up.
  > Not up.
- [x] Down, since
  it falls.
  > Yes, down.
  > Always.

### Act

Move it to <<x>>.

```toml
[[check]]
fact = "pose.x"
is = "<<x>>"
within = 2
unit = "mm"
says = "It stands at <<x>> mm."
[[check]]
fact = "step.overshoot"
at_most = { fact = "kept.overshoot", times = 0.5 }
unit = "%"
says = "Half the overshoot."
if_not = "Less."
ever = true
[[check]]
fact = "reach.ok"
is = true
says = "In reach."
```

### Explain

How much is $q_<<leg>>$?

```toml
answer = "<<q>>"
unit = "deg"
within = 0.5
right = "Right, $<<q>>$."
wrong = "No."
[[near]]
value = "<<minus_q>>"
says = "The sign."
```

### Hints

1. A question?
2. A hint.
3. The worked step.

### Safety

Mind your fingers.

### Solution

```toml
predict = 2
explain = "<<q>>"
[[do]]
set = "pose.x"
to = "<<x>>"
[[do]]
press = "jog"
```

### Wrong solution

```toml
explain = "<<minus_q>>"
[[do]]
set = "pose.y"
to = 40
```

## Second step

```toml setup
minutes = 5
```

### Explain

Why?

- [x] Because.
  > So it is.
- [ ] Not at all.
  > It is.

### Hints

1. A question?
2. A hint.
3. The worked step.

### Solution

```toml
explain = 1
```

### Wrong solution

```toml
explain = 2
```
"""


def write_lesson(folder: Path, source: str = WHOLE, name: str = "01-small") -> Path:
    path = folder / f"{name}.md"
    path.write_text(source, encoding="utf-8")
    return path


def damaged(old: str, new: str) -> tuple[str, int]:
    """The lesson with one text replaced, and the line in which the new text begins (from 1)."""
    assert WHOLE.count(old) == 1, f"{old!r} stands {WHOLE.count(old)} times in the lesson"
    return WHOLE.replace(old, new), WHOLE[: WHOLE.index(old)].count("\n") + 1


def complaints(folder: Path, source: str) -> list[tuple[int, str]]:
    """(line, sentence) of every mistake in a lesson."""
    return [(mistake.line, mistake.reason) for mistake in mistakes_of(folder, source)]


def mistakes_of(folder: Path, source: str) -> list[LessonMistake]:
    return mistakes_in(write_lesson(folder, source))
