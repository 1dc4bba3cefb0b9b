/* What each worker does by itself in a round: steps of its states, in numbers of its own kernel. */
#ifndef REBSYNC_GATHERING_H
#define REBSYNC_GATHERING_H

#include "storing.h"
#include "team.h"

/* --- numbers of local states in two kernels */

static uint32_t looked_up(const struct vector *numbers, uint32_t number)
{
    return number < numbers->count ? ((uint32_t *)numbers->data)[number] : NONE;
}

static void put_name(struct escape *out, struct vector *numbers, uint32_t number, uint32_t other)
{
    size_t known = numbers->count;
    uint32_t *data = room_for(out, numbers, (size_t)number + 1, sizeof *data);
    if (number >= known) {
        memset(data + known, 255, (number + 1 - known) * sizeof *data);
        numbers->count = (size_t)number + 1;
    }
    data[number] = other;
}

static void put_names(struct escape *out, struct names *n, uint32_t own, uint32_t common)
{
    put_name(out, &n->own, common, own);
    put_name(out, &n->common, own, common);
}

/* The worker's number of a local state that the search's kernel knows. */
static uint32_t own_number(struct worker *w, uint32_t rebec, uint32_t common)
{
    const unsigned char *content;
    uint32_t own = looked_up(&w->names[rebec].own, common);
    if (own != NONE)
        return own;
    kernel_content(w->search->kernel, rebec, common, &content);
    own = kernel_number(w->kernel, rebec, content);
    if (own == NONE)
        give_up(w->escape);
    put_names(w->escape, w->names + rebec, own, common);
    return own;
}

/* The search's number of a local state that a worker knows; only while no thread runs. */
static uint32_t common_number(struct search *s, struct worker *w, uint32_t rebec, uint32_t own)
{
    const unsigned char *content;
    uint32_t common = looked_up(&w->names[rebec].common, own);
    if (common != NONE)
        return common;
    kernel_content(w->kernel, rebec, own, &content);
    common = kernel_number(s->kernel, rebec, content);
    if (common == NONE)
        give_up(s->escape);
    put_names(s->escape, w->names + rebec, own, common);
    return common;
}

/* Packs a state of a worker; 0 when the search's kernel does not know all of it. */
static int pack_own(struct worker *w, const uint32_t *ids, uint64_t *words)
{
    for (uint32_t r = 0; r < w->search->rebecs; r++) {
        w->common[r] = looked_up(&w->names[r].common, ids[r]);
        if (w->common[r] == NONE)
            return 0;
    }
    pack(w->search, w->common, words);
    return 1;
}

static struct candidate *candidate(struct worker *w, size_t i)
{
    return (struct candidate *)w->candidates.data + i;
}

static uint32_t *candidate_ids(struct worker *w, size_t i)
{
    return (uint32_t *)w->states.data + i * w->search->rebecs;
}

static uint64_t *candidate_words(struct worker *w, size_t i)
{
    return (uint64_t *)w->words.data + i * w->search->words;
}

/* States change their size, so room for them is counted in bytes. */
static void room_for_words(struct search *s, struct escape *out, struct worker *w)
{
    room_for(out, &w->words, w->candidates.count * s->words * sizeof(uint64_t), 1);
}

/* Packs and hashes a candidate if all of it has a number of the search's kernel. */
static void name_candidate(struct worker *w, size_t i)
{
    struct candidate *c = candidate(w, i);
    uint64_t *words = candidate_words(w, i);
    c->named = (unsigned char)pack_own(w, candidate_ids(w, i), words);
    if (c->named)
        c->hash = hash_words(w->search, words);
}

/* --- first phase: steps of the states, without those to states that are known */

/* Leaves the candidates that the table does not have. */
static void look_up(struct worker *w)
{
    struct search *s = w->search;
    size_t kept = w->looked_up, first = kept;
    for (size_t i = first; i < w->candidates.count; i++) {
        const struct candidate *c = candidate(w, i);
        const uint64_t *words = candidate_words(w, i);
        if (c->named && s->table[find(s, words, c->hash)])
            continue;
        if (kept < i) {
            *candidate(w, kept) = *c;
            memcpy(candidate_ids(w, kept), candidate_ids(w, i), s->rebecs * sizeof(uint32_t));
            memcpy(candidate_words(w, kept), words, s->words * sizeof *words);
        }
        kept++;
    }
    w->candidates.count = w->states.count = w->looked_up = kept;
}

static void gather_state(struct worker *w, const struct transition *step, int64_t time)
{
    struct search *s = w->search;
    if (step->code > UINT32_MAX)
        give_up(w->escape);
    if (w->candidates.count == w->looked_up + BATCH)
        look_up(w);
    size_t i = w->candidates.count;
    struct candidate *c = added(w->escape, &w->candidates, sizeof *c);
    uint32_t *ids = added(w->escape, &w->states, s->rebecs * sizeof *ids);
    room_for_words(s, w->escape, w);
    memcpy(ids, step->state, s->rebecs * sizeof *ids);
    *c = (struct candidate){.time = time,
                            .parent = (uint32_t)w->parent,
                            .code = (uint32_t)step->code,
                            .deadlock = step->deadlock != 0};
    name_candidate(w, i);
    if (c->named)
        __builtin_prefetch(s->table + slot_of(s, c->hash));
}

/* Takes in a step that a worker's kernel has made. */
static void gather_step(void *worker, const struct transition *step)
{
    struct worker *w = worker;
    struct search *s = w->search;
    int64_t parent = (int64_t)w->parent, time = step->time;
    if (step->state && s->until != NEVER) {
        time += ((int64_t *)s->times.data)[parent];
        if (time > s->until) {
            w->dropped++;
            return;
        }
    }
    w->transitions++;
    if (step->state)
        gather_state(w, step, time);
    else
        note(w->judge, (struct event){step->kind, step->pc, step->rebec, parent, (int64_t)step->code});
}

static void expand_own(struct worker *w, uint64_t state)
{
    struct search *s = w->search;
    size_t made;
    unpack(s, words_of(s, state), w->common);
    for (uint32_t r = 0; r < s->rebecs; r++)
        w->ids[r] = own_number(w, r, w->common[r]);
    w->parent = state;
    expect(w->escape, kernel_successors(w->kernel, w->ids, 1, &made, gather_step, w));
}

/* The chunk behind one: each worker begins with the one of its number, and then takes any that is
 * left. So those that are taken are the first ones. */
static struct chunk *next_chunk(struct worker *w, const struct chunk *before)
{
    struct team *t = w->search->team;
    uint64_t number = w->number;
    if (before) {
        size_t gathered = w->candidates.count * w->search->rebecs;
        if (clock_now() >= t->due || gathered > GATHERED)
            t->enough = 1;
        if (t->enough)
            return NULL;
        number = t->next++;
    }
    return number < t->chunk_count ? t->chunks + number : NULL;
}

static void expand_chunks(struct worker *w)
{
    struct team *t = w->search->team;
    for (struct chunk *c = NULL; (c = next_chunk(w, c));) {
        uint64_t state = t->first + (uint64_t)(c - t->chunks) * CHUNK;
        *c = (struct chunk){.worker = w, .first = w->candidates.count};
        for (uint64_t i = 0; i < CHUNK && state < t->end; i++)
            expand_own(w, state++);
        look_up(w);
        c->count = w->candidates.count - c->first;
        if (w->judge->violated)
            t->enough = 1;
    }
}

#endif
