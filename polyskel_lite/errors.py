"""Errors of the library: all are ``ValueError`` and say what is wrong, where, and what to do."""


class PolyskelError(ValueError):
    """Any refusal of this library; catch it to catch them all.

    Examples
    --------
    >>> import polyskel_lite as psl
    >>> try:
    ...     psl.delaunay([(0, 0), (1, 0), (0, 1), (1, 0)])
    ... except psl.PolyskelError as error:
    ...     print(type(error).__name__)
    DuplicatePointError
    """


class InputError(PolyskelError):
    """An array, a file or a name that cannot be used as it is (wrong shape, not finite, unknown)."""


class DuplicatePointError(InputError):
    """Two samples stand at the same place; the message names their indices."""


class ShapeError(PolyskelError):
    """A boundary that is open, crosses itself, or has its interior on the wrong side."""


class TessellationError(PolyskelError):
    """No verified Delaunay tessellation could be made of these points."""


class ContourContainmentError(PolyskelError):
    """The boundary is not in Del(E) (the paper's section 3.4).

    Attributes
    ----------
    missing : (k,) int array
        The indices of the boundary facets that are not Delaunay facets.
    """

    def __init__(self, message: str, missing):
        super().__init__(message)
        self.missing = missing


class ReconstructionError(PolyskelError):
    """No closed curve could be certified from the samples alone."""


class TangentBallsError(PolyskelError):
    """Two balls of a polyball touch without crossing, in a point of its boundary (the paper's appendix A).

    Attributes
    ----------
    pairs : (q, 2) int array
        The balls.
    """

    def __init__(self, message: str, pairs):
        super().__init__(message)
        self.pairs = pairs


class CoarseSamplingWarning(UserWarning):
    """Balls of a skeleton are larger than the room around their centres: the samples are too far apart."""


class LeftOutWarning(UserWarning):
    """Something in a file is no outline, or was taken in a way that should be known; the message names it."""
