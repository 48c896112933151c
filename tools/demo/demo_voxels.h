/* demo_voxels.h - the voxels of the mesh of tribox demo, and their picture. */
#ifndef DEMO_VOXELS_H
#define DEMO_VOXELS_H

#include "console/json.h"
#include "tribox.h"
#include "write/file_out.h"

/*
 * Voxelizes the soup, draws it into the file if one is open, which it keeps, and prints the result: in lines, or, if `to` is not
 * NULL, as the member "voxels" of the JSON object that is open. Returns an exit_code.
 */
int demo_voxels(const tribox_soup *soup, file_out *picture, json *to);

#endif
