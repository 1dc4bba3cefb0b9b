/* Canonical states of orbits (symmetry.py, orbits.py).
 *
 * `names` has for each permutation of the group, and then for each movable rebec its blind, what
 * each rebec becomes; `origins` the inverses of the group. The canonical state of an orbit has the
 * least colours, then the least contents of local states (by their hashes), in the order of
 * `positions`, where the movable rebecs come first.
 */
#ifndef REBSYNC_ORBITS_H
#define REBSYNC_ORBITS_H

#include "components.h"

static inline const int32_t *names_of(struct kernel *k, uint32_t number)
{
    return k->names + (size_t)number * k->rebecs;
}

static inline uint32_t origin(struct kernel *k, uint32_t turn, uint32_t rebec)
{
    return (uint32_t)k->origins[(size_t)turn * k->rebecs + rebec];
}

static inline void rename_cell(cell *at, const int32_t *names)
{
    if (*at >= 0)
        *at = names[*at];
}

static void rename_cells(struct kernel *k, enum reference_kind kind, cell key, cell *cells,
                         const int32_t *names)
{
    for (uint32_t i = 0; i < k->symmetries.references; i++)
        if (k->references[i].kind == (int32_t)kind && k->references[i].key == key)
            rename_cell(cells + k->references[i].cell, names);
}

static void rename_message(struct kernel *k, cell *message, const int32_t *names)
{
    rename_cell(message + SENDER, names);
    rename_cells(k, OF_ARGUMENT, message[SERVER], message + ARGUMENTS, names);
}

/* Renames the rebecs in a local state; the bag stays sorted. */
static void rename_local(struct kernel *k, uint32_t rebec, struct local *l, const int32_t *names)
{
    size_t stride = k->model->stride, messages = l->messages;
    rename_cells(k, OF_VARIABLE, rebec, l->variables, names);
    l->messages = 0;
    for (size_t i = 0; i < messages; i++) {
        memcpy(k->result.message, l->bag + i * stride, stride * sizeof(cell));
        rename_message(k, k->result.message, names);
        insert_message(k, l, k->result.message);
    }
    if (l->frame_count)
        rename_message(k, l->message, names);
    for (size_t i = 0, at = 0; i < l->frame_count; i++, at += 2 + (size_t)l->frames[at + 1])
        rename_cells(k, OF_FRAME, l->frames[at], l->frames + at + 2, names);
}

static uint32_t compute_renamed(struct kernel *k, uint32_t rebec, uint32_t id, uint32_t number)
{
    struct local *l = &k->scratch;
    const int32_t *names = names_of(k, number);
    unpack_local(k, rebec, id, l);
    rename_local(k, rebec, l, names);
    enlarge_memo(k, &k->actors[rebec].renamed, k->actors[rebec].components.count);
    if (number < k->symmetries.order)
        return number_of(k, (uint32_t)names[rebec], l);
    pack_local(k, rebec, l);
    return (uint32_t)hash_of(k->text.data, k->text.count);
}

/* The number of a local state under a permutation, or the hash of one behind a blind. */
static inline uint32_t renamed(struct kernel *k, uint32_t rebec, uint32_t id, uint32_t number)
{
    struct memo *memo = &k->actors[rebec].renamed;
    uint32_t value = recall(memo, id, number);
    return value != NONE ? value : memorise(memo, id, number, compute_renamed(k, rebec, id, number));
}

/* What tells a rebec apart whatever rebecs are called: its own local state, and those of others as
 * they speak of it. Equal colours of different rebecs cost time, and nothing else. */
static uint64_t colour(struct kernel *k, uint32_t rebec, uint32_t blind)
{
    uint64_t own = 0, others = 0;
    for (uint32_t r = 0; r < k->rebecs; r++) {
        uint64_t hash = mixed(renamed(k, r, k->next[r], blind), (uint64_t)k->orbit[r]);
        if (r == rebec)
            own = hash;
        else
            others += hash;
    }
    return mixed(own, others);
}

/* Whether the state k->next is less under one permutation than under another. */
static int is_less(struct kernel *k, uint32_t one, uint32_t other)
{
    for (uint32_t i = 0; i < k->symmetries.movable; i++) {
        uint32_t rebec = (uint32_t)k->positions[i];
        uint64_t a = k->colours[origin(k, one, rebec)], b = k->colours[origin(k, other, rebec)];
        if (a != b)
            return a < b;
    }
    for (uint32_t i = 0; i < k->rebecs; i++) {
        uint32_t rebec = (uint32_t)k->positions[i];
        uint32_t from = origin(k, one, rebec), to = origin(k, other, rebec);
        uint32_t a = renamed(k, from, k->next[from], one), b = renamed(k, to, k->next[to], other);
        uint64_t first = a == b ? 0 : content_hash(k, rebec, a);
        uint64_t second = a == b ? 0 : content_hash(k, rebec, b);
        if (first != second)
            return first < second;
    }
    return 0;
}

/* Puts the canonical state of its orbit in the place of k->next; k->turn says what leads to it. */
static void make_canonical(struct kernel *k)
{
    k->turn = 0;
    if (k->symmetries.order == 1)
        return;
    for (uint32_t i = 0; i < k->symmetries.movable; i++) {
        uint32_t rebec = (uint32_t)k->positions[i];
        k->colours[rebec] = colour(k, rebec, k->symmetries.order + i);
    }
    for (uint32_t turn = 1; turn < k->symmetries.order; turn++)
        if (is_less(k, turn, k->turn))
            k->turn = turn;
    for (uint32_t r = 0; r < k->rebecs; r++) {
        uint32_t from = origin(k, k->turn, r);
        k->turned[r] = renamed(k, from, k->next[from], k->turn);
    }
    memcpy(k->next, k->turned, k->rebecs * sizeof *k->next);
}

#endif
