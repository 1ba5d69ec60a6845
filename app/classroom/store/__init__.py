"""The one file in which a classroom is kept (SQLite)."""
