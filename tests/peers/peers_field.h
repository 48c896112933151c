/* peers_field.h - an index and the trees of all peers over one soup, asked about the same boxes. */
#ifndef TRIBOX_TESTS_PEERS_FIELD_H
#define TRIBOX_TESTS_PEERS_FIELD_H

#include "common/box_scenes.h"
#include "peer.h"

enum { PEERS_MAX = 4, FIELD_MAX = 3 + 2 * PEERS_MAX };

/* A peer over the soup. */
typedef struct peer_field {
    const peer *peer;
    void *tree;          /* NULL if the soup has too many triangles for it */
    double seconds;      /* to build it */
    double list_seconds; /* for the lists of all boxes, when they were compared */
    peer_lists lists;
} peer_field;

/* Answers of a peer that are not those of the index, over boxes. */
typedef struct peer_errors {
    size_t missing, extra, any;
    size_t candidates; /* triangles that had to be tested */
    size_t near;       /* of the missing and the extra: within 2^-18 of the greatest coordinate of contact */
} peer_errors;

typedef struct field {
    const index_scene *scene;
    ordered_soup soup;
    answer_room room;
    float (*triangles)[3][3];
    peer_field peers[PEERS_MAX];
    size_t peer_count;
    const tribox_box *boxes;
    size_t box_count;
    uint32_t *list; /* of the index: that of box b, sorted, begins at start[b] */
    size_t *start;
} field;

/* False, with a message, if memory or the library fails. */
bool field_make(const index_scene *scene, size_t boxes_most, field *made);

void field_free(field *f);

/*
 * Asks everyone, and adds to the errors. verified: so many of the boxes are asked of tribox_overlap, too. False, with a message, if
 * the index itself is wrong about them.
 */
bool field_answer(field *f, const tribox_box *boxes, size_t count, size_t verified, peer_errors errors[PEERS_MAX]);

/* Who can be timed, and what each is called in tables. */
typedef struct entrant {
    char name[32];
    const peer_field *peer; /* NULL for the index */
    bool is_any;
} entrant;

enum { ENTRANT_LIST, ENTRANT_ANY, ENTRANT_LINEAR, ENTRANTS_OF_INDEX };

/* The index, its any and tribox_overlap without it, then the peers. Returns how many; of those that are absent the time is NaN. */
size_t field_entrants(const field *f, entrant list[FIELD_MAX]);

/*
 * Microseconds a box of every entrant, the least of some rounds. Whoever takes more than a second for all boxes is timed once.
 * linear_boxes: so many of the boxes for tribox_overlap alone.
 */
void field_time(field *f, size_t rounds, size_t linear_boxes, generator *order, double us[FIELD_MAX]);

#endif
