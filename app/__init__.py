"""Delta Lab: parallel robots alive in the browser."""

__version__ = "0.1.0"
