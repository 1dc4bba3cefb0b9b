/* Nodes by the time for which they wait, the least first: a radix heap (Ahuja, Mehlhorn, Orlin & Tarjan, 1990). */
#ifndef REBSYNC_RADIX_H
#define REBSYNC_RADIX_H

#include <stdint.h>
#include <stdlib.h>

struct waiter {
    int64_t time;
    int32_t node;
};

/* A bucket has the times that differ from `now` in so many of the lowest bits; no time is before `now`. */
struct radix {
    struct bucket {
        struct waiter *waiters;
        uint64_t count, room;
    } bucket[65];
    int64_t now;
    int full; /* there was no memory for one */
};

static void radix_put(struct radix *r, int32_t node, int64_t time)
{
    uint64_t differing = (uint64_t)(time ^ r->now);
    struct bucket *b = r->bucket + (differing ? 64 - __builtin_clzll(differing) : 0);
    if (b->count == b->room) {
        uint64_t room = b->room ? b->room + b->room / 2 : 64;
        struct waiter *moved = realloc(b->waiters, room * sizeof *moved);
        if (!moved) {
            r->full = 1;
            return;
        }
        b->waiters = moved;
        b->room = room;
    }
    b->waiters[b->count++] = (struct waiter){time, node};
}

/* One of those that wait for the least time; 0 when nobody waits, or one could not be put. */
static int radix_take(struct radix *r, struct waiter *taken)
{
    int i = 0;
    while (i < 65 && !r->bucket[i].count)
        i++;
    if (i == 65 || r->full)
        return 0;
    if (i > 0) {
        struct bucket old = r->bucket[i];
        r->bucket[i] = (struct bucket){0};
        r->now = old.waiters[0].time;
        for (uint64_t w = 1; w < old.count; w++)
            if (old.waiters[w].time < r->now)
                r->now = old.waiters[w].time;
        for (uint64_t w = 0; w < old.count; w++)
            radix_put(r, old.waiters[w].node, old.waiters[w].time);
        free(old.waiters);
    }
    *taken = r->bucket[0].waiters[--r->bucket[0].count];
    return !r->full;
}

static void radix_end(struct radix *r)
{
    for (int i = 0; i < 65; i++)
        free(r->bucket[i].waiters);
}

#endif
