/* Time that stands still: which states are on endless runs without time, and which can leave. */
#ifndef REBSYNC_STANDSTILL_H
#define REBSYNC_STANDSTILL_H

#include <stdint.h>
#include <stdlib.h>

enum { ENDLESS_RUN = 1, LEAVES = 2 };

struct edges {
    const uint64_t *first;
    const int64_t *target, *time;
    uint64_t states;
};

struct before {
    uint64_t *first; /* where the states before each state begin in `state` */
    uint32_t *state, *ahead, *waiting;
};

static int stands(const struct edges *g, uint64_t edge)
{
    return g->target[edge] >= 0 && g->time[edge] == 0;
}

/* Turns the edges without time round, and counts those of each state in `ahead`. */
static int turn_round(const struct edges *g, struct before *b)
{
    uint64_t count = g->states;
    b->first = calloc(count + 2, sizeof *b->first);
    b->ahead = calloc(count + 1, sizeof *b->ahead);
    b->waiting = malloc((count + 1) * sizeof *b->waiting);
    if (!b->first || !b->ahead || !b->waiting)
        return 0;
    for (uint64_t s = 0; s < count; s++)
        for (uint64_t e = g->first[s]; e < g->first[s + 1]; e++)
            if (stands(g, e)) {
                b->first[g->target[e] + 2]++;
                b->ahead[s]++;
            }
    for (uint64_t s = 2; s < count + 2; s++)
        b->first[s] += b->first[s - 1];
    b->state = malloc((b->first[count + 1] + 1) * sizeof *b->state);
    if (!b->state)
        return 0;
    for (uint64_t s = 0; s < count; s++)
        for (uint64_t e = g->first[s]; e < g->first[s + 1]; e++)
            if (stands(g, e))
                b->state[b->first[g->target[e] + 1]++] = (uint32_t)s;
    return 1;
}

static int is_exit(const struct edges *g, uint64_t state)
{
    for (uint64_t e = g->first[state]; e < g->first[state + 1]; e++)
        if (g->time[e] > 0)
            return 1;
    return g->first[state] == g->first[state + 1];
}

static void spread_exits(const struct edges *g, struct before *b, unsigned char *marks)
{
    uint64_t waiting = 0;
    for (uint64_t s = 0; s < g->states; s++)
        if (is_exit(g, s)) {
            marks[s] |= LEAVES;
            b->waiting[waiting++] = (uint32_t)s;
        }
    while (waiting) {
        uint32_t reached = b->waiting[--waiting];
        for (uint64_t i = b->first[reached]; i < b->first[reached + 1]; i++)
            if (!(marks[b->state[i]] & LEAVES)) {
                marks[b->state[i]] |= LEAVES;
                b->waiting[waiting++] = b->state[i];
            }
    }
}

/* Takes away what leads to no cycle. */
static void peel(const struct edges *g, struct before *b, unsigned char *marks)
{
    uint64_t waiting = 0;
    for (uint64_t s = 0; s < g->states; s++)
        if (!b->ahead[s])
            b->waiting[waiting++] = (uint32_t)s;
    while (waiting) {
        uint32_t over = b->waiting[--waiting];
        for (uint64_t i = b->first[over]; i < b->first[over + 1]; i++)
            if (!--b->ahead[b->state[i]])
                b->waiting[waiting++] = b->state[i];
    }
    for (uint64_t s = 0; s < g->states; s++)
        if (b->ahead[s])
            marks[s] |= ENDLESS_RUN;
}

/* Marks the states of a graph, `marks` being zero; 0 without memory. */
int rebsync_standstill(const uint64_t *first, const int64_t *target, const int64_t *time, uint64_t states,
                       unsigned char *marks)
{
    struct edges g = {first, target, time, states};
    struct before b = {0};
    int done = turn_round(&g, &b);
    if (done) {
        spread_exits(&g, &b, marks);
        peel(&g, &b, marks);
    }
    free(b.first);
    free(b.ahead);
    free(b.waiting);
    free(b.state);
    return done;
}

#endif
