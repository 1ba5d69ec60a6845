"""The joints' limits that a toolpath keeps: those of the robot, see `app.robots.limits`."""

from app.robots.limits import RATES, RateLimits, rate_limits

__all__ = ["RATES", "RateLimits", "rate_limits"]
