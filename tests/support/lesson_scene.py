"""A page with lessons, without a page: a course of two small lessons, an apparatus of plain facts."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Executor, Future
from pathlib import Path
from typing import Any

from app.classroom.classroom import Classroom
from app.classroom.lessons.course import Course
from app.classroom.lessons.lesson import Step, Value
from app.errors import UserMistake
from app.signal import Signal
from app.ui.lessons.desk import LessonDesk
from app.ui.lessons.library import Library

FIRST = r"""+++
title = "First & foremost"
minutes = 10
robot = "delta3"
goals = ["Move."]
+++
Welcome.

## Move it

Some text.

```toml setup
minutes = 6
tab = "Robot"
may_change = ["pose"]
[set]
robot = "delta3"
"geometry.rf" = 130
"pose.x" = 0
```

### Predict

Which way?

- [ ] Up.
  > Not up.
- [x] Down.
  > Yes, down.

### Act

Move it.

```toml
[[check]]
fact = "pose.x"
is = 40
within = 2
unit = "mm"
says = "It stands at 40 mm."
if_not = "Move it to the right."
[[check]]
fact = "conditioning"
at_most = 3
says = "It was even once."
why = "Because it is in the middle."
ever = true
```

### Explain

How far?

```toml
answer = 40
unit = "mm"
within = 1
right = "Right, 40."
wrong = "Look again."
[[near]]
value = -40
says = "Mind the sign."
```

### One more

And twice?

```toml
answer = 80
unit = "mm"
within = 1
right = "Yes."
wrong = "No."
```

### Hints

1. Where is it?
2. To the right.
3. Type 40.

### Instructor

Ask the class.

### Solution

```toml
predict = 2
explain = 40
more = 80
[[do]]
set = "pose.x"
to = 40
```

### Wrong solution

```toml
explain = 10
[[do]]
set = "pose.x"
to = 0
```

## Think

More text.

```toml setup
minutes = 4
```

### Explain

Is it so?

- [x] Yes.
  > It is.
- [ ] No.
  > It is, though.

### Hints

1. Think.
2. Think more.
3. Yes.

### Solution

```toml
explain = 1
```

### Wrong solution

```toml
explain = 2
```
"""

SECOND = r"""+++
title = "Numbers that differ"
minutes = 5
robot = "par4"
goals = ["See numbers."]
[vary.x]
from = 0
to = 1000
step = 1
+++
Hello.

## Read

Yours is <<x>>.

```toml setup
minutes = 5
```

### Explain

Which?

```toml
answer = "<<x>>"
unit = "mm"
within = 0.1
right = "Yes."
wrong = "No."
```

### Hints

1. Read.
2. Read the text.
3. It is <<x>>.

### Solution

```toml
explain = "<<x>>"
```

### Wrong solution

```toml
explain = -1
```
"""


class AtOnce(Executor):
    """Does the work when it is asked for."""

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        done: Future[Any] = Future()
        done.set_result(fn(*args, **kwargs))
        return done


class Facts:
    """An apparatus that knows what it was told."""

    def __init__(self) -> None:
        self.changed: Signal[None] = Signal()
        self.busy = False
        self.known: dict[str, Value] = {"robot": "par4", "conditioning": 5.0}
        self.set_before: list[str] = []
        self.refuses = ""
        """A fact that cannot be set."""

    def value(self, fact: str) -> Value | None:
        return self.known.get(fact)

    def set(self, fact: str, value: Value) -> None:
        if fact == self.refuses:
            raise UserMistake(f"{fact} is stuck.")
        self.set_before.append(fact)
        self.tell(**{fact: value})

    def tell(self, **values: Value) -> None:
        """What has come to be so; `pose_x` is `pose.x`."""
        self.known.update({name.replace("_", "."): value for name, value in values.items()})
        self.changed.emit(None)

    def evidence(self, step: Step) -> Sequence[Any]:
        return [{"title": f"Step {step.number}", "x_label": "x", "y_label": "y", "series": []}]


class Scene:
    """One visitor of a course; `await scene.open()` first."""

    def __init__(self, folder: Path, classroom: Classroom | None = None, browser: str = "a browser") -> None:
        self.folder = folder
        for name, text in (("01-first", FIRST), ("02-second", SECOND)):
            (folder / f"{name}.md").write_text(text)
        self.facts = Facts()
        self.library = Library(lambda: Course(folder), AtOnce())
        self.classroom = classroom or Classroom.in_memory()
        self.browser = browser
        self.desk: LessonDesk

    async def open(self) -> LessonDesk:
        await self.library.opened()
        self.desk = LessonDesk(self.library, self.classroom, self.browser, self.facts)
        return self.desk

    def close(self) -> None:
        self.desk.close()
        self.library.close()
        self.classroom.close()

    def act(self) -> None:
        """Do what the first step asks for."""
        step = self.desk.open_step
        assert step is not None
        self.facts.tell(conditioning=2.0, pose_x=40.0)
        for _ in range(2):
            step.look()
