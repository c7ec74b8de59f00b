"""What goes wrong in ways that a user can mend."""


class LookError(Exception):
    """A message for the user: what is wrong, where, and what to do."""


class EndedError(LookError):
    """A program that the look needs is gone: to try again is of no use."""
