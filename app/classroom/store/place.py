"""Where the file is."""

from __future__ import annotations

from pathlib import Path

CLASS_FILE = "class.sqlite3"
SOLO_FILE = "alone.sqlite3"
"""Apart from the class's, so that one can work alone while a class is running."""


def data_file(data: str | None, *, in_class: bool) -> Path:
    """The file to use: `data` is a file, a folder (a name without a dot is one), or None: the user's data folder."""
    name = CLASS_FILE if in_class else SOLO_FILE
    if data is None:
        from platformdirs import user_data_path

        return user_data_path("deltalab", appauthor=False) / name
    place = Path(data).expanduser()
    return place / name if place.is_dir() or not place.suffix else place
