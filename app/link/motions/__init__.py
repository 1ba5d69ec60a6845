"""How the host moves the robot: along an axis, after a hand, along a program. Pure; time is given to them."""
