/* interrupt.h - a run that is told to end leaves nothing unfinished behind, and says how to go on. */
#ifndef INTERRUPT_H
#define INTERRUPT_H

/*
 * Removes a file or an empty folder, the last one first, when SIGINT, SIGTERM or SIGHUP ends the program, which it then does as it
 * would have. Signals that are ignored stay so. The path stays in memory until it is forgotten.
 */
void interrupt_watch(const char *path);
void interrupt_forget(const char *path);

/* Between these a signal waits: for making a file and watching it. */
void interrupt_hold(void);
void interrupt_release(void);

/* Does the same at once, of any thread and in a handler too, says this line, and ends the program as after a failure. */
_Noreturn void interrupt_fail(const char *line);

/* What the line says after "interrupted: ", also where nothing is watched yet; by default that nothing was written. */
void interrupt_advise(const char *advice);

#endif
