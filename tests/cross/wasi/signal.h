/* signal.h - where there are no signals: the engine says itself what went wrong. */
#ifndef TRIBOX_TESTS_SIGNAL_H
#define TRIBOX_TESTS_SIGNAL_H

enum { SIGILL = 4, SIGBUS = 7, SIGFPE = 8, SIGSEGV = 11 };

static inline void signal(int number, void (*handler)(int)) { (void)number, (void)handler; }

#endif
