"""What the calls take and return, for type checkers."""

from typing import TYPE_CHECKING, Any, Literal, Mapping, Protocol, Sequence, SupportsFloat, SupportsIndex, Tuple, Union

from numpy.typing import ArrayLike, NDArray

if TYPE_CHECKING:
    from ._triangles import Soup


class HasFaces(Protocol):
    """A Mesh, and a mesh of trimesh."""

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
TrianglesLike = Union[ArrayLike, "Soup", MeshLike]
Vector = Union[Sequence[SupportsFloat], NDArray[Any]]  # three numbers: x, y, z
Frame = Union[Sequence[Vector], NDArray[Any]]  # three of them
Cell = Union[SupportsFloat, Vector]
Cells = Union[Sequence[SupportsIndex], NDArray[Any]]  # three whole numbers
Window = Tuple[Cells, Cells]
Range = Tuple[SupportsIndex, SupportsIndex]
Accuracy = Literal["exact", "conservative", "fast"]
Fill = Literal["outside", "parity"]
Answer = NDArray[Any]  # of bool, or of uint64 for packed bits
