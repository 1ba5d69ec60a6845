"""Lessons on a student's page."""
