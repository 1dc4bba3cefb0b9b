/* The state space as arrays: steps are made again, and their targets looked up in batches, so that the
 * table's memory is on its way while others are made. */
#ifndef REBSYNC_GRAPH_H
#define REBSYNC_GRAPH_H

#include "storing.h"

/* Where the steps of states go, and what holds in these. */
struct graph {
    uint64_t *first;
    int64_t *target;
    int32_t *actor;
    int64_t *time;
    uint64_t *labels;
    uint16_t *turn; /* of a quotient: by which permutation the target is canonical */
};

/* A step whose target has not been looked up yet, and the state that it leaves. */
struct drawn {
    struct transition step;
    uint64_t from, hash;
};

/* `begun` are the states of which it is known where their steps begin. */
struct drawing {
    struct search *search;
    struct graph graph;
    int turns; /* whether there are permutations */
    uint64_t edges, from, begun;
    uint32_t pending;
    struct drawn batch[BATCH];
};

/* Up to this state, steps begin behind all that were noted. */
static void begin_steps(struct drawing *d, uint64_t state)
{
    while (d->begun <= state)
        d->graph.first[d->begun++] = d->edges;
}

static void note_step(struct drawing *d, const struct transition *step, int64_t target)
{
    if (d->turns && step->state)
        d->graph.turn[d->edges] = (uint16_t)step->turn;
    d->graph.target[d->edges] = target;
    d->graph.actor[d->edges] = step->actor;
    d->graph.time[d->edges++] = step->time;
}

/* Notes the steps of the batch that fail, or lead to a state that was seen. */
static void flush_steps(struct drawing *d)
{
    struct search *s = d->search;
    uint32_t numbers = (uint32_t)((UINT64_C(1) << s->number_bits) - 1);
    for (uint32_t i = 0; i < d->pending; i++) {
        const struct drawn *each = d->batch + i;
        begin_steps(d, each->from);
        if (!each->step.state) {
            note_step(d, &each->step, -1);
            continue;
        }
        uint32_t entry = s->table[find(s, s->batch.words + (size_t)i * s->words, each->hash)];
        if (entry)
            note_step(d, &each->step, (int64_t)(entry & numbers) - 1);
    }
    d->pending = 0;
}

/* Puts a step into the batch; that to a local state which no state has was not seen. */
static void draw(void *visitor, const struct transition *step)
{
    struct drawing *d = visitor;
    struct search *s = d->search;
    if (step->state && !fits(s, step->state))
        return;
    if (d->pending == BATCH)
        flush_steps(d);
    struct drawn *each = d->batch + d->pending;
    *each = (struct drawn){*step, d->from};
    if (step->state) {
        uint64_t *words = s->batch.words + (size_t)d->pending * s->words;
        pack(s, step->state, words);
        each->hash = hash_words(s, words);
        __builtin_prefetch(s->table + slot_of(s, each->hash));
    }
    d->pending++;
}

static void label(struct search *s, uint64_t *labels, uint32_t words)
{
    memset(labels, 0, words * sizeof *labels);
    kernel_observe(s->kernel, s->ids);
    for (int32_t p = 0; p < s->model->predicates; p++) {
        struct valuation found = value_of(s, p);
        if (found.defined && found.value)
            labels[p / 64] |= UINT64_C(1) << p % 64;
    }
}

#endif
