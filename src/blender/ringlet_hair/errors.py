"""What the add-on fails with."""


class RingletError(Exception):
    """A sentence for the user: what was tried, what was found, what to do."""
