/* voxelize_report.h - what summaries of cells have in common: grid and, where there is one, shift; and the files. */
#ifndef VOXELIZE_REPORT_H
#define VOXELIZE_REPORT_H

#include "console/json.h"
#include "write/voxels.h"

/* As lines of a summary, and as members of a JSON object. */
void voxelize_print_grid(const voxels *v, bool is_shifted);
void voxelize_json_grid(json *j, const voxels *v, bool is_shifted);

void voxelize_print_written(const char *path, bool lacks_place);
void voxelize_print_preview(const char *path, const char *up);

#endif
