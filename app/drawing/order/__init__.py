"""The order in which strokes are drawn, so that the robot loses little time with the pen up."""

from app.drawing.order.cost import HopCost, between_mm, ink_mm, pen_up_mm, pen_up_s
from app.drawing.order.improve import Improvement
from app.drawing.order.joining import join_touching
from app.drawing.order.ordering import order_strokes
from app.drawing.order.reseat import is_closed, reseat

__all__ = [
    "HopCost",
    "Improvement",
    "between_mm",
    "ink_mm",
    "is_closed",
    "join_touching",
    "order_strokes",
    "pen_up_mm",
    "pen_up_s",
    "reseat",
]
