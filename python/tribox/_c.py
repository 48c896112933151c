"""The calls of the library about triangles. Each stands for two, about a soup and about a mesh, and returns a status."""

from ._ffi import ffi
from ._library import lib

NULL = ffi.NULL
REGION = ffi.typeof("tribox_region *")


def of_both(name, soup=""):
    """The call of this name about whichever is given. soup: what goes before it where that is a soup."""
    of_soup, of_mesh = getattr(lib, f"tribox_{soup}{name}"), getattr(lib, f"tribox_mesh_{name}")

    def call(held_, *arguments):
        return (of_soup if held_.is_soup else of_mesh)(held_.struct, *arguments)

    return call


overlap, overlap_oriented, classify, find, split = map(of_both, ("overlap", "overlap_oriented", "classify", "find", "split"))
voxelize, voxelize_ids, voxelize_thin = map(of_both, ("voxelize", "voxelize_ids", "voxelize_thin"))
tile_lists_part, cell_lists, fill_parity = map(of_both, ("tile_lists_part", "cell_lists", "fill_parity"))
sort, sort_start = of_both("sort", "soup_"), of_both("sort_start", "soup_")


def gather(held_, order, first, soup):
    """Writes as many triangles as the soup has, of float32 or rounded to it: those from a place in an order on."""
    to, whole = soup.struct, (order, first, soup.struct.count)
    if held_.is_soup:
        return lib.tribox_soup_gather(held_.struct, *whole, to.x, to.y, to.z)
    return lib.tribox_mesh_gather(held_.struct, NULL, *whole, to.x, to.y, to.z)


class Region:
    """A tribox_region, and what it points to."""

    def __init__(self, box=NULL, oriented=NULL):
        self.box, self.oriented = box, oriented
        self.struct = ffi.new(REGION, (box, oriented))


class Indexed:
    """A tribox_index, and what it points to."""

    def __init__(self, nodes, held_, ids):
        self.nodes, self.held, self.ids = nodes, held_, ids
        soup, mesh = (held_.struct, NULL) if held_.is_soup else (NULL, held_.struct)
        self.struct = ffi.new("tribox_index *", (nodes, soup, mesh, ids))


def list_each(index, regions, options, numbers, start, done):
    """Lists of an array of tribox_region, from region `done` on, as far as there is room.

    Returns the status, how many are done, and the room that these and the next one take.
    """
    struct, list_, found, starts = index.struct, lib.tribox_index_list, ffi.new("size_t *"), []
    at, room, to, status, end = int(start[done]), len(numbers), ffi.from_buffer("uint32_t[]", numbers), 0, 0
    for i in range(done, len(start) - 1):
        status = list_(struct, regions + i, options, room - at, to + at, found)
        end = at + found[0]
        if status or end > room:
            break
        starts.append(end)
        at = end
    start[done + 1:done + len(starts) + 1] = starts
    return status, done + len(starts), end
