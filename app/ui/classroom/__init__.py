"""The class in the browser: joining it, what the instructor shows, and the instructor's own page."""
