/* peers_report.h - times of an index and its peers, side by side. */
#ifndef TRIBOX_TESTS_PEERS_REPORT_H
#define TRIBOX_TESTS_PEERS_REPORT_H

#include "peers_field.h"

enum { PEER_SIZES = 7 };

/* Edges of the boxes, as parts of the greatest extent. */
extern const double peer_part[PEER_SIZES];

typedef struct peers_result {
    char name[64];
    size_t triangles, entrant_count;
    entrant entrants[FIELD_MAX]; /* by name alone: their peers may be gone */
    double us[PEER_SIZES][FIELD_MAX];
} peers_result;

void peers_print_head(const field *f, const peers_result *r);
void peers_print_row(const peers_result *r, int size, double hits);

/* Differences of answers about boxes of all sizes. */
void peers_print_errors(const field *f, size_t boxes, size_t hits, const peer_errors errors[PEERS_MAX]);

/* Geometric means over the meshes, and each goal against what was reached. */
void peers_print_goals(const peers_result *results, size_t count);

/* Lines of a table with commas, for the chart: scene, triangles, part, contestant, us. */
void peers_csv_head(FILE *to);
void peers_csv(FILE *to, const peers_result *r);

#endif
