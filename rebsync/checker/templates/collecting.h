/* Local states that are given up; those that are met again are made again. */
#ifndef REBSYNC_COLLECTING_H
#define REBSYNC_COLLECTING_H

#include "components.h"

static size_t size_of_locals(const struct kernel *k)
{
    size_t size = k->outcomes.count * sizeof(struct outcome) + k->sends.count * sizeof(struct send);
    size += k->messages.count * (size_t)k->model->stride * sizeof(cell);
    for (uint32_t r = 0; r < k->rebecs; r++) {
        const struct actor *a = k->actors + r;
        size += a->bytes.count + a->components.count * (sizeof(struct component) + 2 * sizeof(uint64_t));
    }
    return size;
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
static void collect_actor(struct kernel *k, uint32_t rebec, uint32_t *numbers)
{
    struct actor *a = k->actors + rebec;
    uint32_t count = (uint32_t)a->components.count, left = 0;
    size_t bytes = 0;
    for (uint32_t id = 0; id < count; id++) {
        if (!numbers[id])
            continue;
        size_t length = length_of(a, id);
        struct component *c = component(k, rebec, left);
        memmove(a->bytes.data + bytes, a->bytes.data + component(k, rebec, id)->at, length);
        *c = *component(k, rebec, id);
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

/* What is known of local states by their numbers, and of outcomes, which have such numbers. */
static void forget_outcomes(struct kernel *k)
{
    for (uint32_t r = 0; r < k->rebecs; r++)
        if (k->model->observed[r])
            memset(k->observed[r].ids, 255, sizeof k->observed[r].ids);
    k->outcomes.count = k->sends.count = k->messages.count = 0;
    free(k->message_table);
    k->message_table = NULL;
    k->message_mask = 0;
}

#endif
