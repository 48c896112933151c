/* questions.h - what tribox-bench can be asked, a file each. */
#ifndef BENCH_QUESTIONS_H
#define BENCH_QUESTIONS_H

#include "common/asked.h"

extern const bench_question question_ratios, question_inputs, question_sweep, question_grids, question_calls, question_octree,
    question_doubles, question_cgal, question_voxels, question_index;

#endif
