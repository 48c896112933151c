/* grid_options.c - reads which mesh and which grid. */
#include "grid_options.h"

#include <string.h>

#include "console/message.h"
#include "console/numbers.h"

static int read_cell(const char *text, double cell[3])
{
    const bool is_one = !strpbrk(text, NUMBERS_BLANKS ",");
    if (!numbers_read(text, "--cell", is_one ? "S" : "SX,SY,SZ", is_one ? 1 : 3, cell, NULL))
        return EXIT_CODE_USAGE;
    if (is_one)
        cell[1] = cell[2] = cell[0];
    for (int a = 0; a < 3; a++)
        if (!(cell[a] > 0))
            return message_usage("--cell: %.9g is not greater than 0", cell[a]);
    return EXIT_CODE_OK;
}

int grid_take(grid_request *r, int which, const char *value)
{
    switch (which) {
    case GRID_FORMAT:
        return triangle_format_read(value, &r->format);
    case GRID_SHIFT:
        return mesh_shift_read(value, &r->shift);
    case GRID_RESOLUTION:
        return numbers_read_whole(value, "--resolution", GRID_CELLS_MAX, &r->choice.resolution);
    case GRID_CELL:
        return read_cell(value, r->choice.cell);
    case GRID_ORIGIN:
        r->choice.has_origin = true;
        return numbers_read(value, "--origin", "X,Y,Z", 3, r->choice.origin, NULL) ? EXIT_CODE_OK : EXIT_CODE_USAGE;
    default:
        r->choice.has_size = true;
        return numbers_read_sizes(value, "--size", GRID_CELLS_MAX, r->choice.size);
    }
}

int grid_check(const grid_request *r, const options_found *found, int from)
{
    const bool has_resolution = options_has(found, from + GRID_RESOLUTION), has_cell = options_has(found, from + GRID_CELL);
    if (!r->mesh_path)
        return message_usage("no mesh file given");
    if (triangle_format_check(r->mesh_path, r->format))
        return EXIT_CODE_USAGE;
    if (has_resolution == has_cell)
        return message_usage(has_cell ? "--resolution and --cell exclude each other"
                                      : "no grid given; give --resolution or --cell");
    return EXIT_CODE_OK;
}
