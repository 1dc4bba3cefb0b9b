/* States on their way in a search by several shards: batches in memory, and as bytes. */
#ifndef REBSYNC_SHARD_H
#define REBSYNC_SHARD_H

#include "fingerprints.h"

/* A set of states, each as one number for each rebec, in the order in which they came. */
struct tuples {
    struct vector ids;
    uint32_t *table; /* positions from 1 on; 0 is free */
    uint64_t slots, count;
};

/* What is known of a state besides what it is: its own number and that of its parent in the search,
 * the code of the step between, the time of arrival, and where it is among the tuples. */
struct record {
    uint64_t number, parent;
    int64_t time;
    uint32_t code, at;
    int32_t deadlock;
};

/* States with what is known of each. */
struct batch {
    struct tuples states;
    struct vector records;
};

static inline uint32_t *tuple_at(const struct tuples *t, uint32_t rebecs, uint64_t at)
{
    return (uint32_t *)t->ids.data + at * rebecs;
}

static inline struct record *record_at(const struct batch *b, uint64_t at)
{
    return (struct record *)b->records.data + at;
}

/* The slot of a state, or the free one where it would be. */
static uint64_t slot_of_tuple(const struct tuples *t, uint32_t rebecs, const uint32_t *ids)
{
    size_t size = rebecs * sizeof *ids;
    uint64_t at = (uint64_t)(((unsigned __int128)hash_of(ids, size) * t->slots) >> 64);
    while (t->table[at] && memcmp(tuple_at(t, rebecs, t->table[at] - 1), ids, size))
        at = at + 1 == t->slots ? 0 : at + 1;
    return at;
}

static void fill_tuples(struct escape *out, struct tuples *t, uint32_t rebecs, uint64_t slots)
{
    free(t->table);
    t->table = NULL;
    t->table = zeroed(out, slots, sizeof *t->table);
    t->slots = slots;
    for (uint64_t i = 0; i < t->count; i++)
        t->table[slot_of_tuple(t, rebecs, tuple_at(t, rebecs, i))] = (uint32_t)i + 1;
}

/* Where a state is in the set; NONE if it is not there. */
static uint32_t find_tuple(const struct tuples *t, uint32_t rebecs, const uint32_t *ids)
{
    return t->slots ? t->table[slot_of_tuple(t, rebecs, ids)] - 1 : NONE;
}

/* Puts a state into the set unless it is there; gives where it is. */
static uint32_t add_tuple(struct escape *out, struct tuples *t, uint32_t rebecs, const uint32_t *ids)
{
    if (t->count >= NONE - 2)
        give_up(out);
    if (10 * (t->count + 1) >= 6 * t->slots)
        fill_tuples(out, t, rebecs, t->slots ? 2 * t->slots : TABLE);
    uint64_t slot = slot_of_tuple(t, rebecs, ids);
    if (!t->table[slot]) {
        size_t size = rebecs * sizeof *ids;
        room_for(out, &t->ids, (t->count + 1) * size, 1);
        memcpy(tuple_at(t, rebecs, t->count), ids, size);
        t->table[slot] = (uint32_t)++t->count;
    }
    return t->table[slot] - 1;
}

static void free_tuples(struct tuples *t)
{
    free(t->ids.data);
    free(t->table);
    *t = (struct tuples){0};
}

static void free_batch(struct batch *b)
{
    free_tuples(&b->states);
    free(b->records.data);
    *b = (struct batch){0};
}

/* Breadth-first order: of two ways to a state the one of the parent that came first is kept. */
static int compare_records(const void *one, const void *two)
{
    const struct record *a = one, *b = two;
    if (a->parent != b->parent)
        return a->parent < b->parent ? -1 : 1;
    return (a->code > b->code) - (a->code < b->code);
}

/* Puts a state into a batch, or keeps the earlier of two ways to it. */
static void add_record(struct escape *out, struct batch *b, uint32_t rebecs, const uint32_t *ids,
                       struct record record)
{
    uint64_t before = b->states.count;
    record.at = add_tuple(out, &b->states, rebecs, ids);
    if (b->states.count > before)
        *(struct record *)added(out, &b->records, sizeof record) = record;
    else if (compare_records(&record, record_at(b, record.at)) < 0)
        *record_at(b, record.at) = record;
}

/* --- batches as bytes: columns of what is known of states, the contents of the local states that they
 * are made of, each once, and for each rebec a column of the numbers of these */

struct writer {
    struct kernel *kernel;
    struct escape *escape;
    struct vector bytes, marks, locals; /* of a rebec: new numbers, counted from 1, and the old ones */
};

struct reader {
    struct kernel *kernel;
    struct escape *escape;
    const unsigned char *at;
    struct vector numbers;
};

enum { NUMBERED = 1, TIMED = 2 };

static void put(struct writer *w, const void *data, size_t size)
{
    memcpy(room_for(w->escape, &w->bytes, w->bytes.count + size, 1) + w->bytes.count, data, size);
    w->bytes.count += size;
}

static void take(struct reader *r, void *data, size_t size)
{
    memcpy(data, r->at, size);
    r->at += size;
}

/* Bytes that hold numbers below `count`. */
static size_t width_of(uint64_t count)
{
    return count <= 1 << 8 ? 1 : count <= 1 << 16 ? 2 : 4;
}

/* Local states of a rebec in the order in which the states have them. */
static void put_locals(struct writer *w, const struct batch *b, uint32_t rebecs, uint32_t rebec)
{
    size_t size = kernel_locals(w->kernel, rebec) * sizeof(uint32_t);
    uint32_t *marks = memset(room_for(w->escape, &w->marks, size + 1, 1), 0, size);
    w->locals.count = 0;
    for (uint64_t i = 0; i < b->records.count; i++) {
        uint32_t local = tuple_at(&b->states, rebecs, record_at(b, i)->at)[rebec];
        if (marks[local])
            continue;
        *(uint32_t *)added(w->escape, &w->locals, sizeof local) = local;
        marks[local] = (uint32_t)w->locals.count;
    }
    uint32_t count = (uint32_t)w->locals.count;
    put(w, &count, sizeof count);
    for (uint32_t i = 0; i < count; i++) {
        const unsigned char *content;
        uint32_t local = ((uint32_t *)w->locals.data)[i];
        uint32_t length = (uint32_t)kernel_content(w->kernel, rebec, local, &content);
        put(w, &length, sizeof length);
        put(w, content, length);
    }
    for (uint64_t i = 0; i < b->records.count; i++) {
        uint32_t number = marks[tuple_at(&b->states, rebecs, record_at(b, i)->at)[rebec]] - 1;
        put(w, &number, width_of(count));
    }
}

/* Writes a batch, into the bytes of the writer alone. Numbers go in low bytes first. */
static void put_batch(struct writer *w, const struct batch *b, uint32_t rebecs, uint64_t kind)
{
    uint64_t states = b->records.count;
    w->bytes.count = 0;
    put(w, &states, sizeof states);
    put(w, &kind, sizeof kind);
    for (uint64_t i = 0; kind & NUMBERED && i < states; i++)
        put(w, &record_at(b, i)->number, sizeof(uint64_t));
    for (uint64_t i = 0; i < states; i++)
        put(w, &record_at(b, i)->parent, sizeof(uint64_t));
    for (uint64_t i = 0; i < states; i++)
        put(w, &record_at(b, i)->code, sizeof(uint32_t));
    for (uint64_t i = 0; kind & TIMED && i < states; i++)
        put(w, &record_at(b, i)->time, sizeof(int64_t));
    for (uint64_t i = 0; i < states; i++)
        put(w, &record_at(b, i)->deadlock, 1);
    for (uint32_t r = 0; states && r < rebecs; r++)
        put_locals(w, b, rebecs, r);
}

/* Reads the local states of a rebec, and its column in the states. */
static void take_locals(struct reader *r, uint32_t rebecs, uint32_t rebec, uint64_t states, uint32_t *ids)
{
    uint32_t count, length;
    take(r, &count, sizeof count);
    uint32_t *numbers = room_for(r->escape, &r->numbers, count, sizeof *numbers);
    for (uint32_t i = 0; i < count; i++) {
        take(r, &length, sizeof length);
        numbers[i] = kernel_number(r->kernel, rebec, r->at);
        r->at += length;
        if (numbers[i] == NONE)
            give_up(r->escape);
    }
    for (uint64_t i = 0; i < states; i++) {
        uint32_t number = 0;
        take(r, &number, width_of(count));
        ids[i * rebecs + rebec] = numbers[number];
    }
}

/* Reads a batch: room for its states and for what is known of them, filled. Gives how many. */
static uint64_t take_batch(struct reader *r, uint32_t rebecs, struct vector *ids, struct vector *records)
{
    uint64_t states, kind;
    take(r, &states, sizeof states);
    take(r, &kind, sizeof kind);
    struct record *known = room_for(r->escape, records, states, sizeof *known);
    memset(known, 0, states * sizeof *known);
    for (uint64_t i = 0; kind & NUMBERED && i < states; i++)
        take(r, &known[i].number, sizeof(uint64_t));
    for (uint64_t i = 0; i < states; i++)
        take(r, &known[i].parent, sizeof(uint64_t));
    for (uint64_t i = 0; i < states; i++)
        take(r, &known[i].code, sizeof(uint32_t));
    for (uint64_t i = 0; kind & TIMED && i < states; i++)
        take(r, &known[i].time, sizeof(int64_t));
    for (uint64_t i = 0; i < states; i++)
        take(r, &known[i].deadlock, 1);
    room_for(r->escape, ids, states * rebecs, sizeof(uint32_t));
    for (uint32_t rebec = 0; states && rebec < rebecs; rebec++)
        take_locals(r, rebecs, rebec, states, (uint32_t *)ids->data);
    return states;
}

#endif
