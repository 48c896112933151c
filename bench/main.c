/* main.c - tribox-bench: the table of questions. */
#include "common/asked.h"

extern const bench_question question_ratios, question_inputs, question_sweep, question_grids, question_calls, question_octree,
    question_doubles, question_cgal, question_voxels, question_index;

int main(int argc, char **argv)
{
    static const bench_question *const questions[] = {&question_ratios, &question_inputs, &question_sweep,   &question_grids,
                                                      &question_calls,  &question_octree, &question_doubles, &question_cgal,
                                                      &question_voxels, &question_index};
    static asked q;
    return asked_main(argc, argv, questions, sizeof questions / sizeof questions[0], &q);
}
