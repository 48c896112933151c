/* demo_voxels.h - the voxels of the mesh of tribox demo, and their picture. */
#ifndef DEMO_VOXELS_H
#define DEMO_VOXELS_H

#include <stdbool.h>

#include "write/file_out.h"
#include "tribox.h"

/*
 * Voxelizes the soup, draws it into the file if one is open, which it keeps, and prints what came of it, in lines or as a member of a
 * JSON object. Returns an exit_code.
 */
int demo_voxels(const tribox_soup *soup, file_out *picture, bool wants_json);

#endif
