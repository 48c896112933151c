/* json.h - writes JSON to a stream; commas, brackets and quotes are written here and nowhere else. */
#ifndef JSON_H
#define JSON_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum { JSON_DEPTH_MAX = 15 }; /* objects and arrays inside each other */

typedef struct json {
    FILE *to;
    int depth;
    struct {
        char end;       /* '}' or ']' */
        bool is_filled; /* something stands in it, so that a comma is due */
        bool is_rows;   /* each of its values starts a line */
    } level[JSON_DEPTH_MAX + 1];
} json;

/*
 * A writer at the start of a value. In what follows `key` names a member of an object; it is NULL in an array and for the value
 * itself. ferror(to) says in the end whether all of it was written.
 */
json json_to(FILE *to);

void json_open_object(json *j, const char *key);
void json_open_array(json *j, const char *key);

/* The same, with each value on a line of its own. */
void json_open_rows(json *j, const char *key);

/* Ends the object or array that was opened last; after the outermost comes a line feed, and another value may follow. */
void json_close(json *j);

/*
 * A string; NULL becomes null. JSON is UTF-8, paths are bytes: a byte that is not part of a UTF-8 character becomes the lone
 * surrogate \udc80 to \udcff, its value plus 0xdc00. So reads Python: json.loads(text).encode("utf-8", "surrogateescape").
 */
void json_string(json *j, const char *key, const char *value);

void json_bool(json *j, const char *key, bool value);
void json_whole(json *j, const char *key, uint64_t value);

/* A number to `digits` significant digits. NaN and infinity, which JSON does not have, become null. */
void json_number(json *j, const char *key, int digits, double value);

/* Arrays of numbers. Those of doubles read back as the same doubles or, if is_float, the same floats, which they then are. */
void json_doubles(json *j, const char *key, const double *values, size_t count, bool is_float);
void json_wholes(json *j, const char *key, const size_t *values, size_t count);

#endif
