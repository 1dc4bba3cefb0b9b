/* Canonical states of orbits (symmetry.py, orbits.py).
 *
 * `names` has for each permutation of the group, and then for each movable rebec its blind, what
 * each rebec becomes; `origins` the inverses of the group. The canonical state of an orbit has the
 * least colours, then the least contents of local states (by their hashes), in the order of
 * `positions`, where the movable rebecs come first.
 */
#ifndef REBSYNC_ORBITS_H
#define REBSYNC_ORBITS_H

#include "storing.h"

static inline const int32_t *names_of(struct engine *e, uint32_t number)
{
    return e->names + (size_t)number * e->rebecs;
}

static inline uint32_t origin(struct engine *e, uint32_t turn, uint32_t rebec)
{
    return (uint32_t)e->origins[(size_t)turn * e->rebecs + rebec];
}

static inline void rename_cell(cell *at, const int32_t *names)
{
    if (*at >= 0)
        *at = names[*at];
}

static void rename_cells(struct engine *e, enum reference_kind kind, cell key, cell *cells,
                         const int32_t *names)
{
    for (uint32_t i = 0; i < e->symmetries.references; i++)
        if (e->references[i].kind == (int32_t)kind && e->references[i].key == key)
            rename_cell(cells + e->references[i].cell, names);
}

static void rename_message(struct engine *e, cell *message, const int32_t *names)
{
    rename_cell(message + SENDER, names);
    rename_cells(e, OF_ARGUMENT, message[SERVER], message + ARGUMENTS, names);
}

/* Renames the rebecs in a local state; the bag stays sorted. */
static void rename_local(struct engine *e, uint32_t rebec, struct local *l, const int32_t *names)
{
    size_t stride = e->model->stride, messages = l->messages;
    rename_cells(e, OF_VARIABLE, rebec, l->variables, names);
    l->messages = 0;
    for (size_t i = 0; i < messages; i++) {
        memcpy(e->result.message, l->bag + i * stride, stride * sizeof(cell));
        rename_message(e, e->result.message, names);
        insert_message(e, l, e->result.message);
    }
    if (l->frame_count)
        rename_message(e, l->message, names);
    for (size_t i = 0, at = 0; i < l->frame_count; i++, at += 2 + (size_t)l->frames[at + 1])
        rename_cells(e, OF_FRAME, l->frames[at], l->frames + at + 2, names);
}

static uint32_t compute_renamed(struct engine *e, uint32_t rebec, uint32_t id, uint32_t number)
{
    struct local *l = &e->scratch;
    const int32_t *names = names_of(e, number);
    unpack_local(e, rebec, id, l);
    rename_local(e, rebec, l, names);
    enlarge_memo(e, &e->actors[rebec].renamed, e->actors[rebec].components.count);
    if (number < e->symmetries.order)
        return number_of(e, (uint32_t)names[rebec], l);
    pack_local(e, rebec, l);
    return (uint32_t)hash_of(e->text.data, e->text.count);
}

/* The number of a local state under a permutation, or the hash of one behind a blind. */
static inline uint32_t renamed(struct engine *e, uint32_t rebec, uint32_t id, uint32_t number)
{
    uint64_t key = (uint64_t)id << 32 | number;
    struct remembered *known = remembered(&e->actors[rebec].renamed, key);
    if (known->key == key)
        return known->value;
    uint32_t value = compute_renamed(e, rebec, id, number);
    known = remembered(&e->actors[rebec].renamed, key);
    known->key = key;
    return known->value = value;
}

/* What tells a rebec apart whatever rebecs are called: its own local state, and those of others as
 * they speak of it. Equal colours of different rebecs cost time, and nothing else. */
static uint64_t colour(struct engine *e, uint32_t rebec, uint32_t blind)
{
    uint64_t own = 0, others = 0;
    for (uint32_t r = 0; r < e->rebecs; r++) {
        uint64_t hash = mixed(renamed(e, r, e->next[r], blind), (uint64_t)e->orbit[r]);
        if (r == rebec)
            own = hash;
        else
            others += hash;
    }
    return mixed(own, others);
}

/* Whether the state e->next is less under one permutation than under another. */
static int is_less(struct engine *e, uint32_t one, uint32_t other)
{
    for (uint32_t i = 0; i < e->symmetries.movable; i++) {
        uint32_t rebec = (uint32_t)e->positions[i];
        uint64_t a = e->colours[origin(e, one, rebec)], b = e->colours[origin(e, other, rebec)];
        if (a != b)
            return a < b;
    }
    for (uint32_t i = 0; i < e->rebecs; i++) {
        uint32_t rebec = (uint32_t)e->positions[i];
        uint32_t from = origin(e, one, rebec), to = origin(e, other, rebec);
        uint32_t a = renamed(e, from, e->next[from], one), b = renamed(e, to, e->next[to], other);
        uint64_t first = a == b ? 0 : content_hash(e, rebec, a);
        uint64_t second = a == b ? 0 : content_hash(e, rebec, b);
        if (first != second)
            return first < second;
    }
    return 0;
}

/* Puts the canonical state of its orbit in the place of e->next; e->turn says what leads to it. */
static void make_canonical(struct engine *e)
{
    e->turn = 0;
    if (e->symmetries.order == 1)
        return;
    for (uint32_t i = 0; i < e->symmetries.movable; i++) {
        uint32_t rebec = (uint32_t)e->positions[i];
        e->colours[rebec] = colour(e, rebec, e->symmetries.order + i);
    }
    for (uint32_t turn = 1; turn < e->symmetries.order; turn++)
        if (is_less(e, turn, e->turn))
            e->turn = turn;
    for (uint32_t r = 0; r < e->rebecs; r++) {
        uint32_t from = origin(e, e->turn, r);
        e->turned[r] = renamed(e, from, e->next[from], e->turn);
    }
    memcpy(e->next, e->turned, e->rebecs * sizeof *e->next);
}

#endif
