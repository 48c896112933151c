#include "index_fixture.h"

stored_soup stored;
form_fences fences;
const char *names[KERNELS_MAX];
int kernels;

int index_fixture_make(size_t triangles, size_t boxes)
{
    kernels = kernels_here(names);
    stored = stored_soup_make(triangles);
    fences = form_fences_make(triangles, boxes);
    return 0;
}

int index_fixture_free(void **state)
{
    (void)state;
    stored_soup_free(&stored);
    form_fences_free(&fences);
    return 0;
}
