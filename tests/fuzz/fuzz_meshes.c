/*
 * fuzz_meshes.c - whole files of meshes, the fast way and the one that knows every spelling: what the first reads the second reads
 * as well, and both make the same mesh. The first byte chooses the name's ending, the threads and whether numbers stay doubles, the
 * second how long the parts of a text are.
 */
#include "ensure.h"
#include "lines.h"
#include "same_mesh.h"

static const char *const names[] = {"a.ply", "a.obj", "a.stl", "a.off"};
enum { NAMES = sizeof names / sizeof names[0] };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const unsigned threads[] = {1, 2, 3, 7};
    if (size < 2)
        return 0;
    mesh plain = {.coordinates = NULL}, slow = {.coordinates = NULL};
    const bool is_wide = data[0] & 64;
    const char *const path = lines_file(names[data[0] % NAMES], data + 2, size - 2);
    lines_forget();
    const bool is_plain = mesh_read_plain(path, is_wide, threads[data[0] / NAMES % 4], 1 + (size_t)data[1], &plain);
    lines_fit("mesh_read_plain", 0);
    const int code = mesh_read_slowly(path, is_wide, 1, &slow);
    lines_fit("mesh_read_slowly", code);
    ensure(!is_plain || !code, "the fast way reads what the other refuses");
    ensure(!is_plain || mesh_is_same(&plain, &slow), "two ways make two meshes");
    ensure(!is_plain || mesh_is_looked_at_well(&plain), "bounds or triangles that are not finite are others");
    mesh_free(&plain);
    mesh_free(&slow);
    return 0;
}
