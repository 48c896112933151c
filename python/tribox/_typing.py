"""What the calls take and return, for type checkers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, Mapping, Protocol, Sequence, SupportsFloat, SupportsIndex, Tuple, Union

from numpy.typing import ArrayLike, NDArray

if TYPE_CHECKING:
    from ._boxes import OrientedBox
    from ._grids import Grid
    from ._triangles import Mesh, Soup


class HasFaces(Protocol):
    """A mesh of trimesh."""

    @property
    def vertices(self) -> Any: ...

    @property
    def faces(self) -> Any: ...


class HasTriangles(Protocol):
    """A mesh of Open3D."""

    @property
    def vertices(self) -> Any: ...

    @property
    def triangles(self) -> Any: ...


class HasCells(Protocol):
    """A mesh of meshio."""

    @property
    def points(self) -> Any: ...

    @property
    def cells_dict(self) -> Mapping[Any, Any]: ...


class HasPolygons(Protocol):
    """A mesh of PyVista."""

    @property
    def points(self) -> Any: ...

    @property
    def faces(self) -> Any: ...


MeshLike = Union[HasFaces, HasTriangles, HasCells, HasPolygons]
TrianglesLike = Union[ArrayLike, Tuple[ArrayLike, ArrayLike], "Mesh", "Soup", MeshLike]
Vector = Union[Sequence[SupportsFloat], NDArray[Any]]  # three numbers: x, y, z
Corners = Union[Vector, Sequence[Vector]]  # three numbers, or two times three: both corners of a box
Frame = Union[Sequence[Vector], NDArray[Any]]  # three times three numbers
Region = Union[Corners, "OrientedBox"]
Boxes = ArrayLike  # of shape (m, 3) or (3, m), or (m, 2, 3) for both corners
Cell = Union[SupportsFloat, Vector]
Cells = Union[Sequence[SupportsIndex], NDArray[Any]]  # three whole numbers
GridLike = Union["Grid", Tuple[Vector, Cell, Cells]]
Window = Tuple[Cells, Cells]
Range = Tuple[SupportsIndex, SupportsIndex]  # first, count
Accuracy = Literal["exact", "conservative", "fast"]
Fill = Literal["outside", "parity", "middles"]
Answer = NDArray[Any]  # of bool, or of uint64 for packed bits
