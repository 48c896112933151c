/*
 * scan.h - what a mesh file has, one item after another, in every spelling of PLY, OFF, OBJ and STL as text: for the reader, for
 * crop, and for colours.
 */
#ifndef SCAN_H
#define SCAN_H

#include "little.h"
#include "mesh.h"

/* The words of a text, one after another, and the numbers that they spell; independent of the locale. */
typedef struct words {
    const char *path; /* for messages; NULL to say nothing */
    const char *text, *end;
    const char *at;   /* what follows the last word */
    const char *word; /* the last word, `length` bytes; none at the end of the text */
    size_t length;
    char comment;      /* starts a comment that ends with its line; ' ': there are no comments */
    bool is_continued; /* a backslash at the end of a line joins it with the next */
} words;

words words_of(const char *path, const whole_file *file, char comment);

/* Moves to the next word of the text, or of this line. Returns false, and stays there, where there is none. */
bool words_next(words *w);
bool words_next_on_line(words *w);
void words_skip_line(words *w);

/*
 * Where the line of the last word begins, unless that is before `from`; where the line after the one that was skipped does; and
 * what follows the last word on its line, without the blanks around it: a name, which may have blanks within.
 */
const char *words_line_begin(const words *w, const char *from);
const char *words_line_next(const words *w);
const char *words_rest(words w, size_t *length);

/* Whether the last word is this one; upper case and lower case are the same. */
bool words_is(const words *w, const char *expected);

/* Reads a whole number; negative ones, and those beyond 64 bits, become UINT64_MAX. Returns false where the word is not one. */
bool words_whole(const words *w, uint64_t *number);

/* Reads the double nearest to a number. fit: raised to how well float holds that, if it holds it worse. */
bool words_number(const words *w, double *number, float_fit *fit);

/* Says that the text ends too soon, or has another word, where `due` should be. Returns EXIT_CODE_FAILURE. */
int words_refuse(const words *w, const char *due);

/* Whether the text ends with the last word, which may then be part of a longer one. */
bool words_is_cut(const words *w);

/* For messages: the line of the last word, counted from 1, and how much to show of it, with %.*s. */
uint64_t words_line(const words *w);
int words_shown(const words *w);

/* By the first word of a text, which may be none: what a file says of itself counts for more than its name. */
mesh_kind mesh_kind_by(const char *path, const words *first);

/* The header of a PLY file: which elements follow it, and which values each of them has. */
enum { PLY_ELEMENTS_MAX = 32, PLY_PROPERTIES_MAX = 1024 };

typedef enum ply_format { PLY_ASCII, PLY_LITTLE_ENDIAN, PLY_BIG_ENDIAN } ply_format;

typedef enum ply_type {
    PLY_NONE,
    PLY_INT8,
    PLY_UINT8,
    PLY_INT16,
    PLY_UINT16,
    PLY_INT32,
    PLY_UINT32,
    PLY_FLOAT,
    PLY_DOUBLE
} ply_type;

/* What a value is for. PLY_CORNERS: the list of a face's vertices. Colours, of vertices and faces: the first of each name. */
typedef enum ply_role { PLY_X, PLY_Y, PLY_Z, PLY_CORNERS, PLY_RED, PLY_GREEN, PLY_BLUE, PLY_SKIPPED } ply_role;

typedef struct ply_property {
    ply_type count; /* of the number of values in a list; PLY_NONE: a single value */
    ply_type type;
    ply_role role;
    const char *name; /* not terminated: name_length bytes of the file */
    size_t name_length;
} ply_property;

typedef enum ply_kind { PLY_VERTICES, PLY_FACES, PLY_STRIPS, PLY_OTHER } ply_kind;

typedef struct ply_element {
    const char *name; /* not terminated: name_length bytes of the file */
    int name_length;
    ply_kind kind;
    uint64_t count;
    const ply_property *properties;
    int property_count;
    bool has_colour; /* all three */
} ply_element;

typedef struct ply_header {
    ply_format format;
    ply_element elements[PLY_ELEMENTS_MAX];
    int element_count;
    ply_property properties[PLY_PROPERTIES_MAX];
    int property_count;
    size_t size; /* bytes up to the first value */
} ply_header;

/* Reads and checks the header. path: NULL to say nothing of what is wrong. The file has to outlive it. Returns an exit_code. */
int ply_header_read(const char *path, const whole_file *file, ply_header *header);

size_t ply_type_size(ply_type type);

/* The bits of a value of a binary file, and what they stand for. */
static inline uint64_t ply_bits(const void *from, size_t size, bool is_big)
{
    const unsigned char *const bytes = from;
    uint64_t bits = 0;
    if (size == sizeof(uint32_t) && !is_big) /* the usual one */
        return little_get32(bytes);
    for (size_t i = 0; i < size; i++)
        bits = bits << 8 | bytes[is_big ? i : size - 1 - i];
    return bits;
}

double ply_number(uint64_t bits, ply_type type);

/* Where vertices and faces lie in a binary file: vertices of one size, faces of one list among values of one size. */
typedef struct ply_layout {
    bool is_big;
    uint64_t vertices, vertices_at, faces, faces_at;
    size_t vertex, axes[3];         /* bytes of a vertex, and where in it its coordinates are */
    size_t before, after;           /* bytes of a face before its list and after it */
    ply_type number, count, corner; /* of a coordinate, of the list's length, of a corner */
    size_t number_bytes, count_bytes, corner_bytes;
} ply_layout;

/* False where the first two elements are others, or of none, or a file of `size` bytes ends before them if all lists are empty. */
bool ply_layout_of(const ply_header *header, uint64_t size, ply_layout *layout);

typedef enum scan_kind {
    SCAN_VERTEX,   /* of the numbers that `which` says */
    SCAN_FACE,     /* each position that it refers to is a vertex */
    SCAN_STRIP,    /* each corner makes a triangle with the two before it; SCAN_BREAK ends a strip and begins another */
    SCAN_FACET,    /* of STL: three positions of its own */
    SCAN_LINE,     /* or points: no area */
    SCAN_STATE,    /* of the faces after it, a group or a material; `which` says what of them */
    SCAN_COUNT,    /* has the number of vertices or of faces */
    SCAN_LEFT_OUT, /* refers to vertices in ways of its own */
    SCAN_OTHER,
    SCAN_END
} scan_kind;

/* What has numbers of its own, in the order in which a corner of OBJ names them, 5/3/1; and counts, as references are to these. */
enum { SCAN_POSITIONS, SCAN_TEXTURE, SCAN_NORMALS, SCAN_NUMBERED, SCAN_VERTICES = SCAN_NUMBERED, SCAN_FACES, SCAN_EDGES };

enum { SCAN_STATES = 12 };

#define SCAN_BREAK UINT64_MAX

/* A number in an item: where it stands, and what it refers to, counted from 0. */
typedef struct scan_reference {
    const char *at;
    size_t length;
    int which;
    ply_type type; /* of bytes; PLY_NONE: digits */
    uint64_t number;
} scan_reference;

typedef struct scan_item {
    scan_kind kind;
    int which;
    const char *gap;         /* empty lines and comments from here up to the item */
    const char *begin, *end; /* the item, with the end of its line, if it has one that stays */
    uint64_t run;            /* so many of one size, which are not looked at; else 1 */
    const char *after;       /* a line end, of PLY as text, whose items may lack it; else "" */
    words words;             /* of a line of OBJ, at the first */
    double position[9];      /* of a vertex the first three */
    double colour[3];        /* from 0 to `most` */
    double most;
    bool has_colour;
    size_t corners;             /* of a face */
    scan_reference *references; /* in the order in which they stand there */
    size_t count, room;         /* of these */
} scan_item;

typedef struct scan {
    mesh_kind kind;
    words words;
    bool has_colours;                                 /* they are asked for */
    uint64_t all[SCAN_NUMBERED], here[SCAN_NUMBERED]; /* vertices, textures and normals: in the file, and before the next item */
    uint64_t faces;                                   /* of OFF, in the file */
    float_fit fit;                                    /* the worst of the coordinates so far */
    scan_item item;
    const char *from;                        /* what follows the last item */
    bool is_inside;                          /* of STL: a solid; of OFF and PLY: after the header */
    bool has_coloured_vertices, has_normals; /* of OFF: COFF, NOFF */
    ply_header ply;
    int element;                        /* of PLY, which is next */
    uint64_t number;                    /* of these, counted from 0 */
    const char *line_end;               /* of PLY, as its header has it */
    size_t skipped;                     /* of PLY: the bytes of each item of this element, whose run is one; else 0 */
    bool is_left_out[PLY_ELEMENTS_MAX]; /* of PLY: it refers to vertices, and is no face */
} scan;

/*
 * Begins with a file. path: for messages; NULL to say nothing of what is wrong, of a file that was sound when it was read before,
 * and to look at no positions of binary ones.
 * Returns an exit_code; scan_close follows in any case.
 */
int scan_open(const char *path, mesh_kind kind, const whole_file *file, scan *s);
void scan_close(scan *s);

/* Begins with the first item again. */
void scan_again(scan *s);

/* Finds the next item, SCAN_END after the last. Returns an exit_code. */
int scan_next(scan *s);

/* Writes the number that a reference is replaced by, as it is written there. Returns how many characters, at most SCAN_DIGITS. */
enum { SCAN_DIGITS = 20 };
size_t scan_spell(const scan *s, const scan_reference *reference, uint64_t number, char *to);

/*
 * Reads a file into an empty mesh, or says what is wrong and where. What it promises is not believed: memory is in proportion to
 * its size. Returns an exit_code; indexed_mesh_free follows in any case.
 */
int scan_read(const char *path, mesh_kind kind, const whole_file *file, indexed_mesh *m);

/* For the formats: one more reference of the item. Returns an exit_code. */
int scan_refer(scan *s, scan_reference reference);

/* The reason of a failure, unless nothing is to be said. */
#define SCAN_REFUSE(s, ...) ((s)->words.path ? message_failure(__VA_ARGS__) : EXIT_CODE_FAILURE)

/* The formats: what comes first, and what is next. */
#define SCAN_FORMAT(kind, name, ...) \
    int scan_open_##name(scan *s, const whole_file *file); \
    int scan_next_##name(scan *s);
MESH_KINDS(SCAN_FORMAT)

#endif
