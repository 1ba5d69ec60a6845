"""The robot on the table, as the page shows and drives it."""
