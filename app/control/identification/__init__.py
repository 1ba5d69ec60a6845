"""Finding a motor's model from a recording of its input and output."""

from app.control.identification.identify import Identification, identify
from app.control.identification.samples import IdentificationError

__all__ = ["Identification", "IdentificationError", "identify"]
