"""What ends a soak test."""


class Failure(Exception):
    """A promise is broken."""


def require(holds: bool, what: str) -> None:
    if not holds:
        raise Failure(what)
