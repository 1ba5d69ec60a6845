"""The firmware, and how it is built."""
