/* cmd.h - the commands of the program. words[0] is the name of the command; each returns an exit_code. */
#ifndef CMD_H
#define CMD_H

#include "tribox.h"

#define CMD_TEXT_OF(number) #number
#define CMD_TEXT(number) CMD_TEXT_OF(number)
#define CMD_VERSION CMD_TEXT(TRIBOX_VERSION_MAJOR) "." CMD_TEXT(TRIBOX_VERSION_MINOR) "." CMD_TEXT(TRIBOX_VERSION_PATCH)

int cmd_overlap(int count, char **words);
int cmd_sweep(int count, char **words);
int cmd_voxelize(int count, char **words);
int cmd_partition(int count, char **words);
int cmd_merge(int count, char **words);
int cmd_info(int count, char **words);
int cmd_demo(int count, char **words);

#endif
