"""Where a tool should be, and when."""

from app.motion.paths import PATHS, Path, Tour, quintic

__all__ = ["PATHS", "Path", "Tour", "quintic"]
