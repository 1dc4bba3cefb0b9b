/* Hash compaction: of a visited state its fingerprint of 64 bits is kept, and nothing else.
 *
 * Two states with one fingerprint are taken for one, so that states may be missed (Wolper & Leroy
 * 1993; Stern & Dill 1995); how likely that is compiled.py says. States that wait are whole. Which
 * step has led to a state is written to a file. Local states that no waiting state has are given up,
 * so fingerprints are made of their contents, not of their numbers (kernel.h).
 */
#ifndef REBSYNC_COMPACTION_H
#define REBSYNC_COMPACTION_H

#include "visited.h"

/* --- fingerprints */

static struct shard *shard_of(struct search *s, uint64_t print)
{
    return s->shards + print % SHARDS;
}

static uint64_t place_of(const struct shard *t, uint64_t print)
{
    return (uint64_t)(((unsigned __int128)print * t->slots) >> 64);
}

static uint64_t find_print(const struct shard *t, uint64_t print)
{
    uint64_t at = place_of(t, print);
    while (t->prints[at] && t->prints[at] != print)
        at = at + 1 == t->slots ? 0 : at + 1;
    return at;
}

/* Tables grow by an eighth, and one by one, so that few slots are free at any time. */
static void enlarge_shard(struct search *s, struct shard *t)
{
    struct shard larger = {NULL, t->count, t->slots + t->slots / 8 + SHARD};
    larger.prints = zeroed(s->escape, larger.slots, sizeof *larger.prints);
    for (uint64_t i = 0; i < t->slots; i++)
        if (t->prints[i])
            larger.prints[find_print(&larger, t->prints[i])] = t->prints[i];
    free(t->prints);
    *t = larger;
}

/* Remembers a fingerprint; 0 when it is known. */
static int is_new_print(struct search *s, uint64_t print)
{
    struct shard *t = shard_of(s, print);
    if (20 * (t->count + 1) > 17 * t->slots)
        enlarge_shard(s, t);
    uint64_t at = find_print(t, print);
    if (t->prints[at])
        return 0;
    t->prints[at] = print;
    t->count++;
    return 1;
}

static void prefetch_print(struct search *s, uint64_t print)
{
    const struct shard *t = shard_of(s, print);
    if (t->slots)
        __builtin_prefetch(t->prints + place_of(t, print), 1);
}

static void free_prints(struct search *s)
{
    for (uint32_t i = 0; i < SHARDS; i++) {
        free(s->shards[i].prints);
        s->shards[i] = (struct shard){0};
    }
}

/* --- the steps that have led to states, on the disk */

static void write_arrival(struct search *s, struct arrival arrival)
{
    if (fwrite(&arrival, sizeof arrival, 1, s->arrivals) != 1)
        give_up(s->escape);
}

/* Reads the step to a state; 0 when that cannot be. */
static int read_arrival(struct search *s, uint64_t state, struct arrival *arrival)
{
    int found = !fseek(s->arrivals, (long)(state * sizeof *arrival), SEEK_SET) &&
                fread(arrival, sizeof *arrival, 1, s->arrivals) == 1;
    return !fseek(s->arrivals, 0, SEEK_END) && found;
}

/* --- the local states of states that wait */

/* Gives up the states that have been expanded. */
static void forget_expanded(struct search *s)
{
    uint64_t gone = s->expanded - s->forgotten, left = s->count - s->expanded;
    uint64_t size = s->words * sizeof(uint64_t);
    memmove(s->states.data, s->states.data + gone * size, left * size);
    if (s->times.count)
        memmove(s->times.data, (int64_t *)s->times.data + gone, left * sizeof(int64_t));
    s->times.count = s->times.count ? left : 0;
    s->forgotten = s->expanded;
}

/* Leaves only local states of states that wait; the others are made again when they are met. */
static void collect(struct search *s)
{
    size_t total = 0;
    uint32_t *start = zeroed(s->escape, s->rebecs, sizeof *start);
    for (uint32_t r = 0; r < s->rebecs; r++) {
        start[r] = (uint32_t)total;
        total += kernel_locals(s->kernel, r);
    }
    uint32_t *numbers = calloc(total, sizeof *numbers);
    for (uint64_t state = s->forgotten; numbers && state < s->count; state++) {
        unpack(s, words_of(s, state), s->unpacked);
        for (uint32_t r = 0; r < s->rebecs; r++)
            numbers[start[r] + s->unpacked[r]] = 1;
    }
    if (numbers)
        kernel_collect(s->kernel, numbers);
    for (uint64_t state = s->forgotten; numbers && state < s->count; state++) {
        unpack(s, words_of(s, state), s->unpacked);
        for (uint32_t r = 0; r < s->rebecs; r++)
            s->unpacked[r] = numbers[start[r] + s->unpacked[r]];
        pack(s, s->unpacked, words_of(s, state));
    }
    free(start);
    free(numbers);
    if (!numbers)
        give_up(s->escape);
    size_t size = kernel_size(s->kernel);
    s->collect_at = size + size / 2 > COLLECT ? size + size / 2 : COLLECT;
}

/* Gives up, now and then, what only states need that have been expanded. Nothing is pending. */
static void tidy(struct search *s)
{
    uint64_t gone = s->expanded - s->forgotten, left = s->count - s->expanded;
    int full = kernel_size(s->kernel) > s->collect_at;
    if (full || (gone >= GONE && gone >= left))
        forget_expanded(s);
    if (full)
        collect(s);
}

#endif
