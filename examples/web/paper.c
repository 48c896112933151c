/* paper.c - the paper's own test, for the page's chart: compiled with the library, and exported beside it. */
#define PAPER_WALKS paper_walks_any
#include "../../tools/paper/paper_walk.c"

/* A page cannot call through a pointer. The order is the paper's, 312. */
void paper_overlap(const float center[3], const float half[3], const float (*triangles)[3][3], size_t count, uint64_t *mask);

void paper_overlap(const float center[3], const float half[3], const float (*triangles)[3][3], size_t count, uint64_t *mask)
{
    walk_312(center, half, triangles, count, mask);
}
