"""Model-based closed loops of a whole robot."""

from app.simulation.closed_loop.experiment import Experiment
from app.simulation.closed_loop.ranking import Row, ranking
from app.simulation.closed_loop.simulate import compare, simulate

__all__ = ["Experiment", "Row", "compare", "ranking", "simulate"]
