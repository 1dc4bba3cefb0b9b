/* Strongly connected components of numbered nodes, with one number a node (Pearce, 2016), in stretches.
 *
 * The same as temporal/components.py, with the same numbers: an edge between components goes to the one
 * with the higher number. Whoever includes this says what the edges are, by `successor`. */
#ifndef REBSYNC_PEARCE_H
#define REBSYNC_PEARCE_H

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { SKIPPED = -1, NO_MORE = -2 };

struct pearce {
    const void *of;
    uint64_t nodes, at, trailing, waiting, closed;
    int32_t *rank; /* 0: not met; then an order, at last the component, above 0 */
    int32_t *trail, *closing, *members;
    uint32_t *position; /* the next edge to follow */
    unsigned char *is_root;
    int32_t order, component;
};

/* Edge i of a node: the node that it leads to, SKIPPED or NO_MORE. */
static int64_t successor(const void *of, uint64_t node, uint64_t i);

static void pearce_end(struct pearce *p)
{
    free(p->position);
    free(p->trail);
    free(p->closing);
    free(p->is_root);
    p->position = NULL;
    p->trail = p->closing = NULL;
    p->is_root = NULL;
}

/* `rank` is of zeros. If not NULL, `members` gets the nodes of each component side by side, those of the
 * highest number first. 0 without memory. */
static int pearce_begin(struct pearce *p, const void *of, uint64_t nodes, int32_t *rank, int32_t *members)
{
    uint64_t count = nodes + 1;
    *p = (struct pearce){.of = of, .nodes = nodes, .rank = rank, .members = members};
    p->order = 1;
    p->component = (int32_t)nodes;
    p->position = calloc(count, sizeof *p->position);
    p->trail = malloc(count * sizeof *p->trail);
    p->closing = malloc(count * sizeof *p->closing);
    p->is_root = malloc(count);
    if (!p->position || !p->trail || !p->closing || !p->is_root) {
        pearce_end(p);
        return 0;
    }
    memset(p->is_root, 1, count);
    return 1;
}

static void pearce_enter(struct pearce *p, int64_t node)
{
    p->rank[node] = p->order++;
    p->trail[p->trailing++] = (int32_t)node;
}

static void pearce_close(struct pearce *p, int32_t node)
{
    p->rank[node] = p->component;
    p->order--;
    if (p->members)
        p->members[p->closed++] = node;
}

static void pearce_leave(struct pearce *p, int32_t node, int32_t low)
{
    p->trailing--;
    if (!p->is_root[node]) {
        p->closing[p->waiting++] = node;
        return;
    }
    while (p->waiting && p->rank[p->closing[p->waiting - 1]] >= low)
        pearce_close(p, p->closing[--p->waiting]);
    pearce_close(p, node);
    p->component--;
}

/* Goes on at the last node of the trail, up to the first successor that was not met. */
static void pearce_follow(struct pearce *p)
{
    int32_t node = p->trail[p->trailing - 1], low = p->rank[node];
    for (;; p->position[node]++) {
        int64_t next = successor(p->of, (uint64_t)node, p->position[node]);
        if (next == SKIPPED)
            continue;
        if (next >= 0 && !p->rank[next]) {
            p->rank[node] = low;
            pearce_enter(p, next); /* then this step is looked at again */
            return;
        }
        if (next == NO_MORE)
            break;
        if (p->rank[next] < low) {
            low = p->rank[next];
            p->is_root[node] = 0;
        }
    }
    p->rank[node] = low;
    pearce_leave(p, node, low);
}

/* Goes on for so many steps; whether there is more to do. */
static int pearce_go_on(struct pearce *p, uint64_t steps)
{
    for (; steps && (p->trailing || p->at < p->nodes); steps--)
        if (p->trailing)
            pearce_follow(p);
        else if (!p->rank[p->at++])
            pearce_enter(p, (int64_t)p->at - 1);
    return p->trailing || p->at < p->nodes;
}

#endif
