/* The threads of one search, and how they take turns. */
#ifndef REBSYNC_TEAM_H
#define REBSYNC_TEAM_H

#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>

#include "judging.h"

#define WAIT INT64_C(50000000) /* nanoseconds between two questions to who watches */

/* A step to a state that was not known when the round began. */
struct candidate {
    uint64_t hash, slot; /* where it is in the table, once it is `fresh` */
    int64_t time;
    uint32_t parent, code, number;
    unsigned char deadlock, named, fresh; /* packed and hashed; the first step of the round to it */
};

/* The numbers of a rebec's local states: of the worker's kernel by those of the search's, and back;
 * NONE where they are not known. */
struct names {
    struct vector own, common;
};

/* A thread, with a kernel of its own, of which the search's kernel knows nothing. */
struct worker {
    struct search *search;
    struct kernel *kernel;
    struct judge judge[1];
    struct escape escape[1];
    enum answer answer; /* to the phase */
    uint32_t number;
    pthread_t thread;
    struct names *names;                  /* of each rebec */
    uint32_t *ids, *common;               /* one state, in both numberings */
    struct vector candidates;             /* of the round */
    struct vector states, words;          /* theirs, in the worker's numbers, and packed */
    size_t looked_up;
    uint64_t parent, transitions, dropped, inserted, *owned;
    unsigned char *served, *covered; /* when the last round was complete */
    uint32_t *largest;
};

/* Neighbours in a level, expanded by one worker; its candidates, and where their states are stored:
 * all at first, then those that are new. */
struct chunk {
    struct worker *worker;
    size_t first, count;
    uint64_t place, fresh, number;
};

typedef void phase(struct worker *w);

struct team {
    uint32_t workers;
    struct worker *worker;
    struct chunk chunks[ROUND / CHUNK + 1];
    uint64_t first, end, chunk_count, taken; /* the states of the round, and its chunks */
    _Atomic uint64_t next; /* chunk */
    _Atomic int enough, stop; /* no chunk is begun any more; steps that take long are left */
    int refused; /* who watches wants no more */
    int inserted; /* candidates are in the table */
    int disbanded;
    int64_t due;
    uint64_t alone; /* states before this one are expanded by one thread */
    struct vector met; /* events of the round */

    pthread_mutex_t lock;
    pthread_cond_t begin, end_of_phase;
    uint32_t running, busy; /* threads besides the one that calls */
    uint64_t turn; /* counts the phases */
    phase *phase; /* NULL: threads end */
};

/* --- who watches is asked by the thread that calls; the others learn what was said */

static _Thread_local struct worker *this_worker;

static void look_for_all(struct team *t, void (*look)(int *goes_on))
{
    int goes_on = 1;
    if (look) {
        goes_on = 0;
        look(&goes_on);
    }
    if (!goes_on) {
        t->refused = 1;
        t->enough = t->stop = 1;
    }
}

static void look_of_worker(int *goes_on)
{
    struct search *s = this_worker->search;
    if (!this_worker->number)
        look_for_all(s->team, s->look);
    *goes_on = !s->team->stop;
}

/* --- phases */

/* Does the work of a worker in a phase. Whoever cannot goes back to here, and lets all end soon. */
static void work(struct worker *w, phase *phase)
{
    struct team *t = w->search->team;
    this_worker = w;
    w->answer = (enum answer)setjmp(w->escape->to);
    if (w->answer == COMPLETE)
        phase(w);
    else
        t->enough = t->stop = 1;
}

static void *wait_and_work(void *worker)
{
    struct worker *w = worker;
    struct team *t = w->search->team;
    for (uint64_t turn = 0;;) {
        pthread_mutex_lock(&t->lock);
        while (t->turn == turn)
            pthread_cond_wait(&t->begin, &t->lock);
        turn = t->turn;
        phase *phase = t->phase;
        pthread_mutex_unlock(&t->lock);
        if (!phase)
            return NULL;
        work(w, phase);
        pthread_mutex_lock(&t->lock);
        if (!--t->busy)
            pthread_cond_signal(&t->end_of_phase);
        pthread_mutex_unlock(&t->lock);
    }
}

/* Lets the other threads begin a phase, NULL for their end. */
static void call_threads(struct team *t, phase *phase)
{
    pthread_mutex_lock(&t->lock);
    t->phase = phase;
    t->busy = t->running;
    t->turn++;
    pthread_cond_broadcast(&t->begin);
    pthread_mutex_unlock(&t->lock);
}

static struct timespec soon(void)
{
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += WAIT;
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    return until;
}

/* Waits for the others, and asks who watches meanwhile. */
static void wait_for_threads(struct search *s)
{
    struct team *t = s->team;
    pthread_mutex_lock(&t->lock);
    while (t->busy) {
        struct timespec until = soon();
        if (pthread_cond_timedwait(&t->end_of_phase, &t->lock, &until) != ETIMEDOUT)
            continue;
        pthread_mutex_unlock(&t->lock);
        look_for_all(t, s->look);
        pthread_mutex_lock(&t->lock);
    }
    pthread_mutex_unlock(&t->lock);
}

/* Lets all workers go through a phase, and leaves the search if one could not and the whole cannot
 * go on; other answers are left to the caller. */
static void all_do(struct search *s, phase *phase)
{
    struct team *t = s->team;
    call_threads(t, phase);
    work(t->worker, phase);
    wait_for_threads(s);
    for (uint32_t i = 0; i < t->workers; i++)
        if (t->worker[i].answer == NO_MEMORY)
            give_up(s->escape);
    if (t->refused)
        longjmp(s->escape->to, INTERRUPTED);
}

/* Starts the threads unless they run; 0 when that cannot be. */
static int start_threads(struct team *t)
{
    while (t->running + 1 < t->workers) {
        struct worker *w = t->worker + t->running + 1;
        if (pthread_create(&w->thread, NULL, wait_and_work, w))
            return 0;
        t->running++;
    }
    return 1;
}

/* Ends the threads. A search that is not called has none. */
static void end_threads(struct team *t)
{
    if (!t || !t->running)
        return;
    call_threads(t, NULL);
    for (; t->running; t->running--)
        pthread_join(t->worker[t->running].thread, NULL);
    t->turn = 0;
    t->busy = 0;
}

/* --- its life */

static void free_names(struct worker *w)
{
    for (uint32_t r = 0; w->names && r < w->search->rebecs; r++) {
        free(w->names[r].own.data);
        free(w->names[r].common.data);
    }
}

/* Lets the workers go, with all but what they have covered: one thread goes on. */
static void disband(struct team *t)
{
    if (!t || t->disbanded)
        return;
    end_threads(t);
    for (uint32_t i = 0; t->worker && i < t->workers; i++) {
        struct worker *w = t->worker + i;
        free_names(w);
        kernel_free(w->kernel);
        void *parts[] = {w->names, w->ids, w->common, w->candidates.data, w->states.data,
                         w->words.data, w->owned, w->judge->events.data, w->judge->measured};
        for (size_t p = 0; p < sizeof parts / sizeof *parts; p++)
            free(parts[p]);
    }
    t->disbanded = 1;
}

static void free_team(struct team *t)
{
    if (!t)
        return;
    disband(t);
    for (uint32_t i = 0; t->worker && i < t->workers; i++) {
        free(t->worker[i].served);
        free(t->worker[i].covered);
        free(t->worker[i].largest);
    }
    pthread_mutex_destroy(&t->lock);
    pthread_cond_destroy(&t->begin);
    pthread_cond_destroy(&t->end_of_phase);
    free(t->worker);
    free(t->met.data);
    free(t);
}

/* Adds what ran in rounds that were completed. */
static void add_covered(const struct team *t, unsigned char *served, unsigned char *covered,
                        uint32_t *largest)
{
    for (const struct worker *w = t->worker; w < t->worker + t->workers; w++) {
        const struct model *m = w->search->model;
        for (int32_t i = 0; i < m->servers; i++)
            served[i] |= w->served[i];
        for (int32_t i = 0; i < 2 * m->branches; i++)
            covered[i] |= w->covered[i];
        for (uint32_t r = 0; r < w->search->rebecs; r++)
            largest[r] = largest[r] > w->largest[r] ? largest[r] : w->largest[r];
    }
}

static void make_worker(struct search *s, struct worker *w, uint32_t shares)
{
    const struct model *m = s->model;
    struct judge *j = w->judge;
    w->names = zeroed(s->escape, s->rebecs, sizeof *w->names);
    w->ids = zeroed(s->escape, s->rebecs, sizeof *w->ids);
    w->common = zeroed(s->escape, s->rebecs, sizeof *w->common);
    w->owned = zeroed(s->escape, shares, sizeof *w->owned);
    w->served = zeroed(s->escape, (size_t)m->servers, 1);
    w->covered = zeroed(s->escape, 2 * (size_t)m->branches, 1);
    w->largest = zeroed(s->escape, s->rebecs, sizeof *w->largest);
    *j = (struct judge){.search = s, .kernel = w->kernel, .escape = w->escape};
    j->measured = zeroed(s->escape, (size_t)m->measures, sizeof *j->measured);
    measure_nothing(j);
    kernel_watch(w->kernel, look_of_worker);
}

/* A team of so many, whose kernels do as that of the search does. */
static void make_team(struct search *s, uint32_t workers, enum semantics semantics,
                      const int32_t *persistent, int persistent_count)
{
    struct team *t = s->team = zeroed(s->escape, 1, sizeof *t);
    pthread_mutex_init(&t->lock, NULL);
    pthread_cond_init(&t->begin, NULL);
    pthread_cond_init(&t->end_of_phase, NULL);
    t->worker = zeroed(s->escape, workers, sizeof *t->worker);
    for (; t->workers < workers; t->workers++) {
        struct worker *w = t->worker + t->workers;
        w->search = s;
        w->number = t->workers;
        w->kernel = kernel_new(s->model, semantics, 0);
        if (!w->kernel || !kernel_persistent(w->kernel, persistent, persistent_count)) {
            kernel_free(w->kernel);
            w->kernel = NULL;
            give_up(s->escape);
        }
        make_worker(s, w, workers);
    }
}

#endif
