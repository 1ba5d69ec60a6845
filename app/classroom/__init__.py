"""A class and its course: who is here, who has got how far, and the lessons that are worked through."""
