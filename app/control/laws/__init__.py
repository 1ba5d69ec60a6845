"""Control laws for a whole robot, from independent joints to laws that know its dynamics."""

from app.control.laws.catalogue import LAWS, LawError, LawKind
from app.control.laws.law import Law, Reference, Seen, Setup
from app.control.laws.tuning import DECENTRALISED, Tuning, TuningError

__all__ = [
    "DECENTRALISED",
    "LAWS",
    "Law",
    "LawError",
    "LawKind",
    "Reference",
    "Seen",
    "Setup",
    "Tuning",
    "TuningError",
]
