/* Hash compaction: of a visited state its fingerprint of 64 bits is kept, and nothing else.
 *
 * Two states with one fingerprint are taken for one, so that states may be missed (Wolper & Leroy
 * 1993; Stern & Dill 1995); how likely that is compiled.py says. States that wait are whole. Which
 * step has led to a state is written to a file. Local states that no waiting state has are given up,
 * so fingerprints are made of their contents, not of their numbers.
 */
#ifndef REBSYNC_COMPACTION_H
#define REBSYNC_COMPACTION_H

#include "visited.h"

/* --- fingerprints */

static uint64_t print_of(struct engine *e, const uint32_t *ids)
{
    uint64_t hash = UINT64_C(0xE7037ED1A0B428DB);
    for (uint32_t r = 0; r < e->rebecs; r++)
        hash = mixed(hash, ((uint64_t *)e->actors[r].hashes.data)[ids[r]]);
    hash = mixed(hash, UINT64_C(0x8EBC6AF09C88C6E3));
    return hash ? hash : 1;
}

static struct shard *shard_of(struct engine *e, uint64_t print)
{
    return e->shards + print % SHARDS;
}

static uint64_t place_of(const struct shard *s, uint64_t print)
{
    return (uint64_t)(((unsigned __int128)print * s->slots) >> 64);
}

static uint64_t find_print(const struct shard *s, uint64_t print)
{
    uint64_t at = place_of(s, print);
    while (s->prints[at] && s->prints[at] != print)
        at = at + 1 == s->slots ? 0 : at + 1;
    return at;
}

/* Tables grow by an eighth, and one by one, so that few slots are free at any time. */
static void enlarge_shard(struct engine *e, struct shard *s)
{
    struct shard larger = {NULL, s->count, s->slots + s->slots / 8 + SHARD};
    larger.prints = zeroed(e, larger.slots, sizeof *larger.prints);
    for (uint64_t i = 0; i < s->slots; i++)
        if (s->prints[i])
            larger.prints[find_print(&larger, s->prints[i])] = s->prints[i];
    free(s->prints);
    *s = larger;
}

/* Remembers a fingerprint; 0 when it is known. */
static int is_new_print(struct engine *e, uint64_t print)
{
    struct shard *s = shard_of(e, print);
    if (20 * (s->count + 1) > 17 * s->slots)
        enlarge_shard(e, s);
    uint64_t at = find_print(s, print);
    if (s->prints[at])
        return 0;
    s->prints[at] = print;
    s->count++;
    return 1;
}

static void prefetch_print(struct engine *e, uint64_t print)
{
    const struct shard *s = shard_of(e, print);
    if (s->slots)
        __builtin_prefetch(s->prints + place_of(s, print), 1);
}

static void free_prints(struct engine *e)
{
    for (uint32_t i = 0; i < SHARDS; i++) {
        free(e->shards[i].prints);
        e->shards[i] = (struct shard){0};
    }
}

/* --- the steps that have led to states, on the disk */

static void write_step(struct engine *e, struct step step)
{
    if (fwrite(&step, sizeof step, 1, e->steps) != 1)
        give_up(e);
}

/* Reads the step to a state; 0 when that cannot be. */
static int read_step(struct engine *e, uint64_t state, struct step *step)
{
    int found = !fseek(e->steps, (long)(state * sizeof *step), SEEK_SET) &&
                fread(step, sizeof *step, 1, e->steps) == 1;
    return !fseek(e->steps, 0, SEEK_END) && found;
}

/* --- the local states of states that wait */

/* Gives up the states that have been expanded. */
static void forget_expanded(struct engine *e)
{
    uint64_t gone = e->expanded - e->forgotten, left = e->count - e->expanded;
    uint64_t size = e->words * sizeof(uint64_t);
    memmove(e->states.data, e->states.data + gone * size, left * size);
    if (e->times.count)
        memmove(e->times.data, (int64_t *)e->times.data + gone, left * sizeof(int64_t));
    e->times.count = e->times.count ? left : 0;
    e->forgotten = e->expanded;
}

static void refill_table(struct actor *a)
{
    memset(a->table, 0, (a->mask + 1) * sizeof *a->table);
    for (uint64_t id = 0; id < a->components.count; id++) {
        uint64_t hash = ((uint64_t *)a->hashes.data)[id] >> 32, at = hash & a->mask;
        while (a->table[at])
            at = (at + 1) & a->mask;
        a->table[at] = hash << 32 | (id + 1);
    }
}

static void empty(struct memo *m)
{
    if (m->entries)
        memset(m->entries, 255, (m->mask + 1) * sizeof *m->entries);
}

/* Leaves the local states of a rebec that are marked in `numbers`, where each gets its new number. */
static void collect_actor(struct engine *e, uint32_t rebec, uint32_t *numbers)
{
    struct actor *a = e->actors + rebec;
    uint32_t count = (uint32_t)a->components.count, left = 0;
    size_t bytes = 0;
    for (uint32_t id = 0; id < count; id++) {
        if (!numbers[id])
            continue;
        size_t length = length_of(a, id);
        struct component *c = component(e, rebec, left);
        memmove(a->bytes.data + bytes, a->bytes.data + component(e, rebec, id)->at, length);
        *c = *component(e, rebec, id);
        c->at = bytes;
        c->outcomes = NONE;
        bytes += length;
        ((uint64_t *)a->hashes.data)[left] = ((uint64_t *)a->hashes.data)[id];
        numbers[id] = left++;
    }
    a->components.count = a->hashes.count = left;
    a->bytes.count = bytes;
    refill_table(a);
    empty(&a->received);
    empty(&a->passed);
    empty(&a->renamed);
}

static size_t size_of_locals(const struct engine *e)
{
    size_t size = e->outcomes.count * sizeof(struct outcome) + e->sends.count * sizeof(struct send);
    size += e->messages.count * (size_t)e->model->stride * sizeof(cell);
    for (uint32_t r = 0; r < e->rebecs; r++) {
        const struct actor *a = e->actors + r;
        size += a->bytes.count + a->components.count * (sizeof(struct component) + 2 * sizeof(uint64_t));
    }
    return size;
}

/* What is known of local states by their numbers, and of outcomes, which have such numbers. */
static void forget_outcomes(struct engine *e)
{
    for (uint32_t r = 0; r < e->rebecs; r++)
        if (e->model->observed[r])
            memset(e->observed[r].ids, 255, sizeof e->observed[r].ids);
    e->outcomes.count = e->sends.count = e->messages.count = 0;
    free(e->message_table);
    e->message_table = NULL;
    e->message_mask = 0;
}

/* Leaves only local states of states that wait; the others are made again when they are met. */
static void collect(struct engine *e)
{
    size_t total = 0;
    uint32_t *start = zeroed(e, e->rebecs, sizeof *start);
    for (uint32_t r = 0; r < e->rebecs; r++) {
        start[r] = (uint32_t)total;
        total += e->actors[r].components.count;
    }
    uint32_t *numbers = calloc(total, sizeof *numbers);
    for (uint64_t state = e->forgotten; numbers && state < e->count; state++) {
        unpack(e, words_of(e, state), e->unpacked);
        for (uint32_t r = 0; r < e->rebecs; r++)
            numbers[start[r] + e->unpacked[r]] = 1;
    }
    for (uint32_t r = 0; numbers && r < e->rebecs; r++)
        collect_actor(e, r, numbers + start[r]);
    for (uint64_t state = e->forgotten; numbers && state < e->count; state++) {
        unpack(e, words_of(e, state), e->unpacked);
        for (uint32_t r = 0; r < e->rebecs; r++)
            e->unpacked[r] = numbers[start[r] + e->unpacked[r]];
        pack(e, e->unpacked, words_of(e, state));
    }
    free(start);
    free(numbers);
    if (!numbers)
        give_up(e);
    forget_outcomes(e);
    size_t size = size_of_locals(e);
    e->collect_at = size + size / 2 > COLLECT ? size + size / 2 : COLLECT;
}

/* Gives up, now and then, what only states need that have been expanded. Nothing is pending. */
static void tidy(struct engine *e)
{
    uint64_t gone = e->expanded - e->forgotten, left = e->count - e->expanded;
    int full = size_of_locals(e) > e->collect_at;
    if (full || (gone >= GONE && gone >= left))
        forget_expanded(e);
    if (full)
        collect(e);
}

#endif
