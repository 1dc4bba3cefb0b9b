/* The order of new states in a level that several workers have reached. */
#ifndef REBSYNC_RANKING_H
#define REBSYNC_RANKING_H

#include "common.h"

/* A way to a new state, as workers tell each other. */
struct way {
    uint64_t parent;
    uint32_t code, list;
};

static int compare_ways(const void *one, const void *two)
{
    const struct way *a = one, *b = two;
    if (a->parent != b->parent)
        return a->parent < b->parent ? -1 : 1;
    return (a->code > b->code) - (a->code < b->code);
}

/* Merges ordered lists of ways, one of each worker: `into` gets for each list, one behind the other, the
 * places of its ways among all. */
int rebsync_rank(const unsigned char *const *lists, const uint64_t *lengths, int count, uint64_t total,
                 uint32_t *into)
{
    enum { WAY = sizeof(uint64_t) + sizeof(uint32_t) };
    struct way *ways = malloc((total + 1) * sizeof *ways);
    uint64_t *next = calloc((size_t)count + 1, sizeof *next), at = 0;
    if (!ways || !next || total >= NONE) {
        free(ways);
        free(next);
        return NO_MEMORY;
    }
    for (int list = 0; list < count; list++) {
        next[list] = at;
        for (uint64_t i = 0; i < lengths[list]; i += WAY, at++) {
            memcpy(&ways[at].parent, lists[list] + i, sizeof ways->parent);
            memcpy(&ways[at].code, lists[list] + i + sizeof ways->parent, sizeof ways->code);
            ways[at].list = (uint32_t)list;
        }
    }
    qsort(ways, total, sizeof *ways, compare_ways);
    for (uint64_t i = 0; i < total; i++)
        into[next[ways[i].list]++] = (uint32_t)i;
    free(ways);
    free(next);
    return COMPLETE;
}

#endif
