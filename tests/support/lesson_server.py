"""A `deltalab` that teaches lessons of a test's own."""

from __future__ import annotations

import sys
from contextlib import AbstractContextManager
from pathlib import Path

from tests.support.lesson_scene import FIRST, SECOND
from tests.support.server import RunningServer, running_deltalab

# Workers are started with the same program, which then must not serve.
_PROGRAM = """
import sys
from pathlib import Path
import app.resources
folder = Path(sys.argv.pop(1))
app.resources.lessons_dir = lambda: folder
from app.cli import main
main()
"""


def running_course(folder: Path) -> AbstractContextManager[RunningServer]:
    """A listening server with two small lessons and the work done in them, all in `folder`."""
    for name, text in (("01-first", FIRST), ("02-second", SECOND), ("03-broken", "+++\nnonsense")):
        (folder / f"{name}.md").write_text(text)
    data = str(folder / "data.sqlite3")
    return running_deltalab("--no-shadows", "--data", data, command=(sys.executable, "-c", _PROGRAM, str(folder)))
