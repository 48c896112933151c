/* embree_absent.c - built in place of embree.c where there is no Embree: every test is skipped. */
#include "embree.h"

#include <stdio.h>
#include <stdlib.h>

bool embree_is_usable(void)
{
    printf("skipped: built without Embree; install it (Debian: libembree-dev) and set up the build with -Dembree=enabled\n");
    return false;
}

embree_scene *embree_scene_make(const triangle *triangles, size_t count)
{
    (void)triangles;
    (void)count;
    abort();
}

void embree_scene_free(embree_scene *scene)
{
    (void)scene;
    abort();
}

size_t embree_cast(embree_scene *scene, const float from[3], const float along[3], float far, const embree_hit **hits)
{
    (void)scene;
    (void)from;
    (void)along;
    (void)far;
    (void)hits;
    abort();
}
