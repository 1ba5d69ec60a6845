"""MuJoCo models of the robots, for a plant that owes nothing to the formulas of `app.robots.dynamics`.

Importing this does not import MuJoCo: that is done where a model is first run.
"""

from app.simulation.prototype.export import export
from app.simulation.prototype.items import Item
from app.simulation.prototype.model import mjcf
from app.simulation.prototype.plant import MujocoPlant

__all__ = ["Item", "MujocoPlant", "export", "mjcf"]
