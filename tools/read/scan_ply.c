/* scan_ply.c - PLY: the lines of its header, then vertices, faces and what else there is, as text or as bytes of either order. */
#include <inttypes.h>
#include <string.h>

#include "console/message.h"
#include "scan.h"

static bool is_text(const scan *s) { return s->ply.format == PLY_ASCII; }

static const ply_element *element_of(const scan *s) { return &s->ply.elements[s->element]; }

static size_t bytes_left(const scan *s) { return (size_t)(s->words.end - s->words.at); }

/* How many values of so many bytes the file may still have. As text, a digit and a blank each; the last may lack its blank. */
static uint64_t values_left(const scan *s, size_t size)
{
    return is_text(s) ? ((uint64_t)bytes_left(s) + 1) / 2 : (uint64_t)bytes_left(s) / size;
}

/* Refuses more of an element than the bytes that are left can hold, if all its lists are empty. */
static int check_count(const scan *s, const ply_element *e)
{
    uint64_t size = 0;
    for (int i = 0; i < e->property_count; i++) {
        const ply_property *const p = &e->properties[i];
        size += is_text(s) ? 2 : ply_type_size(p->count ? p->count : p->type);
    }
    const uint64_t left = (uint64_t)bytes_left(s) + is_text(s);
    if (!e->count || e->count <= left / size)
        return EXIT_CODE_OK;
    return SCAN_REFUSE(
        s, "%s: truncated: the header promises %" PRIu64 " of '%.*s', the file has bytes for %" PRIu64 " at most; write it again",
        s->words.path, e->count, e->name_length, e->name, left / size);
}

static int refuse_end(const scan *s)
{
    const ply_element *const e = element_of(s);
    return SCAN_REFUSE(
        s, "%s: truncated: the header promises %" PRIu64 " of '%.*s', the file ends in number %" PRIu64 "; write it again",
        s->words.path, e->count, e->name_length, e->name, s->number + 1);
}

/* As text, too, a double is a double. */
static int take_number(scan *s, ply_type type, double *number, float_fit *fit)
{
    const size_t size = ply_type_size(type);
    float_fit own = FLOAT_FIT_EXACT;
    if (is_text(s)) {
        if (!words_next(&s->words) || !words_number(&s->words, number, &own))
            return words_is_cut(&s->words) ? refuse_end(s) : words_refuse(&s->words, "a number");
    } else {
        if (bytes_left(s) < size)
            return refuse_end(s);
        *number = ply_number(ply_bits(s->words.at, size, s->ply.format == PLY_BIG_ENDIAN), type);
        s->words.at += size;
    }
    if (!is_text(s) || type == PLY_DOUBLE)
        own = float_fit_of(*number);
    *fit = own > *fit ? own : *fit;
    return EXIT_CODE_OK;
}

/* The number of values in a list; the bytes that are left can hold as many. */
static int take_count(scan *s, const ply_property *list, uint64_t *count)
{
    double number = 0;
    int code = EXIT_CODE_OK;
    if (!is_text(s) && list->count == PLY_UINT8 && bytes_left(s)) /* the usual one */
        number = (unsigned char)*s->words.at++;
    else
        code = take_number(s, list->count, &number, &(float_fit){FLOAT_FIT_EXACT});
    *count = 0;
    if (code)
        return code;
    if (number > (double)values_left(s, ply_type_size(list->type)))
        return refuse_end(s);
    *count = number >= 0 ? (uint64_t)number : 0;
    if ((double)*count == number)
        return EXIT_CODE_OK;
    return SCAN_REFUSE(s, "%s: damaged: number %" PRIu64 " of '%.*s' has a list of %g values", s->words.path, s->number,
                       element_of(s)->name_length, element_of(s)->name, number);
}

static int skip(scan *s, const ply_property *p)
{
    const size_t size = ply_type_size(p->type);
    uint64_t count = 1;
    const int code = p->count ? take_count(s, p, &count) : EXIT_CODE_OK;
    if (code)
        return code;
    if (count > values_left(s, size))
        return refuse_end(s);
    if (!is_text(s))
        s->words.at += count * size;
    for (; is_text(s) && count; count--)
        if (!words_next(&s->words))
            return refuse_end(s);
    return EXIT_CODE_OK;
}

/* The usual one, in a binary list of which all bytes are there. False where it is another, or damaged. */
static bool find_corner(const scan *s, ply_type type, uint64_t *vertex)
{
    if (is_text(s) || (type != PLY_INT32 && type != PLY_UINT32))
        return false;
    *vertex = ply_bits(s->words.at, sizeof(uint32_t), s->ply.format == PLY_BIG_ENDIAN);
    return *vertex < s->all[SCAN_POSITIONS] && (type == PLY_UINT32 || *vertex <= INT32_MAX);
}

static int take_corner(scan *s, ply_type type)
{
    uint64_t vertex;
    if (find_corner(s, type, &vertex)) {
        s->words.at += sizeof(uint32_t);
        return scan_refer(s, (scan_reference){s->words.at - sizeof(uint32_t), sizeof(uint32_t), SCAN_POSITIONS, type, vertex});
    }
    const bool is_strip = element_of(s)->kind == PLY_STRIPS;
    const char *const before = s->words.at;
    double index = 0;
    const int code = take_number(s, type, &index, &(float_fit){FLOAT_FIT_EXACT});
    if (code)
        return code;
    scan_reference corner = {.at = before, .length = ply_type_size(type), .type = type, .number = SCAN_BREAK};
    if (is_text(s))
        corner = (scan_reference){.at = s->words.word, .length = s->words.length, .number = SCAN_BREAK};
    if (index >= 0 && index < (double)s->all[SCAN_POSITIONS] && index == (double)(uint64_t)index)
        corner.number = (uint64_t)index;
    else if (!is_strip || index != -1)
        return SCAN_REFUSE(s, "%s: damaged: %s %" PRIu64 " refers to vertex %.15g, the mesh has %" PRIu64 ", counted from 0",
                           s->words.path, is_strip ? "strip" : "face", s->number, index, s->all[SCAN_POSITIONS]);
    return scan_refer(s, corner);
}

static int take_corners(scan *s, const ply_property *list)
{
    uint64_t count = 0;
    int code = take_count(s, list, &count);
    for (; !code && count; count--)
        code = take_corner(s, list->type);
    return code;
}

static int take_property(scan *s, const ply_property *p)
{
    scan_item *const i = &s->item;
    if (p->role == PLY_CORNERS)
        return take_corners(s, p);
    if (p->role <= PLY_Z)
        return take_number(s, p->type, &i->position[p->role], &s->fit);
    if (p->role == PLY_SKIPPED || !s->has_colours || !element_of(s)->has_colour)
        return skip(s, p);
    if (!i->has_colour) /* the first of them */
        i->most = p->type == PLY_FLOAT || p->type == PLY_DOUBLE ? 1 : p->type == PLY_UINT16 ? UINT16_MAX : UINT8_MAX;
    i->has_colour = true;
    return take_number(s, p->type, &i->colour[p->role - PLY_RED], &(float_fit){FLOAT_FIT_EXACT});
}

/* Of values alone whose sizes are known. */
static size_t bytes_of(const ply_element *e)
{
    size_t bytes = 0;
    for (int i = 0; i < e->property_count; i++) {
        if (e->properties[i].count)
            return 0;
        bytes += ply_type_size(e->properties[i].type);
    }
    return bytes;
}

static int take_record(scan *s)
{
    static const scan_kind kinds[] = {
        [PLY_VERTICES] = SCAN_VERTEX, [PLY_FACES] = SCAN_FACE, [PLY_STRIPS] = SCAN_STRIP, [PLY_OTHER] = SCAN_OTHER};
    const ply_element *const e = element_of(s);
    int code = EXIT_CODE_OK;
    if (!s->number) {
        code = check_count(s, e);
        s->skipped = is_text(s) || s->words.path ? 0 : bytes_of(e);
    }
    s->item.kind = s->is_left_out[s->element] ? SCAN_LEFT_OUT : kinds[e->kind];
    s->item.which = SCAN_POSITIONS;
    s->item.gap = s->item.begin = s->words.at;
    if (is_text(s)) {
        words first = s->words;
        words_next(&first);
        s->item.gap = s->item.begin = first.word;
        s->item.after = s->line_end;
    }
    for (int i = 0; !code && !s->skipped && i < e->property_count; i++)
        code = take_property(s, &e->properties[i]);
    if (s->skipped)
        s->item.run = e->count;
    s->words.at += s->item.run * s->skipped; /* of all of them the file has the bytes */
    s->item.end = s->words.at;
    s->number += s->item.run;
    s->here[SCAN_POSITIONS] += e->kind == PLY_VERTICES ? s->item.run : 0;
    return code;
}

/* The line of an element or a property, from its first word on. Other lines are gaps. */
static int take_line(scan *s)
{
    scan_item *const i = &s->item;
    words *const w = &s->words;
    int code = EXIT_CODE_OK;
    while (words_next(w) && !words_is(w, "element") && !words_is(w, "property") && !words_is(w, "end_header"))
        words_skip_line(w);
    i->begin = w->word;
    i->kind = SCAN_OTHER;
    if (words_is(w, "end_header")) {
        s->is_inside = true;
        s->element = 0;
        w->at = i->end = w->text + s->ply.size;
        return EXIT_CODE_OK;
    }
    const bool is_element = words_is(w, "element");
    s->element += is_element; /* counted from 1, up to here */
    const int number = s->element - 1;
    if (number >= 0 && s->is_left_out[number]) {
        i->kind = SCAN_LEFT_OUT;
    } else if (is_element && s->ply.elements[number].kind <= PLY_FACES) {
        i->kind = SCAN_COUNT;
        words_next_on_line(w);
        words_next_on_line(w);
        const int which = s->ply.elements[number].kind == PLY_FACES ? SCAN_FACES : SCAN_VERTICES;
        code = scan_refer(s, (scan_reference){.at = w->word, .length = w->length, .which = which});
    }
    words_skip_line(w);
    i->end = words_line_next(w);
    return code;
}

int scan_next_ply(scan *s)
{
    if (!s->is_inside)
        return take_line(s);
    while (s->element < s->ply.element_count && s->number == element_of(s)->count) {
        s->element++;
        s->number = 0;
    }
    if (s->element < s->ply.element_count)
        return take_record(s);
    s->item.kind = SCAN_END;
    s->item.gap = s->item.begin = s->item.end = s->words.at;
    return EXIT_CODE_OK;
}

/* Whether a property is the number of a vertex, or a list of such. */
static bool is_reference(const ply_property *p)
{
    static const char *const known[] = {"vertex1", "vertex2", "vertex_index", "vertex_indices"};
    const words name = {.word = p->name, .length = p->name_length};
    bool is_known = false;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        is_known |= words_is(&name, known[i]);
    return is_known;
}

int scan_open_ply(scan *s, const whole_file *file)
{
    int code = ply_header_read(s->words.path, file, &s->ply);
    for (int n = 0; !code && n < s->ply.element_count; n++) {
        const ply_element *const e = &s->ply.elements[n];
        s->is_left_out[n] = false;
        for (int i = 0; e->kind == PLY_OTHER && i < e->property_count; i++)
            s->is_left_out[n] |= is_reference(&e->properties[i]);
        if (e->kind != PLY_VERTICES)
            continue;
        s->all[SCAN_POSITIONS] = e->count;
        s->words.at = s->words.text + s->ply.size;
        code = check_count(s, e);
    }
    if (!code)
        s->line_end = file->bytes[3] != '\r' ? "\n" : file->bytes[4] == '\n' ? "\r\n" : "\r";
    return code;
}

/* A new number is no larger than the old one, so that it fits the same type. */
size_t scan_spell(const scan *s, const scan_reference *r, uint64_t number, char *to)
{
    const float narrow = (float)number;
    const double wide = (double)number;
    uint64_t bits = number;
    uint32_t low;
    memcpy(&low, &narrow, sizeof low);
    if (r->type == PLY_NONE) {
        char digits[SCAN_DIGITS];
        size_t at = SCAN_DIGITS;
        do
            digits[--at] = (char)('0' + number % 10);
        while (number /= 10);
        memcpy(to, digits + at, SCAN_DIGITS - at);
        return SCAN_DIGITS - at;
    }
    if (r->type == PLY_FLOAT)
        bits = low;
    else if (r->type == PLY_DOUBLE)
        memcpy(&bits, &wide, sizeof bits);
    for (size_t i = 0; i < r->length; i++)
        to[s->ply.format == PLY_BIG_ENDIAN ? r->length - 1 - i : i] = (char)(bits >> 8 * i);
    return r->length;
}
