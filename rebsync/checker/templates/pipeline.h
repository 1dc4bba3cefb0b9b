/* One search by two threads: one expands states, the other looks up and stores what they lead to.
 *
 * The first alone has the kernel, the second all else of the search (a pipeline). Steps go from one to the
 * other in the order in which one thread makes them, so all that is found is what one thread finds. They
 * go on for a round: some states of a level, which are copied, for those that are stored move about. In
 * what is to be told, and where a bound ends the search, the order of all matters, so such a round is
 * taken back, and one thread searches it.
 */
#ifndef REBSYNC_PIPELINE_H
#define REBSYNC_PIPELINE_H

#include <pthread.h>
#include <stdatomic.h>

#include "storing.h"

/* A step on its way; of one that fails `numbers` are the kind, the instruction and the rebec. */
struct made {
    uint64_t code;
    uint32_t parent;
    int32_t end;
    uint32_t numbers[];
};

enum { GOES_ON, IS_DEADLOCK, FAILS };

struct portion {
    uint32_t count;
    int wide, last; /* afterwards numbers do not fit their fields any more; nothing comes */
};

/* A search, and what ran in it, before a round. */
struct outset {
    struct search search;
    unsigned char *served, *covered;
    uint32_t *largest;
    struct measured *measured;
};

struct pipeline {
    struct search *search;
    struct outset outset;
    uint64_t alone; /* up to this state one thread searches */
    uint32_t *ids;  /* of the states of a round */
    char *steps;    /* a ring of portions */
    size_t size;    /* of a step */
    struct portion portions[PORTIONS];
    uint32_t count; /* steps in the portion that is filled */
    size_t expanded;
    int wide;
    enum answer answer;
    struct escape expanding, storing;
    _Alignas(128) _Atomic uint64_t filled;
    _Alignas(128) _Atomic uint64_t stored;
    _Atomic int given_up; /* nothing is stored any more */
};

/* Turns for a moment; then naps that grow longer, but much less so than the ring lasts. */
static void wait_a_little(uint32_t *turns)
{
    enum { SPINS = 64, NAP = 10000, DOUBLED = 5 };
    uint32_t naps = ++*turns < SPINS ? 0 : *turns - SPINS;
    if (*turns >= SPINS)
        nanosleep(&(struct timespec){0, NAP << (naps < DOUBLED ? naps : DOUBLED)}, NULL);
#if defined(__x86_64__) || defined(__i386__)
    else
        __builtin_ia32_pause();
#endif
}

static struct made *step_in(const struct pipeline *p, uint64_t portion, uint32_t step)
{
    return (struct made *)(p->steps + (portion % PORTIONS * PORTION + step) * p->size);
}

/* --- the thread that expands */

/* Waits until at most so many portions wait. */
static void wait_for(struct pipeline *p, uint64_t waiting)
{
    uint64_t filled = atomic_load_explicit(&p->filled, memory_order_relaxed);
    for (uint32_t turns = 0; filled - atomic_load_explicit(&p->stored, memory_order_acquire) > waiting;) {
        if (atomic_load_explicit(&p->given_up, memory_order_relaxed))
            longjmp(p->expanding.to, 1);
        wait_a_little(&turns);
    }
}

/* Hands over the portion that is filled; there is room for another then. */
static void hand_over(struct pipeline *p, int last)
{
    uint64_t filled = atomic_load_explicit(&p->filled, memory_order_relaxed);
    p->portions[filled % PORTIONS] = (struct portion){p->count, p->wide, last};
    atomic_store_explicit(&p->filled, filled + 1, memory_order_release);
    p->count = 0;
    if (!last)
        wait_for(p, p->wide ? 0 : PORTIONS - 1);
    p->wide = 0;
}

static void meet_in_round(void *pipeline, uint32_t rebec, uint32_t number)
{
    struct pipeline *p = pipeline;
    p->wide |= number > p->search->fields[rebec].mask;
}

static void send(void *pipeline, const struct transition *step)
{
    struct pipeline *p = pipeline;
    if (p->count == PORTION || p->wide)
        hand_over(p, 0);
    struct made *made = step_in(p, atomic_load_explicit(&p->filled, memory_order_relaxed), p->count++);
    made->parent = (uint32_t)(p->outset.search.expanded + p->expanded);
    made->code = step->code;
    made->end = step->state ? step->deadlock : FAILS;
    if (step->state)
        memcpy(made->numbers, step->state, p->search->rebecs * sizeof *made->numbers);
    else
        memcpy(made->numbers, (int32_t[]){step->kind, step->pc, step->rebec}, 3 * sizeof(int32_t));
}

/* What is told meanwhile is what is stored then. */
static _Thread_local struct pipeline *asking;

static void look_in_round(int *goes_on)
{
    wait_for(asking, 0);
    asking->search->look(goes_on);
}

static void expand_round(struct pipeline *p, size_t states)
{
    struct search *s = p->search;
    asking = p;
    kernel_meet(s->kernel, meet_in_round, p);
    kernel_watch(s->kernel, s->look ? look_in_round : NULL);
    p->answer = COMPLETE;
    if (!setjmp(p->expanding.to)) {
        p->answer = kernel_successors(s->kernel, p->ids, states, &p->expanded, send, p);
        hand_over(p, 1);
    }
    kernel_meet(s->kernel, meet, s);
    kernel_watch(s->kernel, s->look);
}

/* --- the thread that stores */

static void store_step(struct search *s, const struct made *made)
{
    const int32_t *failure = (const int32_t *)made->numbers;
    struct transition step = {made->numbers, made->code, 0, -1, made->end};
    if (made->end == FAILS)
        step = (struct transition){NULL, made->code, 0, -1, 0, failure[0], failure[1], failure[2]};
    s->expanded = made->parent;
    store(s, &step);
}

static void store_portions(struct pipeline *p)
{
    struct search *s = p->search;
    for (uint64_t at = 0, last = 0; !last; at++) {
        for (uint32_t turns = 0; atomic_load_explicit(&p->filled, memory_order_acquire) == at;)
            wait_a_little(&turns);
        struct portion portion = p->portions[at % PORTIONS];
        for (uint32_t i = 0; i < portion.count; i++)
            store_step(s, step_in(p, at, i));
        last = portion.last;
        if (last || portion.wide)
            flush(s);
        if (portion.wide)
            repack(s);
        atomic_store_explicit(&p->stored, at + 1, memory_order_release);
    }
}

static void *store_round(void *pipeline)
{
    struct pipeline *p = pipeline;
    int escaped = setjmp(p->storing.to);
    if (!escaped)
        store_portions(p);
    atomic_store_explicit(&p->given_up, escaped, memory_order_relaxed);
    return NULL;
}

/* --- a round */

static void begin_round(struct pipeline *p, size_t states)
{
    struct search *s = p->search;
    struct outset *b = &p->outset;
    b->search = *s;
    kernel_covered(s->kernel, b->served, b->covered, b->largest);
    memcpy(b->measured, s->measured, s->model->measures * sizeof *s->measured);
    for (size_t i = 0; i < states; i++)
        unpack(s, words_of(s, s->expanded + i), p->ids + i * s->rebecs);
    p->expanded = p->filled = p->stored = 0;
    p->count = p->wide = p->given_up = 0;
    s->judged_later = 1;
    s->escape = &p->storing;
}

/* Undoes a round: one thread searches it. */
static void take_back(struct pipeline *p)
{
    struct search *s = p->search;
    const struct outset *b = &p->outset;
    s->count = s->parents.count = b->search.count;
    s->transitions = b->search.transitions;
    s->expanded = b->search.expanded;
    s->events.count = b->search.events.count;
    s->pending = s->violated = 0;
    memcpy(s->measured, b->measured, s->model->measures * sizeof *s->measured);
    kernel_forget(s->kernel, b->served, b->covered, b->largest);
    repack(s);
}

/* How many states are expanded next in one round. */
static size_t size_of_round(const struct search *s)
{
    uint64_t left = s->level_end - s->expanded, most = ROUND / s->rebecs;
    return left < most ? left : most;
}

/* Whether two threads go on; what is not common is left to one. */
static int is_for_two(const struct search *s)
{
    const struct pipeline *p = s->pipeline;
    return p && s->until == NEVER && s->expanded >= p->alone && size_of_round(s) >= ROUND_AT_LEAST;
}

/* Expands the next states with two threads; up to so many are to be found. */
static enum answer search_round(struct search *s, uint64_t most)
{
    struct pipeline *p = s->pipeline;
    size_t states = size_of_round(s);
    pthread_t thread;
    flush(s);
    if (s->wide)
        repack(s);
    begin_round(p, states);
    int fails = pthread_create(&thread, NULL, store_round, p);
    if (!fails) {
        expand_round(p, states);
        pthread_join(thread, NULL);
    }
    s->escape = p->outset.search.escape;
    s->judged_later = 0;
    p->alone = p->outset.search.expanded + states;
    if (fails)
        return COMPLETE;
    if (p->answer == NO_MEMORY || p->given_up == NO_MEMORY)
        give_up(s->escape);
    s->expanded = p->outset.search.expanded + p->expanded;
    for (uint64_t state = p->outset.search.count; state < s->count; state++)
        judge_values(s, state, words_of(s, state));
    if (s->events.count == p->outset.search.events.count && s->count < most)
        return p->answer;
    take_back(p);
    return COMPLETE;
}

/* --- its life */

static void free_pipeline(struct pipeline *p)
{
    if (!p)
        return;
    void *parts[] = {p->outset.served, p->outset.covered, p->outset.largest, p->outset.measured, p->ids, p->steps, p};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        free(parts[i]);
}

static void make_pipeline(struct search *s)
{
    struct pipeline *p = s->pipeline = aligned_alloc(128, sizeof *p);
    if (!p)
        give_up(s->escape);
    memset(p, 0, sizeof *p);
    p->search = s;
    p->size = (sizeof(struct made) + (s->rebecs > 3 ? s->rebecs : 3) * sizeof(uint32_t) + 7) & ~(size_t)7;
    p->steps = zeroed(s->escape, PORTIONS * PORTION, p->size);
    p->ids = zeroed(s->escape, ROUND, sizeof *p->ids);
    p->outset.served = zeroed(s->escape, (size_t)s->model->servers, 1);
    p->outset.covered = zeroed(s->escape, 2 * (size_t)s->model->branches, 1);
    p->outset.largest = zeroed(s->escape, s->rebecs, sizeof(uint32_t));
    p->outset.measured = zeroed(s->escape, (size_t)s->model->measures, sizeof(struct measured));
}

#endif
