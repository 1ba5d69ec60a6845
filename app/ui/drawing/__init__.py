"""The drawing desk of one browser: what is drawn, how, on which sheet, and its play in 3-D."""
