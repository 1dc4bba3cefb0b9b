/* Rounds: the next states of a level, expanded by all threads of a team.
 *
 * What a round leaves is what one thread would have left that had expanded the same states: the
 * same states under the same numbers, the same steps that have led to them, and the same events. So
 * candidates are looked up, stored and judged in the order of the steps that make them. Whatever
 * ends a search in the middle of a round (a violation, a bound, a body that does not end) ends it
 * at the same step: the round leaves nothing then, and one thread expands its states.
 *
 * Numbers of local states are those of one kernel (kernel.h). States are stored in the numbers of the
 * search's kernel, to which nothing happens while threads run; each worker has a kernel of its own.
 */
#ifndef REBSYNC_ROUNDS_H
#define REBSYNC_ROUNDS_H

#include "joining.h"

/* --- between phases: names and places */

static void name_chunk(struct search *s, const struct chunk *chunk)
{
    struct worker *w = chunk->worker;
    for (size_t i = chunk->first; i < chunk->first + chunk->count; i++)
        if (!candidate(w, i)->named)
            for (uint32_t r = 0; r < s->rebecs; r++)
                common_number(s, w, r, candidate_ids(w, i)[r]);
}

/* Lets states have other fields, and all candidates be packed again. */
static void repack_round(struct search *s)
{
    repack(s);
    for (struct worker *w = s->team->worker; w < s->team->worker + s->team->workers; w++) {
        room_for_words(s, s->escape, w);
        for (size_t i = 0; i < w->candidates.count; i++)
            candidate(w, i)->named = 0;
    }
}

/* Names all, and gives all a place behind the states; 0 when there are too many. */
static int lay_out_round(struct search *s)
{
    struct team *t = s->team;
    uint64_t place = s->count;
    for (uint64_t i = 0; i < t->taken; i++) {
        name_chunk(s, t->chunks + i);
        t->chunks[i].place = place;
        place += t->chunks[i].count;
    }
    if (place >= NONE - 2)
        return 0;
    if (s->wide)
        repack_round(s);
    room_for(s->escape, &s->states, place * s->words * sizeof(uint64_t), 1);
    room_for(s->escape, &s->parents, place, sizeof(uint32_t));
    if (s->until != NEVER)
        room_for(s->escape, &s->times, place, sizeof(int64_t));
    return 1;
}

/* --- second phase: packed, where all see them */

static void place_chunks(struct worker *w)
{
    struct search *s = w->search;
    size_t size = s->words * sizeof(uint64_t);
    memset(w->owned, 0, s->shares * sizeof *w->owned);
    for (struct chunk *chunk = s->team->chunks; chunk < s->team->chunks + s->team->taken; chunk++) {
        if (chunk->worker != w)
            continue;
        for (size_t i = 0; i < chunk->count; i++) {
            const struct candidate *c = candidate(w, chunk->first + i);
            if (!c->named)
                name_candidate(w, chunk->first + i);
            memcpy(words_of(s, chunk->place + i), candidate_words(w, chunk->first + i), size);
            w->owned[kernel_owner(c->hash, s->shares)]++;
        }
    }
}

static void fill_own_share(struct worker *w)
{
    fill_share(w->search, w->number);
}

static int some_share_is_full(struct search *s)
{
    for (uint32_t share = 0; share < s->shares; share++) {
        uint64_t more = 0;
        for (uint32_t i = 0; i < s->team->workers; i++)
            more += s->team->worker[i].owned[share];
        if (is_full(s, share, more))
            return 1;
    }
    return 0;
}

static void room_for_round(struct search *s)
{
    while (some_share_is_full(s)) {
        make_table(s, larger_table(s));
        all_do(s, fill_own_share);
    }
}

/* --- third phase: into the table, each worker into its share */

static void insert_own(struct worker *w)
{
    struct search *s = w->search;
    w->inserted = 0;
    for (struct chunk *chunk = s->team->chunks; chunk < s->team->chunks + s->team->taken; chunk++) {
        for (size_t i = 0; i < chunk->count; i++) {
            const struct candidate *c = candidate(chunk->worker, chunk->first + i);
            if (kernel_owner(c->hash, s->shares) == w->number)
                __builtin_prefetch(s->table + slot_of(s, c->hash), 1);
        }
        for (size_t i = 0; i < chunk->count; i++) {
            struct candidate *c = candidate(chunk->worker, chunk->first + i);
            if (kernel_owner(c->hash, s->shares) != w->number)
                continue;
            uint64_t place = chunk->place + i;
            c->slot = find(s, words_of(s, place), c->hash);
            c->fresh = !s->table[c->slot];
            if (!c->fresh)
                continue;
            s->table[c->slot] = tag_of(s, c->hash) | (uint32_t)(place + 1);
            w->inserted++;
        }
    }
}

/* Takes all of them out again, and nothing that came earlier can have been behind them. */
static void take_out(struct search *s)
{
    struct team *t = s->team;
    for (struct chunk *chunk = t->chunks; t->inserted && chunk < t->chunks + t->taken; chunk++)
        for (size_t i = 0; i < chunk->count; i++) {
            const struct candidate *c = candidate(chunk->worker, chunk->first + i);
            if (c->fresh)
                s->table[c->slot] = 0;
        }
    t->inserted = 0;
}

/* --- fourth phase: judged under their numbers among the candidates */

static void judge_chunks(struct worker *w)
{
    struct search *s = w->search;
    for (struct chunk *chunk = s->team->chunks; chunk < s->team->chunks + s->team->taken; chunk++) {
        if (chunk->worker != w)
            continue;
        for (size_t i = chunk->first; i < chunk->first + chunk->count; i++) {
            const struct candidate *c = candidate(w, i);
            chunk->fresh += c->fresh;
            if (c->fresh && is_asked(s))
                judge(w->judge, candidate_ids(w, i), (int64_t)i);
            if (c->fresh && c->deadlock)
                note_deadlock(w->judge, (int64_t)i);
        }
    }
}

/* --- fifth phase: stored under their numbers */

static void store_chunks(struct worker *w)
{
    struct search *s = w->search;
    for (struct chunk *chunk = s->team->chunks; chunk < s->team->chunks + s->team->taken; chunk++) {
        uint64_t number = chunk->number;
        for (size_t i = chunk->first; chunk->worker == w && i < chunk->first + chunk->count; i++) {
            struct candidate *c = candidate(w, i);
            if (!c->fresh)
                continue;
            memcpy(words_of(s, number), candidate_words(w, i), s->words * sizeof(uint64_t));
            ((uint32_t *)s->parents.data)[number] = c->parent;
            if (s->until != NEVER)
                ((int64_t *)s->times.data)[number] = c->time;
            s->table[c->slot] = tag_of(s, c->hash) | (uint32_t)(number + 1);
            c->number = (uint32_t)number++;
        }
    }
}

/* --- what it leaves */

static void forget_round(struct search *s)
{
    for (uint32_t i = 0; i < s->team->workers; i++) {
        struct worker *w = s->team->worker + i;
        w->candidates.count = w->states.count = w->looked_up = 0;
        w->transitions = w->dropped = 0;
        w->judge->events.count = 0;
        w->judge->violated = 0;
        measure_nothing(w->judge);
    }
}

/* All that the workers know of the round becomes part of the search; what can fail comes first. */
static void complete_round(struct search *s, uint64_t fresh)
{
    struct team *t = s->team;
    note_all(s);
    t->inserted = 0;
    s->count += fresh;
    s->parents.count = s->count;
    s->times.count = s->until == NEVER ? 0 : s->count;
    s->expanded += t->taken * CHUNK < t->end - t->first ? t->taken * CHUNK : t->end - t->first;
    for (uint32_t i = 0; i < t->workers; i++) {
        struct worker *w = t->worker + i;
        s->taken[i] += w->inserted;
        s->transitions += w->transitions;
        s->dropped += w->dropped;
        for (int32_t m = 0; m < s->model->measures; m++)
            join_measured(w, s->judge->measured + m, w->judge->measured + m);
        kernel_covered(w->kernel, w->served, w->covered, w->largest);
    }
}

/* --- a round */

static void begin_round(struct search *s, int64_t due)
{
    struct team *t = s->team;
    uint64_t left = s->level_end - s->expanded;
    t->first = s->expanded;
    t->end = t->first + (left < ROUND ? left : ROUND);
    t->chunk_count = (t->end - t->first + CHUNK - 1) / CHUNK;
    t->next = t->workers;
    t->enough = t->stop = t->refused = t->inserted = 0;
    t->due = due;
    if (s->wide)
        repack(s);
}

/* Whether the round has to be left to one thread: it ends the search, or would end it at once. */
static int is_spoilt(struct search *s)
{
    for (uint32_t i = 0; i < s->team->workers; i++)
        if (s->team->worker[i].answer != COMPLETE || s->team->worker[i].judge->violated)
            return 1;
    return 0;
}

static uint64_t number_chunks(struct team *t, uint64_t count)
{
    uint64_t number = count;
    for (uint64_t i = 0; i < t->taken; i++) {
        t->chunks[i].number = number;
        number += t->chunks[i].fresh;
    }
    return number - count;
}

/* One round; 0 when it is left to one thread. */
static int make_round(struct search *s, uint64_t states, int64_t due)
{
    struct team *t = s->team;
    begin_round(s, due);
    all_do(s, expand_chunks);
    t->taken = t->next < t->chunk_count ? t->next : t->chunk_count;
    if (is_spoilt(s) || !lay_out_round(s))
        return 0;
    all_do(s, place_chunks);
    room_for_round(s);
    t->inserted = 1;
    all_do(s, insert_own);
    all_do(s, judge_chunks);
    uint64_t fresh = number_chunks(t, s->count);
    if (is_spoilt(s) || s->count + fresh >= states)
        return 0;
    all_do(s, store_chunks);
    complete_round(s, fresh);
    return 1;
}

/* What became of an attempt to expand states together. */
enum attempt { DECLINED, EXPANDED, REFUSED };

/* Lets the team expand the next states, if they are enough to be worth it. */
static enum attempt expand_together(struct search *s, uint64_t states, int64_t due)
{
    struct team *t = s->team;
    if (!t || t->disbanded || s->expanded < t->alone || s->level_end - s->expanded < WORTH)
        return DECLINED;
    flush(s);
    struct escape outside = *s->escape;
    int escaped = setjmp(s->escape->to), done = 0;
    if (!escaped) {
        if (start_threads(t))
            done = make_round(s, states, due);
        else
            disband(t);
    }
    *s->escape = outside;
    if (escaped || !done)
        take_out(s);
    if (escaped == NO_MEMORY)
        disband(t);
    if (!s->table)
        fill_table(s, s->slots);
    if (t->disbanded)
        return DECLINED;
    forget_round(s);
    t->alone = done || t->refused ? 0 : t->first + ROUND;
    return t->refused ? REFUSED : done ? EXPANDED : DECLINED;
}

#endif
