"""Opening the classroom of a server."""

from __future__ import annotations

from collections.abc import Callable

from app.classroom.classroom import NO_OUTLINE, Classroom
from app.classroom.outline import Outline
from app.classroom.store.file import StoreMistake
from app.classroom.store.place import data_file
from app.classroom.store.store import Store


def open_classroom(
    data: str | None,
    *,
    in_class: bool,
    pin: str = "",
    name: str = "",
    outline: Callable[[], Outline] = lambda: NO_OUTLINE,
) -> Classroom:
    """Go on with what is in the file (`data`: a file, a folder, or None: the user's data folder).

    Without a class, and where no file was asked for, a file that cannot be used is no reason not to start: work is
    then kept in memory, and `notice` says so.

    Raises:
        StoreMistake: the file cannot be used, in one sentence.
    """
    notice = ""
    try:
        store = Store(data_file(data, in_class=in_class))
    except StoreMistake as mistake:
        if in_class or data is not None:
            raise
        store = Store()
        notice = f"What you do in lessons is not kept after this run. {mistake}"
    return Classroom(store, in_class=in_class, pin=pin, name=name, outline=outline, notice=notice)
