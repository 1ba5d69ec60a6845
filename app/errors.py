"""The one exception that the command line turns into a sentence."""


class UserMistake(Exception):
    """Something the user can put right; the message is one sentence saying what is wrong and what to do."""
