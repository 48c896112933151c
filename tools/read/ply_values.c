/* ply_values.c - takes values of every type of PLY from text or from bytes of either order. */
#include "ply_values.h"

#include <inttypes.h>
#include <string.h>

#include "console/message.h"

ply_values ply_values_of(const char *path, const whole_file *file, const ply_header *header)
{
    ply_values v = {.path = path, .format = header->format, .words = words_of(path, file, ' ')};
    v.words.at += header->size;
    v.at = (const unsigned char *)file->bytes + header->size;
    v.end = (const unsigned char *)file->bytes + file->size;
    return v;
}

/* How many values of a type the bytes that are left can hold. As text, a digit and a blank each; the last may lack its blank. */
static uint64_t values_left(const ply_values *v, ply_type type)
{
    return v->format == PLY_ASCII ? (uint64_t)(v->words.end - v->words.at + 1) / 2
                                  : (uint64_t)(v->end - v->at) / ply_type_size(type);
}

/* The bytes of an element whose lists are empty. */
static uint64_t least_size(const ply_values *v, const ply_element *e)
{
    uint64_t size = 0;
    for (int i = 0; i < e->property_count; i++) {
        const ply_property *p = &e->properties[i];
        size += v->format == PLY_ASCII ? 2 : ply_type_size(p->count ? p->count : p->type);
    }
    return size;
}

int ply_values_begin(ply_values *v, const ply_element *e)
{
    v->element = e;
    v->number = 0;
    const uint64_t left = v->format == PLY_ASCII ? (uint64_t)(v->words.end - v->words.at) + 1 : (uint64_t)(v->end - v->at);
    if (!e->count || e->count <= left / least_size(v, e))
        return EXIT_CODE_OK;
    return message_failure("%s: truncated: the header promises %" PRIu64 " of '%.*s', the file has bytes for %" PRIu64
                           " at most; write it again",
                           v->path, e->count, e->name_length, e->name, left / least_size(v, e));
}

static int refuse_end(const ply_values *v)
{
    return message_failure("%s: truncated: the header promises %" PRIu64 " of '%.*s', the file ends in number %" PRIu64
                           "; write it again",
                           v->path, v->element->count, v->element->name_length, v->element->name, v->number + 1);
}

static int refuse_word(const ply_values *v)
{
    return words_is_cut(&v->words) ? refuse_end(v) : words_refuse(&v->words, "a number");
}

static uint64_t take_bits(ply_values *v, size_t size)
{
    uint64_t bits = 0;
    for (size_t i = 0; i < size; i++)
        bits = bits << 8 | v->at[v->format == PLY_BIG_ENDIAN ? i : size - 1 - i];
    v->at += size;
    return bits;
}

static float float_of(uint64_t bits)
{
    const uint32_t low = (uint32_t)bits;
    float number;
    memcpy(&number, &low, sizeof number);
    return number;
}

static double number_of(uint64_t bits, ply_type type)
{
    double number;
    switch (type) {
    case PLY_INT8:
        return (int8_t)bits;
    case PLY_INT16:
        return (int16_t)bits;
    case PLY_INT32:
        return (int32_t)bits;
    case PLY_FLOAT:
        return (double)float_of(bits);
    case PLY_DOUBLE:
        memcpy(&number, &bits, sizeof number);
        return number;
    default:
        return (double)bits;
    }
}

int ply_values_take(ply_values *v, ply_type type, double *number)
{
    if (v->format == PLY_ASCII)
        return words_next(&v->words) && words_number(&v->words, number, &(float_fit){FLOAT_FIT_EXACT}) ? EXIT_CODE_OK
                                                                                                       : refuse_word(v);
    if (!values_left(v, type))
        return refuse_end(v);
    *number = number_of(take_bits(v, ply_type_size(type)), type);
    return EXIT_CODE_OK;
}

/* As text, too, a double is a double. */
int ply_values_take_coordinate(ply_values *v, ply_type type, double *number, float_fit *fit)
{
    float_fit own = FLOAT_FIT_EXACT;
    const bool is_text = v->format == PLY_ASCII;
    if (is_text && (!words_next(&v->words) || !words_number(&v->words, number, &own)))
        return refuse_word(v);
    const int code = is_text ? EXIT_CODE_OK : ply_values_take(v, type, number);
    if (code)
        return code;
    if (!is_text || type == PLY_DOUBLE)
        own = float_fit_of(*number);
    *fit = own > *fit ? own : *fit;
    return EXIT_CODE_OK;
}

int ply_values_take_float(ply_values *v, float *number)
{
    if (!values_left(v, PLY_FLOAT))
        return refuse_end(v);
    *number = float_of(take_bits(v, sizeof *number));
    return EXIT_CODE_OK;
}

int ply_values_take_count(ply_values *v, const ply_property *list, uint64_t *count)
{
    double number = 0;
    const int code = ply_values_take(v, list->count, &number);
    *count = 0;
    if (code)
        return code;
    if (number > (double)values_left(v, list->type))
        return refuse_end(v);
    *count = number >= 0 ? (uint64_t)number : 0;
    if ((double)*count == number)
        return EXIT_CODE_OK;
    return message_failure("%s: damaged: number %" PRIu64 " of '%.*s' has a list of %g values", v->path, v->number,
                           v->element->name_length, v->element->name, number);
}

int ply_values_skip(ply_values *v, const ply_property *p)
{
    uint64_t count = 1;
    const int code = p->count ? ply_values_take_count(v, p, &count) : EXIT_CODE_OK;
    if (code)
        return code;
    if (count > values_left(v, p->type))
        return refuse_end(v);
    if (v->format != PLY_ASCII) {
        v->at += count * ply_type_size(p->type);
        return EXIT_CODE_OK;
    }
    while (count--)
        if (!words_next(&v->words))
            return refuse_end(v);
    return EXIT_CODE_OK;
}
