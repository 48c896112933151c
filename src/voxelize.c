/* voxelize.c - a soup into the cells of a grid. */
#include <string.h>

#include "environment.h"
#include "exact.h"
#include "grid.h"
#include "plan.h"
#include "soup.h"

static float least_of(float a, float b, float c) { return a < b ? (a < c ? a : c) : b < c ? b : c; }
static float most_of(float a, float b, float c) { return a > b ? (a > c ? a : c) : b > c ? b : c; }

tribox_status tribox_voxelize_layers(const tribox_soup *soup, const tribox_grid *grid, uint32_t first, uint32_t layers,
                                     const tribox_options *options, uint64_t *occupied, tribox_report *report)
{
    if (!grid || !occupied || !tribox_soup_is_readable(soup))
        return TRIBOX_BAD_ARGUMENT;
    tribox_plan plan;
    const tribox_status status = tribox_plan_make(options, &plan);
    if (status)
        return status;
    if (!tribox_grid_is_sound(grid))
        return TRIBOX_BAD_GRID;
    if (first > grid->size[2] || layers > grid->size[2] - first)
        return TRIBOX_BAD_ARGUMENT;
    tribox_report counts = {0, 0};
    for (size_t t = 0; t < soup->count; t++) {
        float u[3][3];
        tribox_cells range[3];
        for (int v = 0; v < 3; v++) {
            u[v][0] = soup->x[v][t];
            u[v][1] = soup->y[v][t];
            u[v][2] = soup->z[v][t];
        }
        if (!tribox_triangle_is_finite((const float(*)[3])u))
            continue;
        for (int a = 0; a < 3; a++) {
            range[a] = (tribox_cells){0, (int64_t)grid->size[a] - 1};
            if (plan.axes & TRIBOX_AXES_BOX)
                range[a] =
                    tribox_grid_cells(grid, a, least_of(u[0][a], u[1][a], u[2][a]), most_of(u[0][a], u[1][a], u[2][a]));
        }
        for (int64_t k = range[2].first; k <= range[2].last; k++)
            for (int64_t j = range[1].first; k >= first && k < (int64_t)first + layers && j <= range[1].last; j++)
                for (int64_t i = range[0].first; i <= range[0].last; i += 64) {
                    float bound[6][64];
                    uint64_t mask;
                    tribox_report r;
                    tribox_boxes boxes = {.count = (size_t)(range[0].last - i + 1)};
                    if (boxes.count > 64)
                        boxes.count = 64;
                    for (size_t l = 0; l < boxes.count; l++) {
                        const tribox_box b = tribox_grid_cell(grid, (uint32_t)i + (uint32_t)l, (uint32_t)j, (uint32_t)k);
                        for (int a = 0; a < 3; a++) {
                            bound[a][l] = b.lo[a];
                            bound[3 + a][l] = b.hi[a];
                        }
                    }
                    for (int a = 0; a < 3; a++) {
                        boxes.lo[a] = bound[a];
                        boxes.hi[a] = bound[3 + a];
                    }
                    tribox_overlap_boxes((const float(*)[3])u, &boxes, options, &mask, &r);
                    counts.undecided += r.undecided;
                    for (size_t l = 0; l < boxes.count; l++)
                        if (mask >> l & 1) {
                            uint64_t *const word =
                                &occupied[((size_t)(k - first) * grid->size[1] + (size_t)j) * tribox_grid_row_words(grid) +
                                          ((size_t)i + l) / 64];
                            const uint64_t bit = UINT64_C(1) << (((size_t)i + l) % 64);
                            counts.overlapping += !(*word & bit);
                            *word |= bit;
                        }
                }
    }
    if (report)
        *report = counts;
    return TRIBOX_OK;
}

tribox_status tribox_voxelize(const tribox_soup *soup, const tribox_grid *grid, const tribox_options *options, uint64_t *occupied,
                              tribox_report *report)
{
    return tribox_voxelize_layers(soup, grid, 0, grid ? grid->size[2] : 0, options, occupied, report);
}
