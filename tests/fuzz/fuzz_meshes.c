/*
 * fuzz_meshes.c - whole files of meshes, the fast way and the one that knows every spelling: what the first reads the second reads
 * as well, and both make the same mesh; and what scanners take up of a file. The first byte chooses the name's ending, the threads
 * and whether numbers stay doubles, the second how long the parts of a text are.
 */
#include <stdlib.h>
#include <string.h>

#include "ensure.h"
#include "lines.h"
#include "read/scan.h"
#include "same_mesh.h"

static const char *const names[] = {"a.ply", "a.obj", "a.stl", "a.off"};
static const mesh_kind kinds[] = {MESH_PLY, MESH_OBJ, MESH_STL_TEXT, MESH_OFF};
enum { NAMES = sizeof names / sizeof names[0] };

/* Numbers fit float as well as the reader says. */
static void check_numbers(const indexed_mesh *m)
{
    const size_t numbers = m->position_bytes == sizeof(double) ? 3 * m->positions.count : 0;
    size_t fits = 0;
    for (size_t i = 0; i < numbers; i++)
        fits += float_fit_of(((const double *)m->positions.of)[i]) == FLOAT_FIT_EXACT;
    ensure(!numbers || (fits == numbers) == (m->fit == FLOAT_FIT_EXACT), "%zu of %zu numbers are floats", fits, numbers);
}

/* Every corner of a face is a vertex that was read, and memory is in proportion to the file, beyond a large page a list. */
static void check_mesh(const indexed_mesh *m, size_t size, int code)
{
    enum { PAGE = 1 << 21 };
    const uint32_t *const corners = m->corners.of;
    for (size_t i = 0; !code && i < m->corners.count; i++)
        ensure(corners[i] < m->positions.count, "corner %zu is vertex %u of %zu", i, corners[i], m->positions.count);
    ensure(m->positions.count <= m->positions.room && m->positions.room <= size + PAGE / sizeof(float[3]),
           "room for %zu vertices of %zu bytes", m->positions.room, size);
    ensure(m->corners.room <= 4 * size + PAGE && m->sizes.count <= size, "%zu corners of %zu bytes", m->corners.room, size);
}

/* In memory of its own, with the NUL byte that whole_file promises and nothing after it. */
static void scan_file(const char *name, mesh_kind kind, const uint8_t *bytes, size_t size)
{
    whole_file file = {malloc(size + 1), size};
    indexed_mesh m = {.position_bytes = 0};
    ensure(file.bytes, "no memory");
    memcpy(file.bytes, bytes, size);
    file.bytes[size] = '\0';
    lines_forget();
    const int code = scan_read(name, kind, &file, &m);
    lines_fit(name, code);
    check_mesh(&m, size, code);
    if (!code)
        check_numbers(&m);
    indexed_mesh_free(&m);
    whole_file_free(&file);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const unsigned threads[] = {1, 2, 3, 7};
    if (size < 2)
        return 0;
    mesh plain = {.coordinates = NULL}, slow = {.coordinates = NULL};
    const bool is_wide = data[0] & 64;
    scan_file(names[data[0] % NAMES], kinds[data[0] % NAMES], data + 2, size - 2);
    const char *const path = lines_file(names[data[0] % NAMES], data + 2, size - 2);
    lines_forget();
    const bool is_plain = mesh_read_plain(path, is_wide, threads[data[0] / NAMES % 4], 1 + (size_t)data[1], &plain);
    lines_fit("mesh_read_plain", 0);
    const int code = mesh_read_slowly(path, MESH_OTHER, is_wide, 1, &slow);
    lines_fit("mesh_read_slowly", code);
    ensure(!is_plain || !code, "the fast way reads what the other refuses");
    ensure(!is_plain || mesh_is_same(&plain, &slow), "two ways make two meshes");
    ensure(!is_plain || mesh_is_looked_at_well(&plain), "bounds or triangles that are not finite are others");
    mesh_free(&plain);
    mesh_free(&slow);
    return 0;
}
