#include "forms.h"

#include "common/harness.h"
#include "common/pair_f64.h"
#include "common/soup_or_mesh.h"
#include "common/fences.h"

/* For so many triangles at most, and so many boxes at once. */
static form_fences form_fences_make(size_t triangles, size_t boxes)
{
    const size_t words = tribox_mask_words(triangles);
    return (form_fences){
        .mask = guarded_make(words * sizeof(uint64_t)),
        .number = guarded_make(words * sizeof(uint32_t)),
        .bits = guarded_make(words * sizeof(uint64_t)),
        .inside = guarded_make(words * sizeof(uint64_t)),
        .list = guarded_make(triangles * boxes * sizeof(uint32_t)),
        .start = guarded_make((boxes + 1) * sizeof(size_t)),
        .report = guarded_make(sizeof(tribox_report)),
        .found = guarded_make(sizeof(size_t)),
    };
}

form_fences fences;

int index_fixture_make(size_t triangles, size_t boxes)
{
    stored_make(triangles);
    fences = form_fences_make(triangles, boxes);
    return 0;
}

/* What is asked, and the answers of the calls without an index. */
typedef struct question {
    tribox_region region;
    const tribox_options *options;
    const char *name;
    bool is_damaged;
    size_t words;
    uint64_t *least, *most; /* the mask: bits that have to be set, and that may be */
    uint64_t *inside;       /* of tribox_classify; of an oriented box none */
    uint64_t *mask;         /* of tribox_index_overlap, once it is asked */
} question;

static uint64_t *words_of(fenced place) { return (uint64_t *)(void *)place.at; }
static uint32_t *numbers_of(fenced place) { return (uint32_t *)(void *)place.at; }

static void say(const question *q, const char *form)
{
    snprintf(doing, sizeof doing, "%s: %s, %zu triangles, kernel %s, %s, axes %u, order %u", form, q->name, stored.soup.count,
             q->options->kernel, accuracy_name(q->options->accuracy), q->options->axes, q->options->axis_order);
}

static void print_region(const question *q)
{
    const tribox_oriented_box *const turned = q->region.oriented;
    for (int a = 0; a < 3 && !turned; a++)
        print_error("axis %d of the box: %a to %a\n", a, (double)q->region.box->lo[a], (double)q->region.box->hi[a]);
    for (int k = 0; k < 3 && turned; k++)
        print_error("center %a, half %a, axis %a %a %a\n", turned->center[k], turned->half[k], turned->axis[k][0],
                    turned->axis[k][1], turned->axis[k][2]);
}

static void demand_ok(tribox_status status)
{
    if (status)
        fail_msg("%s: %s", doing, tribox_status_text(status));
}

static void demand(const question *q, bool holds, const char *what, size_t number)
{
    if (holds)
        return;
    print_region(q);
    fail_msg("%s: %s %zu", doing, what, number);
}

static tribox_status ask_without(const question *q, const tribox_options *options)
{
    const tribox_index *const index = &stored.index;
    const soup_or_mesh of = {index->soup ? *index->soup : (tribox_soup){.count = 0},
                             index->mesh ? *index->mesh : (tribox_mesh){.count = 0}, index->mesh};
    if (q->region.oriented)
        return CALL(overlap_oriented, &of, q->region.oriented, options, q->least, NULL);
    const tribox_status status = CALL(overlap, &of, q->region.box, options, q->least, NULL);
    return status ? status : CALL(classify, &of, q->region.box, options, NULL, q->inside, NULL);
}

static uint64_t whole_word(size_t w)
{
    const size_t left = stored.soup.count - 64 * w;
    return left < 64 ? ~(~UINT64_C(0) << left) : ~UINT64_C(0);
}

/*
 * Words wholly inside are never tested: at FAST they are set as they are. About an oriented box EXACT alone is known bit for bit,
 * and CONSERVATIVE misses nothing.
 */
static void expect(question *q)
{
    tribox_options options = *q->options;
    say(q, "tribox_overlap");
    if (q->region.oriented)
        options.accuracy = TRIBOX_EXACT;
    if (options.accuracy == TRIBOX_EXACT)
        options.kernel = "scalar";
    demand_ok(ask_without(q, &options));
    memcpy(q->most, q->least, q->words * sizeof *q->most);
    for (size_t w = 0; q->options->accuracy != TRIBOX_EXACT && w < q->words; w++) {
        const uint64_t all = whole_word(w);
        const bool is_fast = q->options->accuracy == TRIBOX_FAST;
        if (q->region.oriented) {
            q->most[w] = all;
            q->least[w] = is_fast ? 0 : q->least[w];
        } else if (is_fast) {
            q->most[w] |= q->inside[w] == all ? all : 0;
            q->least[w] |= ~q->inside[w] ? 0 : ~UINT64_C(0);
        }
    }
}

/* Any mask; and inside what the index says, in which the forms have to agree. */
static void expect_anything(const question *q)
{
    uint32_t *const number = malloc((q->words + 1) * sizeof *number);
    uint64_t *const bits = malloc((2 * q->words + 1) * sizeof *bits);
    size_t found = 0;
    say(q, "tribox_index_words with room for all");
    assert_true(number && bits);
    for (size_t w = 0; w < q->words; w++) {
        q->least[w] = 0;
        q->most[w] = whole_word(w);
    }
    if (q->region.box)
        demand_ok(tribox_index_words(&stored.index, &q->region, q->options, q->words, number, bits, bits + q->words, &found, NULL));
    demand(q, found <= q->words, "words found", found);
    for (size_t k = 0; k < found; k++) {
        demand(q, number[k] < q->words && !(bits[q->words + k] & ~bits[k]), "bits inside that do not overlap at place", k);
        q->inside[number[k]] = bits[q->words + k];
    }
    free(number);
    free(bits);
}

static void fail_at_triangle(const question *q, size_t i, bool bit)
{
    for (int v = 0; i < stored.soup.count && v < 3; v++)
        print_error("vertex %d of triangle %zu: %a %a %a\n", v, i, (double)stored.soup.x[v][i], (double)stored.soup.y[v][i],
                    (double)stored.soup.z[v][i]);
    print_region(q);
    fail_msg("%s: bit %zu is %d", doing, i, bit);
}

static void demand_mask(const question *q, const uint64_t *mask)
{
    for (size_t w = 0; w < q->words; w++) {
        const uint64_t wrong = (q->least[w] & ~mask[w]) | (mask[w] & ~q->most[w]);
        if (wrong)
            fail_at_triangle(q, 64 * w + (size_t)__builtin_ctzll(wrong), mask[w] >> __builtin_ctzll(wrong) & 1);
    }
}

static tribox_report *report_place(fenced *place)
{
    *place = fenced_place(fences.report, sizeof(tribox_report), AT_END);
    return (tribox_report *)(void *)place->at;
}

static void demand_report(const question *q, const tribox_report *report, size_t overlapping)
{
    demand(q, report->overlapping == overlapping, "overlapping, by the report,", report->overlapping);
    demand(q, report->undecided <= (q->options->accuracy == TRIBOX_FAST ? 0 : stored.soup.count), "undecided", report->undecided);
}

static void check_mask(question *q)
{
    const fenced mask = fenced_place(fences.mask, q->words * sizeof(uint64_t), AT_END);
    fenced place;
    tribox_report *const report = report_place(&place);
    say(q, "tribox_index_overlap");
    demand_ok(tribox_index_overlap(&stored.index, &q->region, q->options, words_of(mask), report));
    demand_mask(q, words_of(mask));
    assert_nothing_beside(&mask);
    demand_report(q, report, bits_set(words_of(mask), q->words));
    memcpy(q->mask, words_of(mask), mask.bytes);
}

static void check_count(const question *q)
{
    fenced place;
    tribox_report *const report = report_place(&place);
    say(q, "tribox_index_overlap without a mask");
    demand_ok(tribox_index_overlap(&stored.index, &q->region, q->options, NULL, report));
    demand_report(q, report, bits_set(q->mask, q->words));
}

static size_t less(size_t one, size_t other) { return one < other ? one : other; }

/* In turn, room for nothing, for one, about what is found, about multiples of a word, and for as much as there is. */
static size_t next_room(size_t found, size_t most)
{
    static unsigned turn;
    const size_t rooms[] = {found,     0,         1,          2,          63,   64,    65,    128,  found / 2,
                            found + 1, found - 1, found - 64, found - 65, most, found, found, found};
    const size_t room = rooms[turn++ % (sizeof rooms / sizeof rooms[0])];
    return room <= most ? room : 0;
}

/* What there is room for is written, and the rest counted. */
static void check_words(const question *q, bool has_inside)
{
    size_t expected = 0, k = 0, overlapping = 0;
    const bool is_classified = has_inside && q->options->accuracy == TRIBOX_FAST;
    for (size_t w = 0; w < q->words; w++)
        expected += (q->mask[w] | (is_classified ? q->inside[w] : 0)) != 0;
    const size_t room = next_room(expected, q->words), fits = less(room, expected);
    const fenced number = fenced_place(fences.number, fits * sizeof(uint32_t), AT_END);
    const fenced bits = fenced_place(fences.bits, fits * sizeof(uint64_t), AT_END);
    const fenced inside = fenced_place(fences.inside, (has_inside ? fits : 0) * sizeof(uint64_t), AT_END);
    const fenced found = fenced_place(fences.found, sizeof(size_t), AT_END);
    fenced place;
    tribox_report *const report = report_place(&place);
    say(q, has_inside ? "tribox_index_words with inside" : "tribox_index_words");
    demand_ok(tribox_index_words(&stored.index, &q->region, q->options, room, numbers_of(number), words_of(bits),
                                 has_inside ? words_of(inside) : NULL, (size_t *)(void *)found.at, report));
    demand(q, *(size_t *)(void *)found.at == expected, "words found", *(size_t *)(void *)found.at);
    for (size_t w = 0; w < q->words; w++) {
        const uint64_t all = q->mask[w] | (is_classified ? q->inside[w] : 0);
        overlapping += (size_t)__builtin_popcountll(all);
        if (!all || k >= fits)
            continue;
        demand(q, numbers_of(number)[k] == w, "another word at place", k);
        demand(q, words_of(bits)[k] == all, "other bits at place", k);
        demand(q, !has_inside || words_of(inside)[k] == q->inside[w], "another inside at place", k);
        k++;
    }
    assert_nothing_beside(&number);
    assert_nothing_beside(&bits);
    assert_nothing_beside(&inside);
    demand_report(q, report, overlapping);
}

static void check_list(const question *q, const uint32_t *ids)
{
    const size_t expected = bits_set(q->mask, q->words), room = next_room(expected, stored.soup.count);
    const fenced list = fenced_place(fences.list, less(room, expected) * sizeof(uint32_t), AT_END);
    size_t found = 0, k = 0;
    say(q, ids ? "tribox_index_list with numbers" : "tribox_index_list");
    demand_ok(tribox_index_list(ids ? &stored.with_ids : &stored.index, &q->region, q->options, room, numbers_of(list), &found));
    demand(q, found == expected, "triangles found", found);
    for (size_t i = 0; i < stored.soup.count && k < room; i++)
        if (bit_of(q->mask, i)) {
            demand(q, numbers_of(list)[k] == (ids ? ids[i] : i), "another triangle at place", k);
            k++;
        }
    assert_nothing_beside(&list);
}

/* At FAST it may also be one that lies wholly inside, which the mask has lost. */
static void check_any(const question *q)
{
    size_t triangle = SIZE_MAX, again = SIZE_MAX;
    const bool is_fast = q->options->accuracy == TRIBOX_FAST;
    say(q, "tribox_index_any");
    demand_ok(tribox_index_any(&stored.index, &q->region, q->options, &triangle));
    if (triangle < stored.soup.count)
        demand(q, bit_of(q->mask, triangle) || (is_fast && bit_of(q->inside, triangle)), "not overlapping", triangle);
    else
        demand(q, triangle == stored.soup.count && !bits_set(q->mask, q->words), "none though some overlap,", triangle);
    if (q->options->accuracy == TRIBOX_EXACT && !q->is_damaged) {
        tribox_options other = *q->options;
        other.kernel = "scalar";
        demand_ok(tribox_index_any(&stored.index, &q->region, &other, &again));
        demand(q, triangle == again, "another than the scalar kernel,", triangle);
    }
}

static void ask_all_forms(question *q)
{
    q->words = tribox_mask_words(stored.soup.count);
    uint64_t *const masks = calloc(4 * q->words + 1, sizeof *masks);
    assert_non_null(masks);
    q->least = masks;
    q->most = masks + q->words;
    q->inside = masks + 2 * q->words;
    q->mask = masks + 3 * q->words;
    if (q->is_damaged)
        expect_anything(q);
    else
        expect(q);
    check_mask(q);
    check_count(q);
    check_words(q, false);
    if (q->region.box)
        check_words(q, true);
    check_list(q, NULL);
    check_list(q, stored.ids);
    check_any(q);
    free(masks);
}

void check_forms(const tribox_box *box, const tribox_options *options, const char *name)
{
    ask_all_forms(&(question){.region = {.box = box}, .options = options, .name = name});
}

void check_turned(const tribox_oriented_box *box, const tribox_options *options, const char *name)
{
    ask_all_forms(&(question){.region = {.oriented = box}, .options = options, .name = name});
}

void check_damaged(const tribox_region *region, const tribox_options *options, const char *name)
{
    ask_all_forms(&(question){.region = *region, .options = options, .name = name, .is_damaged = true});
}

void check_lists(const tribox_boxes *boxes, const tribox_options *options, const char *name)
{
    const size_t most = boxes->count * stored.soup.count;
    uint32_t *const expected = malloc((most + 1) * sizeof *expected);
    size_t *const begins = malloc((boxes->count + 1) * sizeof *begins), total = 0;
    tribox_box box = {{0, 0, 0}, {0, 0, 0}};
    const question q = {.region = {.box = &box}, .options = options, .name = name};
    assert_true(expected && begins);
    for (size_t b = 0; b < boxes->count; b++) {
        size_t found = 0;
        for (int a = 0; a < 3; a++) {
            box.lo[a] = boxes->lo[a][b];
            box.hi[a] = boxes->hi[a][b];
        }
        say(&q, "tribox_index_list");
        if (box_is_finite(&box))
            demand_ok(tribox_index_list(&stored.with_ids, &(tribox_region){.box = &box}, options, stored.soup.count,
                                        expected + total, &found));
        begins[b] = total;
        total += found;
    }
    begins[boxes->count] = total;

    static unsigned turn;
    const size_t room = ++turn % 2 ? next_room(total, most) : begins[turn / 2 % (boxes->count + 1)], fits = less(room, total);
    const fenced list = fenced_place(fences.list, fits * sizeof(uint32_t), AT_END);
    const fenced start = fenced_place(fences.start, (boxes->count + 1) * sizeof(size_t), AT_END);
    say(&q, "tribox_index_lists, the last box of which is");
    demand_ok(tribox_index_lists(&stored.with_ids, boxes, options, room, numbers_of(list), (size_t *)(void *)start.at));
    for (size_t b = 0; b <= boxes->count; b++)
        demand(&q, ((size_t *)(void *)start.at)[b] == begins[b], "another start of list", b);
    for (size_t k = 0; k < fits; k++)
        demand(&q, numbers_of(list)[k] == expected[k], "another triangle at place", k);
    assert_nothing_beside(&list);
    assert_nothing_beside(&start);
    free(expected);
    free(begins);
}

tribox_options any_index_options(random_source *r)
{
    return (tribox_options){.accuracy = (tribox_accuracy)random_int(r, 3),
                            .axes = random_int(r, 3) ? 0 : TRIBOX_AXES_BOX | 2u * (unsigned)random_int(r, 4),
                            .axis_order = axis_order_at(random_int(r, AXIS_ORDERS)),
                            .kernel = names[random_int(r, kernels)]};
}
