"""Joint offsets and dimensions of a real robot from measured poses, with what they are worth."""
