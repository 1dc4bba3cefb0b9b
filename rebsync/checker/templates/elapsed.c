/* Untils with bounds of time, at all nodes of a timeline at once.
 *
 * The same as temporal/figures.py, temporal/elapsed.py and temporal/timeline.py, where it is said what
 * is computed. No time is as long as NEVER ends: the caller sees to that. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "pearce.h"
#include "radix.h"

enum { DONE, NO_MEMORY = -1, STOPPED = -2 };
#define FOREVER (INT64_C(1) << 62)
#define NEVER (-1)

/* `entering` are the edges that enter each node: those of n from `entry[n]` on. */
struct line {
    uint64_t nodes, edges;
    int32_t *first, *source, *target;
    int64_t *time;
    const int32_t *entry, *entering;
    int32_t *step, *origin;
    void (*look)(int *goes_on);
    uint64_t stretch, done; /* edges between two questions whether to go on; those since the last one */
};

/* An until as `Outcome` has it; `time` are its figures at all nodes. */
struct outcome {
    const unsigned char *left, *right;
    const int64_t *time;
    int64_t low, high;
};

static int goes_on(struct line *l, uint64_t done)
{
    int on = 0;
    if ((l->done += done) < l->stretch)
        return 1;
    l->done = 0;
    l->look(&on);
    return on;
}

static int64_t greater(int64_t a, int64_t b)
{
    return a > b ? a : b;
}

/* --- timelines */

/* How many edges the timeline of a graph has, and in `longest` the longest time of one. */
uint64_t rebsync_line_size(const uint64_t *first, const int64_t *target, const int64_t *time, uint64_t states,
                           int64_t *longest)
{
    uint64_t edges = 0;
    *longest = 0;
    for (uint64_t s = 0; s < states; s++) {
        uint64_t live = 0;
        for (uint64_t e = first[s]; e < first[s + 1]; e++)
            if (target[e] >= 0) {
                live++;
                *longest = greater(*longest, time[e]);
            }
        edges += live ? live : 1;
    }
    return edges;
}

static void put_edge(struct line *l, uint64_t source, int64_t target, int64_t time, int64_t step)
{
    l->source[l->edges] = (int32_t)source;
    l->target[l->edges] = (int32_t)target;
    l->time[l->edges] = time;
    l->step[l->edges++] = (int32_t)step;
}

/* Fills the timeline of a graph. */
int rebsync_line(struct line *l, const uint64_t *first, const int64_t *target, const int64_t *time, int64_t patience)
{
    l->edges = 0;
    for (uint64_t s = 0; s < l->nodes; s++) {
        l->first[s] = (int32_t)l->edges;
        l->origin[s] = (int32_t)s;
        for (uint64_t e = first[s]; e < first[s + 1]; e++)
            if (target[e] >= 0)
                put_edge(l, s, target[e], time[e], (int64_t)e);
        if (l->edges == (uint64_t)l->first[s])
            put_edge(l, s, (int64_t)s, patience, -1);
        if (!goes_on(l, l->edges - (uint64_t)l->first[s]))
            return STOPPED;
    }
    l->first[l->nodes] = (int32_t)l->edges;
    return DONE;
}

/* Which edges enter each node; `entry` is of zeros. */
int rebsync_entering(struct line *l, int32_t *entry, int32_t *entering)
{
    for (uint64_t e = 0; e < l->edges; e++)
        entry[l->target[e]]++;
    for (uint64_t n = 1; n <= l->nodes; n++) /* where those of each node end */
        entry[n] += entry[n - 1];
    for (uint64_t e = l->edges; e-- > 0;) { /* and, from the last on, begin */
        entering[--entry[l->target[e]]] = (int32_t)e;
        if (!goes_on(l, 1))
            return STOPPED;
    }
    return DONE;
}

/* Where a predicate holds. */
void rebsync_truth(const uint64_t *labels, uint64_t words, uint64_t states, uint32_t predicate, unsigned char *truth)
{
    for (uint64_t s = 0; s < states; s++)
        truth[s] = labels[s * words + predicate / 64] >> predicate % 64 & 1;
}

/* --- the four figures */

/* Lowers values, which are FOREVER, to the least time from what waits, backwards over inner nodes. */
static int spread(struct line *l, struct radix *waiting, const unsigned char *inner, int64_t *value)
{
    for (struct waiter w; radix_take(waiting, &w);) {
        if (value[w.node] < w.time)
            continue;
        int32_t begin = l->entry[w.node], end = l->entry[w.node + 1];
        for (int32_t i = begin; i < end; i++) {
            int32_t edge = l->entering[i], before = l->source[edge];
            int64_t then = w.time + l->time[edge];
            if (inner[before] && then < value[before]) {
                value[before] = then;
                radix_put(waiting, before, then);
            }
        }
        if (!goes_on(l, 1 + (uint64_t)(end - begin)))
            return STOPPED;
    }
    return waiting->full ? NO_MEMORY : DONE;
}

static void start(struct radix *waiting, int64_t *value, uint64_t node, int64_t time)
{
    if (time < value[node]) {
        value[node] = time;
        radix_put(waiting, (int32_t)node, time);
    }
}

int rebsync_earliest(struct line *l, const unsigned char *left, const unsigned char *right, int64_t *value)
{
    struct radix waiting = {0};
    for (uint64_t n = 0; n < l->nodes; n++) {
        value[n] = FOREVER;
        if (right[n])
            start(&waiting, value, n, 0);
    }
    int state = spread(l, &waiting, left, value);
    radix_end(&waiting);
    return state;
}

/* Reaches the nodes of which all edges lead to what was reached, in order; `open` counts the others. */
static int reach(struct line *l, const unsigned char *left, const unsigned char *right, int64_t *value,
                 int32_t *open, int32_t *reached)
{
    uint64_t count = 0;
    for (uint64_t n = 0; n < l->nodes; n++) {
        open[n] = l->first[n + 1] - l->first[n];
        value[n] = 0;
        if (right[n]) {
            open[n] = 0;
            reached[count++] = (int32_t)n;
        }
    }
    for (uint64_t at = 0; at < count; at++) {
        int32_t node = reached[at];
        for (int32_t i = l->entry[node]; i < l->entry[node + 1]; i++) {
            int32_t edge = l->entering[i], before = l->source[edge];
            if (!left[before] || right[before])
                continue;
            value[before] = greater(value[before], value[node] + l->time[edge]);
            if (!--open[before])
                reached[count++] = before;
        }
        if (!goes_on(l, 1 + (uint64_t)(l->entry[node + 1] - l->entry[node])))
            return STOPPED;
    }
    for (uint64_t n = 0; n < l->nodes; n++)
        if (open[n])
            value[n] = FOREVER;
    return DONE;
}

int rebsync_latest(struct line *l, const unsigned char *left, const unsigned char *right, int64_t *value)
{
    int32_t *open = malloc((l->nodes + 1) * sizeof *open), *reached = malloc((l->nodes + 1) * sizeof *reached);
    int state = open && reached ? reach(l, left, right, value, open, reached) : NO_MEMORY;
    free(open);
    free(reached);
    return state;
}

/* The inner nodes and the edges between them: all, or those without time. */
struct inside {
    const struct line *line;
    const unsigned char *inner;
    int zero;
    int32_t *component, *members;
};

static int64_t successor(const void *of, uint64_t node, uint64_t i)
{
    const struct inside *in = of;
    uint64_t edge = (uint64_t)in->line->first[node] + i;
    if (!in->inner[node] || edge >= (uint64_t)in->line->first[node + 1])
        return NO_MORE;
    int32_t target = in->line->target[edge];
    return in->inner[target] && !(in->zero && in->line->time[edge]) ? target : SKIPPED;
}

static int join(struct line *l, struct inside *in)
{
    struct pearce p;
    in->component = calloc(l->nodes + 1, sizeof *in->component);
    in->members = malloc((l->nodes + 1) * sizeof *in->members);
    if (!in->component || !in->members || !pearce_begin(&p, in, l->nodes, in->component, in->members))
        return NO_MEMORY;
    int state = DONE;
    while (state == DONE && pearce_go_on(&p, l->stretch))
        state = goes_on(l, l->stretch) ? DONE : STOPPED;
    pearce_end(&p);
    return state;
}

static void end_inside(struct inside *in)
{
    free(in->component);
    free(in->members);
}

/* The supremum for a component, whose nodes these are. */
static int64_t longest_within(const struct line *l, const struct inside *in, const unsigned char *right,
                              const int64_t *value, const int32_t *member, uint64_t count)
{
    int64_t best = NEVER;
    int advances = 0;
    for (uint64_t i = 0; i < count; i++) {
        int32_t node = member[i], own = in->component[node];
        for (int32_t e = l->first[node]; e < l->first[node + 1]; e++) {
            int32_t target = l->target[e];
            if (right[node])
                best = greater(best, greater(l->time[e] - 1, 0));
            if (in->inner[target] && in->component[target] == own)
                advances |= l->time[e] > 0;
            else if (value[target] >= 0)
                best = greater(best, l->time[e] + value[target]);
        }
    }
    return best >= FOREVER || (advances && best >= 0) ? FOREVER : best;
}

static int longest(struct line *l, const struct inside *in, const unsigned char *right, int64_t *value)
{
    for (uint64_t n = 0; n < l->nodes; n++)
        value[n] = right[n] ? 0 : NEVER;
    for (uint64_t begin = 0, end; begin < l->nodes; begin = end) {
        int32_t own = in->component[in->members[begin]];
        for (end = begin + 1; end < l->nodes && in->component[in->members[end]] == own;)
            end++;
        if (!in->inner[in->members[begin]]) /* alone in its component */
            continue;
        int64_t best = longest_within(l, in, right, value, in->members + begin, end - begin);
        for (uint64_t i = begin; i < end; i++)
            value[in->members[i]] = best;
        if (!goes_on(l, end - begin))
            return STOPPED;
    }
    return DONE;
}

int rebsync_longest(struct line *l, const unsigned char *left, const unsigned char *right, int64_t *value)
{
    struct inside in = {.line = l, .inner = left};
    int state = join(l, &in);
    if (state == DONE)
        state = longest(l, &in, right, value);
    end_inside(&in);
    return state;
}

/* What waits is a node by the time from which on a run from it is not fulfilled any more. */
static void start_last(const struct line *l, const struct inside *in, const unsigned char *left,
                       const unsigned char *failing, struct radix *waiting, int64_t *value)
{
    for (uint64_t n = 0; n < l->nodes; n++) {
        value[n] = FOREVER;
        if (!failing[n] && !left[n])
            start(waiting, value, n, 0);
        for (int32_t e = l->first[n]; in->inner[n] && e < l->first[n + 1]; e++) {
            int32_t target = l->target[e];
            if (failing[target])
                start(waiting, value, n, greater(l->time[e] - 1, 0));
            else if (!l->time[e] && left[target] && in->component[target] == in->component[n])
                start(waiting, value, n, 0);
        }
    }
}

static int surest(struct line *l, const unsigned char *left, unsigned char *failing, unsigned char *inner, int64_t *value)
{
    for (uint64_t n = 0; n < l->nodes; n++) {
        failing[n] = value[n] == FOREVER;
        inner[n] = left[n] && !failing[n];
    }
    struct inside in = {.line = l, .inner = inner, .zero = 1};
    struct radix waiting = {0};
    int state = join(l, &in);
    if (state == DONE) {
        start_last(l, &in, left, failing, &waiting, value);
        state = spread(l, &waiting, inner, value);
    }
    for (uint64_t n = 0; n < l->nodes; n++)
        if (failing[n])
            value[n] = NEVER;
    radix_end(&waiting);
    end_inside(&in);
    return state;
}

int rebsync_surest(struct line *l, const unsigned char *left, const unsigned char *right, int64_t *value)
{
    unsigned char *failing = malloc(l->nodes + 1), *inner = malloc(l->nodes + 1);
    int state = failing && inner ? rebsync_latest(l, left, right, value) : NO_MEMORY;
    if (state == DONE)
        state = surest(l, left, failing, inner, value);
    free(failing);
    free(inner);
    return state;
}

/* --- where an until holds */

static int is_met(const struct outcome *o, int64_t elapsed)
{
    return o->low <= elapsed && elapsed <= o->high;
}

static int holds(const struct outcome *o, int32_t node, int64_t elapsed)
{
    if (o->low == 0)
        return o->time[node] + elapsed <= o->high;
    return o->time[node] > NEVER && o->low <= o->time[node] + elapsed;
}

void rebsync_holding(const struct outcome *o, uint64_t nodes, unsigned char *truth)
{
    for (uint64_t n = 0; n < nodes; n++)
        truth[n] = (unsigned char)holds(o, (int32_t)n, 0);
}

/* Whether it holds on the way along an edge, when so much of its time remains. */
static int between(const struct line *l, const struct outcome *o, uint64_t edge, int64_t remaining)
{
    int32_t node = l->source[edge];
    if (o->right[node] && is_met(o, 0))
        return 1;
    if (!o->left[node])
        return 0;
    int64_t soonest = greater(o->low, 1), last = remaining - 1;
    if (o->right[node] && soonest <= (o->high < last ? o->high : last))
        return 1;
    return holds(o, l->target[edge], remaining);
}

/* The greatest time that remains when it is as at the end of an edge, and not as at its start. */
static int64_t turning_point(const struct line *l, const struct outcome *o, uint64_t edge, int last)
{
    int64_t as_last = 1, other = l->time[edge] - 1;
    while (other - as_last > 1) {
        int64_t middle = as_last + (other - as_last) / 2;
        if (between(l, o, edge, middle) == last)
            as_last = middle;
        else
            other = middle;
    }
    return as_last;
}

/* How often the truth changes on the way along an edge, and with how much time remaining. */
static int changes(const struct line *l, const struct outcome *o, uint64_t edge, int value, int64_t *remaining)
{
    int64_t most = l->time[edge] - 1;
    if (most < 1)
        return 0;
    int count = 0, begin = between(l, o, edge, most), last = between(l, o, edge, 1);
    if (begin != value)
        remaining[count++] = most;
    if (begin != last)
        remaining[count++] = turning_point(l, o, edge, last);
    return count;
}

/* How many nodes it takes to split all edges on which the truth changes, or STOPPED. */
int64_t rebsync_changes(struct line *l, const struct outcome *o, const unsigned char *truth)
{
    int64_t remaining[2], count = 0;
    for (uint64_t e = 0; e < l->edges; e++) {
        count += changes(l, o, e, truth[l->source[e]], remaining);
        if (!goes_on(l, 1))
            return STOPPED;
    }
    return count;
}

/* Splits them; there is room for so many nodes, and as many edges, behind all others. */
void rebsync_split(struct line *l, const struct outcome *o, unsigned char *truth)
{
    int64_t remaining[2];
    for (uint64_t e = 0, edges = l->edges; e < edges; e++) {
        int32_t source = l->source[e], target = l->target[e];
        int value = truth[source], count = changes(l, o, e, value, remaining);
        int64_t left = l->time[e];
        for (uint64_t at = e, i = 0; i < (uint64_t)count; i++) {
            l->target[at] = (int32_t)l->nodes;
            l->time[at] = left - remaining[i];
            at = l->edges;
            left = remaining[i];
            l->origin[l->nodes] = source;
            truth[l->nodes] = (unsigned char)(value = !value);
            put_edge(l, l->nodes++, target, left, -1);
            l->first[l->nodes] = (int32_t)l->edges;
        }
    }
}
