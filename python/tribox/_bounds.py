"""Where triangles are."""

import numpy as np

from ._errors import BadIndexError, check_indices


def bounds_of(held_):
    """The least and the greatest x, y, z of all triangles that are finite; None if there is none."""
    if held_.is_soup:
        streams = [stream for axis in held_.streams for stream in axis]
        is_used = np.logical_and.reduce([np.isfinite(stream) for stream in streams])
        if not is_used.any():
            return None
        used = [[stream[is_used] for stream in axis] for axis in held_.streams]
        return [[float(min(map(np.min, axis))) for axis in used], [float(max(map(np.max, axis))) for axis in used]]
    points, is_finite = held_.vertices, np.isfinite(held_.vertices)
    if held_.faces is None:
        is_used = np.repeat(is_finite.all((1, 2)), 3)
        points = points.reshape(-1, 3)
    else:
        check_indices(held_)
        is_used, faces = np.zeros(len(points), bool), held_.faces
        is_used[faces[is_finite.all(1)[faces].all(1)]] = True
    if not is_used.any():
        return None
    points = points if is_used.all() else points[is_used]
    return [points.min(0).tolist(), points.max(0).tolist()]


def point(numbers):
    """As it looks in a repr."""
    return f"({', '.join(format(number, '.7g') for number in numbers)})"


def extent(held_):
    """Their bounds, for a repr, which raises nothing."""
    try:
        bounds = bounds_of(held_)
    except BadIndexError:
        return "with wrong indices"
    return "without bounds" if bounds is None else f"from {point(bounds[0])} to {point(bounds[1])}"
