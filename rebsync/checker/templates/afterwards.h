/* What is made of a search afterwards: the way to a state, and the graph. */
#ifndef REBSYNC_AFTERWARDS_H
#define REBSYNC_AFTERWARDS_H

#include "compaction.h"
#include "judging.h"

/* The first step from a state to another, and where it is sought. */
struct way {
    struct search *search;
    uint64_t from, to;
    int64_t code; /* -1: not found yet */
};

static void find_way(void *visitor, const struct transition *step)
{
    struct way *w = visitor;
    struct search *s = w->search;
    if (w->code >= 0 || !step->state || !is_state(s, step->state, (int64_t)w->to))
        return;
    int64_t before = s->times.count ? ((int64_t *)s->times.data)[w->from] : 0;
    if (!s->times.count || before + step->time <= s->until)
        w->code = (int64_t)step->code;
}

/* The state before one on its shortest way, or -1; `code` is that of the step between. It is -2
 * when there is no memory to find out, or the file of steps cannot be read. */
int64_t rebsync_before(struct search *s, uint64_t state, int64_t *code)
{
    if (s->compact) {
        struct arrival arrival;
        if (!read_arrival(s, state, &arrival))
            return -2;
        *code = arrival.code;
        return arrival.parent == NONE ? -1 : (int64_t)arrival.parent;
    }
    uint32_t parent = ((uint32_t *)s->parents.data)[state];
    if (state < s->initials) {
        *code = parent;
        return -1;
    }
    size_t made;
    struct way way = {s, parent, state, -1};
    unpack(s, words_of(s, parent), s->ids);
    if (kernel_successors(s->kernel, s->ids, 1, &made, find_way, &way) != COMPLETE)
        return -2;
    *code = way.code;
    return parent;
}

/* Where the steps of states go, and how many there are. */
struct graph {
    uint64_t *first;
    int64_t *target;
    int32_t *actor;
    int64_t *time;
    uint64_t *labels;
    uint16_t *turn; /* of a quotient: by which permutation the target is canonical */
};

struct drawing {
    struct search *search;
    struct graph graph;
    int turns; /* whether there are permutations */
    uint64_t edges;
};

/* Notes a step that fails, or leads to a state that was seen. */
static void draw(void *visitor, const struct transition *step)
{
    struct drawing *d = visitor;
    int64_t target = step->state ? seen(d->search, step->state) : -1;
    if (step->state && target < 0)
        return;
    if (d->turns && step->state)
        d->graph.turn[d->edges] = (uint16_t)step->turn;
    d->graph.target[d->edges] = target;
    d->graph.actor[d->edges] = step->actor;
    d->graph.time[d->edges++] = step->time;
}

static void label(struct search *s, uint64_t *labels, uint32_t words)
{
    memset(labels, 0, words * sizeof *labels);
    kernel_observe(s->kernel, s->ids);
    for (int32_t p = 0; p < s->model->predicates; p++) {
        struct valuation found = value_of(s->judge, p);
        if (found.defined && found.value)
            labels[p / 64] |= UINT64_C(1) << p % 64;
    }
}

/* Expands states again, from number `from` up to `to`, into arrays that are large enough; gives
 * how many edges there are so far, or -1 without memory. */
int64_t rebsync_graph(struct search *s, struct graph graph, uint64_t from, uint64_t to, uint64_t edges)
{
    uint32_t words = s->model->predicates ? (uint32_t)(s->model->predicates + 63) / 64 : 1;
    struct drawing drawing = {s, graph, s->symmetric, edges};
    size_t made;
    if (setjmp(s->escape->to))
        return -1;
    if (!s->table)
        fill_table(s, s->slots);
    for (uint64_t state = from; state < to; state++) {
        unpack(s, words_of(s, state), s->ids);
        label(s, graph.labels + state * words, words);
        graph.first[state] = drawing.edges;
        if (state < s->expanded)
            expect(s->escape, kernel_successors(s->kernel, s->ids, 1, &made, draw, &drawing));
    }
    graph.first[to] = drawing.edges;
    return (int64_t)drawing.edges;
}

#endif
