"""The lesson panel: what a student reads, answers and presses."""
