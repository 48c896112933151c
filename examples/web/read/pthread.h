/* pthread.h - what tools/read takes of threads, where there is one: nothing is ever held by another. */
#ifndef PTHREAD_H
#define PTHREAD_H

typedef int pthread_mutex_t;
typedef int pthread_cond_t;
#define PTHREAD_MUTEX_INITIALIZER 0
#define PTHREAD_COND_INITIALIZER 0

#define ALWAYS_WELL(name, ...) \
    static inline int name(__VA_ARGS__) { return 0; }
ALWAYS_WELL(pthread_mutex_init, pthread_mutex_t *mutex, const void *attributes)
ALWAYS_WELL(pthread_mutex_destroy, pthread_mutex_t *mutex)
ALWAYS_WELL(pthread_mutex_lock, pthread_mutex_t *mutex)
ALWAYS_WELL(pthread_mutex_trylock, pthread_mutex_t *mutex)
ALWAYS_WELL(pthread_mutex_unlock, pthread_mutex_t *mutex)
ALWAYS_WELL(pthread_cond_init, pthread_cond_t *condition, const void *attributes)
ALWAYS_WELL(pthread_cond_destroy, pthread_cond_t *condition)
ALWAYS_WELL(pthread_cond_wait, pthread_cond_t *condition, pthread_mutex_t *mutex)
ALWAYS_WELL(pthread_cond_signal, pthread_cond_t *condition)
ALWAYS_WELL(pthread_cond_broadcast, pthread_cond_t *condition)
#undef ALWAYS_WELL

#endif
