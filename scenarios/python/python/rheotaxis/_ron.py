"""Values of a scenario in its own notation."""


class Ron(str):
    """A value as it stands in a scenario's text, such as ``Ron("Amp(speed_m_s: 1.5)")``.

    A plain ``str`` is a text and gets quotation marks; this does not.
    """

    __slots__ = ()

    def __repr__(self) -> str:
        return f"Ron({str(self)!r})"
