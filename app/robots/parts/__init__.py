"""What the robots look like: bodies of closed parts, and where each of them is in any pose."""

from app.robots.parts.machine import Machine
from app.robots.parts.machines import machine_of
from app.robots.parts.materials import MATERIALS, Material
from app.robots.parts.part import LEG, Body, Part, Placement

__all__ = ["LEG", "MATERIALS", "Body", "Machine", "Material", "Part", "Placement", "machine_of"]
