"""Panels of the control lab; each knows the desk, never another panel."""
