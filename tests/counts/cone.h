/*
 * cone.h - the edges of the cones in which the limits of a triangle are linear, on one axis of a grid. After: claims.h.
 *
 * In cells, counted from the first cell of the triangle's range: its vertices, a cell, how many cells there are, and the length of
 * one, as constants are lengths. The range is where the triangle is: its least vertex is at most `beside` cells above the last
 * plane, and its greatest as far below the first (PROOFS.md 7.2).
 */
enum { CONE_DIMENSIONS = 6, CONE_SIDES = 9, CONE_EDGES = 64 };
typedef struct cone_edge {
    double g[3], cell, cells, one;
} cone_edge;
typedef struct cone_edges {
    int count;
    cone_edge of[CONE_EDGES];
} cone_edges;

/* Whether the rows, all but one as many as there are dimensions, leave one line; then that. */
static inline bool line_of(double row[CONE_DIMENSIONS - 1][CONE_DIMENSIONS], double line[CONE_DIMENSIONS])
{
    int pivot[CONE_DIMENSIONS - 1], rows = 0, free_column = -1;
    for (int c = 0; c < CONE_DIMENSIONS; c++) {
        int best = rows;
        for (int r = rows; r < CONE_DIMENSIONS - 1; r++)
            best = fabs(row[r][c]) > fabs(row[best][c]) ? r : best;
        if (rows == CONE_DIMENSIONS - 1 || !(fabs(row[best][c]) > 1e-9)) {
            if (free_column >= 0)
                return false;
            free_column = c;
            continue;
        }
        for (int k = 0; k < CONE_DIMENSIONS; k++) {
            const double exchanged = row[best][k];
            row[best][k] = row[rows][k];
            row[rows][k] = exchanged;
        }
        for (int r = 0; r < CONE_DIMENSIONS - 1; r++) {
            const double times = r == rows ? 0 : row[r][c] / row[rows][c];
            for (int k = 0; k < CONE_DIMENSIONS; k++)
                row[r][k] -= times * row[rows][k];
        }
        pivot[rows++] = c;
    }
    memset(line, 0, CONE_DIMENSIONS * sizeof *line);
    line[free_column] = 1;
    for (int r = 0; r < rows; r++)
        line[pivot[r]] = -row[r][free_column] / row[r][pivot[r]];
    return true;
}

static inline void add_edge(cone_edges *to, const double line[CONE_DIMENSIONS], double sign)
{
    cone_edge e;
    double number[CONE_DIMENSIONS], most = 0;
    for (int k = 0; k < CONE_DIMENSIONS; k++)
        most = most_of(most, fabs(line[k]));
    for (int k = 0; k < CONE_DIMENSIONS; k++)
        number[k] = fabs(line[k]) > 1e-12 ? sign * line[k] / most : 0;
    memcpy(e.g, number, sizeof e.g);
    e.cell = number[3];
    e.cells = number[4];
    e.one = number[5];
    for (int k = 0; k < to->count; k++) {
        double apart = fabs(e.cell - to->of[k].cell) + fabs(e.cells - to->of[k].cells) + fabs(e.one - to->of[k].one);
        for (int j = 0; j < 3; j++)
            apart += fabs(e.g[j] - to->of[k].g[j]);
        if (apart < 1e-9)
            return;
    }
    COUNT_MUST(to->count < CONE_EDGES);
    to->of[to->count++] = e;
}

/* Where all but one of its sides meet in a line that no other side excludes. */
static inline void add_edges_of(cone_edges *to, double side[CONE_SIDES][CONE_DIMENSIONS], int sides)
{
    for (unsigned chosen = 0; chosen < 1u << sides; chosen++) {
        double row[CONE_DIMENSIONS - 1][CONE_DIMENSIONS], line[CONE_DIMENSIONS];
        int rows = 0;
        for (int k = 0; k < sides && rows < CONE_DIMENSIONS; k++)
            if (chosen >> k & 1) {
                if (rows < CONE_DIMENSIONS - 1)
                    memcpy(row[rows], side[k], sizeof row[0]);
                rows++;
            }
        if (rows != CONE_DIMENSIONS - 1 || __builtin_popcount(chosen) != rows || !line_of(row, line))
            continue;
        bool is_above = true, is_below = true;
        for (int k = 0; k < sides; k++) {
            double at = 0;
            for (int d = 0; d < CONE_DIMENSIONS; d++)
                at += side[k][d] * line[d];
            is_above &= at > -1e-9;
            is_below &= at < 1e-9;
        }
        if (is_above || is_below)
            add_edge(to, line, is_above ? 1 : -1);
    }
}

/* Vertices from the least to the greatest, and which of its neighbours the one between is nearer to. */
static inline void add_cone(cone_edges *to, const int order[3], double nearer, double beside, void (*check)(const cone_edges *))
{
    enum { CELL = 3, CELLS, ONE };
    double side[CONE_SIDES][CONE_DIMENSIONS] = {{0}};
    side[0][order[1]] = 1, side[0][order[0]] = -1;
    side[1][order[2]] = 1, side[1][order[1]] = -1;
    side[2][order[0]] = nearer, side[2][order[2]] = nearer, side[2][order[1]] = -2 * nearer;
    side[3][CELLS] = 1, side[3][ONE] = beside, side[3][order[0]] = -1;
    side[4][order[2]] = 1, side[4][ONE] = beside;
    side[5][CELL] = 1;
    side[6][CELLS] = 1, side[6][ONE] = -1, side[6][CELL] = -1;
    side[7][ONE] = 1;
    cone_edges cone = {.count = 0};
    add_edges_of(&cone, side, 8);
    check(&cone);
    add_edges_of(to, side, 8);
}

/* `check` is asked of each cone. */
static inline void find_edges_of_cones(cone_edges *to, double beside, void (*check)(const cone_edges *))
{
    static const int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    to->count = 0;
    for (int k = 0; k < 6; k++) {
        add_cone(to, orders[k], 1, beside, check);
        add_cone(to, orders[k], -1, beside, check);
    }
}
