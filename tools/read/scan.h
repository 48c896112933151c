/*
 * scan.h - what a mesh file has, one item after another, in every spelling of PLY, OFF, OBJ and STL as text: for the reader, for
 * crop, and for colours.
 */
#ifndef SCAN_H
#define SCAN_H

#include "indexed_mesh.h"
#include "mesh_kind.h"
#include "ply_header.h"
#include "words.h"

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
    size_t skipped;                     /* of PLY: the bytes of each item of this element, which is not looked at; else 0 */
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
int scan_open_ply(scan *s, const whole_file *file);
int scan_open_off(scan *s);
int scan_open_obj(scan *s);
int scan_open_stl(scan *s, const whole_file *file);
int scan_next_ply(scan *s);
int scan_next_off(scan *s);
int scan_next_obj(scan *s);
int scan_next_stl(scan *s);

#endif
