#include "drawn_pairs.h"

#include <string.h>

#include "common/contact.h"

pair_list pairs_over(const drawn_numbers *numbers, size_t count, const tribox_box *box, const float (*triangle)[3])
{
    pair_list q = {.count = count, .box = box, .triangle = triangle};
    for (int s = 0; s < SOUP_STREAMS; s++)
        q.stream[s] = numbers->stream[s];
    return q;
}

static pair_list drawn_over(const drawn_numbers *numbers, bool is_soup, size_t count)
{
    return pairs_over(numbers, count, is_soup ? &numbers->box : NULL, is_soup ? NULL : numbers->triangle);
}

static void put_triangle(drawn_numbers *numbers, size_t i, float u[3][3])
{
    for (int a = 0; a < 3; a++)
        for (int v = 0; v < 3; v++)
            numbers->stream[3 * a + v][i] = u[v][a];
}

/* A bound near the scene's own, or one that touches a vertex, or nearly. */
static float draw_bound(random_source *r, float bound, float triangle[3][3], int a)
{
    return nudged(r, random_int(r, 4) ? bound : triangle[random_int(r, 3)][a], 2);
}

static void put_box(random_source *r, drawn_numbers *numbers, size_t i, const tribox_box *box)
{
    for (int a = 0; a < 3; a++) {
        const float p = draw_bound(r, (float)box->lo[a], numbers->triangle, a),
                    q = draw_bound(r, (float)box->hi[a], numbers->triangle, a);
        numbers->stream[a][i] = p < q ? p : q;
        numbers->stream[3 + a][i] = p < q ? q : p;
    }
}

pair_list draw_pairs(random_source *r, const scene *s, bool is_soup, drawn_numbers *numbers)
{
    scene_batch batch;
    s->draw(r, &batch);
    numbers->box = batch.box;
    memcpy(numbers->triangle, batch.u[random_int(r, SCENE_TRIANGLES)], sizeof numbers->triangle);
    for (size_t i = 0; i < SCENE_TRIANGLES; i++)
        if (is_soup)
            put_triangle(numbers, i, batch.u[i]);
        else
            put_box(r, numbers, i, &batch.box);
    return drawn_over(numbers, is_soup, SCENE_TRIANGLES);
}

pair_list draw_distinct_lanes(random_source *r, bool is_soup, drawn_numbers *numbers)
{
    static const float through_origin[3][3] = {{-0.75f, -0.5f, 0.25f}, {0.5f, -0.25f, -1}, {0.125f, 0.375f, 0.375f}};
    memcpy(numbers->triangle, through_origin, sizeof numbers->triangle);
    for (size_t i = 0; i < DRAWN_MAX; i += SCENE_TRIANGLES) {
        scene_batch batch;
        if (i / SCENE_TRIANGLES % 2)
            draw_paper(r, &batch);
        else
            draw_eighths(r, &batch);
        numbers->box = batch.box;
        for (size_t k = 0; k < SCENE_TRIANGLES && i + k < DRAWN_MAX; k++) {
            put_triangle(numbers, i + k, batch.u[k]);
            if (is_soup)
                continue;
            for (int a = 0; a < 3; a++) {
                const float size = (float)random_double(r, 0, 0.75);
                numbers->stream[a][i + k] = batch.u[k][0][a] / 2;
                numbers->stream[3 + a][i + k] = batch.u[k][0][a] / 2 + size;
            }
        }
    }
    return drawn_over(numbers, is_soup, DRAWN_MAX);
}
