"""Lesson files, and the checks in them."""
