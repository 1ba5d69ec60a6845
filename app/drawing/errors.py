"""The one exception that a user of the drawing pipeline has to expect."""


class DrawingError(ValueError):
    """A picture, file or setting that cannot be drawn; the message is one sentence for the user."""
