#include "cell_oracle.h"

#include <math.h>
#include <string.h>

/*
 * Rounding in double stays below 2^-48 of the sum of the products' magnitudes. Where a number is beyond `large`, or that sum is
 * below `small`, products may overflow, or what underflows may count: cubes of floats do neither.
 */
static const double doubt = 0x1p-42, large = 0x1p300, small = 0x1p-600;

static void set_edge_axis(cell_oracle *t, int number, int i, const double f[3])
{
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    t->axis[number][a] = -f[b];
    t->axis[number][b] = f[a];
}

static void set_plane_axis(cell_oracle *t, double f[3][3])
{
    for (int i = 0; i < 3; i++) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        t->axis[ORACLE_PLANE][i] = f[0][a] * f[1][b] - f[0][b] * f[1][a];
        t->slack[ORACLE_PLANE][i] = fabs(f[0][a] * f[1][b]) + fabs(f[0][b] * f[1][a]);
    }
}

static void set_axes(cell_oracle *t)
{
    double f[3][3];
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            f[j][a] = t->u[(j + 1) % 3][a] - t->u[j][a];
    for (int i = 0; i < 3; i++) {
        t->axis[i][i] = 1;
        for (int j = 0; j < 3; j++)
            set_edge_axis(t, ORACLE_EDGES + 3 * i + j, i, f[j]);
    }
    for (int k = 0; k < ORACLE_AXES; k++)
        for (int a = 0; a < 3; a++)
            t->slack[k][a] = fabs(t->axis[k][a]);
    set_plane_axis(t, f);
}

cell_oracle cell_oracle_make(const double u[3][3])
{
    cell_oracle t;
    memset(&t, 0, sizeof t);
    memcpy(t.u, u, sizeof t.u);
    set_axes(&t);
    for (int k = 0; k < ORACLE_AXES; k++)
        for (int j = 0; j < 3; j++) {
            double at = 0, weight = 0;
            for (int a = 0; a < 3; a++) {
                at += t.axis[k][a] * u[j][a];
                weight += t.slack[k][a] * fabs(u[j][a]);
            }
            t.least[k] = j == 0 || at < t.least[k] ? at : t.least[k];
            t.most[k] = j == 0 || at > t.most[k] ? at : t.most[k];
            t.weight[k] = fmax(t.weight[k], weight);
        }
    return t;
}

static bool is_moderate(const cell_oracle *t, const tribox_box *box)
{
    bool is = true;
    for (int a = 0; a < 3; a++)
        is = is && fmax(fabs(box->lo[a]), fabs(box->hi[a])) < large && fmax(fabs(t->least[a]), fabs(t->most[a])) < large;
    return is;
}

static pair_f64 pair_of(const cell_oracle *t, const tribox_box *box)
{
    pair_f64 pair = {.box = *box};
    memcpy(pair.u, t->u, sizeof pair.u);
    return pair;
}

/* Below zero: the intervals on axis k overlap; above: they are apart. Zero where rounding leaves that open. */
static double gap_on_axis(const cell_oracle *t, const tribox_box *box, int k)
{
    double least = 0, most = 0, weight = t->weight[k];
    for (int a = 0; a < 3; a++) {
        const double lo = t->axis[k][a] * box->lo[a], hi = t->axis[k][a] * box->hi[a];
        least += lo < hi ? lo : hi;
        most += lo < hi ? hi : lo;
        weight += t->slack[k][a] * (fabs(box->lo[a]) + fabs(box->hi[a]));
    }
    const double below = least - t->most[k], above = t->least[k] - most, gap = below > above ? below : above;
    return fabs(gap) > doubt * weight && weight > small && is_moderate(t, box) ? gap : 0;
}

static unsigned group_of(int k)
{
    return k < ORACLE_PLANE ? TRIBOX_AXES_BOX : k < ORACLE_EDGES ? TRIBOX_AXES_PLANE : TRIBOX_AXES_EDGES;
}

bool cell_oracle_overlaps(const cell_oracle *t, const tribox_box *box, unsigned groups)
{
    bool is_open = false;
    for (int k = 0; k < ORACLE_AXES; k++) {
        if (!(groups & group_of(k)))
            continue;
        const double gap = gap_on_axis(t, box, k);
        if (gap > 0)
            return false;
        is_open = is_open || gap == 0;
    }
    if (!is_open)
        return true;
    const pair_f64 pair = pair_of(t, box);
    return oracle_overlaps(oracle_separating(&pair), groups);
}

static double tolerance_on_axis(const cell_oracle *t, int k, const double band[3])
{
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        const double extent_a = t->most[a] - t->least[a], extent_b = t->most[b] - t->least[b];
        if (k == ORACLE_PLANE)
            sum += extent_a * extent_b * band[i];
        else if (k >= ORACLE_EDGES && (k - ORACLE_EDGES) / 3 == i)
            sum = extent_a * band[b] + extent_b * band[a];
    }
    return sum;
}

bool cell_oracle_errs_within(const cell_oracle *t, const tribox_box *box, unsigned groups, const double band[3], bool answer)
{
    for (int k = 0; k < ORACLE_AXES; k++) {
        if (!(groups & group_of(k)))
            continue;
        const double gap = gap_on_axis(t, box, k), tolerance = tolerance_on_axis(t, k, band);
        const double *const axis = t->axis[k];
        if (answer && gap > tolerance)
            return false;
        if (!answer && k >= ORACLE_PLANE && (axis[0] != 0 || axis[1] != 0 || axis[2] != 0) && gap >= -tolerance)
            return true;
    }
    return answer;
}

void cell_oracle_explain(FILE *out, const cell_oracle *t, const tribox_box *box)
{
    const pair_f64 pair = pair_of(t, box);
    oracle_explain(out, &pair);
}
