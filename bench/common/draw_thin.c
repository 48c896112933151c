/* draw_thin.c - segments and slivers: triangles whose computed normal is rounding, or nearly. */
#include "draw.h"

#include <math.h>
#include <string.h>

/* Off the edge from t[0] to t[1] by `share` of its length, in a direction across it. */
static void put_off_edge(generator *g, triangle t, float along, double share)
{
    double edge[3], any[3], across[3], edge_length = 0, across_length = 0;
    for (int a = 0; a < 3; a++) {
        edge[a] = (double)t[1][a] - (double)t[0][a];
        any[a] = (double)random_between(g, -1, 1);
        edge_length += edge[a] * edge[a];
    }
    for (int a = 0; a < 3; a++) {
        across[a] = edge[(a + 1) % 3] * any[(a + 2) % 3] - edge[(a + 2) % 3] * any[(a + 1) % 3];
        across_length += across[a] * across[a];
    }
    const double off = across_length > 0 ? share * sqrt(edge_length / across_length) : 0;
    for (int a = 0; a < 3; a++)
        t[2][a] = (float)((double)t[0][a] + (double)along * edge[a] + off * across[a]);
}

/* A quarter go there and back, a quarter have a vertex on an edge; the others are 2^10 to 2^30 times as long as high. */
void draw_thin(generator *g, triangle t)
{
    draw_paper(g, t);
    const size_t kind = random_below(g, 4);
    const float along = random_between(g, 0, 1);
    const int power = 10 + (int)random_below(g, 21);
    if (kind == 0)
        memcpy(t[2], t[0], sizeof t[2]);
    else
        put_off_edge(g, t, along, kind == 1 ? 0 : ldexp(1, -power));
}
