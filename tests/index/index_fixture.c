#include "index_fixture.h"

stored_soup stored;
form_fences fences;

int index_fixture_make(size_t triangles, size_t boxes)
{
    stored = stored_soup_make(triangles);
    fences = form_fences_make(triangles, boxes);
    return 0;
}
