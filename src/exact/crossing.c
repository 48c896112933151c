/* crossing.c - a point, an edge and a plane, by exact signs: in double first, and in a sum as long as it takes. */
#include "crossing.h"

#include "terms.h"

static int sign_of_difference(double from, double less) { return (from > less) - (from < less); }

static bool are_tame(const double number[], int count)
{
    bool are = true;
    for (int k = 0; k < count; k++)
        are &= is_tame_number(number[k]);
    return are;
}

int tribox_exact_side(const double a[2], const double b[2], const double point[2])
{
    exact_term term[2];
    set_difference(term[0].difference[0], b[0], a[0]);
    set_difference(term[0].difference[1], point[1], a[1]);
    set_difference(term[1].difference[0], a[1], b[1]);
    set_difference(term[1].difference[1], point[0], a[0]);
    const int sign = sign_of_sum(term, 2, 2, are_tame(a, 2) && are_tame(b, 2) && are_tame(point, 2));
    if (sign)
        return sign;
    const int by_y = sign_of_difference(a[1], b[1]);
    return by_y ? by_y : sign_of_difference(b[0], a[0]);
}

/* n_i as two terms, with f_j the edges from u_0: f_1a f_2b - f_1b f_2a. */
static void set_crossing_normal(exact_term term[2], double u[3][3], int i)
{
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    set_difference(term[0].difference[0], u[1][a], u[0][a]);
    set_difference(term[0].difference[1], u[2][b], u[0][b]);
    set_difference(term[1].difference[0], u[0][b], u[1][b]);
    set_difference(term[1].difference[1], u[2][a], u[0][a]);
}

int tribox_exact_height(double u[3][3], const double point[3])
{
    exact_term term[TERMS_MAX];
    const bool is_tame = are_tame(u[0], 3) && are_tame(u[1], 3) && are_tame(u[2], 3) && are_tame(point, 3);
    for (int i = 0; i < 3; i++) {
        set_crossing_normal(&term[2 * i], u, i);
        for (int k = 0; k < 2; k++)
            set_difference(term[2 * i + k].difference[2], point[i], u[0][i]);
    }
    int sign = sign_of_sum(term, TERMS_MAX, 3, is_tame);
    for (int i = 1; !sign && i <= 3; i++)
        sign = sign_of_sum(&term[2 * (i % 3)], 2, 2, is_tame);
    return sign;
}
