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

/* Steps on their way from one thread to the other. */
struct portion {
    _Alignas(LINES) struct batch batch;
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
    uint64_t *packed; /* the states of a round, in these fields */
    struct field *fields;
    uint32_t *ids; /* of those that are expanded together */
    struct portion *portions, *filling; /* a ring, and what is being filled */
    uint64_t first; /* of these; as many have all their steps */
    size_t made;
    int wide;
    enum answer answer;
    struct escape expanding, storing;
    _Alignas(LINES) _Atomic uint64_t filled;
    _Alignas(LINES) _Atomic uint64_t stored;
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

/* --- the thread that expands */

/* Waits until at most so many portions wait. */
static void wait_for(struct pipeline *p, uint64_t waiting)
{
    uint64_t filled = atomic_load_explicit(&p->filled, memory_order_relaxed);
    for (uint32_t turns = 0; filled - atomic_load_explicit(&p->stored, memory_order_acquire) > waiting;) {
        int given_up = atomic_load_explicit(&p->given_up, memory_order_relaxed);
        if (given_up)
            longjmp(p->expanding.to, given_up);
        wait_a_little(&turns);
    }
}

/* Hands over the portion that is filled; there is room for another then. */
static void hand_over(struct pipeline *p, int last)
{
    uint64_t filled = atomic_load_explicit(&p->filled, memory_order_relaxed) + 1;
    int wide = p->filling->wide = p->wide;
    p->filling->last = last;
    p->wide = 0;
    p->filling = p->portions + filled % PORTIONS;
    atomic_store_explicit(&p->filled, filled, memory_order_release);
    if (last)
        return;
    wait_for(p, wide ? 0 : PORTIONS - 1);
    p->filling->batch.count = 0;
}

static void meet_in_round(void *pipeline, uint32_t rebec, uint32_t number)
{
    struct pipeline *p = pipeline;
    p->wide |= number > p->search->fields[rebec].mask;
}

static void send(void *pipeline, const struct transition *step)
{
    struct pipeline *p = pipeline;
    if (p->filling->batch.count == PORTION || p->wide)
        hand_over(p, 0);
    gather(p->search, &p->expanding, &p->filling->batch, p->first + p->made, step);
}

/* What is told meanwhile is what is stored then. */
static _Thread_local struct pipeline *asking;

static void look_in_round(int *goes_on)
{
    wait_for(asking, 0);
    asking->search->look(goes_on);
}

static enum answer expand_states(struct pipeline *p, size_t states)
{
    struct search *s = p->search;
    uint32_t words = p->outset.search.words;
    enum answer answer = COMPLETE;
    for (size_t at = 0, count; at < states && answer == COMPLETE; at += count) {
        count = states - at < BATCH ? states - at : BATCH;
        for (size_t i = 0; i < count; i++)
            unpack_fields(p->fields, s->rebecs, p->packed + (at + i) * words, p->ids + i * s->rebecs);
        p->made = 0;
        answer = kernel_successors(s->kernel, p->ids, count, &p->made, send, p);
        p->first += p->made;
    }
    p->made = 0;
    return answer;
}

static void expand_round(struct pipeline *p, size_t states)
{
    struct search *s = p->search;
    asking = p;
    kernel_meet(s->kernel, meet_in_round, p);
    kernel_watch(s->kernel, s->look ? look_in_round : NULL);
    p->answer = setjmp(p->expanding.to);
    if (!p->answer)
        p->answer = expand_states(p, states);
    hand_over(p, 1);
    kernel_meet(s->kernel, meet, s);
    kernel_watch(s->kernel, s->look);
}

/* --- the thread that stores */

/* Looks up and stores the steps of a portion; memory for those behind is on its way meanwhile. */
static void store_portion(struct search *s, const struct batch *b)
{
    enum { AHEAD = 16 };
    uint64_t hashes[AHEAD];
    for (uint32_t i = 0; i < b->count + AHEAD; i++) {
        if (i >= AHEAD) {
            const uint64_t *words = b->words + (size_t)(i - AHEAD) * s->words;
            settle(s, b->steps + i - AHEAD, words, (struct sought){hashes[i % AHEAD], 0});
            if (s->violated)
                longjmp(s->escape->to, VIOLATED);
        }
        if (i < b->count)
            hashes[i % AHEAD] = hash_ahead(s, b->words + (size_t)i * s->words);
    }
}

static void store_portions(struct pipeline *p)
{
    struct search *s = p->search;
    for (uint64_t at = 0, last = 0; !last; at++) {
        for (uint32_t turns = 0; atomic_load_explicit(&p->filled, memory_order_acquire) == at;)
            wait_a_little(&turns);
        const struct portion *portion = p->portions + at % PORTIONS;
        const struct batch *b = &portion->batch;
        last = portion->last;
        if (b->count)
            s->expanded = b->steps[b->count - 1].parent;
        s->transitions += b->count;
        store_portion(s, b);
        if (portion->wide)
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
    memcpy(p->packed, words_of(s, s->expanded), states * s->words * sizeof *p->packed);
    memcpy(p->fields, s->fields, s->rebecs * sizeof *p->fields);
    p->first = s->expanded;
    p->made = p->filled = p->stored = 0;
    p->filling = p->portions;
    p->filling->batch.count = p->wide = p->given_up = 0;
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
    s->batch.count = s->violated = 0;
    memcpy(s->measured, b->measured, s->model->measures * sizeof *s->measured);
    kernel_forget(s->kernel, b->served, b->covered, b->largest);
    repack(s);
}

/* How many states are expanded next in one round. */
static size_t size_of_round(const struct search *s)
{
    uint64_t left = s->level_end - s->expanded, most = ROUND / s->words;
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
    s->expanded = p->first + p->made;
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
    for (size_t i = 0; p->portions && i < PORTIONS; i++)
        free_batch(&p->portions[i].batch);
    void *parts[] = {p->outset.served, p->outset.covered, p->outset.largest, p->outset.measured, p->packed, p->fields, p->ids,
                     p->portions, p};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        free(parts[i]);
}

static void make_pipeline(struct search *s)
{
    struct pipeline *p = s->pipeline = zeroed_lines(1, sizeof *p);
    if (!p)
        give_up(s->escape);
    p->search = s;
    p->portions = zeroed_lines(PORTIONS, sizeof *p->portions);
    if (!p->portions)
        give_up(s->escape);
    for (size_t i = 0; i < PORTIONS; i++)
        p->portions[i].batch = make_batch(s, PORTION);
    p->packed = zeroed(s->escape, ROUND, sizeof *p->packed);
    p->fields = zeroed(s->escape, s->rebecs, sizeof *p->fields);
    p->ids = zeroed(s->escape, BATCH * s->rebecs, sizeof *p->ids);
    p->outset.served = zeroed(s->escape, (size_t)s->model->servers, 1);
    p->outset.covered = zeroed(s->escape, 2 * (size_t)s->model->branches, 1);
    p->outset.largest = zeroed(s->escape, s->rebecs, sizeof(uint32_t));
    p->outset.measured = zeroed(s->escape, (size_t)s->model->measures, sizeof(struct measured));
}

#endif
