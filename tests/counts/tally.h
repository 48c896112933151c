/* tally.h - the most that is counted over many points. After: vec_count.h, claims.h. */

/* The largest of what is counted at each point, in units of u times a size. */
typedef struct tally {
    double first;               /* to first order */
    double of_bound;            /* all of it, with what rounding does to the bound, over the bound as the text computes it */
    double taken;               /* the least that bound is, 0 where there is none */
    double of[COUNT_ROUNDINGS]; /* where `first` is the largest: how much of it each rounding is */
    count_place at[COUNT_ROUNDINGS];
    int roundings;
} tally;

static inline void tally_first(tally *to, const counted *error, double size)
{
    const double first = count_first(error) / size;
    if (!(first > to->first))
        return;
    to->first = first;
    to->roundings = error->width;
    for (int k = 0; k < error->width; k++) {
        to->of[k] = fabs(error->c[k]) / size;
        to->at[k] = count_rounding[k];
    }
}

/*
 * `orders`: 1 where signs are said of the computed numbers; 16 where the size of an exact one is meant whose sign rounding may
 * turn, as a term of that many roundings then counts so often (PROOFS.md 3.8).
 */
static inline void tally_bound(tally *to, const counted *error, const counted *bound, int orders)
{
    COUNT_MUST(error->order <= 16);
    const double all = count_error(error) + (orders - 1) * V_UNIT * V_UNIT * error->rest * COUNT_ROOM;
    if (all + count_error(bound) > 0)
        to->of_bound = most_of(to->of_bound, (all + count_error(bound)) / bound->x);
}

/* Where the size is 0, so is the error, and what rounding does to the bound is no more than the bound. */
static inline void tally_both(tally *to, const counted *error, double size, const counted *bound, int orders)
{
    if (size > 0) {
        tally_first(to, error, size);
        tally_bound(to, error, bound, orders);
        to->taken = to->taken > 0 ? fmin(to->taken, bound->x / (V_UNIT * size)) : bound->x / (V_UNIT * size);
    } else {
        COUNT_MUST(!(count_error(error) > 0) && !(count_error(bound) > bound->x));
    }
}

static inline void claims_explain_tally(const tally *of)
{
    for (int k = 0; k < of->roundings; k++)
        if (of->of[k] > 0)
            printf("    %8.4f  %s:%d\n", of->of[k], of->at[k].file, of->at[k].line);
}

static inline void claim_tally(const char *name, const tally *of)
{
    claim(&(count_claim){name, of->first, of->of_bound, of->taken});
    if (claims_explain)
        claims_explain_tally(of);
}
